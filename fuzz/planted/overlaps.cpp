/// Mistakes: overlaps.
#include "fuzz/planted/planting.hpp"

namespace nearmiss::planted {
namespace {

double longest(const Vector& half) { return std::max({half.x, half.y, half.z}); }
/// Positions in fixed point with ten binary places.
Vector fixed_point(const Vector& p) {
  return {std::nearbyint(p.x * 1024) / 1024, std::nearbyint(p.y * 1024) / 1024, std::nearbyint(p.z * 1024) / 1024};
}
/// The first of fifteen axes, each absolute cosine made larger by epsilon, that separates the boxes; -1 if none does.
int separating_axis(const collide::BoxBoxInfo<double>& info, double epsilon) {
  const auto c = [&](int i, int j) { return component(info.cosine[i], j); };
  const auto larger = [&](int i, int j) { return component(info.abs_cosine[i], j) + epsilon; };
  const auto h1 = [&](int i) { return component(info.half1, i); };
  const auto h2 = [&](int i) { return component(info.half2, i); };
  const auto d1 = [&](int i) { return component(info.between1, i); };
  for (int i = 0; i < 3; ++i) {
    if (std::abs(d1(i)) > h1(i) + h2(0) * larger(i, 0) + h2(1) * larger(i, 1) + h2(2) * larger(i, 2)) return i;
    const double reach = h2(i) + h1(0) * larger(0, i) + h1(1) * larger(1, i) + h1(2) * larger(2, i);
    if (std::abs(component(info.between2, i)) > reach) return 3 + i;
  }
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      const double reach1 = h1(i1) * larger(i2, j) + h1(i2) * larger(i1, j);
      const double reach2 = h2(j1) * larger(i, j2) + h2(j2) * larger(i, j1);
      if (std::abs(d1(i2) * c(i1, j) - d1(i1) * c(i2, j)) > reach1 + reach2) return 6 + 3 * i + j;
    }
  }
  return -1;
}
/// Whether the axis strictly separates the box, with these half extents around the origin, from the three corners.
bool separates(const Vector& axis, const Vector& half, const Vector& a, const Vector& b, const Vector& c) {
  const double reach = half.x * std::abs(axis.x) + half.y * std::abs(axis.y) + half.z * std::abs(axis.z);
  const double pa = dot(axis, a), pb = dot(axis, b), pc = dot(axis, c);
  return std::min({pa, pb, pc}) > reach || std::max({pa, pb, pc}) < -reach;
}

