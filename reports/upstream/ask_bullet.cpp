#include <fmt/format.h>

#include <cmath>

#include "corpus/files/errors.hpp"
#include "impl/adapters/motion.hpp"
#include "reports/upstream/asking.hpp"

namespace nearmiss {

namespace bullet_text {
namespace {

using namespace collide;

constexpr ShapeText shape_texts[] = {
    {Shape::sphere, R"(btSphereShape $name($radius);
const btTransform $name_pose(btQuaternion::getIdentity(),
    btVector3($center));
)"},
    {Shape::box, R"(btBoxShape $name(btVector3($half));
$name.setMargin(0);
const btTransform $name_pose(btQuaternion($turn),
    btVector3($center));
)"},
    {Shape::capsule, R"(btCapsuleShapeZ $name($radius, $length);
const btTransform $name_pose($turned,
    btVector3($center));
)",
     "shortestArcQuat(btVector3(0, 0, 1), btVector3($along).normalized())", "btQuaternion::getIdentity()"},
    {Shape::plane, R"(btStaticPlaneShape $name(btVector3($normal), $distance);  // Bullet normalizes the normal
const btTransform $name_pose = btTransform::getIdentity();
)"},
    {Shape::triangle, R"(btTriangleShape $name(btVector3($v0), btVector3($v1), btVector3($v2));
$name.setMargin(0);
const btTransform $name_pose = btTransform::getIdentity();
)"},
    {Shape::aabox, "const btVector3 low($min), high($max);\n"},
};

/// Its callback of rays takes a triangle as three points.
constexpr ShapeText points_of_triangle[] = {
    {Shape::triangle, "btVector3 $name[3] = {btVector3($v0), btVector3($v1), btVector3($v2)};\n"},
};

std::string declared(const NamedShape& o) { return nearmiss::declared(o, shape_texts, "Bullet"); }

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
constexpr std::string_view sweep_helpers = R"(btTransform moved(const btTransform& from, double x, double y, double z) {
  const btVector3& at = from.getOrigin();
  return btTransform(from.getBasis(), btVector3(btScalar(at.x() + x), btScalar(at.y() + y), btScalar(at.z() + z)));
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

/// $from, $end, $way and $duration of a cast that carries the body past the target.
Words cast_of(const Moving& m, const NamedShape& target, Scalar scalar) {
  const double speed = adapters::length(m.velocity),
               size = is_a<HalfSpace>(target) ? m.radius : ball_around(target.shape).radius;
  double duration = time_to_pass(m, target);
  if (!(duration > 0) && speed > 0) duration = adapters::power_of_two_above((size > 0 ? size : 1.0) / speed);
  const Vec3<double> way = m.velocity * duration, end = m.from + way;
  if (duration == 0 || !fits(end, scalar))
    throw BadInput("Bullet cannot be asked: a cast has two ends, apart and finite");
  return {{"from", literals(m.from)}, {"end", literals(end)}, {"way", literals(way)}, {"duration", literal(duration)}};
}

constexpr std::string_view overlap = R"(const Deepest deepest = deepest_contact($a, $a_pose, $b, $b_pose);
got_yes = deepest.any && deepest.distance <= 0;
)";
constexpr std::string_view depth = R"(if (got_yes) {
  got_depth = -deepest.distance;
  for (int k = 0; k < 3; ++k) got_normal[k] = $side.normal[k];
)";
constexpr std::string_view contact_on_first =
    R"(  const btVector3 on_first = deepest.on_second + deepest.normal * deepest.distance;
  for (int k = 0; k < 3; ++k) got_contact[k] = on_first[k];
)";

constexpr std::string_view point_cast = R"(btSphereShape dot(0);
dot.setMargin(0);
btVoronoiSimplexSolver simplex;
btSubsimplexConvexCast cast(&dot, &$b, &simplex);
)";
constexpr std::string_view sweep = R"(btVoronoiSimplexSolver simplex;
btGjkEpaPenetrationDepthSolver epa;
btContinuousConvexCollision cast(&$a, &$b, &simplex, &epa);
)";
constexpr std::string_view sweep_to_plane = "btContinuousConvexCollision cast(&$a, &$b);\n";
constexpr std::string_view cast_result = R"(btConvexCast::CastResult result;
result.m_fraction = 1;
got_yes = cast.calcTimeOfImpact($first_pose, $last_pose, $b_pose, $b_pose, result);
if (got_yes) {
  got_time = result.m_fraction * $duration;
  for (int k = 0; k < 3; ++k) got_normal[k] = result.m_normal[k];
}
)";

constexpr std::string_view triangle_ray =
    R"(Nearest nearest(btVector3($from), btVector3($end), btTriangleRaycastCallback::kF_FilterBackfaces);
nearest.processTriangle($b, 0, 0);
got_yes = nearest.hit;
if (got_yes) {
  got_time = nearest.m_hitFraction * $duration;
  for (int k = 0; k < 3; ++k) got_normal[k] = nearest.normal[k];
}
)";
constexpr std::string_view aabox_ray = R"(btScalar fraction = 1;
btVector3 normal(0, 0, 0);
got_yes = btRayAabb(btVector3($from), btVector3($end), low, high, fraction, normal);
if (got_yes) got_time = fraction * $duration;
)";

