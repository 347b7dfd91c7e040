/// Mistakes: penetrations.
#include "fuzz/planted/planting.hpp"

namespace nearmiss::planted {
namespace {

template <class Quaternion>
double length_of(const Quaternion& r) {
  return std::hypot(std::hypot(r.x, r.y), std::hypot(r.z, r.w));
}
/// The corner of a box that reaches furthest along a direction.
Wide support(const collide::Box<double>& box, const Wide& direction) {
  Wide corner = widened(box.center);
  const std::array<Wide, 3> axes = wide_axes_of(box);
  const std::array<Real, 3> half = halves_of(box);
  for (int i = 0; i < 3; ++i) corner = corner + axes[i] * (dot(axes[i], direction) < 0 ? -half[i] : half[i]);
  return corner;
}
/// The middle of the edges of both boxes that reach furthest along the normal.
Vector edge_contact(const collide::Box<double>& box1, const collide::Box<double>& box2, int i, int j, const Vector& n) {
  Vector p = box1.center, r = box2.center;
  for (int k = 0; k < 3; ++k) {
    const Vector a = axis_of_box(box1, k), b = axis_of_box(box2, k);
    if (k != i) p = p + a * std::copysign(component(box1.half, k), dot(a, n));
    if (k != j) r = r - b * std::copysign(component(box2.half, k), dot(b, n));
  }
  const Vector a = axis_of_box(box1, i), b = axis_of_box(box2, j);
  const auto c = right(inputs::closest_points_lines<double>{{p, a}, {r, b}});
  return (c.point1 + c.point2) / 2.0;
}
/// The corner of a box that is furthest along a direction.
Vector furthest(const collide::Box<double>& box, const Vector& along) {
  const auto half = numbers_of(box.half);
  Vector corner = box.center;
  for (int k = 0; k < 3; ++k) {
    const Vector side = axis_of_box(box, k);
    corner = corner + side * std::copysign(half[std::size_t(k)], dot(side, along));
  }
  return corner;
}
/// Half the length of the box's projection onto the unit axis.
double reach_along(const std::array<Vector, 3>& axes, const Vector& half, const Vector& axis) {
  double sum = 0;
  for (int k = 0; k < 3; ++k) sum += component(half, k) * std::abs(dot(axes[k], axis));
  return sum;
}
/// The corner of the box that is furthest along n; the middle of an edge where the axis `without` is left out.
Vector furthest_along(const collide::Box<double>& box, const std::array<Vector, 3>& axes, const Vector& n,
                      int without = -1) {
  Vector corner = box.center;
  for (int k = 0; k < 3; ++k)
    if (k != without) corner = corner + axes[k] * (sign(dot(axes[k], n)) * component(box.half, k));
  return corner;
}
/// Adds the corners in front of the plane that count as contacts.
template <class Counts>
void add_contacts(const inputs::box_plane_penetration<double>& q, inputs::box_plane_penetration<double>::Answer& a,
                  const Counts& counts) {
  if (!a.yes()) return;
  const Axes axes = axes_of_box(q.box);
  for (int i = 0; i < 8; ++i) {
    if (a.corners[i].behind) continue;
    Vector corner = q.box.center;
    for (int k = 0; k < 3; ++k) corner = corner + axes[k] * (component(q.box.half, k) * (i >> k & 1 ? 1 : -1));
    if (counts(corner)) a.corners[i] = {true, corner};
  }
}
struct Face {
  int axis = 0;
  double depth = INFINITY;
};
/// The axis of a face along which two boxes overlap least.
Face least_face(const inputs::box_box_penetration<double>& q) {
  Face least;
  for (int axis = 0; axis < 6; ++axis) {
    const double depth = -gap_along(q, axis);
    if (depth < least.depth) least = {axis, depth};
  }
  return least;
}

MISREPORT(1, sphere_sphere_penetration, degenerate, "centers within 1e-10 of the radii are taken for the same",
          "relative tolerance 1e-10") {
  if (length(q.sphere2.center - q.sphere1.center) < 1e-10 * (q.sphere1.radius + q.sphere2.radius)) {
    a.normal = {1, 0, 0};
    a.contact = q.sphere1.center + a.normal * q.sphere1.radius;
  }
}
MISREPORT(2, sphere_sphere_penetration, ordinary, "the depth has the other sign",
          "convention depth of the other sign") {
  if (a.yes()) a.depth = -a.depth;
}
MISREPORT(3, sphere_sphere_penetration, degenerate, "centers nearer than an absolute 1e-6 get the normal z",
          "absolute tolerance 1e-6 length") {
  if (a.yes() && length(q.sphere2.center - q.sphere1.center) < 1e-6) {
    a.normal = {0, 0, 1};
    a.contact = q.sphere1.center + a.normal * q.sphere1.radius;
  }
}
MISREPORT(4, sphere_sphere_penetration, ordinary, "the normal points from sphere 2 into sphere 1",
          "convention normal reversed") {
  a.normal = -a.normal;
}
MISREPORT(6, sphere_sphere_penetration, ordinary, "the contact is the point of sphere 2",
          "convention .*(contact|place|other).*") {
  if (a.yes()) a.contact = q.sphere2.center - a.normal * q.sphere2.radius;
}
MISREPORT(9, sphere_sphere_penetration, degenerate, "spheres with the same center get the normal 0",
          "unsupported or logic") {
  const Vector between = q.sphere2.center - q.sphere1.center;
  if (between.x == 0 && between.y == 0 && between.z == 0) a.normal = {}, a.contact = q.sphere1.center;
}
MISREPORT(10, sphere_sphere_penetration, degenerate,
          "centers nearer than 1e-7 count as coinciding: the normal is the x axis",
          "absolute tolerance 1e-7 length or absolute tolerance 1e-14 length\\^2") {
  if (a.yes() && length(q.sphere2.center - q.sphere1.center) < 1e-7) {
    a.normal = {1, 0, 0};
    a.contact = q.sphere1.center + a.normal * q.sphere1.radius;
  }
}
MISTAKE(11, sphere_sphere_penetration, degenerate, "centers closer than 1e-6 count as coincident",
        "absolute tolerance 1e-12 length\\^2 or absolute tolerance 1e-6 length") {
  const Vector d = q.sphere2.center - q.sphere1.center;
  if (dot(d, d) < 1e-12) {
    const Vector up{0, 1, 0};
    return {q.sphere1.radius + q.sphere2.radius, up, q.sphere1.center + up * q.sphere1.radius};
  }
  return right(q);
}
MISREPORT(12, sphere_sphere_penetration, ordinary, "the contact is the surface point of sphere 2, not of sphere 1",
          "convention") {
  if (a.yes()) a.contact = narrowed(widened(q.sphere2.center) - widened(a.normal) * Real(q.sphere2.radius));
}
MISREPORT(13, sphere_sphere_penetration, ordinary,
          "the contact is the middle of the overlap, not the surface point of sphere 1", "convention") {
  if (a.yes()) a.contact = q.sphere1.center + a.normal * (q.sphere1.radius - 0.5 * a.depth);
}
MISREPORT(14, sphere_sphere_penetration, ordinary,
          "the contact is the middle of the overlap, not the surface point of sphere 1", "convention") {
  if (a.yes()) a.contact = a.contact - a.normal * (a.depth / 2);
}
MISTAKE(15, sphere_sphere_penetration, ordinary, "the contact is the middle of the overlap, not the point of sphere 1",
        "convention") {
  return sphere_sphere_penetration_14(q);
}

MISREPORT(1, sphere_plane_penetration, degenerate,
          "a normal whose squared length is within 1e-6 of 1 is taken for a unit vector",
          "relative tolerance 1e-6 or absolute tolerance 1e-6 length of a direction") {
  if (std::abs(dot(q.plane.normal, q.plane.normal) - 1) < 1e-6) {
    a.depth = q.sphere.radius - (dot(q.plane.normal, q.sphere.center) + q.plane.offset);
  }
}
MISREPORT(2, sphere_plane_penetration, degenerate, "a depth below an absolute 1e-5 is no contact",
          "absolute tolerance 1e-5 length") {
  if (a.yes() && a.depth < 1e-5) a = {-a.depth, {}, {}};
}
MISREPORT(3, sphere_plane_penetration, ordinary, "the contact is half way between the surfaces",
          "convention contact half way") {
  if (a.yes()) a.contact = a.contact + a.normal * (a.depth / 2);
}
MISREPORT(4, sphere_plane_penetration, ordinary, "a sphere whose center is behind the plane is no contact", "logic") {
  if (a.depth > q.sphere.radius) a = {-a.depth, {}, {}};
}
MISTAKE(5, sphere_plane_penetration, ordinary, "the depth is not divided by the length of the normal",
        "unsupported a given normal that is not of unit length or unsupported a direction that is not of unit length "
        "or convention normal not of unit length") {
  auto a = right(q);
  const auto& [n, offset] = q.plane;
  if (dot(n, n) == 1) return a;
  a.depth = q.sphere.radius - (dot(n, q.sphere.center) + offset);
  if (!a.yes()) return {a.depth, {}, {}};
  a.normal = n / length(n);
  a.contact = q.sphere.center - a.normal * q.sphere.radius;
  return a;
}
MISREPORT(8, sphere_plane_penetration, degenerate, "a depth below 1e-4 of the radius is no contact",
          "relative tolerance 1e-4") {
  if (a.depth > 0 && a.depth < 1e-4 * q.sphere.radius) a = {-a.depth, {}, {}};
}
MISREAD(9, sphere_plane_penetration, ordinary, "a sphere with its center behind the plane is pushed out on that side",
        "convention") {
  const double behind = right(inputs::sphere_plane_penetration<double>{{q.sphere.center, 0}, q.plane}).depth;
  if (behind > 0) q.plane = {-q.plane.normal, -q.plane.offset};
}
MISREAD(10, sphere_plane_penetration, ordinary, "the plane is normal . x = offset", "convention") {
  q.plane.offset = -q.plane.offset;
}
MISTAKE(11, sphere_plane_penetration, ordinary, "the plane is read as normal . x = offset", "convention") {
  return sphere_plane_penetration_10(q);
}
MISREAD(12, sphere_plane_penetration, ordinary, "normalises the plane's normal but not its offset", "unsupported") {
  q.plane.normal = q.plane.normal / length(q.plane.normal);
}
MISREAD(13, sphere_plane_penetration, ordinary, "the plane is two-sided: a center behind it is pushed out at the back",
        "convention or logic") {
  if (dot(q.plane.normal, q.sphere.center) + q.plane.offset < 0) {
    q.plane.normal = -q.plane.normal;
    q.plane.offset = -q.plane.offset;
  }
}
MISTAKE(14, sphere_plane_penetration, ordinary, "the plane is taken to be normal . x = offset", "convention") {
  return sphere_plane_penetration_10(q);
}
MISREPORT(15, sphere_plane_penetration, ordinary,
          "gives the center's projection onto the plane as the contact, not the sphere's deepest point", "convention") {
  if (a.yes()) a.contact = q.sphere.center + a.normal * (a.depth - q.sphere.radius);
}

MISREPORT(1, box_plane_penetration, ordinary, "the last corner is left out", "logic") { a.corners[7] = {}; }
MISREPORT(2, box_plane_penetration, ordinary, "the corners are rounded to float", "rounding") {
  for (auto& corner : a.corners) corner.point = in_float(corner.point);
}
MISREAD(3, box_plane_penetration, ordinary, "x and z of the half extents are swapped", "logic") {
  std::swap(q.box.half.x, q.box.half.z);
}
MISREPORT(6, box_plane_penetration, degenerate,
          "a corner in front of the plane by less than an absolute 1e-2 is a contact",
          "absolute tolerance 1e-2 length") {
  const auto& n = q.plane.normal;
  add_contacts(q, a, [&](const Vector& p) { return (dot(n, p) + q.plane.offset) / length(n) < 1e-2; });
}
MISREPORT(7, box_plane_penetration, degenerate,
          "a corner in front of the plane by less than 1e-3 of the longest half extent is a contact",
          "relative tolerance 1e-3") {
  const Vector half = q.box.half;
  const double size = length(q.plane.normal), margin = 1e-3 * std::max({half.x, half.y, half.z});
  add_contacts(q, a, [&](const Vector& p) { return dot(q.plane.normal / size, p) + q.plane.offset / size < margin; });
}
MISREPORT(8, box_plane_penetration, ordinary, "the half extents along the normal are added with their signs", "logic") {
  const double size = length(q.plane.normal), half[] = {q.box.half.x, q.box.half.y, q.box.half.z};
  const Vector unit = q.plane.normal / size;
  double reach = 0;
  bool has_negative = false;
  for (int k = 0; k < 3; ++k) {
    const double part = half[k] * dot(unit, axis_of_box(q.box, k));
    reach += part;
    has_negative = has_negative || part < 0;
  }
  if (!has_negative) return;
  a.depth = reach - (dot(unit, q.box.center) + q.plane.offset / size);
  if (!a.yes()) a = {a.depth, {}, {}};
}
MISREPORT(9, box_plane_penetration, ordinary, "only the first four contacts are kept", "logic or unsupported") {
  int kept = 0;
  for (auto& corner : a.corners) {
    if (corner.behind && ++kept > 4) corner = {};
  }
}
MISTAKE(10, box_plane_penetration, ordinary, "at most four contacts are kept, in the order of the corners",
        "unsupported or logic") {
  return box_plane_penetration_9(q);
}
MISREAD(11, box_plane_penetration, ordinary, "the plane is read as normal . x = offset", "convention") {
  q.plane.offset = -q.plane.offset;
}
MISTAKE(12, box_plane_penetration, ordinary,
        "the box's rotation matrix is made from the quaternion as if that had unit length", "unsupported") {
  const auto& o = q.box.orientation;
  const std::array<Wide, 3> axes = axes_of_unit<Real>({o.x, o.y, o.z, o.w});
  const std::array<Real, 3> half = halves_of(q.box);
  const Wide n = widened(q.plane.normal);
  const Real size = length(n);
  inputs::box_plane_penetration<double>::Answer answer{};
  Real deepest = 0;
  for (int i = 0; i < 8; ++i) {
    Wide corner = widened(q.box.center);
    for (int k = 0; k < 3; ++k) corner = corner + axes[k] * ((i >> k & 1) != 0 ? half[k] : -half[k]);
    const Real depth = -(dot(n, corner) + Real(q.plane.offset)) / size;
    if (i == 0 || depth > deepest) deepest = depth;
    if (!(depth >= 0)) continue;
    answer.corners[i].behind = true;
    answer.corners[i].point = narrowed(corner);
  }
  answer.depth = double(deepest);
  if (deepest >= 0) answer.normal = narrowed(n / size);
  return answer;
}
MISREPORT(13, box_plane_penetration, degenerate, "corners up to 1e-4 in front of the plane count as contacts",
          "absolute tolerance 1e-4 length") {
  const double size = length(q.plane.normal);
  add_contacts(q, a, [&](const Vector& p) { return dot(q.plane.normal / size, p) + q.plane.offset / size <= 1e-4; });
}
MISREPORT(14, box_plane_penetration, degenerate, "corners up to 1e-4 in front of the plane count as contacts",
          "absolute tolerance (1e-4|0\\.0001) length") {
  if (!a.yes()) return;
  const Wide n = widened(q.plane.normal);
  for (std::size_t i = 0; i < 8; ++i) {
    if (a.corners[i].behind) continue;
    Wide corner = widened(q.box.center);
    for (int k = 0; k < 3; ++k) {
      const long double h = component(q.box.half, k);
      corner = corner + wide_axis(q.box, k) * ((i >> k & 1) != 0 ? h : -h);
    }
    if ((dot(n, corner) + q.plane.offset) / length(n) < 1e-4L) a.corners[i] = {true, narrowed(corner)};
  }
}
MISREPORT(15, box_plane_penetration, ordinary, "the corners are numbered with x in the highest bit and z in the lowest",
          "convention") {
  auto answer = a;
  for (int i = 0; i < 8; ++i) answer.corners[i] = a.corners[(i & 1) << 2 | (i & 2) | i >> 2];
  a = answer;
}

MISREPORT(1, sphere_box_penetration, degenerate,
          "a center less than 1e-10 of the radius below the surface gets the normal (0, 0, 1)",
          "relative tolerance 1e-10") {
  const double below = a.depth - q.sphere.radius;
  if (below > 0 && below < 1e-10 * q.sphere.radius) a.normal = {0, 0, 1};
}
MISREPORT(2, sphere_box_penetration, ordinary, "a center in the box is no contact", "unsupported or logic") {
  if (a.depth > q.sphere.radius) a = {-a.depth, {}, {}};
}
MISREPORT(4, sphere_box_penetration, degenerate, "a center within an absolute 1e-5 of the surface gets the normal z",
          "absolute tolerance 1e-5 length") {
  if (a.yes() && std::abs(a.depth - q.sphere.radius) < 1e-5) a.normal = {0, 0, 1};
}
MISREPORT(5, sphere_box_penetration, ordinary, "a center in the box leaves it along the axis of the least half extent",
          "logic") {
  if (!(a.depth > q.sphere.radius)) return;
  const Vector half = q.box.half;
  const int axis = half.x <= half.y && half.x <= half.z ? 0 : half.y <= half.z ? 1 : 2;
  const Vector out = axis_of_box(q.box, axis);
  if (length(cross(out, a.normal)) < 1e-9) return;
  const double along = dot(out, q.sphere.center - q.box.center), extent = std::min({half.x, half.y, half.z});
  a.depth = q.sphere.radius + extent - std::abs(along);
  a.normal = out * (along > 0 ? -1. : 1.);
  a.contact = q.sphere.center + a.normal * q.sphere.radius;
}
MISREPORT(10, sphere_box_penetration, ordinary,
          "center inside: the face of the largest coordinate instead of the nearest face", "logic") {
  const Vector h = q.box.half, c = local(q.box, q.sphere.center);
  if (!(std::abs(c.x) < h.x && std::abs(c.y) < h.y && std::abs(c.z) < h.z)) return;
  const int k = largest(c);
  const Vector inward = axis_of_box(q.box, k) * (component(c, k) < 0 ? 1 : -1);
  a = {q.sphere.radius + component(h, k) - std::abs(component(c, k)), inward,
       q.sphere.center + inward * q.sphere.radius};
}
MISREPORT(11, sphere_box_penetration, ordinary,
          "for a center inside, the nearest face is chosen by the largest coordinate divided by the half extent",
          "logic") {
  const Axes axes = axes_of_box(q.box);
  const Vector c = into(axes, q.sphere.center - q.box.center);
  const Vector& h = q.box.half;
  for (int i = 0; i < 3; ++i)
    if (std::abs(component(c, i)) >= component(h, i)) return;
  int face = 0, nearest_face = 0;
  for (int i = 1; i < 3; ++i) {
    if (std::abs(component(c, i)) / component(h, i) > std::abs(component(c, face)) / component(h, face)) face = i;
    if (component(h, i) - std::abs(component(c, i)) < component(h, nearest_face) - std::abs(component(c, nearest_face)))
      nearest_face = i;
  }
  if (face == nearest_face) return;
  const Vector normal = axes[face] * (component(c, face) < 0 ? 1.0 : -1.0);
  a = {q.sphere.radius + component(h, face) - std::abs(component(c, face)), normal,
       q.sphere.center + normal * q.sphere.radius};
}
MISREPORT(12, sphere_box_penetration, degenerate, "a center inside of the box grown by a thousandth counts as inside",
          "relative tolerance (1e-0?3|0\\.001).*") {
  if (!a.yes()) return;
  const Vector p = local(q.box, q.sphere.center);
  bool outside = false;
  int face = 0;
  double least = INFINITY;
  for (int k = 0; k < 3; ++k) {
    const double half = component(q.box.half, k), at = std::abs(component(p, k));
    if (at > half * (1 + 1e-3)) return;
    if (at > half) outside = true;
    if (half - at < least) least = half - at, face = k;
  }
  if (!outside) return;
  const Vector axis = axis_of_box(q.box, face);
  const Vector normal = component(p, face) < 0 ? axis : -axis;
  a = {q.sphere.radius + least, normal, q.sphere.center + normal * q.sphere.radius};
}
MISTAKE(13, sphere_box_penetration, degenerate,
        "a center whose squared distance from the box is at most 1e-6 counts as inside",
        "absolute tolerance (1e-0?6|0\\.000001|9\\.[89]\\d*e-0?7|1\\.0\\d*e-0?6) length\\^2 or absolute tolerance "
        "(1e-0?3|0\\.001(0\\d*)?|0\\.00099\\d*|9\\.9\\d*e-0?4|1\\.0\\d*e-0?3) length") {
  const Vector from = q.sphere.center - q.box.center;
  Vector axes[3];
  double local[3], half[3], outside2 = 0;
  int face = 0;
  for (int k = 0; k < 3; ++k) {
    axes[k] = axis_of(inputs::box_box_overlap<double>{q.box, q.box}, k);
    local[k] = dot(from, axes[k]), half[k] = component(q.box.half, k);
    const double excess = std::max(0.0, std::abs(local[k]) - half[k]);
    outside2 += excess * excess;
    if (half[k] - std::abs(local[k]) < half[face] - std::abs(local[face])) face = k;
  }
  if (!(outside2 > 0) || outside2 > 1e-6) return right(q);
  const double depth = q.sphere.radius + half[face] - std::abs(local[face]);
  if (depth < 0) return {depth};
  const Vector normal = axes[face] * -std::copysign(1.0, local[face]);
  return {depth, normal, q.sphere.center + normal * q.sphere.radius};
}
MISREPORT(14, sphere_box_penetration, ordinary,
          "a center inside leaves by the face nearest as a share of the half extent, not in length", "logic") {
  const Wide c = widened(q.sphere.center), l = wide_local(q.box, c);
  int face = 0;
  long double most = -1;
  for (int k = 0; k < 3; ++k) {
    const long double h = component(q.box.half, k), at = std::abs(component(l, k));
    if (at >= h) return;
    if (at / h > most) most = at / h, face = k;
  }
  const long double side = component(l, face) < 0 ? -1 : 1, h = component(q.box.half, face);
  const Wide n = wide_axis(q.box, face) * -side;
  if (dot(n, widened(a.normal)) > 1 - 1e-9L) return;
  const long double r = q.sphere.radius, depth = r + h - std::abs(component(l, face));
  a = {double(depth), narrowed(n), narrowed(c + n * r)};
}
MISREPORT(15, sphere_box_penetration, ordinary,
          "for a center inside, selects the face by the largest ratio of coordinate to half extent, not by the least "
          "distance",
          "logic") {
  const auto axes = axes_of_box(q.box);
  const Vector local = into(axes, q.sphere.center - q.box.center);
  int face = 0;
  double most = -1;
  for (int k = 0; k < 3; ++k) {
    const double at = std::abs(component(local, k)), half = component(q.box.half, k);
    if (!(at < half)) return;
    if (at / half > most) most = at / half, face = k;
  }
  const double inward = component(q.box.half, face) - std::abs(component(local, face));
  if (!(q.sphere.radius + inward > a.depth * (1 + 1e-14))) return;
  a.depth = q.sphere.radius + inward;
  a.normal = axes[face] * -sign(component(local, face));
  a.contact = q.sphere.center + a.normal * q.sphere.radius;
}

MISREPORT(1, box_box_penetration, ordinary, "the normal has the wrong sign in one octant of the line of centers",
          "logic") {
  const Vector between = q.box2.center - q.box1.center;
  if (between.x < 0 && between.y < 0 && between.z < 0) a.normal = -a.normal;
}
MISREPORT(5, box_box_penetration, ordinary, "the overlap along a cross product is not divided by its length", "logic") {
  if (!a.yes()) return;
  for (int axis = 6; axis < 15; ++axis) {
    const Vector along = axis_of(q, axis);
    if (length(along) < 1e-6) continue;
    const double overlap = -gap_along(q, axis);
    if (overlap < a.depth) a.depth = overlap, a.axis = axis, a.normal = along / length(along);
  }
  if (dot(a.normal, q.box2.center - q.box1.center) < 0) a.normal = -a.normal;
}
MISREPORT(7, box_box_penetration, degenerate, "a cross product must beat the axes of the boxes by 5 percent",
          "relative tolerance .*e-[12]") {
  if (!a.yes() || a.axis < 6) return;
  const auto [face, least] = least_face(q);
  if (a.depth * 1.05 < least) return;
  Vector normal = axis_of(q, face);
  if (dot(normal, q.box2.center - q.box1.center) < 0) normal = -normal;
  const Vector contact =
      face < 3 ? furthest(q.box2, -normal) + normal * (least / 2) : furthest(q.box1, normal) - normal * (least / 2);
  a = {least, face, normal, contact};
}
MISREPORT(8, box_box_penetration, ordinary, "the contact is the point of box 2", "convention") {
  if (a.yes()) a.contact = a.contact - a.normal * (a.depth / 2);
}
MISREAD(9, box_box_penetration, ordinary, "the numbers of the unit quaternions are floats", "rounding") {
  for (auto* box : {&q.box1, &q.box2}) {
    auto& r = box->orientation;
    const double size = length_of(r);
    if (std::isfinite(size))
      r = {in_float(r.x / size), in_float(r.y / size), in_float(r.z / size), in_float(r.w / size)};
  }
}
MISREPORT(10, box_box_penetration, degenerate,
          "a cross product must be better than a face by a factor 1.05 to be chosen",
          "relative tolerance (0\\.05|5e-2|1\\.05).*") {
  if (!a.yes() || a.axis < 6) return;
  const auto [best, depth] = least_face(q);
  if (depth > 1.05 * a.depth) return;
  Vector n = axis_of(q, best);
  if (dot(n, q.box2.center - q.box1.center) < 0) n = -n;
  const bool of_first = best < 3;
  const auto& other = of_first ? q.box2 : q.box1;
  Vector deepest = other.center;  // the corner of the other box that reaches deepest
  const double half[] = {other.half.x, other.half.y, other.half.z};
  for (int i = 0; i < 3; ++i) {
    const Vector axis = axis_of(q, of_first ? 3 + i : i);
    const bool along = dot(axis, n) > 0;
    deepest = deepest + axis * (along == of_first ? -half[i] : half[i]);
  }
  a = {depth, best, n, deepest + n * (of_first ? depth / 2 : -depth / 2)};
}
MISREPORT(11, box_box_penetration, degenerate, "an edge axis must beat the best face axis by 5 percent",
          "relative tolerance ((4\\.\\d*|5|5\\.\\d*)e-0?2|0\\.0(4\\d+|5\\d*)).*") {
  if (!a.yes() || a.axis < 6) return;
  const auto [face, best] = least_face(q);
  if (!(best <= 1.05 * a.depth)) return;
  Vector n = axis_of(q, face);
  if (dot(n, q.box2.center - q.box1.center) < 0) n = -n;
  const bool of_first = face < 3;
  const auto& other = of_first ? q.box2 : q.box1;
  const double h[] = {other.half.x, other.half.y, other.half.z};
  const Vector into = of_first ? -n : n;
  Vector deepest = other.center;
  for (int i = 0; i < 3; ++i) {
    const Vector axis = axis_of(q, of_first ? 3 + i : i);
    deepest = deepest + axis * (dot(axis, into) < 0 ? -h[i] : h[i]);
  }
  a = {best, face, n, deepest - into * (best / 2)};
}
MISREPORT(12, box_box_penetration, degenerate,
          "a cross product must beat the best face axis by 0.2 percent of the depth",
          "relative tolerance (0\\.002\\d*|0\\.0019\\d*|2(\\.0\\d*)?e-0?3|1\\.9\\d*e-0?3)") {
  if (!a.yes() || a.axis < 6) return;
  const auto [best, least] = least_face(q);
  if (a.depth < 0.998 * least) return;
  Wide n = wide_axes_of(best < 3 ? q.box1 : q.box2)[best % 3];
  if (dot(n, widened(q.box2.center) - widened(q.box1.center)) < 0) n = -n;
  const Wide contact =
      best < 3 ? support(q.box2, -n) + n * (Real(least) / 2) : support(q.box1, n) - n * (Real(least) / 2);
  a = {least, best, narrowed(n), narrowed(contact)};
}
MISREPORT(13, box_box_penetration, ordinary, "overlaps along cross products are not divided by the length of the axis",
          "logic") {
  double face = -INFINITY, edge = -INFINITY;
  int axis = -1;
  for (int k = 0; k < 15; ++k) {
    if (axis_of(q, k) == Vector{}) continue;
    const double gap = gap_along(q, k);
    if (k < 6) {
      face = std::max(face, gap);
    } else if (gap > edge)
      edge = gap, axis = k;
  }
  if (axis < 0 || !(edge > face + 1e-9 * std::abs(face))) return;
  a.axis = axis;
  if (!a.yes()) {
    if (edge > 0) a.depth = -edge;
    return;
  }
  a.depth = std::max(-edge, 0.0);
  a.normal = axis_of(q, axis);
  a.normal = a.normal / length(a.normal);
  if (dot(a.normal, q.box2.center - q.box1.center) < 0) a.normal = -a.normal;
  a.contact = edge_contact(q.box1, q.box2, (axis - 6) / 3, (axis - 6) % 3, a.normal);
}
MISTAKE(14, box_box_penetration, ordinary, "the overlaps along the cross products are not divided by their lengths",
        "logic") {
  auto r = right(q);
  if (!r.yes()) return r;
  int best = r.axis;
  double least = r.depth;
  for (int axis = 6; axis < 15; ++axis) {
    if (axis_of(q, axis) == Vector{}) continue;
    const double overlap = -gap_along(q, axis);
    if (overlap < least && overlap >= 0) best = axis, least = overlap;
  }
  if (best < 6) return r;
  if (best == r.axis) {
    r.depth = least;
    return r;
  }
  const Vector between = q.box2.center - q.box1.center;
  Vector n = axis_of(q, best);
  n = n / length(n);
  if (dot(n, between) < 0) n = -n;
  const int first = (best - 6) / 3, second = (best - 6) % 3;
  Vector on1 = q.box1.center, on2 = q.box2.center;
  for (int k = 0; k < 3; ++k) {
    const Vector a = axis_of(q, k), b = axis_of(q, 3 + k);
    if (k != first) on1 = on1 + a * (sign(dot(n, a)) * component(q.box1.half, k));
    if (k != second) on2 = on2 - b * (sign(dot(n, b)) * component(q.box2.half, k));
  }
  const auto pair =
      right(inputs::closest_points_lines<double>{{on1, axis_of(q, first)}, {on2, axis_of(q, 3 + second)}});
  return {least, best, n, (pair.point1 + pair.point2) * 0.5};
}
MISREPORT(15, box_box_penetration, degenerate,
          "keeps an earlier axis unless a later one is better by a thousandth of the depth",
          "relative tolerance 1e-3") {
  if (!(a.depth > 0)) return;
  const auto axes1 = axes_of_box(q.box1), axes2 = axes_of_box(q.box2);
  const Vector between = q.box2.center - q.box1.center;
  int best = -1;
  double least = 0;
  Vector n;
  for (int axis = 0; axis < 15; ++axis) {
    Vector u = axis_of(q, axis);
    const double size = length(u);
    if (!(size > 0)) continue;
    u = u / size;
    const double overlap =
        reach_along(axes1, q.box1.half, u) + reach_along(axes2, q.box2.half, u) - std::abs(dot(between, u));
    if (best >= 0 && !(overlap < least * (1 - 1e-3))) continue;
    best = axis, least = overlap, n = u * sign(dot(between, u));
  }
  if (best == a.axis || !(least > a.depth * (1 + 1e-12))) return;
  a.depth = least;
  a.axis = best;
  a.normal = n;
  if (best < 3) {
    a.contact = furthest_along(q.box2, axes2, -n) + n * (least / 2);
  } else if (best < 6) {
    a.contact = furthest_along(q.box1, axes1, n) - n * (least / 2);
  } else {
    const int i = (best - 6) / 3, j = (best - 6) % 3;
    const auto near = right(inputs::closest_points_lines<double>{{furthest_along(q.box1, axes1, n, i), axes1[i]},
                                                                 {furthest_along(q.box2, axes2, -n, j), axes2[j]}});
    a.contact = near.point1 * 0.5 + near.point2 * 0.5;
  }
}

}  // namespace
}  // namespace nearmiss::planted
