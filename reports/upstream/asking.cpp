#include "reports/upstream/asking.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <stdexcept>

#include "corpus/files/errors.hpp"
#include "corpus/files/source_folder.hpp"
#include "impl/adapters/motion.hpp"
#include "reports/findings/encoded.hpp"

namespace nearmiss {

namespace {

bool is_of_name(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

}  // namespace

std::string filled_in(std::string_view text, const Words& values) {
  std::string filled;
  for (std::size_t at = 0; at < text.size();) {
    if (text[at] != '$') {
      filled += text[at++];
      continue;
    }
    std::size_t end = at + 1;
    while (end < text.size() && is_of_name(text[end])) ++end;
    const std::string_view name = text.substr(at + 1, end - at - 1);
    const auto value = std::find_if(values.begin(), values.end(), [&](const auto& v) { return v.first == name; });
    if (value == values.end()) throw std::logic_error("no value for $" + std::string(name));
    filled += value->second;
    at = end;
  }
  return filled;
}

std::string include_option(const std::string& folder) {
  const std::filesystem::path path = std::filesystem::path(source_folder()) / folder;
  std::error_code error;
  return std::filesystem::is_directory(path, error) ? " -I " + shell_quoted(path.string()) : "";
}

std::string literal(double x) {
  const std::string text = fmt::format("{}", x);
  return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

std::string literals(const collide::Vec3<double>& v) {
  return fmt::format("{}, {}, {}", literal(v.x), literal(v.y), literal(v.z));
}

namespace {

/// The shape and its numbers by name.
struct ShapeWords {
  Shape shape;
  Words words;
};
ShapeWords words_of(const collide::Sphere<double>& s) {
  return {Shape::sphere, {{"center", literals(s.center)}, {"radius", literal(s.radius)}}};
}
ShapeWords words_of(const collide::Box<double>& b) {
  const auto [x, y, z, w] = adapters::unit(b.orientation);
  return {Shape::box,
          {{"center", literals(b.center)},
           {"half", literals(b.half)},
           {"sides", literals(b.half * 2.0)},
           {"turn", literals({x, y, z}) + ", " + literal(w)},
           {"turn_w_first", literal(w) + ", " + literals({x, y, z})},
           {"axis0", literals({1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)})},
           {"axis1", literals({2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)})},
           {"axis2", literals({2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)})}}};
}
ShapeWords words_of(const collide::Capsule<double>& c) {
  const collide::Vec3<double> along = c.p1 - c.p0;
  const double length = adapters::length(along);
  return {Shape::capsule,
          {{"center", literals(c.p0 * 0.5 + c.p1 * 0.5)},
           {"radius", literal(c.radius)},
           {"length", literal(length)},
           {"along", literals(along)},
           {"direction", literals(along / length)},
           {"p0", literals(c.p0)},
           {"p1", literals(c.p1)}}};
}
ShapeWords words_of(const collide::Plane<double>& p) {
  return {Shape::plane,
          {{"normal", literals(p.normal)},
           {"minus_offset", literal(-p.offset)},
           {"distance", literal(-p.offset / adapters::length(p.normal))}}};
}
/// A plane of these libraries is a half-space.
ShapeWords words_of(const collide::HalfSpace<double>& h) {
  return words_of(collide::Plane<double>{h.normal, h.offset});
}
ShapeWords words_of(const collide::Segment<double>& s) {
  return {Shape::segment, {{"v0", literals(s.v0)}, {"v1", literals(s.v1)}}};
}
ShapeWords words_of(const collide::Triangle<double>& t) {
  return {Shape::triangle, {{"v0", literals(t.v0)}, {"v1", literals(t.v1)}, {"v2", literals(t.v2)}}};
}
ShapeWords words_of(const collide::AABox<double>& b) {
  return {Shape::aabox, {{"min", literals(b.min)}, {"max", literals(b.max)}}};
}

}  // namespace

std::string declared(const NamedShape& shape, std::span<const ShapeText> texts, std::string_view library) {
  return std::visit(
      [&](const auto& s) -> std::string {
        if constexpr (requires { words_of(s); }) {
          auto [kind, words] = words_of(s);
          words.insert(
              words.end(),
              {{"name", shape.name}, {"name_pose", shape.name + "_pose"}, {"name_turn", shape.name + "_turn"}});
          const auto text = std::ranges::find(texts, kind, &ShapeText::shape);
          if (text != texts.end()) {
            if (const auto* c = std::get_if<collide::Capsule<double>>(&shape.shape))
              words.emplace_back("turned",
                                 filled_in(adapters::length(c->p1 - c->p0) > 0 ? text->turned : text->unturned, words));
            return filled_in(text->text, words);
          }
        }
        throw BadInput(fmt::format("{} has no such shape", library));
      },
      shape.shape);
}

Words names_of(const NamedShape& a, const NamedShape& b) {
  return {{"a", a.name}, {"a_pose", a.name + "_pose"}, {"b", b.name}, {"b_pose", b.name + "_pose"}};
}

