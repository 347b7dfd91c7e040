// The kernels of batches of points, spheres, segments, capsules and triangles; kernels.hpp says what a kernel does.
// Included inside a namespace for each instruction set, as detail/batch/values.hpp says.
#include <collide/detail/strict_begin.hpp>

template <class T>
struct WideTriangle {
  WideVec3<T> v0, v1, v2;
};
/// A segment and a radius.
template <class T>
struct WideCapsule {
  WideVec3<T> p0, p1;
  Wide<T> radius;
};

// The shapes as balls and capsules.
template <class T>
COLLIDE_BATCH_FUNCTION WideBall<T> point_in(Reader<T>& in) {
  return {in.vec3(), Wide<T>::splat(T(0))};
}
template <class T>
COLLIDE_BATCH_FUNCTION WideCapsule<T> segment_in(Reader<T>& in) {
  return {in.vec3(), in.vec3(), Wide<T>::splat(T(0))};
}
template <class T>
COLLIDE_BATCH_FUNCTION WideCapsule<T> capsule_in(Reader<T>& in) {
  return {in.vec3(), in.vec3(), in.number()};
}

/// A power of two for each lane: of_moderate_length divides a vector by it, and Axis multiplies an end by it.
template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> power_of_length(const WideVec3<T>& v) {
  using L = Wide<T>;
  const L one = L::splat(T(1)), infinity = L::splat(std::numeric_limits<T>::infinity());
  const L largest = larger(larger(absolute(v.x), absolute(v.y)), absolute(v.z));
  const L is_moderate = (L::splat(T(0.0625)) <= largest) & (largest <= L::splat(T(16)));
  const L is_number = (L::splat(T(0)) < largest) & (largest < infinity);
  return select(and_not(is_number, is_moderate), largest & infinity, one);  // the bits of infinity are the exponent's
}
/// The lanes in which that power is a number, and its inverse too: others have a subnormal or huge length.
template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> is_usual_power(Wide<T> power) {
  return (Wide<T>::splat(std::numeric_limits<T>::min()) <= power) &
         (power <= Wide<T>::splat(std::numeric_limits<T>::max() / T(16)));
}

/// As Axis of nearest_points.hpp.
template <class T>
struct WideAxis {
  WideVec3<T> start, direction;
  Wide<T> end;

  COLLIDE_BATCH_FUNCTION static WideAxis of(const WideVec3<T>& from, const WideVec3<T>& to, const WideVec3<T>& origin) {
    const WideVec3<T> way = to - from;
    const Wide<T> power = power_of_length(way);
    return {from - origin, way * (Wide<T>::splat(T(1)) / power), power};
  }
  COLLIDE_BATCH_FUNCTION WideVec3<T> at(Wide<T> parameter) const { return start + direction * parameter; }
};
template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> parameter_within(Wide<T> x, Wide<T> end) {
  return larger(smaller(x, end), Wide<T>::splat(T(0)));
}
template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> inverse_or_zero(Wide<T> x) {
  return (Wide<T>::splat(T(1)) / x) & (Wide<T>::splat(std::numeric_limits<T>::min()) <= x);
}
template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> nearest_parameter(const WideAxis<T>& axis, Wide<T> inverse2, const WideVec3<T>& point) {
  return parameter_within(dot(point - axis.start, axis.direction) * inverse2, axis.end);
}

