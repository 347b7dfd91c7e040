// The kernels of batches of motions and rays; kernels.hpp says what a kernel does.
// Included inside a namespace for each instruction set, as detail/batch/values.hpp says.
#include <collide/detail/strict_begin.hpp>

template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> block(batched::moving_point_plane, Reader<T>& in, Writer<T>& out) {
  using L = Wide<T>;
  const L zero = L::splat(T(0)), most = L::splat(std::numeric_limits<T>::max());
  const WideVec3<T> from = in.vec3(), along = in.vec3();
  const auto [n, offset] = in.plane();
  const L approach = zero - dot(n, along), height = dot(n, from) + offset, n2 = dot(n, n), time = height / approach;
  const WideVec3<T> location = from + along * time;
  const L hit = (zero < approach) & (zero <= height) & (time <= most);
  write_impact_where(hit, time, location, n / sqrt(n2), out);
  return are_finite(location & hit) & (L::splat(least_length2<T>) <= n2) & (n2 <= most);
}

template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> block(batched::moving_sphere_plane, Reader<T>& in, Writer<T>& out) {
  using L = Wide<T>;
  const L zero = L::splat(T(0)), most = L::splat(std::numeric_limits<T>::max());
  const auto [center, radius] = in.ball();
  const WideVec3<T> along = in.vec3();
  const auto [n, offset] = in.plane();
  const L approach = zero - dot(n, along), height = dot(n, center) + offset, n2 = dot(n, n);
  const L length = sqrt(n2), reach = radius * length, starts = height <= reach;
  const L time = and_not((height - reach) / approach, starts), down = select(starts, height / length, radius);
  const L hit = (zero <= approach) & (zero - reach <= height) & (starts | ((zero < approach) & (time <= most)));
  const WideVec3<T> normal = n / length, location = (center + along * time) - normal * down;
  write_impact_where(hit, time, location, normal, out);
  return are_finite(location & hit) & (L::splat(least_length2<T>) <= n2) & (n2 <= most) & (reach <= most);
}

template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> block(batched::moving_point_sphere, Reader<T>& in, Writer<T>& out) {
  using L = Wide<T>;
  const L zero = L::splat(T(0)), infinity = L::splat(std::numeric_limits<T>::infinity());
  const WideVec3<T> point = in.vec3(), velocity = in.vec3();
  const auto [center, radius] = in.ball();
  const L solid = in.flag();
  const WideVec3<T> m = point - center;
  const L starts_in = (dot(m, m) - radius * radius) <= zero, at_start = starts_in & solid;
  const L speed2 = dot(velocity, velocity), nearest = negated(dot(m, velocity)) / speed2;
  const WideVec3<T> offset = m + velocity * nearest;
  const L chord2 = negated(dot(offset, offset) - radius * radius);
  const L half_chord = sqrt(larger(chord2, zero)) / sqrt(speed2);
  const L crossing = larger(select(starts_in, nearest + half_chord, nearest - half_chord), zero);
  const L reaches = (zero < speed2) & (starts_in | ((zero < nearest) & (zero <= chord2))) & (crossing < infinity);
  const L hit = at_start | reaches, time = and_not(crossing, at_start);
  const WideVec3<T> displacement = velocity * crossing, away = select(at_start, m, m + displacement);
  const L away2 = dot(away, away);
  const WideVec3<T> location = select(at_start, point, point + displacement);
  out.impact(select(hit, time, infinity), location & hit, (away / sqrt(away2)) & hit);
  const L usual = in_range_of_unit(away2) & (at_start | (zero < radius)) & are_finite(point, velocity, center, radius);
  return usual | and_not(every_lane<T>(), hit);
}

