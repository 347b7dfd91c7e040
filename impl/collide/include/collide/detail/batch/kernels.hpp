// The kernels of batches. Included inside a namespace for each instruction set (detail/batch_sse2.hpp,
// detail/batch_avx2.hpp), which defines `Wide`; so this file has no include guard.
//
// A kernel answers a block: one query in each lane. It computes all cases and selects, by the operations of the query
// in the tier `Fast` in their order, so that the numbers are the same to the last bit. It returns a mask of the lanes
// that it answered; the query itself answers the others, such as those whose squares underflow. So a kernel covers the
// usual path of the query alone. A change of a query in `Fast` needs the same change here: properties of the batches
// compare the bits.
#include <collide/detail/strict_begin.hpp>

/// In each lane: a where the mask is set, b elsewhere.
template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> select(Wide<T> where, Wide<T> a, Wide<T> b) {
  return (a & where) | and_not(b, where);
}
template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> absolute(Wide<T> a) {
  return and_not(a, Wide<T>::splat(T(-0.0)));
}
template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> negated(Wide<T> a) {
  return a ^ Wide<T>::splat(T(-0.0));
}
template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> every_lane() {
  return Wide<T>::splat(T(0)) == Wide<T>::splat(T(0));
}

template <class T>
struct WideVec3 {
  Wide<T> x, y, z;