/// Whether a way is within reach, and all numbers of the shapes are finite.
template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> is_overlap(const WideVec3<T>& way, Wide<T> reach, Wide<T> finite) {
  return ((dot(way, way) - reach * reach) <= Wide<T>::splat(T(0))) & finite;
}
template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> overlap(const WideBall<T>& ball, const WideCapsule<T>& capsule, Writer<T>& out) {
  using L = Wide<T>;
  const WideAxis<T> axis = WideAxis<T>::of(capsule.p0, capsule.p1, ball.center);
  const WideVec3<T> origin{L::splat(T(0)), L::splat(T(0)), L::splat(T(0))};
  const L nearest = nearest_parameter(axis, inverse_or_zero(dot(axis.direction, axis.direction)), origin);
  out.flag(is_overlap(axis.at(nearest), ball.radius + capsule.radius,
                      are_finite(ball.center, ball.radius, capsule.p0, capsule.p1, capsule.radius)));
  return is_usual_power(axis.end);
}
template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> overlap(const WideCapsule<T>& capsule1, const WideCapsule<T>& capsule2, Writer<T>& out) {
  using L = Wide<T>;
  const WideAxis<T> a = WideAxis<T>::of(capsule1.p0, capsule1.p1, capsule1.p0),
                    b = WideAxis<T>::of(capsule2.p0, capsule2.p1, capsule1.p0);
  const WideVec3<T> normal = cross(a.direction, b.direction);
  const L inverse_a = inverse_or_zero(dot(a.direction, a.direction));
  const L inverse_b = inverse_or_zero(dot(b.direction, b.direction));
  const L at = dot(cross(b.start - a.start, b.direction), normal);
  const L near_normal = parameter_within(at * inverse_or_zero(dot(normal, normal)), a.end);
  const L second = nearest_parameter(b, inverse_b, a.at(near_normal));
  const L first = nearest_parameter(a, inverse_a, b.at(second));
  out.flag(
      is_overlap(b.at(second) - a.at(first), capsule1.radius + capsule2.radius,
                 are_finite(capsule1.p0, capsule1.p1, capsule1.radius, capsule2.p0, capsule2.p1, capsule2.radius)));
  return is_usual_power(a.end) & is_usual_power(b.end);
}

template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> block(batched::point_sphere_overlap, Reader<T>& in, Writer<T>& out) {
  const WideBall<T> point = point_in(in);
  return overlap(point, in.ball(), out);
}
template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> block(batched::point_capsule_overlap, Reader<T>& in, Writer<T>& out) {
  const WideBall<T> point = point_in(in);
  return overlap(point, capsule_in(in), out);
}
template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> block(batched::sphere_segment_overlap, Reader<T>& in, Writer<T>& out) {
  const WideBall<T> ball = in.ball();
  return overlap(ball, segment_in(in), out);
}
template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> block(batched::sphere_capsule_overlap, Reader<T>& in, Writer<T>& out) {
  const WideBall<T> ball = in.ball();
  return overlap(ball, capsule_in(in), out);
}
template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> block(batched::segment_capsule_overlap, Reader<T>& in, Writer<T>& out) {
  const WideCapsule<T> segment = segment_in(in);
  return overlap(segment, capsule_in(in), out);
}
template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> block(batched::capsule_capsule_overlap, Reader<T>& in, Writer<T>& out) {
  const WideCapsule<T> capsule = capsule_in(in);
  return overlap(capsule, capsule_in(in), out);
}

