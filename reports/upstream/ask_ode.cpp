#include <fmt/format.h>

#include <cmath>

#include "corpus/files/errors.hpp"
#include "impl/adapters/motion.hpp"
#include "reports/upstream/asking.hpp"

namespace nearmiss {

namespace ode_text {
namespace {

using namespace collide;

/// Declares the geometry NAME.
struct OdeShape {
  std::string name;

  std::string placed(const std::string& make, const Vec3<double>& at) const {
    return fmt::format("const dGeomID {} = {};\ndGeomSetPosition({}, {});\n", name, make, name, literals(at));
  }
  std::string operator()(const Sphere<double>& s) const {
    return placed(fmt::format("dCreateSphere(nullptr, {})", literal(s.radius)), s.center);
  }
  std::string operator()(const Box<double>& b) const {
    const auto [x, y, z, w] = adapters::unit(b.orientation);
    return placed(fmt::format("dCreateBox(nullptr, {})", literals(b.half * 2.0)), b.center) +
           fmt::format("const dQuaternion {}_turn = {{{}, {}}};  // w, x, y, z\ndGeomSetQuaternion({}, {}_turn);\n",
                       name, literal(w), literals({x, y, z}), name, name);
  }
  std::string operator()(const Capsule<double>& c) const {
    const Vec3<double> along = c.p1 - c.p0;
    const double length = adapters::length(along);
    const std::string text = placed(fmt::format("dCreateCapsule(nullptr, {}, {})", literal(c.radius), literal(length)),
                                    c.p0 * 0.5 + c.p1 * 0.5);
    if (!(length > 0)) return text;
    return text + fmt::format("dMatrix3 {}_turn;\ndRFromZAxis({}_turn, {});\ndGeomSetRotation({}, {}_turn);\n", name,
                              name, literals(along / length), name, name);
  }
  std::string operator()(const Plane<double>& p) const {
    return fmt::format("const dGeomID {} = dCreatePlane(nullptr, {}, {});  // ODE normalizes the normal\n", name,
                       literals(p.normal), literal(-p.offset));
  }
  template <class S>
  std::string operator()(const S&) const {
    throw BadInput("ODE has no such shape");
  }
};

std::string declared(const NamedShape& o) { return std::visit(OdeShape{o.name}, o.shape); }

constexpr std::string_view deepest_helper = R"(/// The number of contacts; the deepest of them in `deepest`.
int contacts_of(dGeomID a, dGeomID b, dContactGeom* deepest) {
  dContactGeom contacts[8];
  const int count = dCollide(a, b, 8, contacts, sizeof(dContactGeom));
  for (int i = 0; i < count; ++i) {
    if (i == 0 || contacts[i].depth > deepest->depth) *deepest = contacts[i];
  }
  return count;
}
)";

Asking overlap(const NamedShape& a, const NamedShape& b) {
  Asking asking;
  asking.helpers = deepest_helper;
  asking.statements = declared(a) + declared(b) +
                      filled_in(
                          "dContactGeom deepest;\n"
                          "got_yes = contacts_of($a, $b, &deepest) > 0;\n",
                          {{"a", a.name}, {"b", b.name}});
  return asking;
}

Asking depth(const NamedShape& a, const NamedShape& b, bool to_first) {
  Asking asking = overlap(a, b);
  asking.statements += filled_in(
      "if (got_yes) {\n"
      "  got_depth = deepest.depth;\n"
      "  for (int k = 0; k < 3; ++k) got_normal[k] = $side.normal[k];  // ODE's normal points into the first\n"
      "  got_yes = got_depth >= 0;\n"
      "}\n",
      {{"side", to_first ? "deepest" : "-deepest"}});
  asking.members = {"depth", "normal"};
  return asking;
}

constexpr std::string_view ray_cast = R"(const dGeomID ray = dCreateRay(nullptr, $reach);
dGeomRaySet(ray, $from, $along);
dContactGeom contact;
got_yes = dCollide(ray, $to, 1, &contact, sizeof contact) > 0;
if (got_yes) {
  got_time = contact.depth / $speed;
)";

std::string ray(const Moving& m, const std::string& to, double horizon, bool with_normal) {
  const double speed = adapters::length(m.velocity);
  if (!(speed > 0)) throw BadInput("ODE cannot be asked: a ray has a direction, and nothing moves here");
  const double reach = (horizon == 0 ? 1 / speed : horizon) * speed;
  if (!std::isfinite(reach)) throw BadInput("ODE cannot be asked: the ray's length is not finite");
  return filled_in(ray_cast, {{"reach", literal(reach)},
                              {"from", literals(m.from)},
                              {"along", literals(m.velocity / speed)},
                              {"to", to},
                              {"speed", literal(speed)}}) +
         (with_normal
              ? "  for (int k = 0; k < 3; ++k) got_location[k] = contact.pos[k], got_normal[k] = contact.normal[k];\n"
              : "") +
         "}\n";
}

Asking sphere_ray(const CaseShapes& shapes, const NamedShape& b) {
  const Moving m = moving_of(shapes);
  const double horizon = adapters::time_to_pass(m.from, 0, m.velocity, std::get<Sphere<double>>(b.shape));
  Asking asking;
  asking.statements =
      declared(b) + fmt::format("const bool inside = dGeomSpherePointDepth({}, {}) >= 0;\n", b.name, literals(m.from));
  const std::string cast = indented(ray(m, b.name, horizon, true));
  if (shapes.flag("solid")) {
    asking.statements +=
        "if (inside) {  // ODE's ray would tell the exit\n  got_yes = true;\n  got_time = 0;\n} else {\n" + cast +
        "}\n";
  } else {
    asking.statements += "{\n" + cast + "}\nif (inside) {  // the ray's normal leads inward there\n" +
                         "  for (int k = 0; k < 3; ++k) got_location[k] = got_normal[k] = NAN;\n}\n";
  }
  asking.members = {"time", "location", "normal"};
  return asking;
}

Asking solid_ray(const CaseShapes& shapes, const NamedShape& b, const std::string& point_depth) {
  const Moving m = moving_of(shapes);
  const double horizon = adapters::time_to_pass(m.from, 0, m.velocity, ball_around(b.shape));
  Asking asking;
  asking.statements =
      declared(b) +
      fmt::format("if (!({}({}, {}) > 0)) {{  // a start inside is a miss\n", point_depth, b.name, literals(m.from)) +
      indented(ray(m, b.name, horizon, true)) + "}\n";
  asking.members = {"time", "location", "normal"};
  return asking;
}

Asking plane_ray(const CaseShapes& shapes, const NamedShape& b) {
  const Moving m = moving_of(shapes);
  const Plane<double>& plane = std::get<Plane<double>>(b.shape);
  Asking asking;
  asking.members = {"time", "location", "normal"};
  if (!(adapters::dot(plane.normal, m.velocity) < 0)) {
    throw BadInput("ODE is not asked: its planes have two sides, and the point does not approach the front");
  }
  const double horizon = 2 * adapters::time_to_pass(m.from, 0, m.velocity, plane);
  asking.statements =
      declared(b) +
      fmt::format("if (!(dGeomPlanePointDepth({}, {}) > 0)) {{  // a start behind the plane is a miss\n", b.name,
                  literals(m.from)) +
      indented(ray(m, b.name, horizon, true)) + "}\n";
  return asking;
}

Asking asking_of(const Case& question) {
  const CaseShapes shapes(question);
  if (shapes.has("point.x")) {
    const NamedShape b = target_of(shapes);
    if (shapes.has("sphere.radius")) return sphere_ray(shapes, b);
    if (shapes.has("plane.normal.x")) return plane_ray(shapes, b);
    return solid_ray(shapes, b, shapes.has("box.half.x") ? "dGeomBoxPointDepth" : "dGeomCapsulePointDepth");
  }
  const auto [a, b] = two_operands(shapes);
  if (question.query->kind != Kind::depth) return overlap(a, b);
  return depth(a, b, shapes.has("plane.normal.x"));
}

}  // namespace
}  // namespace ode_text

Asking ask_ode(const Case& question, const Subject&) {
  using namespace ode_text;
  Asking asking = asking_of(question);
  asking.includes = "#include <ode/ode.h>\n";
  asking.helpers = "static_assert(sizeof(dReal) == 8, \"a build of ODE in double\");\n\n" + asking.helpers;
  asking.statements = "dInitODE2(0);\n" + asking.statements + "dCloseODE();\n";
  asking.build = "g++ -std=c++17 test.cpp $(pkg-config --cflags --libs ode)";
  return asking;
}

}  // namespace nearmiss
