#include <fmt/format.h>

#include "corpus/files/errors.hpp"
#include "impl/adapters/motion.hpp"
#include "reports/upstream/asking.hpp"

namespace nearmiss {

namespace fcl_text {
namespace {

using namespace collide;

/// Declares the shape NAME and its pose NAME_pose.
struct FclShape {
  std::string name;

  std::string operator()(const Sphere<double>& s) const {
    return filled_in(
        "const fcl::Sphered $name($radius);\nconst fcl::Transform3d $name_pose = at($center);\n",
        {{"name", name}, {"name_pose", name + "_pose"}, {"radius", literal(s.radius)}, {"center", literals(s.center)}});
  }
  std::string operator()(const Box<double>& b) const {
    const auto [x, y, z, w] = adapters::unit(b.orientation);
    return filled_in(
        "const fcl::Boxd $name($sides);\n"
        "fcl::Transform3d $name_pose = at($center);\n"
        "$name_pose.linear() = fcl::Quaterniond($turn).toRotationMatrix();  // w, x, y, z\n",
        {{"name", name},
         {"name_pose", name + "_pose"},
         {"sides", literals(b.half * 2.0)},
         {"center", literals(b.center)},
         {"turn", literal(w) + ", " + literals({x, y, z})}});
  }
  std::string operator()(const Capsule<double>& c) const {
    const Vec3<double> along = c.p1 - c.p0;
    std::string text = filled_in(
        "const fcl::Capsuled $name($radius, $length);  // along the local z axis\n"
        "fcl::Transform3d $name_pose = at($center);\n",
        {{"name", name},
         {"name_pose", name + "_pose"},
         {"radius", literal(c.radius)},
         {"length", literal(adapters::length(along))},
         {"center", literals(c.p0 * 0.5 + c.p1 * 0.5)}});
    if (!(adapters::length(along) > 0)) return text;
    return text + fmt::format(
                      "{}_pose.linear() = fcl::Quaterniond::FromTwoVectors(fcl::Vector3d::UnitZ(), fcl::Vector3d({}))\n"
                      "    .toRotationMatrix();\n",
                      name, literals(along));
  }
  std::string operator()(const Plane<double>& p) const {
    return filled_in(
        "const fcl::Halfspaced $name(fcl::Vector3d($normal), $offset);  // behind the plane; FCL normalizes the "
        "normal\n"
        "const fcl::Transform3d $name_pose = fcl::Transform3d::Identity();\n",
        {{"name", name},
         {"name_pose", name + "_pose"},
         {"normal", literals(p.normal)},
         {"offset", literal(-p.offset)}});
  }
  std::string operator()(const Triangle<double>& t) const {
    return filled_in("const fcl::Vector3d v0($v0), v1($v1), v2($v2);\n",
                     {{"v0", literals(t.v0)}, {"v1", literals(t.v1)}, {"v2", literals(t.v2)}});
  }
  std::string operator()(const AABox<double>& b) const {
    const auto box = adapters::centered(b);
    if (!box) throw BadInput("FCL cannot be asked: the box's center and sides are not doubles exactly");
    return (*this)(*box);
  }
  template <class S>
  std::string operator()(const S&) const {
    throw BadInput("FCL has no such shape");
  }
};

std::string declared(const NamedShape& o) { return std::visit(FclShape{o.name}, o.shape); }

constexpr std::string_view at_helper = R"(fcl::Transform3d at(double x, double y, double z) {
  fcl::Transform3d pose = fcl::Transform3d::Identity();
  pose.translation() = fcl::Vector3d(x, y, z);
  return pose;
}
)";

std::string decision(const std::string& a, const std::string& b, const std::string& solver) {
  return filled_in(
      "fcl::CollisionRequestd request(1, false);\n"
      "request.gjk_solver_type = $solver;\n"
      "fcl::CollisionResultd result;\n"
      "got_yes = fcl::collide(&$a, $a_pose, &$b, $b_pose, request, result) > 0;\n",
      {{"a", a}, {"a_pose", a + "_pose"}, {"b", b}, {"b_pose", b + "_pose"}, {"solver", solver}});
}

/// `turn`: a factor for FCL's normal.
std::string depth(const std::string& a, const std::string& b, const std::string& solver, int turn) {
  return filled_in(
      "fcl::CollisionRequestd request(16, true);\n"
      "request.gjk_solver_type = $solver;\n"
      "fcl::CollisionResultd result;\n"
      "got_yes = fcl::collide(&$a, $a_pose, &$b, $b_pose, request, result) > 0;\n"
      "for (std::size_t i = 0; got_yes && i < result.numContacts(); ++i) {  // the deepest contact\n"
      "  const fcl::Contactd& c = result.getContact(i);\n"
      "  if (i > 0 && !(c.penetration_depth > got_depth)) continue;\n"
      "  got_depth = c.penetration_depth;\n"
      "  for (int k = 0; k < 3; ++k) got_normal[k] = $turnc.normal[k];\n"
      "}\n"
      "got_yes = got_yes && got_depth >= 0;\n",
      {{"a", a},
       {"a_pose", a + "_pose"},
       {"b", b},
       {"b_pose", b + "_pose"},
       {"solver", solver},
       {"turnc", turn < 0 ? "-c" : "c"}});
}

std::string distance(const std::string& a, const std::string& b, const std::string& solver, bool boxes) {
  return filled_in(
             "fcl::DistanceRequestd request(false, true);  // signed\n"
             "request.gjk_solver_type = $solver;\n"
             "fcl::DistanceResultd result;\n"
             "fcl::distance(&$a, $a_pose, &$b, $b_pose, request, result);\n"
             "got_depth = -result.min_distance;\n"
             "got_yes = got_depth >= 0;\n",
             {{"a", a}, {"a_pose", a + "_pose"}, {"b", b}, {"b_pose", b + "_pose"}, {"solver", solver}}) +
         (boxes ? "if (!got_yes) got_depth = NAN;  // a distance is not the gap along an axis\n" : "");
}

std::string triangle(const std::string& a, bool libccd) {
  return filled_in(
      "got_yes = fcl::detail::$solver<double>().shapeTriangleIntersect($a, $a_pose, v0, v1, v2, nullptr, nullptr, "
      "nullptr);\n",
      {{"a", a}, {"a_pose", a + "_pose"}, {"solver", libccd ? "GJKSolver_libccd" : "GJKSolver_indep"}});
}

std::string motion(const Moving& moving, const NamedShape& target, const std::string& solver, bool naive) {
  const Plane<double>* plane = std::get_if<Plane<double>>(&target.shape);
  const double horizon =
      plane != nullptr ? adapters::time_to_pass(moving.from, moving.radius, moving.velocity, *plane)
                       : adapters::time_to_pass(moving.from, moving.radius, moving.velocity, ball_around(target.shape));
  if (horizon == 0) {
    return decision("sphere", target.name, solver) + "if (got_yes) got_time = 0;  // the sphere moves no nearer\n";
  }
  const Vec3<double> end = moving.from + moving.velocity * horizon;
  if (!adapters::finite(end)) throw BadInput(adapters::no_end);
  return filled_in(
      "const double duration = $horizon;  // carries the sphere past\n"
      "fcl::ContinuousCollisionRequestd request;\n"
      "request.gjk_solver_type = $solver;\n"
      "request.ccd_solver_type = $by;\n"
      "fcl::ContinuousCollisionResultd result;\n"
      "fcl::continuousCollide(&sphere, sphere_pose, at($end), &$b, $b_pose, $b_pose, request, result);\n"
      "got_yes = result.is_collide;\n"
      "if (got_yes) got_time = result.time_of_contact * duration;\n",
      {{"horizon", literal(horizon)},
       {"solver", solver},
       {"by", naive ? "fcl::CCDC_NAIVE" : "fcl::CCDC_CONSERVATIVE_ADVANCEMENT"},
       {"end", literals(end)},
       {"b", target.name},
       {"b_pose", target.name + "_pose"}});
}

}  // namespace
}  // namespace fcl_text

