#include <fmt/format.h>

#include <cmath>

#include "corpus/files/errors.hpp"
#include "impl/adapters/motion.hpp"
#include "reports/upstream/asking.hpp"

namespace nearmiss {

namespace bullet_text {
namespace {

using namespace collide;

/// Declares the shape NAME and its pose NAME_pose.
struct BulletShape {
  std::string name;

  std::string posed(const std::string& shape, const std::string& turn, const Vec3<double>& at) const {
    return shape + fmt::format("const btTransform {}_pose({},\n    btVector3({}));\n", name, turn, literals(at));
  }
  std::string operator()(const Sphere<double>& s) const {
    return posed(fmt::format("btSphereShape {}({});\n", name, literal(s.radius)), "btQuaternion::getIdentity()",
                 s.center);
  }
  std::string operator()(const Box<double>& b) const {
    const auto [x, y, z, w] = adapters::unit(b.orientation);
    return posed(fmt::format("btBoxShape {}(btVector3({}));\n{}.setMargin(0);\n", name, literals(b.half), name),
                 fmt::format("btQuaternion({}, {})", literals({x, y, z}), literal(w)), b.center);
  }
  std::string operator()(const Capsule<double>& c) const {
    const Vec3<double> along = c.p1 - c.p0;
    const double length = adapters::length(along);
    return posed(fmt::format("btCapsuleShapeZ {}({}, {});\n", name, literal(c.radius), literal(length)),
                 length > 0
                     ? fmt::format("shortestArcQuat(btVector3(0, 0, 1), btVector3({}).normalized())", literals(along))
                     : "btQuaternion::getIdentity()",
                 c.p0 * 0.5 + c.p1 * 0.5);
  }
  std::string operator()(const Plane<double>& p) const {
    return fmt::format(
        "btStaticPlaneShape {}(btVector3({}), {});  // Bullet normalizes the normal\n"
        "const btTransform {}_pose = btTransform::getIdentity();\n",
        name, literals(p.normal), literal(-p.offset / adapters::length(p.normal)), name);
  }
  std::string operator()(const Triangle<double>& t) const {
    return fmt::format("const btVector3 v0({}), v1({}), v2({});\n", literals(t.v0), literals(t.v1), literals(t.v2));
  }
  std::string operator()(const AABox<double>& b) const {
    return fmt::format("const btVector3 low({}), high({});\n", literals(b.min), literals(b.max));
  }
  template <class S>
  std::string operator()(const S&) const {
    throw BadInput("Bullet has no such shape");
  }
};

std::string declared(const NamedShape& o) { return std::visit(BulletShape{o.name}, o.shape); }

constexpr std::string_view contact_helpers =
    R"(/// Collects the deepest contact of the algorithm of Bullet's dispatcher.
struct Deepest : btManifoldResult {
  using btManifoldResult::btManifoldResult;
  void addContactPoint(const btVector3& on_b, const btVector3& point, btScalar d) override {
    if (any && d >= distance) return;
    any = true, distance = d, normal = on_b, on_second = point;
  }
  bool any = false;
  btScalar distance = 0;
  btVector3 normal{0, 0, 0};  // on the second, towards the first
  btVector3 on_second{0, 0, 0};
};

Deepest deepest_contact(btCollisionShape& a, const btTransform& a_pose, btCollisionShape& b, const btTransform& b_pose) {
  static btDefaultCollisionConfiguration configuration;
  static btCollisionDispatcher dispatcher(&configuration);
  btCollisionObject first, second;
  first.setCollisionShape(&a);
  first.setWorldTransform(a_pose);
  second.setCollisionShape(&b);
  second.setWorldTransform(b_pose);
  btCollisionObjectWrapper first_wrapper(nullptr, &a, &first, first.getWorldTransform(), -1, -1);
  btCollisionObjectWrapper second_wrapper(nullptr, &b, &second, second.getWorldTransform(), -1, -1);
  btCollisionAlgorithm* algorithm =
      dispatcher.findAlgorithm(&first_wrapper, &second_wrapper, nullptr, BT_CONTACT_POINT_ALGORITHMS);
  Deepest deepest(&first_wrapper, &second_wrapper);
  algorithm->processCollision(&first_wrapper, &second_wrapper, btDispatcherInfo(), &deepest);
  algorithm->~btCollisionAlgorithm();
  dispatcher.freeCollisionAlgorithm(algorithm);
  return deepest;
}
)";

constexpr std::string_view cast_helpers = R"(btTransform at(double x, double y, double z) {
  return btTransform(btQuaternion::getIdentity(), btVector3(x, y, z));
}
)";

constexpr std::string_view triangle_helpers = R"(struct Nearest : btTriangleRaycastCallback {
  using btTriangleRaycastCallback::btTriangleRaycastCallback;
  btScalar reportHit(const btVector3& hit_normal, btScalar fraction, int, int) override {
    normal = hit_normal, hit = true;
    return fraction;
  }
  btVector3 normal{0, 0, 0};
  bool hit = false;
};
)";