MISREAD(1, sphere_sphere_overlap, degenerate, "spheres that are apart by less than 1e-12 of their radii overlap",
        "relative tolerance 1e-12") {
  q.sphere1.radius += 1e-12 * (q.sphere1.radius + q.sphere2.radius);
}
MISREAD(2, sphere_sphere_overlap, degenerate, "the numbers are rounded to float", "rounding") {
  q.sphere1 = {in_float(q.sphere1.center), in_float(q.sphere1.radius)};
  q.sphere2 = {in_float(q.sphere2.center), in_float(q.sphere2.radius)};
}
MISTAKE(4, sphere_sphere_overlap, degenerate, "the squared distance may exceed the squared radius by 1e-6 of it",
        "relative tolerance 1e-6 or relative tolerance 5e-7") {
  const Vector between = q.sphere2.center - q.sphere1.center;
  const double reach = q.sphere1.radius + q.sphere2.radius;
  return {dot(between, between) <= reach * reach * (1 + 1e-6)};
}
MISTAKE(5, sphere_sphere_overlap, degenerate, "the squared distance is computed as a^2 + b^2 - 2 a b, and cancels",
        "rounding") {
  const Vector a = q.sphere1.center, b = q.sphere2.center;
  const double reach = q.sphere1.radius + q.sphere2.radius;
  return {dot(a, a) + dot(b, b) - 2 * dot(a, b) <= reach * reach};
}
MISREPORT(10, sphere_sphere_overlap, degenerate, "the squared distance may exceed the squared sum of the radii by 1e-6",
          "absolute tolerance 1e-6 length\\^2") {
  const double r = q.sphere1.radius + q.sphere2.radius;
  if (squared(q.sphere2.center - q.sphere1.center) <= r * r + 1e-6) a = {true};
}
MISREPORT(11, sphere_sphere_overlap, degenerate, "the squares are computed and compared in float",
          "rounding or overflow or underflow") {
  const Vector d = q.sphere2.center - q.sphere1.center;
  const float x = float(d.x), y = float(d.y), z = float(d.z), r = float(q.sphere1.radius + q.sphere2.radius);
  a.decision = x * x + y * y + z * z <= r * r;
}
MISREAD(12, sphere_sphere_overlap, ordinary, "compares the squared distance with the sum of the squared radii",
        "logic") {
  q.sphere1.radius = std::hypot(q.sphere1.radius, q.sphere2.radius);
  q.sphere2.radius = 0;
}
MISTAKE(13, sphere_sphere_overlap, degenerate,
        "expands the squared distance to |a|^2 + |b|^2 - 2 a.b, which cancels far from the origin", "rounding") {
  return sphere_sphere_overlap_5(q);
}
MISTAKE(14, sphere_sphere_overlap, degenerate,
        "the squared distance as |a|^2 + |b|^2 - 2 a.b, which cancels far from the origin", "rounding") {
  const double largest =
      std::max({length(q.sphere1.center), length(q.sphere2.center), q.sphere1.radius, q.sphere2.radius});
  if (largest == 0 || !std::isfinite(largest)) return right(q);
  const int down = -std::ilogb(largest);
  const auto scaled = [&](double x) { return std::ldexp(x, down); };
  const Vector a{scaled(q.sphere1.center.x), scaled(q.sphere1.center.y), scaled(q.sphere1.center.z)};
  const Vector b{scaled(q.sphere2.center.x), scaled(q.sphere2.center.y), scaled(q.sphere2.center.z)};
  const double reach = scaled(q.sphere1.radius) + scaled(q.sphere2.radius);
  return {dot(a, a) + dot(b, b) - 2 * dot(a, b) <= reach * reach};
}
MISREAD(15, sphere_sphere_overlap, degenerate, "the centers are snapped to a grid of 1/1024",
        "rounding or absolute tolerance (1/1024|0\\.000[4-9]\\d*|0\\.001\\d*|[4-9](\\.\\d+)?e-0?4|1(\\.\\d+)?e-0?3) "
        "length") {
  q.sphere1.center = fixed_point(q.sphere1.center);
  q.sphere2.center = fixed_point(q.sphere2.center);
}