constexpr std::string_view sphere_triangle = R"(btVector3 point, normal;
btScalar depth = 0, time = 1;
SphereTriangleDetector detector(&$a, &$b, 0);
got_yes = detector.collide($b_pose.invXform($a_pose.getOrigin()), point, normal, depth, time, 0);
)";
constexpr std::string_view distance = R"(btVoronoiSimplexSolver simplex;
btGjkEpaPenetrationDepthSolver epa;
btGjkPairDetector detector(&$a, &$b, &simplex, &epa);
btGjkPairDetector::ClosestPointInput input;
input.m_transformA = $a_pose, input.m_transformB = $b_pose;
btPointCollector nearest;
detector.getClosestPoints(input, nearest, nullptr);
if (nearest.m_hasResult) {
  got_distance = nearest.m_distance;
  const btVector3 on_first = nearest.m_pointInWorld + nearest.m_normalOnBInWorld * nearest.m_distance;
  for (int k = 0; k < 3; ++k) {
    got_normal[k] = -nearest.m_normalOnBInWorld[k];  // from the first to the second
    got_point1[k] = on_first[k];
    got_point2[k] = nearest.m_pointInWorld[k];
  }
}
)";

constexpr std::string_view distance_to_plane = R"(const Deepest deepest = deepest_contact($a, $a_pose, $b, $b_pose);
if (deepest.any) {
  got_distance = deepest.distance;
  const btVector3 on_first = deepest.on_second + deepest.normal * deepest.distance;
  for (int k = 0; k < 3; ++k) {
    got_normal[k] = -deepest.normal[k];  // from the first to the second
    got_point1[k] = on_first[k];
    got_point2[k] = deepest.on_second[k];
  }
}
)";

Asking point_motion(const CaseShapes& shapes, Scalar scalar) {
  const NamedShape b = target_of(shapes);
  Words cast = cast_of(moving_of(shapes), b, scalar);
  if (is_a<Triangle>(b)) {
    return {.helpers = std::string(triangle_helpers),
            .statements = nearmiss::declared(b, points_of_triangle, "Bullet") + call(triangle_ray, b, b, cast),
            .members = {"time", "normal"}};
  }
  if (is_a<AABox>(b)) return {.statements = declared(b) + filled_in(aabox_ray, cast), .members = {"time"}};
  cast.push_back({"first_pose", filled_in("at($from)", cast)});
  cast.push_back({"last_pose", filled_in("at($end)", cast)});
  return {.helpers = std::string(cast_helpers),
          .statements = declared(b) + call(point_cast, b, b) + call(cast_result, b, b, cast),
          .members = {"time", "normal"}};
}

Asking asking_of(const Case& question) {
  const CaseShapes shapes(question);
  if (shapes.has("point.x")) return point_motion(shapes, question.scalar);
  const auto [a, b] = sides_of(shapes);
  if (asks_signed_distance(*question.query) && is_a<HalfSpace>(b)) {
    return {.helpers = std::string(contact_helpers),
            .statements = declared(a) + declared(b) + call(distance_to_plane, a, b),
            .members = member_names(*question.query)};
  }
  if (asks_signed_distance(*question.query)) {
    return {.statements = declared(a) + declared(b) + call(distance, a, b), .members = member_names(*question.query)};
  }
  if (is_a<Sphere>(a) && is_a<Triangle>(b))
    return {.statements = declared(a) + declared(b) + call(sphere_triangle, a, b)};
  Asking asking{.helpers = std::string(contact_helpers), .statements = declared(a) + declared(b) + call(overlap, a, b)};
  if (shapes.has("velocity.x")) {
    Words cast = cast_of(moving_of(shapes), b, question.scalar);
    cast.push_back({"first_pose", a.name + "_pose"});
    cast.push_back({"last_pose", filled_in("moved(" + a.name + "_pose, $way)", cast)});
    asking.helpers += "\n" + std::string(sweep_helpers);
    asking.statements +=
        "if (got_yes) {  // Bullet's sweeps miss a shape in which they start\n  got_time = 0;\n} else {\n" +
        indented(call(is_a<HalfSpace>(b) ? sweep_to_plane : sweep, a, b) + call(cast_result, a, b, cast)) + "}\n";
    asking.members = {"time", "normal"};
  } else if (question.query->kind == Kind::depth) {
    asking.statements += filled_in(depth, {{"side", is_a<Plane>(b) ? "deepest" : "-deepest"}});
    asking.members = {"depth", "normal"};
    if (is_a<Sphere>(a) && !is_a<Box>(b)) {
      asking.statements += contact_on_first;
      asking.members.push_back("contact");
    }
    asking.statements += "}\n";
  }
  return asking;
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
      "#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>\n"
      "#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>\n"
      "#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>\n"
      "#include <BulletCollision/NarrowPhaseCollision/btSubSimplexConvexCast.h>\n"
      "#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>\n"
      "#include <LinearMath/btAabbUtil2.h>\n";
  asking.helpers = fmt::format("static_assert(sizeof(btScalar) == {}, \"a build of Bullet in {}\");\n\n",
                               is_double ? 8 : 4, is_double ? "double" : "float") +
                   asking.helpers;
  asking.packages = "libbullet-dev";
  asking.build = is_double ? "g++ -std=c++17 -DBT_USE_DOUBLE_PRECISION -I/usr/include/bullet test.cpp "
                             "-lBulletCollision-float64 -lLinearMath-float64"
                           : "g++ -std=c++17 -I/usr/include/bullet test.cpp -lBulletCollision -lLinearMath";
  return asking;
}

}  // namespace nearmiss
