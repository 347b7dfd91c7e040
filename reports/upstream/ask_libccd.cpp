#include <fmt/format.h>

#include "corpus/files/errors.hpp"
#include "impl/adapters/motion.hpp"
#include "reports/upstream/asking.hpp"

namespace nearmiss {

namespace libccd_text {
namespace {

using namespace collide;

constexpr std::string_view vectors = R"(struct Vec {
  double x, y, z;
};
Vec operator+(Vec a, Vec b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vec operator*(Vec a, double f) { return {a.x * f, a.y * f, a.z * f}; }
Vec operator/(Vec a, double f) { return {a.x / f, a.y / f, a.z / f}; }
double dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

const int most_iterations = 1000;
int points = 0;
/// EPA has no limit of iterations: beyond so many support points a point inside of the shape ends it.
bool beyond_the_limit() { return ++points > 4 * most_iterations; }

)";

/// The same support function as that of the adapter.
constexpr std::string_view convex = R"(/// A point, segment, triangle or box, rounded by a radius.
struct Convex {
  int corners;
  Vec corner[3];
  Vec half, axes[3];  // of a box
  double radius;
};

Vec center_of(const Convex& s) {
  Vec sum = {0, 0, 0};
  for (int i = 0; i < s.corners; ++i) sum = sum + s.corner[i] / double(s.corners);
  return sum;
}
Vec support_of(const Convex& s, Vec direction) {
  Vec best = s.corner[0];
  for (int i = 1; i < s.corners; ++i) {
    if (dot(s.corner[i], direction) > dot(best, direction)) best = s.corner[i];
  }
  const double reach[3] = {s.half.x, s.half.y, s.half.z};
  for (int i = 0; i < 3; ++i) {
    if (reach[i] > 0) best = best + s.axes[i] * (dot(s.axes[i], direction) < 0 ? -reach[i] : reach[i]);
  }
  const double norm = std::hypot(direction.x, direction.y, direction.z);
  return s.radius > 0 && norm > 0 ? best + direction * (s.radius / norm) : best;
}

)";

constexpr std::string_view corners = R"(/// An axis-aligned box.
struct Corners {
  Vec min, max;
};

Vec center_of(const Corners& b) { return b.min * 0.5 + b.max * 0.5; }
Vec support_of(const Corners& b, Vec d) {
  return {d.x < 0 ? b.min.x : b.max.x, d.y < 0 ? b.min.y : b.max.y, d.z < 0 ? b.min.z : b.max.z};
}

)";

constexpr std::string_view callbacks = R"(template <class S>
void support(const void* shape, const ccd_vec3_t* direction, ccd_vec3_t* point) {
  const S& s = *static_cast<const S*>(shape);
  const Vec p = beyond_the_limit() ? center_of(s) : support_of(s, {direction->v[0], direction->v[1], direction->v[2]});
  ccdVec3Set(point, p.x, p.y, p.z);
}
template <class S>
void center(const void* shape, ccd_vec3_t* point) {
  const Vec p = center_of(*static_cast<const S*>(shape));
  ccdVec3Set(point, p.x, p.y, p.z);
}
)";

constexpr ShapeText shape_texts[] = {
    {Shape::sphere, "const Convex $name = {1, {{$center}}, {}, {}, $radius};\n"},
    {Shape::segment, "const Convex $name = {2, {{$v0}, {$v1}}, {}, {}, 0.0};\n"},
    {Shape::triangle, "const Convex $name = {3, {{$v0}, {$v1}, {$v2}}, {}, {}, 0.0};\n"},
    {Shape::capsule, "const Convex $name = {2, {{$p0}, {$p1}}, {}, {}, $radius};\n"},
    {Shape::box, R"(const Convex $name = {1,
    {{$center}},  // the center
    {$half},  // half the sides
    {{$axis0},
     {$axis1},
     {$axis2}},
    0.0};
)"},
    {Shape::aabox, "const Corners $name = {{$min}, {$max}};\n"},
};

std::string declared(const NamedShape& o) { return nearmiss::declared(o, shape_texts, "libccd"); }

constexpr std::string_view settings = R"(ccd_t ccd;
CCD_INIT(&ccd);
ccd.support1 = support<$a_type>;
ccd.support2 = support<$b_type>;
ccd.center1 = center<$a_type>;
ccd.center2 = center<$b_type>;
ccd.max_iterations = most_iterations;
)";
constexpr std::string_view decision = "got_yes = $function(&$a, &$b, &ccd) != 0;\n";
constexpr std::string_view depth = R"(ccd_vec3_t direction, position;
double depth = 0;
got_yes = $function(&$a, &$b, &ccd, &depth, &direction, &position) == 0;
if (got_yes) {
  got_depth = depth;
  for (int k = 0; k < 3; ++k) got_normal[k] = direction.v[k];
  got_yes = depth >= 0;
}
)";

}  // namespace
}  // namespace libccd_text

Asking ask_libccd(const Case& question, const Subject& subject) {
  using namespace libccd_text;
  const CaseShapes shapes(question);
  const bool gjk = subject.name == "libccd-gjk", is_depth = question.query->kind == Kind::depth;
  const auto [a, b] = sides_of(shapes);
  Asking asking;
  asking.includes = "#include <ccd/ccd.h>\n#include <ccd/vec3.h>\n";
  asking.helpers = std::string(vectors) + std::string(convex);
  if (is_a<AABox>(a)) asking.helpers += corners;
  asking.helpers += callbacks;
  asking.packages = "libccd-dev";
  asking.build = "g++ -std=c++17 test.cpp -lccd";
  const std::string function = std::string(gjk ? "ccdGJK" : "ccdMPR") + (is_depth ? "Penetration" : "Intersect");
  const auto type_of = [](const NamedShape& o) { return is_a<AABox>(o) ? "Corners" : "Convex"; };
  asking.statements = declared(a) + declared(b) +
                      call(std::string(settings) + std::string(is_depth ? depth : decision), a, b,
                           {{"a_type", type_of(a)}, {"b_type", type_of(b)}, {"function", function}});
  if (is_depth) asking.members = {"depth", "normal"};
  return asking;
}

}  // namespace nearmiss