MISREAD(1, sphere_box_overlap, ordinary, "half.y is taken for half.z", "logic") { q.box.half.z = q.box.half.y; }
MISTAKE(2, sphere_box_overlap, degenerate, "the squared distance may exceed the squared radius by an absolute 1e-6",
        "absolute tolerance 1e-6 length\\^2") {
  const double r = q.sphere.radius;
  q.sphere.radius = std::sqrt(r * r + 1e-6);
  return {right(inputs::sphere_box_overlap<double>{{q.sphere.center, r}, q.box}).yes() || right(q).yes()};
}
MISTAKE(3, sphere_box_overlap, ordinary, "a squared distance is compared with the radius", "logic") {
  const double distance = -right(inputs::sphere_box_penetration<double>{{q.sphere.center, 0}, q.box}).depth;
  return {distance <= 0 || distance * distance <= q.sphere.radius};
}
MISREPORT(
    6, sphere_box_overlap, ordinary, "the quaternion is taken for one of unit length",
    "unsupported .*(rotation|quaternion|orientation|unit).* or convention .*(rotation|quaternion|orientation|unit).*") {
  const auto& [x, y, z, w] = q.box.orientation;
  const double square = x * x + y * y + z * z + w * w;
  if (std::abs(square - 1) < 1e-14) return;
  const Vector axes[] = {{1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)},
                         {2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)},
                         {2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)}};
  const Vector d = q.sphere.center - q.box.center, h = q.box.half;
  const double local[] = {dot(d, axes[0]), dot(d, axes[1]), dot(d, axes[2])}, half[] = {h.x, h.y, h.z};
  double outside[3];
  for (int k = 0; k < 3; ++k) outside[k] = std::max(0., std::abs(local[k]) - half[k]);
  a = {std::hypot(outside[0], outside[1], outside[2]) <= q.sphere.radius};
}
MISREPORT(7, sphere_box_overlap, degenerate, "the center in the frame of the box is a float", "rounding") {
  const Vector from = q.sphere.center - q.box.center;
  const auto half = numbers_of(q.box.half);
  double outside[3];
  for (int k = 0; k < 3; ++k) {
    const double along = dot(from, axis_of_box(q.box, k)), local = in_float(along);
    if (std::isinf(local) || (along != 0 && std::abs(along) < 1e-30)) return;
    outside[k] = std::max(0., std::abs(local) - half[k]);
  }
  a = {std::hypot(outside[0], outside[1], outside[2]) <= q.sphere.radius};
}
MISREAD(8, sphere_box_overlap, degenerate, "a sphere overlaps if its gap is at most 1e-5 of its radius",
        "relative tolerance 1e-5") {
  q.sphere.radius *= 1 + 1e-5;
}
MISREAD(10, sphere_box_overlap, ordinary, "the half extents are read as the lengths of the sides", "convention") {
  q.box.half = q.box.half * 0.5;
}
MISREPORT(11, sphere_box_overlap, ordinary, "the quaternion is taken to be a unit one", "unsupported or convention") {
  const auto& o = q.box.orientation;
  const double n = o.x * o.x + o.y * o.y + o.z * o.z + o.w * o.w;
  if (std::abs(n - 1) < 1e-12) return;
  const Vector c = into(axes_of_unit(o), q.sphere.center - q.box.center);
  Vector out;
  for (int i = 0; i < 3; ++i) component(out, i) = std::max(std::abs(component(c, i)) - component(q.box.half, i), 0.0);
  a = {length(out) <= q.sphere.radius};
}
MISTAKE(12, sphere_box_overlap, ordinary,
        "the box is grown by the radius along each axis, so that its edges and corners are square", "logic") {
  if (right(q).decision) return {true};
  const std::array<Wide, 3> axes = wide_axes_of(q.box);
  const std::array<Real, 3> half = halves_of(q.box);
  const Wide from = widened(q.sphere.center) - widened(q.box.center);
  for (int i = 0; i < 3; ++i)
    if (std::abs(dot(axes[i], from)) > half[i] + Real(q.sphere.radius)) return {false};
  return {true};
}
MISREPORT(13, sphere_box_overlap, ordinary,
          "the box is inflated by the radius with square corners: each axis is tested by itself", "logic") {
  if (a.decision) return;
  const Vector between = q.sphere.center - q.box.center;
  a.decision = true;
  for (int k = 0; k < 3; ++k)
    if (std::abs(dot(between, axis_of_box(q.box, k))) > component(q.box.half, k) + q.sphere.radius) a.decision = false;
}
MISTAKE(14, sphere_box_overlap, ordinary, "the center is turned by a quaternion that is not normalised",
        "unsupported") {
  const auto& o = q.box.orientation;
  const long double x = o.x, y = o.y, z = o.z, w = o.w, n = x * x + y * y + z * z + w * w;
  if (std::abs(n - 1) < 1e-12L) return right(q);
  const Vector local = narrowed(wide_local(q.box, widened(q.sphere.center)) * n);
  if (!std::isfinite(local.x) || !std::isfinite(local.y) || !std::isfinite(local.z)) return {false};
  return right(inputs::sphere_box_overlap<double>{{local, q.sphere.radius}, {{0, 0, 0}, q.box.half, {0, 0, 0, 1}}});
}
MISREAD(15, sphere_box_overlap, degenerate, "rounds the sphere's center in the frame of the box to float", "rounding") {
  const Vector local = into(axes_of_box(q.box), q.sphere.center - q.box.center);
  q.sphere.center = {in_24_bits(local.x), in_24_bits(local.y), in_24_bits(local.z)};
  q.box.center = {};
  q.box.orientation = {};
}