/// As SphereFromTriangle.
template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> block(batched::sphere_triangle_overlap, Reader<T>& in, Writer<T>& out) {
  using L = Wide<T>;
  const L zero = L::splat(T(0)), one = L::splat(T(1));
  const WideBall<T> ball = in.ball();
  const WideTriangle<T> triangle{in.vec3(), in.vec3(), in.vec3()};
  const auto& [v0, v1, v2] = triangle;
  const WideVec3<T> edge0 = v1 - v0, edge1 = v2 - v1, edge2 = v0 - v2;
  const WideVec3<T> w0 = ball.center - v0, w1 = ball.center - v1, w2 = ball.center - v2;
  const L length0 = dot(edge0, edge0), base_share = dot(w0, edge0) / length0;
  const auto squared_distance = [&](const WideVec3<T>& from_start, const WideVec3<T>& edge, L length2, L along)
                                    COLLIDE_BATCH_LAMBDA {
                                      const L share = smaller(larger(along, zero), one) & (zero < length2);
                                      const WideVec3<T> from_edge = from_start - edge * share;
                                      return dot(from_edge, from_edge);
                                    };
  const L length1 = dot(edge1, edge1), length2 = dot(edge2, edge2);
  const L apart0 = squared_distance(w0, edge0, length0, base_share),
          apart1 = squared_distance(w1, edge1, length1, dot(w1, edge1) / length1),
          apart2 = squared_distance(w2, edge2, length2, dot(w2, edge2) / length2);
  const L apex_share = zero - dot(edge2, edge0) / length0;
  const WideVec3<T> none{zero, zero, zero};
  const WideVec3<T> height = (none - edge2) - edge0 * apex_share, beside = w0 - edge0 * base_share;
  const L apex_weight = dot(beside, height) / dot(height, height), base_weight = base_share - apex_weight * apex_share;
  const L inside = (zero <= apex_weight) & (zero <= base_weight) & ((base_weight + apex_weight) <= one);
  const WideVec3<T> from_face = beside - height * apex_weight;
  const L radius2 = ball.radius * ball.radius;
  const L reaches = ((apart0 - radius2) <= zero) | ((apart1 - radius2) <= zero) | ((apart2 - radius2) <= zero) |
                    (((dot(from_face, from_face) - radius2) <= zero) & inside);
  out.flag(reaches & are_finite(v0, v1, v2, ball.center, ball.radius));
  return every_lane<T>();
}

/// A core of one or two vertices, relative to an origin, as core_of makes it.
template <class T, std::size_t n>
struct WideCore {
  std::array<WideVec3<T>, n> vertices;
  WideVec3<T> direction;  ///< of the edge
  Wide<T> radius;
  Wide<T> usual;  ///< a mask
};
template <class T>
COLLIDE_BATCH_FUNCTION WideCore<T, 1> core_of(const WideBall<T>& ball, const WideVec3<T>& origin) {
  const Wide<T> none = Wide<T>::splat(T(0));
  return {{ball.center - origin}, {none, none, none}, ball.radius, every_lane<T>()};
}
template <class T>
COLLIDE_BATCH_FUNCTION WideCore<T, 2> core_of(const WideCapsule<T>& capsule, const WideVec3<T>& origin) {
  const WideVec3<T> along = capsule.p1 - capsule.p0;
  const Wide<T> power = power_of_length(along);
  return {{capsule.p0 - origin, capsule.p1 - origin},
          along * (Wide<T>::splat(T(1)) / power),
          capsule.radius,
          is_usual_power(power)};
}

template <class T>
COLLIDE_BATCH_FUNCTION WideVec3<T> negated(const WideVec3<T>& a) {
  return {negated(a.x), negated(a.y), negated(a.z)};
}
/// A mask of the lanes in which a vector is zero.
template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> is_zero(const WideVec3<T>& a) {
  const Wide<T> zero = Wide<T>::splat(T(0));
  return (a.x == zero) & (a.y == zero) & (a.z == zero);
}

/// As WayBetween. For each vertex of a core, the mask of the lanes in which an end of the way belongs to it.
template <class T, std::size_t of_a, std::size_t of_b>
struct WideWay {
  WideVec3<T> from, way;
  std::array<Wide<T>, of_a> from_of;
  std::array<Wide<T>, of_b> to_of;
};
template <class T, std::size_t of_a, std::size_t of_b>
COLLIDE_BATCH_FUNCTION WideWay<T, of_a, of_b> select(Wide<T> where, const WideWay<T, of_a, of_b>& a,
                                                     const WideWay<T, of_a, of_b>& b) {
  WideWay<T, of_a, of_b> way{select(where, a.from, b.from), select(where, a.way, b.way), {}, {}};
  for (std::size_t i = 0; i < of_a; ++i) way.from_of[i] = select(where, a.from_of[i], b.from_of[i]);
  for (std::size_t i = 0; i < of_b; ++i) way.to_of[i] = select(where, a.to_of[i], b.to_of[i]);
  return way;
}
template <class T, std::size_t of_a, std::size_t of_b>
COLLIDE_BATCH_FUNCTION WideWay<T, of_b, of_a> reversed(const WideWay<T, of_a, of_b>& way, const WideVec3<T>& from) {
  return {from, negated(way.way), way.to_of, way.from_of};
}

