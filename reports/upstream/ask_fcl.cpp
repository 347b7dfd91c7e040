#include <fmt/format.h>

#include "corpus/files/errors.hpp"
#include "impl/adapters/motion.hpp"
#include "reports/upstream/asking.hpp"

namespace nearmiss {

namespace fcl_text {
namespace {

using namespace collide;

constexpr ShapeText shape_texts[] = {
    {Shape::sphere, R"(const fcl::Sphered $name($radius);
const fcl::Transform3d $name_pose = at($center);
)"},
    {Shape::box, R"(const fcl::Boxd $name($sides);
fcl::Transform3d $name_pose = at($center);
$name_pose.linear() = fcl::Quaterniond($turn_w_first).toRotationMatrix();  // w, x, y, z
)"},
    {Shape::capsule, R"(const fcl::Capsuled $name($radius, $length);  // along the local z axis
fcl::Transform3d $name_pose = at($center);
$turned)",
     R"($name_pose.linear() = fcl::Quaterniond::FromTwoVectors(fcl::Vector3d::UnitZ(), fcl::Vector3d($along))
    .toRotationMatrix();
)"},
    {Shape::plane,
     R"(const fcl::Halfspaced $name(fcl::Vector3d($normal), $minus_offset);  // behind the plane; FCL normalizes the normal
const fcl::Transform3d $name_pose = fcl::Transform3d::Identity();
)"},
    {Shape::triangle, R"(const fcl::Vector3d $name[3] = {fcl::Vector3d($v0), fcl::Vector3d($v1), fcl::Vector3d($v2)};
)"},
};

std::string declared(NamedShape o) {
  if (const auto* aabox = std::get_if<AABox<double>>(&o.shape)) {
    const auto box = adapters::centered(*aabox);
    if (!box) throw BadInput("FCL cannot be asked: the box's center and sides are not doubles exactly");
    o.shape = *box;
  }
  return nearmiss::declared(o, shape_texts, "FCL");
}

constexpr std::string_view at_helper = R"(fcl::Transform3d at(double x, double y, double z) {
  fcl::Transform3d pose = fcl::Transform3d::Identity();
  pose.translation() = fcl::Vector3d(x, y, z);
  return pose;
}
)";

constexpr std::string_view decision = R"(fcl::CollisionRequestd request(1, false);
request.gjk_solver_type = $solver;
fcl::CollisionResultd result;
got_yes = fcl::collide(&$a, $a_pose, &$b, $b_pose, request, result) > 0;
)";

constexpr std::string_view depth = R"(fcl::CollisionRequestd request(16, true);
request.gjk_solver_type = $solver;
fcl::CollisionResultd result;
got_yes = fcl::collide(&$a, $a_pose, &$b, $b_pose, request, result) > 0;
for (std::size_t i = 0; got_yes && i < result.numContacts(); ++i) {  // the deepest contact
  const fcl::Contactd& c = result.getContact(i);
  if (i > 0 && !(c.penetration_depth > got_depth)) continue;
  got_depth = c.penetration_depth;
  for (int k = 0; k < 3; ++k) got_normal[k] = $turned_contact.normal[k];
}
got_yes = got_yes && got_depth >= 0;
)";

constexpr std::string_view distance = R"(fcl::DistanceRequestd request(false, true);  // signed
request.gjk_solver_type = $solver;
fcl::DistanceResultd result;
fcl::distance(&$a, $a_pose, &$b, $b_pose, request, result);
)";
constexpr std::string_view depth_of_distance = "got_depth = -result.min_distance;\ngot_yes = got_depth >= 0;\n";
constexpr std::string_view distance_itself = "got_distance = result.min_distance;\n";
constexpr std::string_view distance_of_boxes =
    "if (!got_yes) got_depth = NAN;  // a distance is not the gap along an axis\n";

constexpr std::string_view triangle =
    "got_yes = fcl::detail::$function<double>().shapeTriangleIntersect($a, $a_pose, $b[0], $b[1], $b[2], nullptr, "
    "nullptr, "
    "nullptr);\n";
constexpr std::string_view triangle_and_plane =
    "got_yes = fcl::detail::$function<double>().shapeTriangleIntersect($a, $a_pose, $b[0], $b[1], $b[2],\n"
    "    fcl::Transform3d::Identity(), nullptr, nullptr, nullptr);\n";
constexpr std::string_view distance_of_triangles = R"(fcl::Vector3d on_first, on_second;
got_distance = fcl::detail::TriangleDistanced::triDistance($a, $b, on_first, on_second);
)";
constexpr std::string_view distance_of_triangle =
    R"(fcl::detail::$function<double>().shapeTriangleDistance($a, $a_pose, $b[0], $b[1], $b[2], &got_distance);
)";
constexpr std::string_view depth_unknown =
    "if (!(got_distance > 0)) got_distance = NAN;  // FCL tells no depth of a triangle\n";

