// The kernels of batches: decisions, closest points and penetrations; motions.hpp has those of motions and rays.
// Included inside a namespace for each instruction set, as detail/batch/values.hpp says.
//
// A kernel answers a block: one query in each lane. It computes all cases and selects, by the operations of the query
// in the tier `Fast` in their order, so that the numbers are the same to the last bit. It returns a mask of the lanes
// that it answered; the query itself answers the others, such as those whose squares underflow. So a kernel covers the
// usual path of the query alone. A change of a query in `Fast` needs the same change here: properties of the batches
// compare the bits.
#include <collide/detail/strict_begin.hpp>

template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> overlap(const WideBall<T>& ball1, const WideBall<T>& ball2, Writer<T>& out) {
  using L = Wide<T>;
  const WideVec3<T> between = ball2.center - ball1.center;
  const L reach = ball1.radius + ball2.radius, beyond = dot(between, between) - reach * reach;
  // A center that is not finite makes `beyond` NaN or +infinity.
  out.flag((reach <= L::splat(std::numeric_limits<T>::max())) & (beyond <= L::splat(T(0))) &
           are_finite(ball1.radius, ball2.radius));
  return every_lane<T>();
}
template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> block(batched::sphere_sphere_overlap, Reader<T>& in, Writer<T>& out) {
  const WideBall<T> ball = in.ball();
  return overlap(ball, in.ball(), out);
}

template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> block(batched::moving_sphere_passes_sphere, Reader<T>& in, Writer<T>& out) {
  using L = Wide<T>;
  const L zero = L::splat(T(0));
  const WideBall<T> ball = in.ball();
  const WideVec3<T> velocity = in.vec3();
  const WideBall<T> fixed = in.ball();
  const L limit = in.number(), reach = ball.radius + fixed.radius;
  const WideVec3<T> from = ball.center - fixed.center;
  const L closing = negated(dot(from, velocity));
  const L nearest = smaller(closing / dot(velocity, velocity), limit);
  const WideVec3<T> offset = select(zero < closing, from + velocity * nearest, from);
  const L inside = negated(dot(offset, offset) - reach * reach);
  out.flag((zero <= limit) & (zero <= inside) &
           are_finite(ball.center, ball.radius, velocity, fixed.center, fixed.radius));
  return every_lane<T>();
}

template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> sum_of_squares(const WideVec3<T>& q, Wide<T> w) {
  if constexpr (sizeof(T) == 4) return (q.x * q.x + q.y * q.y) + (q.z * q.z + w * w);
  return (q.x * q.x + q.z * q.z) + (q.y * q.y + w * w);  // as the single query adds two registers
}
/// `excess` of coordinates in the frame of a box.
template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> excess(Wide<T> coordinate, Wide<T> half) {
  return coordinate - smaller(larger(coordinate, Wide<T>::splat(T(0)) - half), half);
}

template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> block(batched::sphere_box_overlap, Reader<T>& in, Writer<T>& out) {
  using L = Wide<T>;
  const L one = L::splat(T(1));
  const WideBall<T> ball = in.ball();
  const auto [middle, half, q, w] = in.box();
  const WideVec3<T> scaled = q * (L::splat(T(2)) / sum_of_squares(q, w));
  const L xx = q.x * scaled.x, yy = q.y * scaled.y, zz = q.z * scaled.z;
  const WideVec3<T> products{q.y * scaled.z, q.z * scaled.x, q.x * scaled.y}, w_products = scaled * w;
  const WideVec3<T> sums = products + w_products, differences = products - w_products;
  const WideVec3<T> seen = ball.center - middle;
  const WideVec3<T> local{(one - (yy + zz)) * seen.x + sums.z * seen.y + differences.y * seen.z,
                          (one - (zz + xx)) * seen.y + sums.x * seen.z + differences.z * seen.x,
                          (one - (xx + yy)) * seen.z + sums.y * seen.x + differences.x * seen.y};
  const WideVec3<T> away{excess(local.x, half.x), excess(local.y, half.y), excess(local.z, half.z)};
  const L beyond = dot(away, away) - ball.radius * ball.radius;
  out.flag((beyond <= L::splat(T(0))) & are_finite(ball.center, middle, half, q, ball.radius));
  return every_lane<T>();
}

