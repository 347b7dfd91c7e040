#include <fmt/format.h>

#include <cmath>

#include "corpus/files/errors.hpp"
#include "impl/adapters/motion.hpp"
#include "reports/upstream/asking.hpp"

namespace nearmiss {

namespace ode_text {
namespace {

using namespace collide;

constexpr ShapeText shape_texts[] = {
    {Shape::sphere, R"(const dGeomID $name = dCreateSphere(nullptr, $radius);
dGeomSetPosition($name, $center);
)"},
    {Shape::box, R"(const dGeomID $name = dCreateBox(nullptr, $sides);
dGeomSetPosition($name, $center);
const dQuaternion $name_turn = {$turn_w_first};  // w, x, y, z
dGeomSetQuaternion($name, $name_turn);
)"},
    {Shape::capsule, R"(const dGeomID $name = dCreateCapsule(nullptr, $radius, $length);
dGeomSetPosition($name, $center);
$turned)",
     R"(dMatrix3 $name_turn;
dRFromZAxis($name_turn, $direction);
dGeomSetRotation($name, $name_turn);
)"},
    {Shape::plane,
     "const dGeomID $name = dCreatePlane(nullptr, $normal, $minus_offset);  // ODE normalizes the normal\n"},
};

std::string declared(const NamedShape& o) { return nearmiss::declared(o, shape_texts, "ODE"); }

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

constexpr std::string_view overlap = R"(dContactGeom deepest;
got_yes = contacts_of($a, $b, &deepest) > 0;
)";
constexpr std::string_view depth = R"(if (got_yes) {
  got_depth = deepest.depth;
  for (int k = 0; k < 3; ++k) got_normal[k] = $side.normal[k];  // ODE's normal points into the first
  got_yes = got_depth >= 0;
}
)";

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

constexpr std::string_view from_outside = R"(if (!($point_depth($b, $from) > 0)) {  // a start $where is a miss
)";

Asking ray_from_outside(const CaseShapes& shapes, const NamedShape& b) {
  const Moving m = moving_of(shapes);
  const Plane<double>* plane = std::get_if<Plane<double>>(&b.shape);
  if (plane != nullptr && !(adapters::dot(plane->normal, m.velocity) < 0)) {
    throw BadInput("ODE is not asked: its planes have two sides, and the point does not approach the front");
  }
  const double horizon = time_to_pass(m, b) * (plane != nullptr ? 2 : 1);
  const char* point_depth = plane != nullptr ? "dGeomPlanePointDepth"
                            : is_a<Box>(b)   ? "dGeomBoxPointDepth"
                                             : "dGeomCapsulePointDepth";
  return {.statements = declared(b) +
                        filled_in(from_outside, {{"point_depth", point_depth},
                                                 {"b", b.name},
                                                 {"from", literals(m.from)},
                                                 {"where", plane != nullptr ? "behind the plane" : "inside"}}) +
                        indented(ray(m, b.name, horizon, true)) + "}\n",
          .members = {"time", "location", "normal"}};
}

constexpr std::string_view distance_of_segments = R"(const dVector3 a0 = {$a0}, a1 = {$a1}, b0 = {$b0}, b1 = {$b1};
dVector3 on_a, on_b;
dClosestLineSegmentPoints(a0, a1, b0, b1, on_a, on_b);
for (int k = 0; k < 3; ++k) got_point1[k] = on_a[k], got_point2[k] = on_b[k];
)";

Asking signed_distance(const CaseShapes& shapes) {
  if (shapes.has("point.x")) {
    const NamedShape b = target_of(shapes);
    return {.statements = declared(b) + fmt::format("got_distance = -dGeom{}PointDepth({}, {});\n",
                                                    is_a<Sphere>(b)      ? "Sphere"
                                                    : is_a<HalfSpace>(b) ? "Plane"
                                                                         : "Capsule",
                                                    b.name, literals(shapes.vector("point"))),
            .members = {"distance"}};
  }
  const auto [a, b] = sides_of(shapes);
  const auto &first = std::get<Segment<double>>(a.shape), &second = std::get<Segment<double>>(b.shape);
  return {.statements = filled_in(distance_of_segments, {{"a0", literals(first.v0)},
                                                         {"a1", literals(first.v1)},
                                                         {"b0", literals(second.v0)},
                                                         {"b1", literals(second.v1)}}),
          .members = {"point1", "point2"}};
}

Asking asking_of(const Case& question) {
  const CaseShapes shapes(question);
  if (asks_signed_distance(*question.query)) return signed_distance(shapes);
  if (shapes.has("point.x")) {
    const NamedShape b = target_of(shapes);
    return is_a<Sphere>(b) ? sphere_ray(shapes, b) : ray_from_outside(shapes, b);
  }
  const auto [a, b] = sides_of(shapes);
  Asking asking{.helpers = std::string(deepest_helper), .statements = declared(a) + declared(b) + call(overlap, a, b)};
  if (question.query->kind == Kind::depth) {
    asking.statements += filled_in(depth, {{"side", is_a<Plane>(b) ? "deepest" : "-deepest"}});
    asking.members = {"depth", "normal"};
  }
  return asking;
}

}  // namespace
}  // namespace ode_text

Asking ask_ode(const Case& question, const Subject&) {
  using namespace ode_text;
  Asking asking = asking_of(question);
  asking.includes = "#include <ode/ode.h>\n";
  asking.helpers = "static_assert(sizeof(dReal) == 8, \"a build of ODE in double\");\n\n" + asking.helpers;
  asking.statements = "dInitODE2(0);\n" + asking.statements + "dCloseODE();\n";
  asking.packages = "libode-dev pkg-config";
  asking.build = "g++ -std=c++17 test.cpp $(pkg-config --cflags --libs ode)";
  return asking;
}

}  // namespace nearmiss
