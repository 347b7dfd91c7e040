#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "reports/upstream/asking.hpp"

namespace nearmiss {

namespace collide_text {
namespace {

using namespace collide;

/// Literals of one scalar.
struct Numbers {
  Scalar scalar;

  std::string type() const { return std::string(name_of(scalar)); }
  std::string operator()(double x) const {
    if (scalar == Scalar::float64) return literal(x);
    const std::string text = fmt::format("{}", float(x));
    return text + (text.find_first_of(".e") == std::string::npos ? ".0f" : "f");
  }
  std::string operator()(const Vec3<double>& v) const {
    return fmt::format("{{{}, {}, {}}}", (*this)(v.x), (*this)(v.y), (*this)(v.z));
  }
};

/// "Sphere<float>{{0.0f, 0.0f, 0.0f}, 1.0f}" without the namespace.
struct CollideShape {
  Numbers of;

  std::string made(const char* type, const std::string& members) const {
    return fmt::format("{}<{}>{{{}}}", type, of.type(), members);
  }
  std::string operator()(const Sphere<double>& s) const { return made("Sphere", of(s.center) + ", " + of(s.radius)); }
  std::string operator()(const Box<double>& b) const {
    const auto& [x, y, z, w] = b.orientation;
    return made("Box", fmt::format("{}, {}, {{{}, {}, {}, {}}}", of(b.center), of(b.half), of(x), of(y), of(z), of(w)));
  }
  std::string operator()(const Capsule<double>& c) const {
    return made("Capsule", of(c.p0) + ", " + of(c.p1) + ", " + of(c.radius));
  }
  std::string operator()(const Plane<double>& p) const { return made("Plane", of(p.normal) + ", " + of(p.offset)); }
  std::string operator()(const HalfSpace<double>& h) const {
    return made("HalfSpace", of(h.normal) + ", " + of(h.offset));
  }
  std::string operator()(const Triangle<double>& t) const {
    return made("Triangle", of(t.v0) + ", " + of(t.v1) + ", " + of(t.v2));
  }
  std::string operator()(const AABox<double>& b) const { return made("AABox", of(b.min) + ", " + of(b.max)); }
  std::string operator()(const Rectangle<double>& r) const {
    return made("Rectangle", of(r.v0) + ", " + of(r.v1) + ", " + of(r.v2) + ", " + of(r.v3));
  }
  std::string operator()(const Segment<double>& s) const { return made("Segment", of(s.v0) + ", " + of(s.v1)); }
  std::string operator()(const Line<double>& l) const { return made("Line", of(l.point) + ", " + of(l.direction)); }
  std::string operator()(const Ray<double>& r) const { return made("Ray", of(r.origin) + ", " + of(r.direction)); }
};

/// The argument as the function takes it; some take prepared shapes.
std::string prepared(std::string_view query, const std::string& name, const std::string& tier) {
  const auto by = [&](const char* function) { return fmt::format("collide::{}<{}>({})", function, tier, name); };
  if (query == "closest_point_segment_unit" && name == "segment") return by("prepare_segment");
  if (query == "closest_point_triangle_perimeter_edges" && name == "triangle") return by("prepare_triangle_edges");
  if (query == "moving_point_triangle_prepared" && name == "triangle") return by("prepare_triangle");
  if (query == "ray_aabox" && name == "ray") return by("prepare_ray");
  if (query == "ray_aabox" && name == "aabox") return by("prepare_aabox");
  return name;
}

/// One declaration of each input, and the arguments of the function.
struct Arguments {
  std::string declarations, list;

  void add(const std::string& declaration, const std::string& argument) {
    declarations += "const " + declaration + ";\n";
    list += (list.empty() ? "" : ", ") + argument;
  }
};

Arguments arguments_of(const Case& question, const std::string& tier) {
  const Query& query = *question.query;
  const CaseShapes given(question);
  const Numbers of{question.scalar};
  Arguments a;
  const std::vector<NamedShape> shapes = given.operands();
  for (const InputMember& m : question.operands().members) {
    const Operand* operand = m.operand ? &question.operands()[*m.operand] : nullptr;
    if (m.name == "forever" || (operand != nullptr && m.begin != operand->begin)) continue;
    const std::string& name = operand != nullptr ? operand->name : m.name;
    const auto shape = std::find_if(shapes.begin(), shapes.end(), [&](const NamedShape& o) { return o.name == name; });
    if (shape != shapes.end()) {
      a.add(fmt::format("auto {} = collide::{}", name, std::visit(CollideShape{of}, shape->shape)),
            prepared(query.name, name, tier));
    } else if (m.is_vector()) {
      a.add(fmt::format("collide::Vec3<{}> {}{}", of.type(), name, of(given.vector(name))), name);
    } else if (m.role == Role::flag) {
      a.add(fmt::format("bool {} = {}", name, given.flag(name)), name);
    } else if (m.role == Role::index) {
      a.add(fmt::format("int {} = {}", name, int(given.number(name))), name);
    } else if (given.has("forever") && given.flag("forever")) {
      a.add(fmt::format("{} {} = INFINITY", of.type(), name), name);
    } else {
      a.add(fmt::format("{} {} = {}", of.type(), name, of(given.number(name))), name);
    }
  }
  return a;
}

/// The header of a tier that needs the library collide::certified; empty for another tier.
std::string header_of(const std::string& tier) {
  if (tier == "collide::Decisive") return "decisive.hpp";
  return tier == "collide::Certified" ? "certified.hpp" : "";
}

std::string tier_of(const Subject& subject) {
  static constexpr std::pair<std::string_view, const char*> tiers[] = {
      {"accurate", "collide::Accurate"}, {"decisive", "collide::Decisive"}, {"certified", "collide::Certified"}};
  for (const auto& [word, tier] : tiers) {
    if (subject.name.find(word) != std::string::npos) return tier;
  }
  return "collide::Fast";
}

}  // namespace
}  // namespace collide_text

Asking ask_collide(const Case& question, const Subject& subject) {
  using namespace collide_text;
  const Query& query = *question.query;
  const std::string tier = tier_of(subject);
  const std::string header = header_of(tier);
  const Arguments arguments = arguments_of(question, tier);
  Asking asking;
  asking.style = Asking::Style::googletest;
  asking.suite = "Nearmiss";
  asking.includes = (header.empty() ? "" : fmt::format("#include <collide/{}>\n", header)) +
                    fmt::format("#include <collide/{}.hpp>\n", query.name);
  asking.statements = arguments.declarations +
                      fmt::format("const auto answer = collide::{}<{}>({});\n", query.name, tier, arguments.list);
  if (decides(query.kind)) asking.statements += "got_yes = answer.yes();\n";
  for (const Layout::Part& part : query.layout.parts) {
    asking.members.push_back(part.name);
    for (std::size_t i = part.begin; i < part.end; ++i) {
      const std::string index = part.end - part.begin == 1 ? "" : fmt::format("[{}]", i - part.begin);
      asking.statements +=
          fmt::format("{}{} = answer.{};\n", variable_of(part.name), index, expression_of(query.outputs[i].name));
    }
  }
  asking.build = "g++ -std=c++20 test.cpp" + include_option("impl/collide/include") +
                 " -lgtest -lgtest_main -lpthread" + (header.empty() ? "" : " -lcollide_certified -lmpfr -lgmp");
  return asking;
}

}  // namespace nearmiss