  COLLIDE_BATCH_FUNCTION friend WideVec3 operator+(const WideVec3& a, const WideVec3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  COLLIDE_BATCH_FUNCTION friend WideVec3 operator-(const WideVec3& a, const WideVec3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  COLLIDE_BATCH_FUNCTION friend WideVec3 operator*(const WideVec3& a, Wide<T> s) { return {a.x * s, a.y * s, a.z * s}; }
  COLLIDE_BATCH_FUNCTION friend WideVec3 operator/(const WideVec3& a, Wide<T> s) { return {a.x / s, a.y / s, a.z / s}; }
  COLLIDE_BATCH_FUNCTION friend WideVec3 operator&(const WideVec3& a, Wide<T> mask) {
    return {a.x & mask, a.y & mask, a.z & mask};
  }
};
template <class T>
COLLIDE_BATCH_FUNCTION WideVec3<T> select(Wide<T> where, const WideVec3<T>& a, const WideVec3<T>& b) {
  return {select(where, a.x, b.x), select(where, a.y, b.y), select(where, a.z, b.z)};
}
template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> dot(const WideVec3<T>& a, const WideVec3<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
COLLIDE_BATCH_FUNCTION WideVec3<T> cross(const WideVec3<T>& a, const WideVec3<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// a - a: 0 where a is finite, else NaN. The sum of such numbers is 0 where all are finite.
template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> zero_if_finite(Wide<T> a) {
  return a - a;
}
template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> zero_if_finite(const WideVec3<T>& a) {
  return (a.x - a.x) + (a.y - a.y) + (a.z - a.z);
}
/// A mask of the lanes in which every argument is finite.
template <class A, class... More>
COLLIDE_BATCH_FUNCTION auto are_finite(const A& a, const More&... more) {
  const auto sum = (zero_if_finite(a) + ... + zero_if_finite(more));
  return sum == decltype(sum){sum ^ sum};
}

template <class T>
struct WideBall {
  WideVec3<T> center;
  Wide<T> radius;
};
template <class T>
struct WidePlane {
  WideVec3<T> normal;
  Wide<T> offset;
};
template <class T>
struct WideBox {
  WideVec3<T> center, half, q;
  Wide<T> w;
};

/// Loads the arguments of a block, leaf after leaf.
template <class T>
struct Reader {
  const void* const* next;
  std::size_t at;

  COLLIDE_BATCH_FUNCTION Wide<T> number() { return Wide<T>::load(static_cast<const T*>(*next++) + at); }
  COLLIDE_BATCH_FUNCTION Wide<T> flag() { return Wide<T>::mask(static_cast<const bool*>(*next++) + at); }
  COLLIDE_BATCH_FUNCTION WideVec3<T> vec3() { return {number(), number(), number()}; }
  COLLIDE_BATCH_FUNCTION WideBall<T> ball() { return {vec3(), number()}; }
  COLLIDE_BATCH_FUNCTION WidePlane<T> plane() { return {vec3(), number()}; }
  COLLIDE_BATCH_FUNCTION WideBox<T> box() { return {vec3(), vec3(), vec3(), number()}; }
};

/// Stores the answers of a block, leaf after leaf.
template <class T>
struct Writer {
  void* const* next;
  std::size_t at;

  COLLIDE_BATCH_FUNCTION void number(Wide<T> n) { n.store(static_cast<T*>(*next++) + at); }
  COLLIDE_BATCH_FUNCTION void vec3(const WideVec3<T>& a) { number(a.x), number(a.y), number(a.z); }
  COLLIDE_BATCH_FUNCTION void flag(Wide<T> mask) {
    bool* const flags = static_cast<bool*>(*next++) + at;
    constexpr std::size_t n = Wide<T>::size < 4 ? Wide<T>::size : 4;
    for (std::size_t i = 0; i < Wide<T>::size; i += n) {
      // Copies bit k of the four to bit 8 k: 2^7 moves bit 1 there, 2^14 bit 2, 2^21 bit 3.
      const unsigned four = (unsigned(mask.bits()) >> i & 15U) * 0x204081U & 0x01010101U;
      std::memcpy(flags + i, &four, n);
    }
  }
  COLLIDE_BATCH_FUNCTION void impact(Wide<T> time, const WideVec3<T>& location, const WideVec3<T>& normal) {
    number(time), vec3(location), vec3(normal);
  }
};

/// The least squared length whose root keeps its digits.
template <class T>
inline constexpr T least_length2 = std::numeric_limits<T>::min() / std::numeric_limits<T>::epsilon();

/// The mask of squared lengths from which `unit` computes the direction directly.
template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> in_range_of_unit(Wide<T> length2) {
  return (Wide<T>::splat(least_length2<T>) <= length2) &
         (length2 <= Wide<T>::splat(std::numeric_limits<T>::max() / T(16)));
}

/// Writes an impact where `hit` is set and a miss elsewhere, as `impact_where` of single queries does.
template <class T>
COLLIDE_BATCH_FUNCTION void write_impact_where(Wide<T> hit, Wide<T> time, const WideVec3<T>& location,
                                               const WideVec3<T>& normal, Writer<T>& out) {
  const Wide<T> none = and_not(Wide<T>::splat(std::numeric_limits<T>::infinity()), hit);
  out.impact(larger(none, time), location & hit, normal & hit);
}

template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> block(batched::sphere_sphere_overlap, Reader<T>& in, Writer<T>& out) {
  using L = Wide<T>;
  const WideBall<T> ball1 = in.ball(), ball2 = in.ball();
  const WideVec3<T> between = ball2.center - ball1.center;
  const L reach = ball1.radius + ball2.radius, beyond = dot(between, between) - reach * reach;
  // A center that is not finite makes `beyond` NaN or +infinity.
  out.flag((reach <= L::splat(std::numeric_limits<T>::max())) & (beyond <= L::splat(T(0))) &
           are_finite(ball1.radius, ball2.radius));
  return every_lane<T>();
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

/// Answers all queries of a batch: blocks, the last of which may overlap the one before it. A batch smaller than a
/// block is answered one by one.
template <class Query, class T>
COLLIDE_BATCH_LOOP void answer_blocks(std::size_t count, const void* const* in, void* const* out, AnswerOne one) {
  constexpr std::size_t size = Wide<T>::size;
  constexpr int all = (1 << size) - 1;
  if (count < size) {
    for (std::size_t i = 0; i < count; ++i) one(i, in, out);
    return;
  }
  for (std::size_t next = 0; next < count; next += size) {
    const std::size_t at = next <= count - size ? next : count - size;
    Reader<T> reader{in, at};
    Writer<T> writer{out, at};
    const int left = all & ~block(Query(), reader, writer).bits();
    if (left == 0) continue;
    for (std::size_t i = 0; i < size; ++i) {
      if ((left >> i & 1) != 0) one(at + i, in, out);
    }
  }
}

#include <collide/detail/strict_end.hpp>