MISTAKE(1, box_box_overlap, degenerate, "the cross product of edges whose angle has a sine below 1e-5 is left out",
        "relative tolerance 1e-5") {
  q.hint = -1;
  const auto a = right(q);
  if (a.axis >= 6 && length(axis_of(q, a.axis)) < 1e-5) return {true, -1};
  return a;
}
MISTAKE(2, box_box_overlap, ordinary, "cross products of edges are not tested", "logic") {
  q.hint = -1;
  const auto a = right(q);
  if (a.axis >= 6) return {true, -1};
  return a;
}
MISREPORT(3, box_box_overlap, degenerate, "1e-6 is added to each absolute cosine", "relative tolerance 1e-6") {
  const int axis = separating_axis(info_of(q), 1e-6);
  a = {axis < 0, axis};
}
MISREPORT(5, box_box_overlap, ordinary, "with a hint, only the axis of the hint is tested", "logic") {
  if (q.hint < 0 || q.hint >= 15) return;
  const double apart = gap_along(q, q.hint);
  if (apart > 0) return;
  a = {true, -1};
}
MISTAKE(6, box_box_overlap, degenerate, "a cross product with a squared length below 1e-6 is left out",
        "relative tolerance 1e-3 or relative tolerance 1e-6") {
  q.hint = -1;
  const auto exact = right(q);
  if (exact.yes()) return exact;
  bool leaves_out = false;
  for (int axis = 0; axis < 15; ++axis) {
    const Vector along = axis_of(q, axis);
    if (!(gap_along(q, axis) > 0)) continue;
    if (axis < 6 || dot(along, along) >= 1e-6) return {false, axis};
    leaves_out = true;
  }
  return leaves_out ? collide::BoxOverlap<double>{true, -1} : exact;
}
MISREPORT(8, box_box_overlap, ordinary,
          "boxes are apart if their centers are farther than the sum of the longest half extents", "logic") {
  const double reach = longest(q.box1.half) + longest(q.box2.half);
  if (!a.yes() || length(q.box2.center - q.box1.center) <= reach) return;
  const auto distance = [&](int axis) { return gap_along(q, axis); };
  int furthest = 0;
  for (int axis = 1; axis < 6; ++axis) {
    if (distance(axis) > distance(furthest)) furthest = axis;
  }
  a = {false, furthest};
}
MISTAKE(9, box_box_overlap, degenerate, "an axis separates only if the gap along it is above an absolute 1e-4",
        "absolute tolerance 1e-4 length") {
  const auto exact = right(q);
  if (exact.yes()) return exact;
  for (int axis = 0; axis < 15; ++axis) {
    const double size = length(axis_of(q, axis));
    if (!(size > 0)) continue;
    const double gap = gap_along(q, axis) / size;
    if (gap > 1e-4) return {false, axis};
  }
  return {true, -1};
}
MISREPORT(10, box_box_overlap, degenerate, "1e-6 is added to each absolute cosine",
          "relative tolerance [1-9](\\.\\d+)?e-6") {
  if (!a.yes() && separating_axis(info_of(q), 1e-6) < 0) a = {true, -1};
}
MISTAKE(11, box_box_overlap, degenerate, "1e-6 is added to each absolute cosine", "relative tolerance 1e-6") {
  const auto exact = right(q);
  if (exact.yes()) return exact;
  const Axes a1 = axes_of_box(q.box1), a2 = axes_of_box(q.box2);
  const Vector t = into(a1, q.box2.center - q.box1.center), &h1 = q.box1.half, &h2 = q.box2.half;
  double r[3][3], s[3][3];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) r[i][j] = dot(a1[i], a2[j]), s[i][j] = std::abs(r[i][j]) + 1e-6;
  for (int i = 0; i < 3; ++i)
    if (std::abs(component(t, i)) > component(h1, i) + h2.x * s[i][0] + h2.y * s[i][1] + h2.z * s[i][2])
      return {false, i};
  for (int j = 0; j < 3; ++j)
    if (std::abs(t.x * r[0][j] + t.y * r[1][j] + t.z * r[2][j]) >
        component(h2, j) + h1.x * s[0][j] + h1.y * s[1][j] + h1.z * s[2][j])
      return {false, 3 + j};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int k = (i + 1) % 3, l = (i + 2) % 3, m = (j + 1) % 3, n = (j + 2) % 3;
      if (std::abs(component(t, l) * r[k][j] - component(t, k) * r[l][j]) >
          component(h1, k) * s[l][j] + component(h1, l) * s[k][j] + component(h2, m) * s[i][n] +
              component(h2, n) * s[i][m])
        return {false, 6 + 3 * i + j};
    }
  return {true, -1};
}
MISREPORT(12, box_box_overlap, degenerate, "adds 1e-4 to the absolute cosines",
          "relative tolerance (1e-0?4|0\\.000[12]\\d*).*") {
  if (!a.yes() && separating_axis(info_of(q), 1e-4) < 0) a = {true, -1};
}
MISREPORT(13, box_box_overlap, degenerate, "adds 1e-3 to the absolute cosines of all pairs of axes",
          "relative tolerance (1e-0?3|0\\.001(0\\d*)?|0\\.00099\\d*|9\\.9\\d*e-0?4|1\\.0\\d*e-0?3)") {
  if (!a.yes() && separating_axis(info_of(q), 1e-3) < 0) a = {true, -1};
}
MISREPORT(14, box_box_overlap, degenerate, "1e-6 is added to the absolute cosines, as in the textbook",
          "relative tolerance 1e-6") {
  if (a.yes()) return;
  const Wide ones{1, 1, 1};
  const long double sum1 = dot(widened(q.box1.half), ones), sum2 = dot(widened(q.box2.half), ones);
  for (int axis = 0; axis < 15; ++axis) {
    const int i = (axis - 6) / 3, j = (axis - 6) % 3;
    const long double more = axis < 3   ? sum2
                             : axis < 6 ? sum1
                                        : sum1 - component(q.box1.half, i) + sum2 - component(q.box2.half, j);
    const double apart = gap_along(q, axis);
    if (apart > 1e-6L * more) return;
  }
  a = {true, -1};
}
MISTAKE(15, box_box_overlap, degenerate, "1e-6 is added to the absolute cosines of all axes",
        "relative tolerance 1e-0?6") {
  return box_box_overlap_10(q);
}