constexpr std::string_view sweep = R"(const double duration = $horizon;  // carries the $what past
fcl::Transform3d end = $a_pose;
end.translation() += fcl::Vector3d($way);
fcl::ContinuousCollisionRequestd request;
request.gjk_solver_type = $solver;
request.ccd_solver_type = $by;
fcl::ContinuousCollisionResultd result;
fcl::continuousCollide(&$a, $a_pose, end, &$b, $b_pose, $b_pose, request, result);
got_yes = result.is_collide;
if (got_yes) got_time = result.time_of_contact * duration;
)";

std::string motion(const Moving& moving, const NamedShape& mover, const NamedShape& target, const std::string& solver,
                   bool naive) {
  const double horizon = time_to_pass(moving, target);
  if (horizon == 0) {
    return call(decision, mover, target, {{"solver", solver}}) +
           fmt::format("if (got_yes) got_time = 0;  // the {} moves no nearer\n", mover.name);
  }
  const Vec3<double> way = moving.velocity * horizon;
  if (!adapters::finite(moving.from + way)) throw BadInput(adapters::no_end);
  return call(sweep, mover, target,
              {{"horizon", literal(horizon)},
               {"solver", solver},
               {"by", naive ? "fcl::CCDC_NAIVE" : "fcl::CCDC_CONSERVATIVE_ADVANCEMENT"},
               {"what", mover.name},
               {"way", literals(way)}});
}

}  // namespace
}  // namespace fcl_text

Asking ask_fcl(const Case& question, const Subject& subject) {
  using namespace fcl_text;
  const CaseShapes shapes(question);
  const bool libccd = subject.name == "fcl" || subject.name == "fcl-distance";
  const std::string solver = libccd ? "fcl::GST_LIBCCD" : "fcl::GST_INDEP";
  Asking asking;
  asking.style = Asking::Style::googletest_with_main;
  asking.suite = "FCL_NEARMISS";
  asking.includes =
      "#include <fcl/narrowphase/collision.h>\n"
      "#include <fcl/narrowphase/continuous_collision.h>\n"
      "#include <fcl/narrowphase/detail/gjk_solver_indep.h>\n"
      "#include <fcl/narrowphase/detail/gjk_solver_libccd.h>\n"
      "#include <fcl/narrowphase/detail/primitive_shape_algorithm/triangle_distance.h>\n"
      "#include <fcl/narrowphase/distance.h>\n";
  asking.packages = "libfcl-dev libgtest-dev pkg-config";
  asking.build = "g++ -std=c++17 test.cpp $(pkg-config --cflags --libs fcl eigen3) -lgtest -lpthread";
  const Words by{{"solver", solver},
                 {"function", libccd ? "GJKSolver_libccd" : "GJKSolver_indep"},
                 {"turned_contact", is_a<Plane>(target_of(shapes)) ? "-c" : "c"}};
  const auto [a, b] = sides_of(shapes);
  asking.statements = declared(a) + declared(b);
  if (!is_a<Triangle>(a) || is_a<Box>(b)) asking.helpers = at_helper;
  if (shapes.has("velocity.x") && !shapes.has("limit")) {
    asking.statements += motion(moving_of(shapes), a, b, solver, subject.name != "fcl-conservative-advancement");
    asking.members = {"time"};
  } else if (subject.name.starts_with("fcl-distance") && is_a<Triangle>(b)) {
    asking.statements += call(is_a<Triangle>(a) ? distance_of_triangles : distance_of_triangle, a, b, by);
    asking.statements += depth_unknown;
    asking.members = {"distance"};
  } else if (subject.name.starts_with("fcl-distance")) {
    const bool is_depth = question.query->kind == Kind::depth;
    asking.statements += call(distance, a, b, by);
    asking.statements += is_depth ? depth_of_distance : distance_itself;
    if (is_depth && is_a<Box>(a) && is_a<Box>(b)) asking.statements += distance_of_boxes;
    asking.members = {is_depth ? "depth" : "distance"};
  } else if (is_a<Triangle>(a)) {
    asking.statements += call(is_a<HalfSpace>(b) ? triangle_and_plane : triangle, b, a, by);
  } else if (is_a<Triangle>(b)) {
    asking.statements += call(triangle, a, b, by);
  } else if (question.query->kind == Kind::depth) {
    asking.statements += call(depth, a, b, by);
    asking.members = {"depth", "normal"};
  } else {
    asking.statements += call(decision, a, b, by);
  }
  return asking;
}

}  // namespace nearmiss