template <class T>
COLLIDE_BATCH_FUNCTION WideVec3<T> across_direction(const WideVec3<T>& v, const WideVec3<T>& direction) {
  const Wide<T> length2 = dot(direction, direction);
  const WideVec3<T> part = v - direction * (dot(v, direction) / length2);
  return part - direction * (dot(part, direction) / length2);
}
/// From the point of an edge that is nearest to a point.
template <class T>
COLLIDE_BATCH_FUNCTION WideWay<T, 2, 1> way_to_point(const WideCore<T, 2>& edge, const WideVec3<T>& point) {
  const Wide<T> zero = Wide<T>::splat(T(0)), all = every_lane<T>();
  const auto& [v0, v1] = edge.vertices;
  const WideVec3<T> from0 = point - v0, from1 = point - v1;
  const Wide<T> along = dot(from0, edge.direction), length2 = dot(edge.direction, edge.direction);
  const Wide<T> at_first = along <= zero, at_last = and_not(zero <= dot(from1, edge.direction), at_first);
  const WideWay<T, 2, 1> within{v0 + edge.direction * (along / length2),
                                across_direction(from0, edge.direction),
                                {and_not(all, at_last), and_not(all, at_first)},
                                {all}};
  return {select(at_first, v0, select(at_last, v1, within.from)),
          select(at_first, from0, select(at_last, from1, within.way)), within.from_of, within.to_of};
}

template <class T>
COLLIDE_BATCH_FUNCTION WideVec3<T> second_across_first(const WideCore<T, 2>& a, const WideCore<T, 2>& b) {
  return across_direction(b.direction, a.direction) & (Wide<T>::splat(T(0)) < dot(a.direction, a.direction));
}

template <class T>
COLLIDE_BATCH_FUNCTION WideWay<T, 1, 1> shortest_way(const WideCore<T, 1>& a, const WideCore<T, 1>& b) {
  const Wide<T> all = every_lane<T>();
  return {a.vertices[0], b.vertices[0] - a.vertices[0], {all}, {all}};
}
template <class T>
COLLIDE_BATCH_FUNCTION WideWay<T, 1, 2> shortest_way(const WideCore<T, 1>& a, const WideCore<T, 2>& b) {
  return reversed(way_to_point(b, a.vertices[0]), a.vertices[0]);
}
template <class T>
COLLIDE_BATCH_FUNCTION WideWay<T, 2, 2> shortest_way(const WideCore<T, 2>& a, const WideCore<T, 2>& b) {
  const Wide<T> zero = Wide<T>::splat(T(0)), all = every_lane<T>();
  const auto& [v0, v1] = b.vertices;
  // The point of the second edge that is nearest to the line of the first one.
  const WideVec3<T> across = second_across_first(a, b);
  const Wide<T> before = negated(dot(across_direction(v0 - a.vertices[0], a.direction), across)),
                behind = negated(dot(across_direction(v1 - a.vertices[0], a.direction), across));
  const Wide<T> at_first = and_not(all, and_not(zero < dot(across, across), before <= zero)),
                at_last = and_not(zero <= behind, at_first);
  const WideVec3<T> within = v0 + (v1 - v0) * (before / (before - behind));
  const WideVec3<T> to = select(at_first, v0, select(at_last, v1, within));
  const WideWay<T, 2, 1> from_edge = way_to_point(a, to);
  const WideWay<T, 1, 2> from_end = reversed(way_to_point(b, from_edge.from), from_edge.from);
  return select(from_edge.from_of[0] & from_edge.from_of[1],
                WideWay<T, 2, 2>{
                    from_edge.from, from_edge.way, from_edge.from_of, {and_not(all, at_last), and_not(all, at_first)}},
                WideWay<T, 2, 2>{from_end.from, from_end.way, from_edge.from_of, from_end.to_of});
}