template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> block(batched::moving_sphere_sphere, Reader<T>& in, Writer<T>& out) {
  using L = Wide<T>;
  const L zero = L::splat(T(0)), infinity = L::splat(std::numeric_limits<T>::infinity());
  const WideBall<T> ball = in.ball();
  const WideVec3<T> velocity = in.vec3();
  const WideBall<T> fixed = in.ball();
  const L reach = ball.radius + fixed.radius;
  const WideVec3<T> from = ball.center - fixed.center;
  const L apart = dot(from, from) - reach * reach, starts_apart = zero < apart;
  const L along = dot(from, velocity), closing = negated(along), speed2 = dot(velocity, velocity);
  const L starts = ((apart == zero) & (along <= zero)) | ((apart < zero) & (zero < ball.radius));
  const L nearest = closing / speed2;
  const WideVec3<T> offset = from + velocity * nearest;
  const L chord2 = negated(dot(offset, offset) - reach * reach);
  const L crossing = larger(nearest - sqrt(chord2) / sqrt(speed2), zero);
  const L reaches = starts_apart & (zero < closing) & (zero < speed2) & (zero <= chord2) & (crossing < infinity);
  const L hit = starts | reaches, time = crossing & starts_apart;
  const WideVec3<T> away = from + velocity * time;
  const L away2 = dot(away, away);
  const WideVec3<T> normal = away / sqrt(away2);
  out.impact(select(hit, time, infinity), (fixed.center + normal * fixed.radius) & hit, normal & hit);
  const L usual = in_range_of_unit(away2) & (zero < reach) &
                  are_finite(ball.center, ball.radius, velocity, fixed.center, fixed.radius);
  return usual | and_not(every_lane<T>(), hit);
}

/// The largest, or smallest, coordinate.
template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> largest_of(const WideVec3<T>& a) {
  return larger(larger(a.x, a.y), a.z);
}
template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> smallest_of(const WideVec3<T>& a) {
  return smaller(smaller(a.x, a.y), a.z);
}

/// One coordinate of the motion of a point and of an axis-aligned box.
template <class T>
struct WideCoordinate {
  Wide<T> at, step, low, high;
  Wide<T> within, below, face, gap, time;

  COLLIDE_BATCH_FUNCTION static WideCoordinate of(Wide<T> at, Wide<T> step, Wide<T> low, Wide<T> high) {
    const Wide<T> within = (low <= at) & (at <= high), below = at < low;
    const Wide<T> face = select(below, low, high), gap = face - at;
    return {at, step, low, high, within, below, face, gap, and_not(gap / step, within)};
  }
  /// A mask of the faces reached at the time of the entry.
  COLLIDE_BATCH_FUNCTION Wide<T> enters_at(Wide<T> entry) const { return and_not(time == entry, within); }
  COLLIDE_BATCH_FUNCTION Wide<T> place(Wide<T> entry) const { return at + step * entry; }
  COLLIDE_BATCH_FUNCTION Wide<T> meets_box_at(Wide<T> entry) const {
    const Wide<T> zero = Wide<T>::splat(T(0)), x = place(entry);
    const Wide<T> ends_within = select(zero < step, x <= high, low <= x) | enters_at(entry);
    return and_not(ends_within, and_not((gap ^ step).sign_mask() | (step == zero), within));
  }
  COLLIDE_BATCH_FUNCTION Wide<T> location_at(Wide<T> entry) const {
    return select(enters_at(entry), face, smaller(larger(place(entry), low), high));
  }
  COLLIDE_BATCH_FUNCTION Wide<T> side() const { return select(below, Wide<T>::splat(T(-1)), Wide<T>::splat(T(1))); }
};

template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> block(batched::moving_point_aabox, Reader<T>& in, Writer<T>& out) {
  using L = Wide<T>;
  using C = WideCoordinate<T>;
  const WideVec3<T> at = in.vec3(), step = in.vec3(), low = in.vec3(), high = in.vec3();
  const C x = C::of(at.x, step.x, low.x, high.x), y = C::of(at.y, step.y, low.y, high.y),
          z = C::of(at.z, step.z, low.z, high.z);
  const L time = largest_of(WideVec3<T>{x.time, y.time, z.time});
  const L meets = x.meets_box_at(time) & y.meets_box_at(time) & z.meets_box_at(time) & are_finite(at, step, low, high) &
                  (time <= L::splat(std::numeric_limits<T>::max()));
  const L inside = x.within & y.within & z.within, enters = and_not(meets, inside);
  const L by_x = x.enters_at(time), by_y = and_not(y.enters_at(time), by_x),
          by_z = and_not(z.enters_at(time), by_x | y.enters_at(time));
  out.flag(meets & inside);
  out.vec3(WideVec3<T>{x.location_at(time), y.location_at(time), z.location_at(time)} & meets);
  out.number(select(enters, time, L::splat(std::numeric_limits<T>::infinity())));
  out.vec3(WideVec3<T>{x.side() & by_x, y.side() & by_y, z.side() & by_z} & enters);
  return every_lane<T>();
}

