#include "reports/upstream/asking.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <stdexcept>

#include "corpus/files/errors.hpp"
#include "impl/adapters/motion.hpp"

namespace nearmiss {

namespace {

bool is_of_name(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

}  // namespace

std::string filled_in(std::string_view text, std::initializer_list<std::pair<std::string_view, std::string>> values) {
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

std::string literal(double x) {
  const std::string text = fmt::format("{}", x);
  return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

std::string literals(const collide::Vec3<double>& v) {
  return fmt::format("{}, {}, {}", literal(v.x), literal(v.y), literal(v.z));
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
  return {shapes.vector("sphere.center"), shapes.number("sphere.radius"), shapes.vector("velocity")};
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

std::pair<NamedShape, NamedShape> two_operands(const CaseShapes& shapes) {
  const std::vector<NamedShape> all = shapes.operands();
  if (all.size() != 2) throw std::logic_error("not two shapes");
  return {all[0], all[1]};
}

}  // namespace nearmiss