/// A unit vector, and the lanes in which it is computed in the usual way.
template <class T>
struct WideUnit {
  WideVec3<T> vector;
  Wide<T> usual;
};
template <class T>
COLLIDE_BATCH_FUNCTION WideUnit<T> unit_of(const WideVec3<T>& v) {
  const Wide<T> one = Wide<T>::splat(T(1)), power = power_of_length(v);
  const WideVec3<T> moderate = v * (one / power);
  return {moderate * (one / sqrt(dot(moderate, moderate))), and_not(is_usual_power(power), is_zero(v))};
}

template <class T>
COLLIDE_BATCH_FUNCTION WideVec3<T> any_perpendicular(const WideVec3<T>& v) {
  const Wide<T> zero = Wide<T>::splat(T(0)), one = Wide<T>::splat(T(1));
  const Wide<T> x = absolute(v.x), y = absolute(v.y), z = absolute(v.z);
  const WideVec3<T> by_x =
      select((v.y == zero) & (v.z == zero), WideVec3<T>{one, zero, zero}, WideVec3<T>{zero, negated(v.z), v.y});
  return select((x <= y) & (x <= z), by_x,
                select(y <= z, WideVec3<T>{v.z, zero, negated(v.x)}, WideVec3<T>{negated(v.y), v.x, zero}));
}
template <class T>
COLLIDE_BATCH_FUNCTION WideVec3<T> direction_across(const WideCore<T, 1>&, const WideCore<T, 2>& b) {
  return any_perpendicular(b.direction);
}
template <class T>
COLLIDE_BATCH_FUNCTION WideVec3<T> direction_across(const WideCore<T, 2>& a, const WideCore<T, 2>& b) {
  const Wide<T> zero = Wide<T>::splat(T(0));
  const WideVec3<T> normal = cross(a.direction, second_across_first(a, b));
  return select(zero < dot(normal, normal), normal,
                any_perpendicular(select(zero < dot(a.direction, a.direction), a.direction, b.direction)));
}

/// How far a core reaches along a direction at most, and the least that a vertex at the end of a way does.
template <class T>
struct WideReach {
  Wide<T> most, at_way;
};
template <class T, std::size_t n>
COLLIDE_BATCH_FUNCTION WideReach<T> reach_of(const WideCore<T, n>& core, const std::array<Wide<T>, n>& of_way,
                                             const WideVec3<T>& direction) {
  std::array<Wide<T>, n> along;
  for (std::size_t i = 0; i < n; ++i) along[i] = dot(direction, core.vertices[i]);
  Wide<T> most = along[0];
  for (std::size_t i = 1; i < n; ++i) most = larger(most, along[i]);
  Wide<T> at_way = most;
  for (std::size_t i = 0; i < n; ++i) at_way = select(of_way[i], smaller(at_way, along[i]), at_way);
  return {most, at_way};
}
/// As defect_of. The second core reaches back along the normal as far as it does forth along its opposite.
template <class T, std::size_t of_a, std::size_t of_b>
COLLIDE_BATCH_FUNCTION Wide<T> defect_of(const WideVec3<T>& normal, const WideWay<T, of_a, of_b>& way,
                                         const WideCore<T, of_a>& a, const WideCore<T, of_b>& b) {
  const WideVec3<T> aside = way.way - normal * dot(way.way, normal);
  const WideReach<T> on_a = reach_of(a, way.from_of, normal), on_b = reach_of(b, way.to_of, negated(normal));
  return sqrt(dot(aside, aside)) + (on_a.most - on_a.at_way) + (on_b.most - on_b.at_way);
}
template <class T, std::size_t of_a, std::size_t of_b>
COLLIDE_BATCH_FUNCTION WideUnit<T> normal_of(const WideWay<T, of_a, of_b>& way, const WideCore<T, of_a>& a,
                                             const WideCore<T, of_b>& b) {
  const WideUnit<T> normal = unit_of(way.way);
  if constexpr (of_b == 2) {
    const WideUnit<T> unit = unit_of(direction_across(a, b));
    const Wide<T> leads_back = dot(unit.vector, way.way) < Wide<T>::splat(T(0));
    const WideVec3<T> other = select(leads_back, negated(unit.vector), unit.vector);
    const Wide<T> is_better = defect_of(other, way, a, b) < defect_of(normal.vector, way, a, b);
    return {select(is_better, other, normal.vector), normal.usual & unit.usual};
  }
  return normal;
}