bool fits(const Vec3<double>& v, Scalar scalar) {
  const double most = largest_finite(scalar);
  return std::abs(v.x) <= most && std::abs(v.y) <= most && std::abs(v.z) <= most;
}

/// The end of a cast that carries the body past the target.
struct CastEnd {
  double duration;
  Vec3<double> end;
};
CastEnd cast_end(const Moving& m, const TypedShape& target, Scalar scalar) {
  const Sphere<double> to = ball_around(target);
  const double speed = adapters::length(m.velocity);
  double duration = adapters::time_to_pass(m.from, m.radius, m.velocity, to);
  if (!(duration > 0) && speed > 0) duration = adapters::power_of_two_above((to.radius > 0 ? to.radius : 1.0) / speed);
  const Vec3<double> end = m.from + m.velocity * duration;
  if (duration == 0 || !fits(end, scalar))
    throw BadInput("Bullet cannot be asked: a cast has two ends, apart and finite");
  return {duration, end};
}

Asking overlap(const NamedShape& a, const NamedShape& b) {
  Asking asking;
  asking.helpers = contact_helpers;
  asking.statements = declared(a) + declared(b) +
                      filled_in(
                          "const Deepest deepest = deepest_contact($a, $a_pose, $b, $b_pose);\n"
                          "got_yes = deepest.any && deepest.distance <= 0;\n",
                          {{"a", a.name}, {"a_pose", a.name + "_pose"}, {"b", b.name}, {"b_pose", b.name + "_pose"}});
  return asking;
}

Asking depth(const NamedShape& a, const NamedShape& b, bool to_first, bool has_contact) {
  Asking asking = overlap(a, b);
  asking.statements += filled_in(
      "if (got_yes) {\n"
      "  got_depth = -deepest.distance;\n"
      "  for (int k = 0; k < 3; ++k) got_normal[k] = $side.normal[k];\n",
      {{"side", to_first ? "deepest" : "-deepest"}});
  asking.members = {"depth", "normal"};
  if (has_contact) {
    asking.statements +=
        "  const btVector3 on_first = deepest.on_second + deepest.normal * deepest.distance;\n"
        "  for (int k = 0; k < 3; ++k) got_contact[k] = on_first[k];\n";
    asking.members.push_back("contact");
  }
  asking.statements += "}\n";
  return asking;
}

constexpr std::string_view cast_result = R"(btConvexCast::CastResult result;
result.m_fraction = 1;
got_yes = cast.calcTimeOfImpact(at($from), at($end), $b_pose, $b_pose, result);
if (got_yes) {
  got_time = result.m_fraction * $duration;
  for (int k = 0; k < 3; ++k) got_normal[k] = result.m_normal[k];
}
)";

std::string cast(const Moving& m, const NamedShape& b, const std::string& by, Scalar scalar) {
  const CastEnd e = cast_end(m, b.shape, scalar);
  return by + filled_in(cast_result, {{"from", literals(m.from)},
                                      {"end", literals(e.end)},
                                      {"b_pose", b.name + "_pose"},
                                      {"duration", literal(e.duration)}});
}

Asking point_cast(const Moving& m, const NamedShape& b, Scalar scalar) {
  Asking asking;
  asking.helpers = cast_helpers;
  asking.statements = declared(b) + cast(m, b,
                                         filled_in("btSphereShape dot(0);\n"
                                                   "dot.setMargin(0);\n"
                                                   "btVoronoiSimplexSolver simplex;\n"
                                                   "btSubsimplexConvexCast cast(&dot, &$b, &simplex);\n",
                                                   {{"b", b.name}}),
                                         scalar);
  asking.members = {"time", "normal"};
  return asking;
}

Asking sweep(const Moving& m, const NamedShape& a, const NamedShape& b, Scalar scalar) {
  Asking asking = overlap(a, b);
  asking.helpers += "\n" + std::string(cast_helpers);
  asking.statements +=
      "if (got_yes) {  // Bullet's sweeps miss a shape in which they start\n  got_time = 0;\n} else {\n" +
      indented(cast(m, b,
                    filled_in("btVoronoiSimplexSolver simplex;\n"
                              "btGjkEpaPenetrationDepthSolver epa;\n"
                              "btContinuousConvexCollision cast(&$a, &$b, &simplex, &epa);\n",
                              {{"a", a.name}, {"b", b.name}}),
                    scalar)) +
      "}\n";
  asking.members = {"time", "normal"};
  return asking;
}