Asking ask_fcl(const Case& question, const Subject& subject) {
  using namespace fcl_text;
  const CaseShapes shapes(question);
  const bool libccd = subject.name == "fcl" || subject.name == "fcl-distance";
  const std::string solver = libccd ? "fcl::GST_LIBCCD" : "fcl::GST_INDEP";
  const bool is_depth = question.query->kind == Kind::depth;
  Asking asking;
  asking.style = Asking::Style::googletest_with_main;
  asking.suite = "FCL_NEARMISS";
  asking.includes =
      "#include <fcl/narrowphase/collision.h>\n"
      "#include <fcl/narrowphase/continuous_collision.h>\n"
      "#include <fcl/narrowphase/detail/gjk_solver_indep.h>\n"
      "#include <fcl/narrowphase/detail/gjk_solver_libccd.h>\n"
      "#include <fcl/narrowphase/distance.h>\n";
  asking.helpers = at_helper;
  asking.build = "g++ -std=c++17 test.cpp $(pkg-config --cflags --libs fcl eigen3) -lgtest -lpthread";
  if (shapes.has("limit")) {
    const NamedShape way{"way", way_of_sphere(shapes)}, target = target_of(shapes);
    asking.statements = declared(way) + declared(target) + decision("way", target.name, solver);
    return asking;
  }
  const auto [a, b] = two_operands(shapes);
  asking.statements = declared(a) + declared(b);
  if (shapes.has("velocity.x")) {
    const bool naive = subject.name != "fcl-conservative-advancement";
    asking.statements += motion(moving_of(shapes), b, solver, naive);
    asking.members = {"time"};
  } else if (subject.name.starts_with("fcl-distance")) {
    asking.statements += distance(a.name, b.name, solver, shapes.has("box1.half.x"));
    asking.members = {"depth"};
  } else if (shapes.has("triangle.v0.x")) {
    asking.statements += triangle(a.name, libccd);
  } else if (is_depth) {
    asking.statements += depth(a.name, b.name, solver, shapes.has("plane.normal.x") ? -1 : 1);
    asking.members = {"depth", "normal"};
  } else {
    asking.statements += decision(a.name, b.name, solver);
  }
  return asking;
}

}  // namespace nearmiss