/// Writes the signed distance of two cores, which are relative to the origin. Returns a mask of the answered lanes.
template <class T, std::size_t of_a, std::size_t of_b>
COLLIDE_BATCH_FUNCTION Wide<T> signed_distance(const WideCore<T, of_a>& a, const WideCore<T, of_b>& b,
                                               const WideVec3<T>& origin, Writer<T>& out) {
  const WideWay<T, of_a, of_b> way = shortest_way(a, b);
  const auto [normal, usual] = normal_of(way, a, b);
  const Wide<T> distance = dot(way.way, normal) - (a.radius + b.radius);
  const WideVec3<T> on_first = (origin + way.from) + normal * a.radius,
                    on_second = (origin + (way.from + way.way)) - normal * b.radius;
  const Wide<T> from_first = a.radius <= b.radius;
  out.number(distance), out.vec3(normal);
  out.vec3(select(from_first, on_first, on_second - normal * distance));
  out.vec3(select(from_first, on_first + normal * distance, on_second));
  return usual & a.usual & b.usual & are_finite(distance, way.from, way.way);
}
template <class T, class B>
COLLIDE_BATCH_FUNCTION Wide<T> signed_distance(const WideBall<T>& ball, const B& other, Writer<T>& out) {
  return signed_distance(core_of(ball, ball.center), core_of(other, ball.center), ball.center, out);
}
template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> signed_distance(const WideCapsule<T>& capsule, const WideCapsule<T>& other,
                                               Writer<T>& out) {
  return signed_distance(core_of(capsule, capsule.p0), core_of(other, capsule.p0), capsule.p0, out);
}

template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> block(batched::point_sphere_signed_distance, Reader<T>& in, Writer<T>& out) {
  const WideBall<T> point = point_in(in);
  return signed_distance(point, in.ball(), out);
}
template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> block(batched::point_segment_signed_distance, Reader<T>& in, Writer<T>& out) {
  const WideBall<T> point = point_in(in);
  return signed_distance(point, segment_in(in), out);
}
template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> block(batched::point_capsule_signed_distance, Reader<T>& in, Writer<T>& out) {
  const WideBall<T> point = point_in(in);
  return signed_distance(point, capsule_in(in), out);
}
template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> block(batched::sphere_sphere_signed_distance, Reader<T>& in, Writer<T>& out) {
  const WideBall<T> sphere = in.ball();
  return signed_distance(sphere, in.ball(), out);
}
template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> block(batched::sphere_segment_signed_distance, Reader<T>& in, Writer<T>& out) {
  const WideBall<T> sphere = in.ball();
  return signed_distance(sphere, segment_in(in), out);
}
template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> block(batched::sphere_capsule_signed_distance, Reader<T>& in, Writer<T>& out) {
  const WideBall<T> sphere = in.ball();
  return signed_distance(sphere, capsule_in(in), out);
}
template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> block(batched::segment_segment_signed_distance, Reader<T>& in, Writer<T>& out) {
  const WideCapsule<T> segment = segment_in(in);
  return signed_distance(segment, segment_in(in), out);
}
template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> block(batched::segment_capsule_signed_distance, Reader<T>& in, Writer<T>& out) {
  const WideCapsule<T> segment = segment_in(in);
  return signed_distance(segment, capsule_in(in), out);
}
template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> block(batched::capsule_capsule_signed_distance, Reader<T>& in, Writer<T>& out) {
  const WideCapsule<T> capsule = capsule_in(in);
  return signed_distance(capsule, capsule_in(in), out);
}

#include <collide/detail/strict_end.hpp>