Asking triangle_ray(const Moving& m, const NamedShape& b, Scalar scalar) {
  const CastEnd e = cast_end(m, b.shape, scalar);
  Asking asking;
  asking.helpers = triangle_helpers;
  asking.statements =
      declared(b) +
      filled_in(
          "Nearest nearest(btVector3($from), btVector3($end), btTriangleRaycastCallback::kF_FilterBackfaces);\n"
          "btVector3 corners[3] = {v0, v1, v2};\n"
          "nearest.processTriangle(corners, 0, 0);\n"
          "got_yes = nearest.hit;\n"
          "if (got_yes) {\n"
          "  got_time = nearest.m_hitFraction * $duration;\n"
          "  for (int k = 0; k < 3; ++k) got_normal[k] = nearest.normal[k];\n"
          "}\n",
          {{"from", literals(m.from)}, {"end", literals(e.end)}, {"duration", literal(e.duration)}});
  asking.members = {"time", "normal"};
  return asking;
}

Asking aabox_ray(const Moving& m, const NamedShape& b, Scalar scalar) {
  const CastEnd e = cast_end(m, b.shape, scalar);
  Asking asking;
  asking.statements =
      declared(b) + filled_in(
                        "btScalar fraction = 1;\n"
                        "btVector3 normal(0, 0, 0);\n"
                        "got_yes = btRayAabb(btVector3($from), btVector3($end), low, high, fraction, normal);\n"
                        "if (got_yes) got_time = fraction * $duration;\n",
                        {{"from", literals(m.from)}, {"end", literals(e.end)}, {"duration", literal(e.duration)}});
  asking.members = {"time"};
  return asking;
}

Asking sphere_triangle(const NamedShape& a, const NamedShape& b) {
  Asking asking;
  asking.statements =
      declared(a) + filled_in(
                        "btTriangleShape triangle(btVector3($v0), btVector3($v1), btVector3($v2));\n"
                        "triangle.setMargin(0);\n"
                        "btVector3 point, normal;\n"
                        "btScalar depth = 0, time = 1;\n"
                        "SphereTriangleDetector detector(&sphere, &triangle, 0);\n"
                        "got_yes = detector.collide(sphere_pose.getOrigin(), point, normal, depth, time, 0);\n",
                        {{"v0", literals(std::get<Triangle<double>>(b.shape).v0)},
                         {"v1", literals(std::get<Triangle<double>>(b.shape).v1)},
                         {"v2", literals(std::get<Triangle<double>>(b.shape).v2)}});
  return asking;
}

Asking asking_of(const Case& question) {
  const CaseShapes shapes(question);
  const Scalar scalar = question.scalar;
  if (shapes.has("point.x")) {
    const NamedShape b = target_of(shapes);
    if (shapes.has("triangle.v0.x")) return triangle_ray(moving_of(shapes), b, scalar);
    if (shapes.has("aabox.min.x")) return aabox_ray(moving_of(shapes), b, scalar);
    return point_cast(moving_of(shapes), b, scalar);
  }
  const auto [a, b] = two_operands(shapes);
  if (shapes.has("velocity.x")) return sweep(moving_of(shapes), a, b, scalar);
  if (shapes.has("triangle.v0.x")) return sphere_triangle(a, b);
  if (question.query->kind != Kind::depth) return overlap(a, b);
  const bool plane = shapes.has("plane.normal.x");
  return depth(a, b, plane, shapes.has("sphere1.radius") || (plane && shapes.has("sphere.radius")));
}

}  // namespace
}  // namespace bullet_text

Asking ask_bullet(const Case& question, const Subject& subject) {
  using namespace bullet_text;
  const bool is_double = subject.scalar == Scalar::float64;
  Asking asking = asking_of(question);
  asking.includes =
      "#include <btBulletCollisionCommon.h>\n"
      "\n"
      "#include <BulletCollision/CollisionDispatch/SphereTriangleDetector.h>\n"
      "#include <BulletCollision/CollisionShapes/btTriangleShape.h>\n"
      "#include <BulletCollision/NarrowPhaseCollision/btContinuousConvexCollision.h>\n"
      "#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>\n"
      "#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>\n"
      "#include <BulletCollision/NarrowPhaseCollision/btSubSimplexConvexCast.h>\n"
      "#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>\n"
      "#include <LinearMath/btAabbUtil2.h>\n";
  asking.helpers = fmt::format("static_assert(sizeof(btScalar) == {}, \"a build of Bullet in {}\");\n\n",
                               is_double ? 8 : 4, is_double ? "double" : "float") +
                   asking.helpers;
  asking.build = is_double ? "g++ -std=c++17 -DBT_USE_DOUBLE_PRECISION -I/usr/include/bullet test.cpp "
                             "-lBulletCollision-float64 -lLinearMath-float64"
                           : "g++ -std=c++17 -I/usr/include/bullet test.cpp -lBulletCollision -lLinearMath";
  return asking;
}

}  // namespace nearmiss