MISREPORT(1, sphere_triangle_overlap, ordinary, "a sphere with its center behind the triangle does not overlap",
          "logic or unsupported") {
  if (dot(normal_of(q.triangle), q.sphere.center - q.triangle.v0) < 0) a = {};
}
MISREPORT(2, sphere_triangle_overlap, degenerate, "a triangle with a height below 1e-6 of its longest edge is empty",
          "relative tolerance 1e-6") {
  const auto& t = q.triangle;
  const double longest = std::max({length(t.v1 - t.v0), length(t.v2 - t.v1), length(t.v0 - t.v2)});
  const double area = length(normal_of(t));
  if (area > 0 && area < 1e-6 * longest * longest) a = {};
}
MISREPORT(3, sphere_triangle_overlap, ordinary, "the corners are not tested", "logic") {
  const auto& t = q.triangle;
  const Vector corners[] = {t.v0, t.v1, t.v2};
  double to_corner = INFINITY, to_edge = INFINITY;
  for (std::size_t i = 0; i < 3; ++i) {
    to_corner = std::min(to_corner, length(corners[i] - q.sphere.center));
    to_edge = std::min(to_edge, length(nearest(corners[i], corners[(i + 1) % 3], q.sphere.center) - q.sphere.center));
  }
  if (to_corner <= to_edge) a = {};
}
MISREPORT(6, sphere_triangle_overlap, degenerate,
          "the squared distance must be below the squared radius by an absolute 1e-6",
          "absolute tolerance 1e-3 length or absolute tolerance 1e-6 length\\^2") {
  const Vector place = nearest(q.triangle, q.sphere.center);
  const Vector between = q.sphere.center - place;
  if (dot(between, between) > q.sphere.radius * q.sphere.radius - 1e-6) a = {false};
}
MISREPORT(7, sphere_triangle_overlap, degenerate, "a triangle whose squared normal overflows in float does not overlap",
          "overflow") {
  const Vector n = normal_of(q.triangle);
  if (std::isinf(float(dot(n, n)))) a = {false};
}
MISTAKE(9, sphere_triangle_overlap, ordinary,
        "negative weights of the projected center are set to 0, and the weights divided by their sum, for the nearest "
        "point",
        "logic") {
  const auto exact = right(q);
  const auto& [v0, v1, v2] = q.triangle;
  const Vector c = q.sphere.center, n = normal_of(q.triangle);
  const double square = dot(n, n);
  const double x = dot(n, cross(v1 - c, v2 - c)) / square, y = dot(n, cross(v2 - c, v0 - c)) / square;
  const double z = dot(n, cross(v0 - c, v1 - c)) / square;
  if (!exact.yes() || !std::isfinite(x + y + z) || std::min({x, y, z}) >= 0) return exact;
  const double a = std::max(0., x), b = std::max(0., y), d = std::max(0., z), sum = a + b + d;
  return {length(v0 * (a / sum) + v1 * (b / sum) + v2 * (d / sum) - c) <= hardly_more * q.sphere.radius};
}
MISREPORT(
    10, sphere_triangle_overlap, degenerate, "a triangle with a squared normal below 1e-12 is skipped",
    "absolute tolerance 1e-12 length\\^4 or absolute tolerance 1e-6 length\\^2 or absolute tolerance 1e-3 length") {
  const Vector n = normal_of(q.triangle);
  if (dot(n, n) < 1e-12) a = {false};
}
MISTAKE(11, sphere_triangle_overlap, ordinary, "the triangle is culled for centers behind it",
        "convention or unsupported") {
  return sphere_triangle_overlap_1(q);
}
MISTAKE(12, sphere_triangle_overlap, degenerate,
        "the squares that the plane's axis compares leave the range of float, and the axis separates nothing",
        "overflow or underflow") {
  if (right(q).decision) return {true};
  const auto& t = q.triangle;
  const Wide n = wide_normal(t.v0, t.v1, t.v2), center = widened(q.sphere.center);
  const Real e = dot(n, n), d = dot(n, widened(t.v0) - center), r = q.sphere.radius;
  if (!(e > 0) || !none_negative(foot_weights(t, n, center))) return {false};
  constexpr Real highest = std::numeric_limits<float>::max(), lowest = std::numeric_limits<float>::denorm_min();
  const Real left = d * d, other = r * r * e;
  return {(left > highest && other > highest) || (left < lowest && other < lowest)};
}
MISREPORT(13, sphere_triangle_overlap, degenerate,
          "the squared height times the squared normal (length^6) is kept in a float, whose range it leaves",
          "overflow or underflow") {
  const auto& t = q.triangle;
  const Vector n = normal_of(t), to = q.sphere.center - t.v0;
  const double height = dot(n, to);
  const float squared = float(height * height);
  // Within the range of float, and where the foot is not in the triangle, the answer is right.
  if (height == 0 || (squared > 0 && !std::isinf(squared))) return;
  if (dot(cross(t.v1 - t.v0, to), n) < 0 || dot(cross(t.v2 - t.v1, q.sphere.center - t.v1), n) < 0 ||
      dot(cross(t.v0 - t.v2, q.sphere.center - t.v2), n) < 0)
    return;
  a = {squared == 0.0f};
}
MISREPORT(14, sphere_triangle_overlap, degenerate, "refuses a triangle whose squared area leaves the range of float",
          "overflow or underflow") {
  const Vector n = normal_of(q.triangle);
  if (n != Vector{} && !std::isnormal(float(dot(n, n)))) a = {};
}
MISTAKE(15, sphere_triangle_overlap, ordinary,
        "separating axes of the face and the vertices only; those of the edges are forgotten", "logic or unsupported") {
  using Wide = long double;
  const auto product = [](const Vector& a, const Vector& b) {
    return Wide(a.x) * Wide(b.x) + Wide(a.y) * Wide(b.y) + Wide(a.z) * Wide(b.z);
  };
  const Vector n = normal_of(q.triangle);
  const Vector corner[3] = {q.triangle.v0 - q.sphere.center, q.triangle.v1 - q.sphere.center,
                            q.triangle.v2 - q.sphere.center};
  const Wide r2 = Wide(q.sphere.radius) * Wide(q.sphere.radius);
  const Wide height = product(corner[0], n);
  if (height * height > r2 * product(n, n)) return right(q);
  for (int i = 0; i < 3; ++i) {
    const Vector& a = corner[i];
    const Wide square = product(a, a);
    if (square > r2 && product(a, corner[(i + 1) % 3]) >= square && product(a, corner[(i + 2) % 3]) >= square)
      return right(q);
  }
  return {true};
}

