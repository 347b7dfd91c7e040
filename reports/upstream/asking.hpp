/// The part of an emitted test that asks one library, in the same way as the library's adapter does.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "impl/host/engines.hpp"
#include "impl/subject/subject.hpp"
#include "reports/upstream/case_shapes.hpp"

namespace nearmiss {

/// Source text. The statements set `got_yes` and, where the library tells them, the variables of the members, such as
/// `got_depth` and `got_normal[3]`, which are declared before them. In C they also set the flags of the members. In
/// JavaScript they declare `got`, an object with these members and `yes`.
struct Asking {
  enum class Style { googletest, googletest_with_main, main, c, javascript };

  Style style = Style::main;
  std::string suite{};                 ///< of a GoogleTest
  std::string includes{};              ///< lines
  std::string helpers{};               ///< declarations outside of the test
  std::string statements{};            ///< lines without indentation
  std::vector<std::string> members{};  ///< the members of an answer that they may set: "depth"
  std::string build{};                 ///< the compiler's command line for the file "test.cpp" or "test.c"
  std::string packages{};              ///< of Debian, with the library and what the test needs; empty: none
  bool may_leave_out = false;          ///< whether a right answer may lack some of these members
};

/// Each throws BadInput where the library cannot be asked the case.
Asking ask_fcl(const Case& question, const Subject& subject);
Asking ask_libccd(const Case& question, const Subject& subject);
Asking ask_bullet(const Case& question, const Subject& subject);
Asking ask_ode(const Case& question, const Subject& subject);
Asking ask_collide(const Case& question, const Subject& subject);
/// A plugin by its entry, in C.
Asking ask_plugin(const Case& question, const Subject& subject);
/// An engine of this source tree, by what its subject in impl/engines asks: for a package of npm in JavaScript, for a
/// library of Debian in C++.
Asking ask_engine(const Case& question, const Engine& engine);

/// Values by name.
using Words = std::vector<std::pair<std::string_view, std::string>>;
/// The text with every "$name" replaced. A name is of letters, digits and underscores.
std::string filled_in(std::string_view text, const Words& values);

/// How a library declares a shape: $name is its name, $name_pose and $name_turn those of its pose and rotation, and
/// further words are its numbers: $center, $radius, $half, $sides, $turn (x, y, z, w), $turn_w_first, $axis0 to $axis2,
/// $length and $along of a capsule, $direction (along / length), $normal, $minus_offset, $distance (from the origin),
/// $v0, $p0, $min and the like.
struct ShapeText {
  Shape shape;
  std::string_view text;
  std::string_view turned{}, unturned{};  ///< $turned in the text of a capsule: with a length, and without
};
/// Throws BadInput where no text is for the shape: "LIBRARY has no such shape".
std::string declared(const NamedShape& shape, std::span<const ShapeText> texts, std::string_view library);
/// $a, $a_pose, $b and $b_pose: the names of two shapes and of their poses.
Words names_of(const NamedShape& a, const NamedShape& b);

/// A library's statements for the sides of one operation, with the words of names_of() and `more`.
std::string call(std::string_view text, const NamedShape& a, const NamedShape& b, const Words& more = {});

/// " -I FOLDER" of the source tree, for a compiler's command line; empty where the folder is not there.
std::string include_option(const std::string& folder);
/// A number that reads back exactly, as a literal of double: "0.5", "1.0".
std::string literal(double x);
/// "1.0, 2.0, 0.5".
std::string literals(const collide::Vec3<double>& v);
/// Every line that is not empty, moved right by two spaces.
std::string indented(std::string_view text);
/// "corners.2.point.x" as an expression: "corners[2].point.x".
std::string expression_of(const std::string& field);
/// The inputs of a case as the initializers of an array: one line for each number, with its name in a comment.
std::string listed_inputs(const Case& question);
/// The names of all members of an answer.
std::vector<std::string> member_names(const Query& query);
/// Whether the answer is a signed distance with its normal and points.
bool asks_signed_distance(const Query& query);
/// The statements that take what `answer`, a nearmiss_answer, gives; in C with the flags of the members.
std::string take_answer(const Query& query, bool in_c);
/// The name of the variable of an answer's member: "got_corners_2_point".
std::string variable_of(std::string_view member);
/// The variable that tells whether a plugin gave the member: "gave_corners_2_point".
std::string flag_of(std::string_view member);

/// What the sphere of a motion with a limit sweeps. Throws BadInput where its end is not finite.
collide::Capsule<double> way_of_sphere(const CaseShapes& shapes);
/// A ball around the shape that moves, by which adapters choose the length of a cast.
struct Moving {
  collide::Vec3<double> from;
  double radius;
  collide::Vec3<double> velocity;
};
Moving moving_of(const CaseShapes& shapes);
/// The shape that is met.
NamedShape target_of(const CaseShapes& shapes);
template <template <class> class S>
bool is_a(const NamedShape& shape) {
  return std::holds_alternative<S<double>>(shape.shape);
}
/// A ball around the shape, as adapters choose it for the length of a cast. The shape must be bounded.
collide::Sphere<double> ball_around(const TypedShape& shape);
/// The least power of two as a time after which the mover is past the shape.
double time_to_pass(const Moving& moving, const NamedShape& target);
/// The two shapes of a query; for a motion with a limit, the way of the sphere ("way") and the target.
std::pair<NamedShape, NamedShape> sides_of(const CaseShapes& shapes);

}  // namespace nearmiss
