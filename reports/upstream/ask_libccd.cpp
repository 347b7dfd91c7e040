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

std::string braced(const Vec3<double>& v) { return "{" + literals(v) + "}"; }

struct Declared {
  std::string type, text;
};

/// Declares the shape NAME.
struct CcdShape {
  std::string name;

  Declared round(int count, const std::string& corner, double radius) const {
    return {"Convex",
            fmt::format("const Convex {} = {{{}, {{{}}}, {{}}, {{}}, {}}};\n", name, count, corner, literal(radius))};
  }
  Declared operator()(const Sphere<double>& s) const { return round(1, braced(s.center), s.radius); }
  Declared operator()(const Triangle<double>& t) const {
    return round(3, braced(t.v0) + ", " + braced(t.v1) + ", " + braced(t.v2), 0);
  }
  Declared operator()(const Capsule<double>& c) const { return round(2, braced(c.p0) + ", " + braced(c.p1), c.radius); }
  Declared operator()(const Box<double>& b) const {
    const auto [x, y, z, w] = adapters::unit(b.orientation);
    const Vec3<double> e0{1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)};
    const Vec3<double> e1{2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)};
    const Vec3<double> e2{2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)};
    return {"Convex", fmt::format("const Convex {} = {{1,\n    {{{}}},  // the center\n    {},  // half the sides\n    "
                                  "{{{},\n     {},\n     {}}},\n    0.0}};\n",
                                  name, braced(b.center), braced(b.half), braced(e0), braced(e1), braced(e2))};
  }
  Declared operator()(const AABox<double>& b) const {
    return {"Corners", fmt::format("const Corners {} = {{{}, {}}};\n", name, braced(b.min), braced(b.max))};
  }
  template <class S>
  Declared operator()(const S&) const {
    throw BadInput("libccd has no such shape");
  }
};

std::string settings(const Declared& a, const Declared& b) {
  return filled_in(
      "ccd_t ccd;\n"
      "CCD_INIT(&ccd);\n"
      "ccd.support1 = support<$a>;\n"
      "ccd.support2 = support<$b>;\n"
      "ccd.center1 = center<$a>;\n"
      "ccd.center2 = center<$b>;\n"
      "ccd.max_iterations = most_iterations;\n",
      {{"a", a.type}, {"b", b.type}});
}

}  // namespace
}  // namespace libccd_text

Asking ask_libccd(const Case& question, const Subject& subject) {
  using namespace libccd_text;
  const CaseShapes shapes(question);
  const bool gjk = subject.name == "libccd-gjk", is_depth = question.query->kind == Kind::depth;
  const auto [first, second] = shapes.has("limit")
                                   ? std::pair(NamedShape{"way", way_of_sphere(shapes)}, target_of(shapes))
                                   : two_operands(shapes);
  const Declared a = std::visit(CcdShape{first.name}, first.shape), b = std::visit(CcdShape{second.name}, second.shape);
  Asking asking;
  asking.includes = "#include <ccd/ccd.h>\n#include <ccd/vec3.h>\n";
  asking.helpers = std::string(vectors) + std::string(convex);
  if (a.type == "Corners") asking.helpers += corners;
  asking.helpers += callbacks;
  asking.build = "g++ -std=c++17 test.cpp -lccd";
  const std::string function = std::string(gjk ? "ccdGJK" : "ccdMPR") + (is_depth ? "Penetration" : "Intersect");
  asking.statements = a.text + b.text + settings(a, b);
  if (is_depth) {
    asking.statements += filled_in(
        "ccd_vec3_t direction, position;\n"
        "double depth = 0;\n"
        "got_yes = $function(&$a, &$b, &ccd, &depth, &direction, &position) == 0;\n"
        "if (got_yes) {\n"
        "  got_depth = depth;\n"
        "  for (int k = 0; k < 3; ++k) got_normal[k] = direction.v[k];\n"
        "  got_yes = depth >= 0;\n"
        "}\n",
        {{"function", function}, {"a", first.name}, {"b", second.name}});
    asking.members = {"depth", "normal"};
  } else {
    asking.statements += filled_in("got_yes = $function(&$a, &$b, &ccd) != 0;\n",
                                   {{"function", function}, {"a", first.name}, {"b", second.name}});
  }
  return asking;
}

}  // namespace nearmiss