MISTAKE(1, aabox_triangle_overlap, degenerate,
        "a side below 1e-6 of the largest one, but not zero, makes the box empty", "relative tolerance 1e-6") {
  const Vector side = q.box.max - q.box.min;
  const double largest = std::max({side.x, side.y, side.z});
  for (const double s : {side.x, side.y, side.z}) {
    if (s > 0 && s < 1e-6 * largest) return {};
  }
  return right(q);
}
MISREAD(2, aabox_triangle_overlap, ordinary, "y and z of v2 are swapped", "logic") {
  std::swap(q.triangle.v2.y, q.triangle.v2.z);
}
MISREAD(3, aabox_triangle_overlap, degenerate, "the box is larger by an absolute 1e-5",
        "absolute tolerance 1e-5 length") {
  const Vector margin{1e-5, 1e-5, 1e-5};
  q.box = {q.box.min - margin, q.box.max + margin};
}
MISREPORT(5, aabox_triangle_overlap, degenerate, "a triangle whose squared normal underflows in float does not overlap",
          "underflow") {
  const Vector n = normal_of(q.triangle);
  const double square = dot(n, n);
  if (square > 0 && float(square) == 0) a = {false};
}
MISREPORT(7, aabox_triangle_overlap, ordinary, "cross products of edges are not tested", "logic") {
  if (a.yes()) return;
  const auto v0 = numbers_of(q.triangle.v0), v1 = numbers_of(q.triangle.v1), v2 = numbers_of(q.triangle.v2);
  const auto low = numbers_of(q.box.min), high = numbers_of(q.box.max);
  for (std::size_t k = 0; k < 3; ++k) {
    if (std::min({v0[k], v1[k], v2[k]}) > high[k] || std::max({v0[k], v1[k], v2[k]}) < low[k]) return;
  }
  const Vector n = normal_of(q.triangle), half = (q.box.max - q.box.min) * 0.5;
  if (!(length(n) > 0) || std::isinf(length(n))) return;
  const double apart = std::abs(dot(n / length(n), (q.box.min + q.box.max) * 0.5 - q.triangle.v0));
  const double reach = std::abs(n.x) * half.x + std::abs(n.y) * half.y + std::abs(n.z) * half.z;
  a = {apart < reach / length(n) * (1 - 1e-12)};
}
MISTAKE(10, aabox_triangle_overlap, ordinary, "the cross products with the third edge are not tested", "logic") {
  if (right(q).decision) return {true};
  const Vector middle = (q.box.min + q.box.max) * 0.5, half = (q.box.max - q.box.min) * 0.5;
  const Vector v[] = {q.triangle.v0 - middle, q.triangle.v1 - middle, q.triangle.v2 - middle};
  const auto apart = [&](const Vector& axis) {
    const double p0 = dot(axis, v[0]), p1 = dot(axis, v[1]), p2 = dot(axis, v[2]);
    const double r = half.x * std::abs(axis.x) + half.y * std::abs(axis.y) + half.z * std::abs(axis.z);
    return std::min({p0, p1, p2}) > r || std::max({p0, p1, p2}) < -r;
  };
  const Vector units[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const Vector& u : units)
    if (apart(u) || apart(cross(u, v[1] - v[0])) || apart(cross(u, v[2] - v[1]))) return {false};
  return {!apart(normal_of(q.triangle))};
}
MISREPORT(11, aabox_triangle_overlap, degenerate, "cross products with a squared length below 1e-10 are skipped",
          "absolute tolerance 1e-10 length\\^2 or absolute tolerance 1e-5 length") {
  if (a.decision) return;
  const Vector center = (q.box.min + q.box.max) * 0.5, half = (q.box.max - q.box.min) * 0.5;
  const Vector v[] = {q.triangle.v0 - center, q.triangle.v1 - center, q.triangle.v2 - center};
  const auto separates = [&](const Vector& axis) {
    const double p[] = {dot(axis, v[0]), dot(axis, v[1]), dot(axis, v[2])};
    const double r = std::abs(axis.x) * half.x + std::abs(axis.y) * half.y + std::abs(axis.z) * half.z;
    return *std::min_element(p, p + 3) > r || *std::max_element(p, p + 3) < -r;
  };
  const Vector axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const Vector& axis : axes)
    if (separates(axis)) return;
  if (separates(normal_of(q.triangle))) return;
  bool skipped = false;
  for (int i = 0; i < 3; ++i)
    for (const Vector& axis : axes) {
      const Vector both = cross(axis, v[(i + 1) % 3] - v[i]);
      if (!separates(both)) continue;
      if (squared(both) >= 1e-10) return;
      skipped = true;
    }
  a.decision = skipped;
}
MISREAD(12, aabox_triangle_overlap, ordinary, "takes the full extents for half extents", "convention") {
  const Vector center = q.box.min * 0.5 + q.box.max * 0.5;
  const Vector extent = q.box.max - q.box.min;
  if (extent.x > 0) q.box.min.x = center.x - extent.x, q.box.max.x = center.x + extent.x;
  if (extent.y > 0) q.box.min.y = center.y - extent.y, q.box.max.y = center.y + extent.y;
  if (extent.z > 0) q.box.min.z = center.z - extent.z, q.box.max.z = center.z + extent.z;
}
MISTAKE(13, aabox_triangle_overlap, degenerate,
        "an early way out squares n.d and n in float, which overflow and underflow", "overflow or underflow") {
  const Vector n = normal_of(q.triangle);
  if (!(length(n) > 0)) return right(q);
  const Vector center = q.box.min * 0.5 + q.box.max * 0.5;
  const float height = float(dot(n, center - q.triangle.v0));
  const float distance2 = height * height / float(dot(n, n));
  if (!(distance2 <= std::numeric_limits<float>::max())) return {};  // finite: decides rightly
  return right(q);
}
MISTAKE(14, aabox_triangle_overlap, ordinary,
        "tests only the triangle's edges, not a box that reaches through its face", "logic") {
  const auto edge = [&](const Vector& a, const Vector& b) {
    return right(inputs::aabox_triangle_overlap<double>{q.box, {a, b, b}}).yes();
  };
  return {edge(q.triangle.v0, q.triangle.v1) || edge(q.triangle.v1, q.triangle.v2) ||
          edge(q.triangle.v2, q.triangle.v0)};
}
MISTAKE(15, aabox_triangle_overlap, ordinary,
        "tests the cross products of the box's axes with two edges of the triangle, and forgets the third edge",
        "logic") {
  if (right(q).yes()) return {true};
  const Vector center = q.box.min * 0.5 + q.box.max * 0.5, half = q.box.max * 0.5 - q.box.min * 0.5;
  const Vector a = q.triangle.v0 - center, b = q.triangle.v1 - center, c = q.triangle.v2 - center;
  const std::array<Vector, 3> axes = {Vector{1, 0, 0}, Vector{0, 1, 0}, Vector{0, 0, 1}};
  for (const Vector& axis : axes) {
    if (separates(axis, half, a, b, c)) return {false};
    for (const Vector& edge : {b - a, c - b})
      if (separates(cross(axis, edge), half, a, b, c)) return {false};
  }
  return {!separates(cross(b - a, c - a), half, a, b, c)};
}

}  // namespace
}  // namespace nearmiss::planted