template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> block(batched::box_box_conservative, Reader<T>& in, Writer<T>& out) {
  using L = Wide<T>;
  using limits = std::numeric_limits<T>;
  const L least = L::splat(least_length2<T>);
  const WideBox<T> box1 = in.box(), box2 = in.box();
  const WideVec3<T> between = box2.center - box1.center;
  const L distance2 = dot(between, between), a2 = dot(box1.half, box1.half), b2 = dot(box2.half, box2.half);
  const L distance = sqrt(distance2), sum = sqrt(a2) + sqrt(b2);
  const L reach = sum + (sum * L::splat(T(4) * limits::epsilon()) + L::splat(limits::denorm_min()));
  const L yes = distance <= reach;
  out.flag(yes);
  const L has_digits = (least <= distance2) & (least <= a2) & (least <= b2) & (distance <= L::splat(limits::max()));
  return and_not(has_digits, and_not(yes, are_finite(box1.center, box1.half, box1.q, box1.w, box2.center, box2.half,
                                                     box2.q, box2.w)));
}

template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> block(batched::closest_point_segment, Reader<T>& in, Writer<T>& out) {
  const WideVec3<T> v0 = in.vec3(), v1 = in.vec3(), point = in.vec3(), along = v1 - v0;
  const Wide<T> projection = dot(point - v0, along), length2 = dot(along, along);
  const WideVec3<T> foot = v0 + along * (projection / length2);
  out.vec3(select(projection <= Wide<T>::splat(T(0)), v0, select(length2 <= projection, v1, foot)));
  return every_lane<T>();
}

template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> block(batched::closest_points_lines, Reader<T>& in, Writer<T>& out) {
  using L = Wide<T>;
  const WideVec3<T> start1 = in.vec3(), direction1 = in.vec3(), start2 = in.vec3(), direction2 = in.vec3();
  const WideVec3<T> normal = cross(direction1, direction2);
  const L normal2 = dot(normal, normal), parallel = normal2 <= L::splat(T(0));
  const WideVec3<T> crossing = start1 + direction1 * (dot(cross(start2 - start1, direction2), normal) / normal2);
  const WideVec3<T> point1 = select(parallel, start1, crossing);
  const L along = dot(point1 - start2, direction2) / dot(direction2, direction2);
  out.vec3(point1), out.vec3(start2 + direction2 * along);
  return absolute(along) <= L::splat(std::numeric_limits<T>::max());
}

/// Writes a penetration where the depth is not negative, else the depth alone.
template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> write_penetration(Wide<T> depth, const WideVec3<T>& normal, const WideVec3<T>& contact,
                                                 Writer<T>& out) {
  const Wide<T> overlap = Wide<T>::splat(T(0)) <= depth;
  out.number(depth), out.vec3(normal & overlap), out.vec3(contact & overlap);
  return overlap;
}

template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> block(batched::sphere_sphere_penetration, Reader<T>& in, Writer<T>& out) {
  using L = Wide<T>;
  const WideBall<T> ball1 = in.ball(), ball2 = in.ball();
  const WideVec3<T> between = ball2.center - ball1.center;
  const L length2 = dot(between, between), distance = sqrt(length2);
  const WideVec3<T> normal = between / distance;
  const L overlap =
      write_penetration((ball1.radius + ball2.radius) - distance, normal, ball1.center + normal * ball1.radius, out);
  const L usual = in_range_of_unit(length2) & are_finite(ball1.center, ball1.radius, ball2.center, ball2.radius);
  return and_not(usual | and_not(every_lane<T>(), overlap), length2 < L::splat(least_length2<T>));
}

template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> block(batched::sphere_plane_penetration, Reader<T>& in, Writer<T>& out) {
  using L = Wide<T>;
  const auto [center, radius] = in.ball();
  const auto [n, offset] = in.plane();
  const L n2 = dot(n, n), norm = sqrt(n2);
  const WideVec3<T> normal = n / norm;
  const L overlap = write_penetration(radius - (dot(n, center) + offset) / norm, normal, center - normal * radius, out);
  const L usual = are_finite(center, radius, n, offset) | and_not(every_lane<T>(), overlap);
  return and_not(usual, n2 < L::splat(least_length2<T>));
}

#include <collide/detail/strict_end.hpp>