template <class T>
COLLIDE_BATCH_FUNCTION WideVec3<T> larger(const WideVec3<T>& a, const WideVec3<T>& b) {
  return {larger(a.x, b.x), larger(a.y, b.y), larger(a.z, b.z)};
}
template <class T>
COLLIDE_BATCH_FUNCTION WideVec3<T> smaller(const WideVec3<T>& a, const WideVec3<T>& b) {
  return {smaller(a.x, b.x), smaller(a.y, b.y), smaller(a.z, b.z)};
}
template <class T>
COLLIDE_BATCH_FUNCTION WideVec3<T> splat_vec3(T a) {
  return {Wide<T>::splat(a), Wide<T>::splat(a), Wide<T>::splat(a)};
}
/// The inverse of a direction of a ray, as `prepare_ray` computes it.
template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> inverse_of(Wide<T> x) {
  using L = Wide<T>;
  using limits = std::numeric_limits<T>;
  const L inverse = smaller(larger(L::splat(T(1)) / x, L::splat(-limits::max())), L::splat(limits::max()));
  return select(x == L::splat(T(0)), L::splat(limits::infinity()), inverse);
}

template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> block(batched::ray_aabox, Reader<T>& in, Writer<T>& out) {
  using L = Wide<T>;
  const WideVec3<T> origin = in.vec3(), direction = in.vec3(), low = in.vec3(), high = in.vec3();
  const WideVec3<T> inverse{inverse_of(direction.x), inverse_of(direction.y), inverse_of(direction.z)};
  const auto times = [&](const WideVec3<T>& face) COLLIDE_BATCH_LAMBDA {
    const WideVec3<T> gap = face - origin;
    return WideVec3<T>{gap.x * inverse.x, gap.y * inverse.y, gap.z * inverse.z};
  };
  const WideVec3<T> to_low = times(low), to_high = times(high);
  const L time = largest_of(larger(splat_vec3(T(0)), smaller(to_low, to_high)));
  const L exit = smallest_of(smaller(splat_vec3(std::numeric_limits<T>::max()), larger(to_high, to_low)));
  const L hit = time <= exit;
  out.flag(hit);
  out.flag(hit & (time == L::splat(T(0))));
  out.vec3(smaller(larger(origin + direction * time, low), high) & hit);
  return are_finite(origin, direction, low, high);
}

template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> block(batched::moving_point_triangle, Reader<T>& in, Writer<T>& out) {
  using L = Wide<T>;
  constexpr T u = std::numeric_limits<T>::epsilon() / 2;
  constexpr T least_size2 = sizeof(T) == 4 ? T(0x1p-30) : T(0x1p-300), least_speed2 = least_size2 / 4;
  const WideVec3<T> from = in.vec3(), along = in.vec3(), v0 = in.vec3(), v1 = in.vec3(), v2 = in.vec3();
  const WideVec3<T> f = v0 - v2, edge1 = v1 - v0, a = v0 - from;
  const WideVec3<T> n = cross(f, edge1), q = cross(along, a);
  const L beside_f = dot(q, f), beside_edge1 = dot(q, edge1), approach = dot(n, along), behind = dot(n, a);
  const L speed2 = dot(along, along) + L::splat(least_speed2);
  const L e2 = (dot(f, f) + L::splat(least_size2)) + dot(edge1, edge1), l2 = e2 + dot(a, a);
  const L outside = larger(larger(beside_f, beside_edge1), approach - (beside_f + beside_edge1));
  const L hit = larger(outside, behind) <= L::splat(T(0)), n2 = dot(n, n), time = behind / approach;
  write_impact_where(hit, time, from + along * time, n / sqrt(n2), out);
  const L certain = L::splat(T(64 * 64) * u * u) * (l2 * l2 * speed2) < outside * outside;
  return certain & ((hit & (e2 * e2)) < L::splat(T(thinness)) * n2);
}

#include <collide/detail/strict_end.hpp>
