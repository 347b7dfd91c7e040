/// The part of an emitted test that asks one library, in the same way as the library's adapter does.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "impl/subject/subject.hpp"
#include "reports/upstream/case_shapes.hpp"

namespace nearmiss {

/// Source text. The statements set `got_yes` and, where the library tells them, the variables of the members, such as
/// `got_depth` and `got_normal[3]`, which are declared before them. In C they also set the flags of the members.
struct Asking {
  enum class Style { googletest, googletest_with_main, main, c };

  Style style = Style::main;
  std::string suite;                 ///< of a GoogleTest
  std::string includes;              ///< lines
  std::string helpers;               ///< declarations outside of the test
  std::string statements;            ///< lines without indentation
  std::vector<std::string> members;  ///< the members of an answer that they may set: "depth"
  std::string build;                 ///< the compiler's command line for the file "test.cpp" or "test.c"
};

/// Each throws BadInput where the library cannot be asked the case.
Asking ask_fcl(const Case& question, const Subject& subject);
Asking ask_libccd(const Case& question, const Subject& subject);
Asking ask_bullet(const Case& question, const Subject& subject);
Asking ask_ode(const Case& question, const Subject& subject);
Asking ask_collide(const Case& question, const Subject& subject);
/// A plugin by its entry, in C.
Asking ask_plugin(const Case& question, const Subject& subject);

/// The text with every "$name" replaced. A name is of letters, digits and underscores.
std::string filled_in(std::string_view text, std::initializer_list<std::pair<std::string_view, std::string>> values);

/// A number that reads back exactly, as a literal of double: "0.5", "1.0".
std::string literal(double x);
/// "1.0, 2.0, 0.5".
std::string literals(const collide::Vec3<double>& v);
/// Every line that is not empty, moved right by two spaces.
std::string indented(std::string_view text);
/// The name of the variable of an answer's member: "got_corners_2_point".
std::string variable_of(std::string_view member);
/// The variable that tells whether a plugin gave the member: "gave_corners_2_point".
std::string flag_of(std::string_view member);

/// What the sphere of a motion with a limit sweeps. Throws BadInput where its end is not finite.
collide::Capsule<double> way_of_sphere(const CaseShapes& shapes);
/// The sphere, point or radius that moves, in the forms that adapters cast.
struct Moving {
  collide::Vec3<double> from;
  double radius;
  collide::Vec3<double> velocity;
};
Moving moving_of(const CaseShapes& shapes);
/// The shape that is met.
NamedShape target_of(const CaseShapes& shapes);
/// A ball around the shape, as adapters choose it for the length of a cast. The shape must be bounded.
collide::Sphere<double> ball_around(const TypedShape& shape);
/// The operands of a query that has two shapes.
std::pair<NamedShape, NamedShape> two_operands(const CaseShapes& shapes);

}  // namespace nearmiss