std::string call(std::string_view text, const NamedShape& a, const NamedShape& b, const Words& more) {
  Words words = names_of(a, b);
  words.insert(words.end(), more.begin(), more.end());
  return filled_in(text, words);
}

std::string indented(std::string_view text) {
  std::string out;
  bool starts = true;
  for (const char c : text) {
    if (starts && c != '\n') out += "  ";
    out += c;
    starts = c == '\n';
  }
  return out;
}

namespace {

std::string identifier(std::string_view prefix, std::string_view member) {
  std::string name = std::string(prefix) + std::string(member);
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
}

}  // namespace

std::string expression_of(const std::string& field) {
  std::string text;
  for (std::size_t at = 0; at < field.size();) {
    const std::size_t end = std::min(field.find('.', at), field.size());
    const std::string part = field.substr(at, end - at);
    const bool number = part.find_first_not_of("0123456789") == std::string::npos;
    text += number ? "[" + part + "]" : (text.empty() ? "" : ".") + part;
    at = end + 1;
  }
  return text;
}

std::string listed_inputs(const Case& question) {
  std::string text;
  for (std::size_t i = 0; i < question.values.size(); ++i)
    text += fmt::format("    {}, /* {} */\n", literal(question.values[i]), question.name(i));
  return text;
}

bool asks_signed_distance(const Query& query) {
  const std::vector<std::string> names = member_names(query);
  return names == std::vector<std::string>{"distance", "normal", "point1", "point2"};
}

std::vector<std::string> member_names(const Query& query) {
  std::vector<std::string> names;
  for (std::size_t m = 0; m < query.layout.parts.size(); ++m) names.push_back(query.layout.parts[m].name);
  return names;
}

std::string take_answer(const Query& query, bool in_c) {
  std::string text = decides(query.kind) ? "got_yes = answer.yes;\n" : "";
  for (std::size_t m = 0; m < query.layout.parts.size(); ++m) {
    const Layout::Part& part = query.layout.parts[m];
    const std::string name = query.layout.parts[m].name;
    if (in_c) text += fmt::format("{} = (int)(answer.given >> {} & 1);\n", flag_of(name), part.begin);
    for (std::size_t i = part.begin; i < part.end; ++i) {
      const std::string index = part.end - part.begin == 1 ? "" : fmt::format("[{}]", i - part.begin);
      text += fmt::format("if (answer.given >> {} & 1) {}{} = answer.values[{}];\n", i, variable_of(name), index, i);
    }
  }
  return text;
}

std::string variable_of(std::string_view member) { return identifier("got_", member); }
std::string flag_of(std::string_view member) { return identifier("gave_", member); }

collide::Capsule<double> way_of_sphere(const CaseShapes& shapes) {
  struct {
    collide::Sphere<double> sphere;
    collide::Vec3<double> velocity;
    double limit;
    bool forever;
  } q;
  const Moving moving = moving_of(shapes);
  q = {{moving.from, moving.radius}, moving.velocity, shapes.number("limit"), shapes.flag("forever")};
  const auto way = adapters::way_of(q, ball_around(target_of(shapes).shape));
  if (!way) throw BadInput(adapters::no_end);
  return *way;
}

Moving moving_of(const CaseShapes& shapes) {
  if (shapes.has("point.x")) return {shapes.vector("point"), 0, shapes.vector("velocity")};
  const collide::Sphere<double> ball = ball_around(shapes.operands().front().shape);
  return {ball.center, ball.radius, shapes.vector("velocity")};
}

NamedShape target_of(const CaseShapes& shapes) {
  const std::vector<NamedShape> all = shapes.operands();
  if (all.empty()) throw std::logic_error("nothing to meet");
  return all.back();  // the moving shape, if any, stands first
}

collide::Sphere<double> ball_around(const TypedShape& shape) {
  return std::visit(
      [](const auto& s) -> collide::Sphere<double> {
        if constexpr (requires { adapters::ball_around(s); }) return adapters::ball_around(s);
        throw std::logic_error("a shape without a ball around it");
      },
      shape);
}

double time_to_pass(const Moving& moving, const NamedShape& target) {
  return std::visit(
      [&](const auto& shape) -> double {
        const auto bound = adapters::bound_of(shape);
        if constexpr (requires { adapters::time_to_pass(moving.from, moving.radius, moving.velocity, bound); })
          return adapters::time_to_pass(moving.from, moving.radius, moving.velocity, bound);
        throw std::logic_error("a shape without a bound");
      },
      target.shape);
}

std::pair<NamedShape, NamedShape> sides_of(const CaseShapes& shapes) {
  if (shapes.has("limit")) return {{"way", way_of_sphere(shapes)}, target_of(shapes)};
  const std::vector<NamedShape> all = shapes.operands();
  if (all.size() != 2) throw std::logic_error("not two shapes");
  return {all[0], all[1]};
}

}  // namespace nearmiss
