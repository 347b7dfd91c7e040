/// Filters of Certified that compute in the next wider type: its digits give every number of an answer within half a
/// unit in the last place, and bounds for the whole query tell where they do not.
///
/// In the derivations u is the unit roundoff of the wider type, and |x| the sum of the magnitudes of the numbers of x.
/// A sum, difference, product or quotient adds an error of 1 u of itself. Neither overflow nor underflow occurs: the
/// wider type has the range for all products here. An answer is accurate before the last rounding if its error is at
/// most half_ulp u of its largest number.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

#include <collide/answers.hpp>
#include <collide/detail/double_word.hpp>
#include <collide/detail/frame.hpp>
#include <collide/detail/number.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide::detail {

/// The binary digits that the wider type has more than T.
template <class T>
inline constexpr int spare_digits = std::numeric_limits<Wider<T>>::digits - std::numeric_limits<T>::digits;

/// A quarter of the epsilon of T, in units of u.
template <class T>
inline constexpr Wider<T> half_ulp = Wider<T>(std::uint64_t{1} << (spare_digits<T> - 1));

/// The same for double-words, in units of 2^-99, the error of an operation on them.
template <class T, class W>
inline constexpr double half_ulp_in =
    std::same_as<W, DoubleWord<double>> ? 0x1p99 * double(std::numeric_limits<T>::epsilon() / 4) : double(half_ulp<T>);

inline double leading_part(double value) { return value; }
inline long double leading_part(long double value) { return value; }
inline double leading_part(const DoubleWord<double>& value) { return value.high; }

/// Numbers of a filter in W, for results in T. Sizes and errors are doubles; errors are in units of the unit roundoff.
template <class T, class W>
struct InW {
  /// The error that leaves a number of magnitude 1 accurate, with a margin of a half for the errors of the bounds.
  static constexpr double enough = half_ulp_in<T, W> / 1.5;
  static constexpr double u = double(std::numeric_limits<T>::epsilon()) / 4 / half_ulp_in<T, W>;

  static Vec3<W> wide(const Vec3<T>& v) { return {W(v.x), W(v.y), W(v.z)}; }
  static double number(const W& x) { return double(leading_part(x)); }
  static double size(const Vec3<W>& v) {
    return detail::abs(number(v.x)) + detail::abs(number(v.y)) + detail::abs(number(v.z));
  }
  static Vec3<T> rounded(const Vec3<W>& v) {
    return {T(leading_part(v.x)), T(leading_part(v.y)), T(leading_part(v.z))};
  }
};

template <class T>
Vec3<Wider<T>> in_wider(const Vec3<T>& a) {
  using W = Wider<T>;
  return {W(a.x), W(a.y), W(a.z)};
}
template <class T, class W>
Vec3<T> rounded_to(const Vec3<W>& a) {
  return {T(a.x), T(a.y), T(a.z)};
}
template <class W>
W magnitudes(const Vec3<W>& a) {
  return detail::abs(a.x) + detail::abs(a.y) + detail::abs(a.z);
}
template <class W>
W largest_magnitude(const Vec3<W>& a) {
  return larger(larger(detail::abs(a.x), detail::abs(a.y)), detail::abs(a.z));
}

/// Filter: the point of a segment closest to `point`, or nullopt.
///
/// Let a be the segment's vector and p the one from its start to the point, both with an error of 1 u of themselves.
/// Their product has an error of 5 u |p| |a|, and the squared length 5 u of itself. So the way along the segment, of
/// at most |a|, has an error of 10 u |p| + 3 u |a|; clamping does not add to it. The place has an error of 1 u of
/// itself more. If |p| + |a| is at most half_ulp / 32 of the largest number of the place, that is at most
/// (10 / 32 half_ulp + 1) u of this number. The comparison itself may round: it leaves two thirds of half_ulp.
///
/// An end that is certainly nearest in double needs no more digits: there both products have an error of 6 v (|p| +
/// |a|)^2 in all, with v = 2^-53.
///
/// Where the foot is a number of few bits, no operation rounds, because the quotient comes last.
template <class T>
std::optional<ClosestPoint<T>> filtered_foot(const Vec3<T>& start, const Vec3<T>& end, const Vec3<T>& point) {
  if constexpr (has_wider<T>) {
    using W = Wider<T>;
    const Vec3<double> first = in_double(start), a = in_double(end) - first, p = in_double(point) - first;
    const double size = magnitudes(a) + magnitudes(p);
    if (!(size <= double(std::numeric_limits<T>::max()))) return std::nullopt;
    const double reached = Plain::dot(p, a), bound = 0x1p-50 * (size * size) + 0x1p-1000;
    if (-reached > bound) return ClosestPoint<T>{start};
    if (reached - Plain::dot(a, a) > bound) return ClosestPoint<T>{end};
    const Vec3<W> from = in_wider(start), along = in_wider(end) - from, to = in_wider(point) - from;
    const W product = Plain::dot(to, along), length2 = Plain::dot(along, along);
    Vec3<T> place = start;
    if (product > W(0)) place = product < length2 ? rounded_to<T>(from + along * product / length2) : end;
    if (size <= double(half_ulp<T> / 32) * double(largest_magnitude(place))) return ClosestPoint<T>{place};
  }
  return std::nullopt;
}

/// Filter: the direction after a bounce, or nullopt.
///
/// The vector c to the center has an error of 2 u B, with B the sum of the magnitudes of its two terms. Where B is at
/// most m times the length of c, its direction has an error of 2 m u, which moves the reflected unit vector by at most
/// 8 m u. Products, quotients and the root add 22 u. m is half_ulp / 32, and the largest number of a unit vector is at
/// least 0.57.
template <class T>
std::optional<Direction<T>> filtered_bounce(const Vec3<T>& center, const Vec3<T>& velocity, T time,
                                            const Vec3<T>& location) {
  if constexpr (has_wider<T>) {
    using W = Wider<T>;
    constexpr W most = half_ulp<T> / 32;
    const Vec3<W> step = in_wider(velocity), apart = in_wider(center) - in_wider(location), moved = step * W(time);
    const Vec3<W> to_center = apart + moved;
    const W terms = magnitudes(apart) + magnitudes(moved);
    const W length2 = Plain::dot(to_center, to_center), speed2 = Plain::dot(step, step);
    if (!(terms * terms <= length2 * (most * most) && length2 > W(0) && speed2 > W(0))) return std::nullopt;
    const W across = Plain::dot(step, to_center) / length2, inverse = W(1) / detail::sqrt(speed2);
    const Vec3<W> bounced = (step - to_center * (W(2) * across)) * inverse;
    if (!(magnitudes(bounced) <= W(2))) return std::nullopt;  // an input was not finite
    return Direction<T>{rounded_to<T>(bounced)};
  }
  return std::nullopt;
}

/// Filter: the direction of a slide, or nullopt.
///
/// As for filtered_bounce, the direction of c has an error of 2 m u, which moves the slid vector by at most 4 m u.
/// Two cross products, quotients and the root add 16 u. With m = half_ulp / 64 and a largest number of at least 1/8,
/// the error is at most two thirds of half_ulp.
template <class T>
std::optional<Direction<T>> filtered_slide(const Vec3<T>& center, const Vec3<T>& velocity, T time,
                                           const Vec3<T>& location) {
  if constexpr (has_wider<T>) {
    using W = Wider<T>;
    constexpr W most = half_ulp<T> / 64;
    const Vec3<W> step = in_wider(velocity), apart = in_wider(center) - in_wider(location), moved = step * W(time);
    const Vec3<W> to_center = apart + moved;
    const W terms = magnitudes(apart) + magnitudes(moved);
    const W length2 = Plain::dot(to_center, to_center), speed2 = Plain::dot(step, step);
    if (!(terms * terms <= length2 * (most * most) && length2 > W(0) && speed2 > W(0))) return std::nullopt;
    const W inverse = W(1) / (length2 * detail::sqrt(speed2));
    const Vec3<W> slid = Plain::cross(to_center, Plain::cross(step, to_center)) * inverse;
    const W largest = largest_magnitude(slid);
    if (!(largest >= W(0.125) && largest <= W(2))) return std::nullopt;
    return Direction<T>{rounded_to<T>(slid)};
  }
  return std::nullopt;
}

/// The impact of a moving sphere, or of a point with the radius 0, at the time height / approach and with a normal in
/// the direction of n; or nullopt where that is not accurate.
///
/// The time has an error of 16 m u of itself, and n one of 4 m u: the unit normal has one of 4 m u + 5 u. The way to
/// the contact is at most the sum of the largest numbers of the start, of the contact, and of the radius. Where start
/// and radius together are at most m / 2 times the contact, the contact has an error of (m / 2 + 1) (16 m + 2) u + 3 m
/// u + 2 u of its largest number, if the radius is 0 or n has an error of 0 u. The comparison itself may round.
template <class T>
inline constexpr int most_cancelled = 1 << ((spare_digits<T> - 5) / 2);  // m
template <class T, class W>
std::optional<Impact<T>> accurate_impact(const Vec3<T>& center, T radius, const Vec3<W>& velocity, W height, W approach,
                                         const Vec3<W>& n) {
  using limits = std::numeric_limits<T>;
  constexpr T m = most_cancelled<T>;
  static_assert((W(m) / 2 + 1) * (16 * W(m) + 2) + 3 * W(m) + 2 < half_ulp<T> * W(0.75));
  const W time = height / approach;
  const Vec3<W> normal = n * (W(1) / detail::sqrt(Plain::dot(n, n)));
  const Vec3<W> place = in_wider(center) + velocity * time - normal * W(radius);
  const Impact<T> impact{T(time), rounded_to<T>(place), rounded_to<T>(normal)};
  const T size = largest_magnitude(impact.location);
  if (impact.time >= limits::min() && impact.time <= limits::max() / 2 && size <= limits::max() / m &&
      largest_magnitude(center) + radius <= size * (m / 2))
    return impact;
  return std::nullopt;
}

/// Filter: the impact of a moving sphere that certainly starts in front of a plane or in touch with it, and certainly
/// moves toward it; or nullopt. A point is a sphere of radius 0.
///
/// A sum of n products has an error of n u of the sum of their magnitudes, and the length of the normal one of 4 u of
/// itself. So the approach has an error of 3 u of its terms, and the difference of height and reach one of 6 u of
/// theirs. Where each sum of terms is at most m times the result, the time has an error of 3 m u + 6 m u + 2 u of
/// itself. A start in touch has its contact at the foot of the center: that has an error of 14 u of the terms of the
/// height and 1 u of itself.
template <class T>
std::optional<Impact<T>> filtered_contact(const Vec3<T>& center, T radius, const Vec3<T>& velocity,
                                          const Plane<T>& plane) {
  if constexpr (has_wider<T>) {
    using W = Wider<T>;
    constexpr W m = most_cancelled<T>;
    const Vec3<W> from = in_wider(center), step = in_wider(velocity), n = in_wider(plane.normal);
    const Vec3<W> towards{n.x * step.x, n.y * step.y, n.z * step.z}, above{n.x * from.x, n.y * from.y, n.z * from.z};
    const W approach = -(towards.x + towards.y + towards.z), offset = W(plane.offset);
    const W height = above.x + above.y + above.z + offset, terms = magnitudes(above) + detail::abs(offset);
    if (!(magnitudes(towards) <= approach * m)) return std::nullopt;
    const W length2 = Plain::dot(n, n), reach = radius > T(0) ? W(radius) * detail::sqrt(length2) : W(0);
    if (terms + reach <= (height - reach) * m)
      return accurate_impact(center, radius, step, height - reach, approach, n);
    if (radius > T(0) && terms + reach <= (reach - height) * half_ulp<T> &&
        terms + reach <= (reach + height) * half_ulp<T> && radius <= std::numeric_limits<T>::max() &&
        all_finite(center, velocity, plane)) {
      const Vec3<T> contact = rounded_to<T>(from - n * (height / length2));
      if (terms <= detail::sqrt(length2) * W(largest_magnitude(contact)) * (half_ulp<T> / 32))
        return Impact<T>{T(0), contact, rounded_to<T>(n * (W(1) / detail::sqrt(length2)))};
    }
  }
  return std::nullopt;
}

/// Filter: the answer for a point whose line of motion certainly passes all edges of a triangle on their inner side, or
/// nullopt.
///
/// Let t be the vector of the sums of the magnitudes of the two products in each number of the normal n. The edges have
/// an error of 1 u of themselves, so n has one of 4 u t. Its products with the velocity and with the vector to a corner
/// have errors of at most 8 u of the same products of t. Where these are at most m times the results, height and
/// approach have errors of 8 m u of themselves, and their quotient one of less than 16 m u + 1 u: 16 m u, since each
/// count is rounded up. n is at least its product with the velocity by its length: its error is at most 4 m u of it.
template <class T>
std::optional<Impact<T>> filtered_contact(const Vec3<T>& point, const Vec3<T>& velocity, const Triangle<T>& triangle) {
  if constexpr (has_wider<T>) {
    using W = Wider<T>;
    constexpr W m = most_cancelled<T>;
    const Vec3<W> from = in_wider(point), step = in_wider(velocity), corner = in_wider(triangle.v0);
    const Vec3<W> a = in_wider(triangle.v1) - corner, b = in_wider(triangle.v2) - corner, to = from - corner;
    const W yz = a.y * b.z, zy = a.z * b.y, zx = a.z * b.x, xz = a.x * b.z, xy = a.x * b.y, yx = a.y * b.x;
    const Vec3<W> n{yz - zy, zx - xz, xy - yx};
    const Vec3<W> terms{detail::abs(yz) + detail::abs(zy), detail::abs(zx) + detail::abs(xz),
                        detail::abs(xy) + detail::abs(yx)};
    const auto bound = [&](const Vec3<W>& v) {
      return terms.x * detail::abs(v.x) + terms.y * detail::abs(v.y) + terms.z * detail::abs(v.z);
    };
    const W approach = -Plain::dot(n, step), height = Plain::dot(n, to);
    if (!(bound(step) <= approach * m)) return std::nullopt;
    const W bound_of_height = bound(to);
    if (bound_of_height <= -height * m && bound_of_height > W(0)) return Impact<T>::miss();
    if (bound_of_height <= height * m) return accurate_impact(point, T(0), step, height, approach, n);
  }
  return std::nullopt;
}

/// Filter: the closest points of two lines that are not parallel, or nullopt.
///
/// Let b be the vector between the lines' points, and q the inverse of the sine of the angle between the lines. The
/// cross product of the directions has an error of 3 q u of itself, and its square one of 9 q u. So the way along the
/// first line, of at most q |b|, has an error of 21 q^2 u |b|. Its end is projected on the second line: the second
/// point has an error of 45 q^2 u |b| in all, and 1 u of itself.
template <class T>
std::optional<ClosestPoints<T>> filtered_closest_points(const Line<T>& line1, const Line<T>& line2) {
  if constexpr (has_wider<T>) {
    using W = Wider<T>;
    const Vec3<W> first = in_wider(line1.point), second = in_wider(line2.point), between = second - first;
    const Vec3<W> along1 = in_wider(line1.direction), along2 = in_wider(line2.direction);
    const Vec3<W> normal = Plain::cross(along1, along2);
    const W normal2 = Plain::dot(normal, normal), squared2 = Plain::dot(along2, along2);
    if (!(normal2 > W(0))) return std::nullopt;
    const Vec3<W> point1 = first + along1 * (Plain::dot(Plain::cross(between, along2), normal) / normal2);
    const Vec3<W> point2 = second + along2 * (Plain::dot(point1 - second, along2) / squared2);
    const ClosestPoints<T> answer{rounded_to<T>(point1), rounded_to<T>(point2)};
    const W size = magnitudes(between) * (Plain::dot(along1, along1) * squared2);  // times normal2: q^2 |b|
    const T least = smaller(largest_magnitude(answer.point1), largest_magnitude(answer.point2));
    if (size <= normal2 * (W(least) * (half_ulp<T> / 64)) && all_finite(answer)) return answer;
  }
  return std::nullopt;
}

/// A penetration, or nullopt where it is not accurate: where `of_depth` is more than half_ulp / 64 of the depth, or
/// `of_contact` more than that of the contact's largest number, or one of them is not finite.
template <class T>
std::optional<Penetration<T>> accurate_penetration(T depth, const Vec3<T>& normal, const Vec3<T>& contact,
                                                   double of_depth, double of_contact) {
  using limits = std::numeric_limits<T>;
  constexpr double most = double(half_ulp<T> / 64);
  const T magnitude = detail::abs(depth);
  if (!(of_depth <= most * double(magnitude) && magnitude >= limits::min() && magnitude <= limits::max() &&
        of_contact <= double(limits::max())))
    return std::nullopt;
  if (depth < T(0)) return Penetration<T>{depth, {}, {}};
  const Penetration<T> answer{depth, normal, contact};
  if (of_contact <= most * double(largest_magnitude(contact))) return answer;
  return std::nullopt;
}

/// The errors of a signed distance and its points, in units of u.
struct ErrorsOfDistance {
  double distance, point1, point2;
};
/// A signed distance, or nullopt where the distance or a point is not accurate, or not finite.
template <class T>
std::optional<SignedDistance<T>> accurate_distance(const Wider<T>& distance, const Vec3<Wider<T>>& normal,
                                                   const Vec3<Wider<T>>& point1, const Vec3<Wider<T>>& point2,
                                                   const ErrorsOfDistance& errors) {
  using W = Wider<T>;
  using limits = std::numeric_limits<T>;
  constexpr double enough = double(half_ulp<T>) / 1.5;  // a margin of a half for the errors of the bounds
  const auto is_accurate = [](const W& largest, double error) {
    return error <= enough * double(largest) && largest >= W(limits::min()) && largest <= W(limits::max());
  };
  if (is_accurate(detail::abs(distance), errors.distance) && is_accurate(largest_magnitude(point1), errors.point1) &&
      is_accurate(largest_magnitude(point2), errors.point2))
    return SignedDistance<T>{T(distance), rounded_to<T>(normal), rounded_to<T>(point1), rounded_to<T>(point2)};
  return std::nullopt;
}

/// Filter: the signed distance of two spheres with different centers, or nullopt.
///
/// The way between the centers has an error of 1 u, its length one of 4 u, and the normal one of 6 u. So the distance
/// has an error of 4 u of the length and 2 u of the radii, 1 u of itself more, and a point one of 7 u of its radius and
/// 1 u of itself.
template <class T>
std::optional<SignedDistance<T>> filtered_distance(const Sphere<T>& sphere1, const Sphere<T>& sphere2) {
  if constexpr (has_wider<T>) {
    using W = Wider<T>;
    const Vec3<W> center1 = in_wider(sphere1.center), center2 = in_wider(sphere2.center), between = center2 - center1;
    const W length = detail::sqrt(Plain::dot(between, between));
    if (!(length >= W(std::numeric_limits<T>::min()))) return std::nullopt;
    const W radius1 = W(sphere1.radius), radius2 = W(sphere2.radius), radii = radius1 + radius2;
    const Vec3<W> normal = between * (W(1) / length);
    const double of_point1 = 8 * double(radius1) + double(largest_magnitude(center1)),
                 of_point2 = 8 * double(radius2) + double(largest_magnitude(center2));
    return accurate_distance<T>(length - radii, normal, center1 + normal * radius1, center2 - normal * radius2,
                                {5 * double(length + radii), of_point1, of_point2});
  }
  return std::nullopt;
}
template <class T>
std::optional<SignedDistance<T>> filtered_distance(const Vec3<T>& point, const Sphere<T>& sphere) {
  return filtered_distance(Sphere<T>{point, T(0)}, sphere);
}

/// Filter: the penetration of two spheres with different centers, or nullopt.
///
/// The distance has an error of 4 u of itself and the sum of the radii one of 1 u. So the depth has an error of 4 u of
/// their sum and 1 u of itself, the normal one of 5 u, and the contact one of 6 u of the radius and 1 u of itself.
///
/// Here and below, the coordinates are computed one after the other: registers of the wider type are few.
template <class T>
std::optional<Penetration<T>> filtered_penetration(const Sphere<T>& sphere1, const Sphere<T>& sphere2) {
  if constexpr (has_wider<T>) {
    using W = Wider<T>;
    const std::array<T, 3> center = components(sphere1.center), other = components(sphere2.center);
    const auto between = [&](std::size_t k) { return W(other[k]) - W(center[k]); };
    const W distance = detail::sqrt(between(0) * between(0) + between(1) * between(1) + between(2) * between(2));
    const W radius = W(sphere1.radius), radii = radius + W(sphere2.radius), depth = radii - distance;
    if (!(distance > W(0))) return std::nullopt;
    const double of_depth = double(radii + distance) / 8;
    if (depth < W(0)) return accurate_penetration<T>(T(depth), {}, {}, of_depth, 0);
    const W inverse = W(1) / distance;
    std::array<T, 3> normal, contact;
    for (std::size_t k = 0; k < 3; ++k) {
      const W outward = between(k) * inverse;
      normal[k] = T(outward), contact[k] = T(W(center[k]) + outward * radius);
    }
    return accurate_penetration<T>(T(depth), {normal[0], normal[1], normal[2]}, {contact[0], contact[1], contact[2]},
                                   of_depth, double(radius) / 8);
  }
  return std::nullopt;
}

/// Filter: the penetration of a sphere and a plane, or nullopt.
///
/// Let S be the sum of the radius and of the magnitudes of the terms of the height, by the length of the normal. The
/// height has an error of 9 u S, the depth 1 u of itself more, and the contact one of 6 u of the radius and 1 u of
/// itself.
template <class T>
std::optional<Penetration<T>> filtered_penetration(const Sphere<T>& sphere, const Plane<T>& plane) {
  if constexpr (has_wider<T>) {
    using W = Wider<T>;
    const std::array<T, 3> center = components(sphere.center), n = components(plane.normal);
    W above = W(0), length2 = W(0);
    double terms = detail::abs(double(plane.offset)) + 4 * std::numeric_limits<double>::min();  // of underflow
    for (std::size_t k = 0; k < 3; ++k) {
      above = above + W(n[k]) * W(center[k]), length2 = length2 + W(n[k]) * W(n[k]);
      terms = terms + detail::abs(double(n[k]) * double(center[k]));
    }
    const W inverse = W(1) / detail::sqrt(length2), radius = W(sphere.radius);
    const W depth = radius - (above + W(plane.offset)) * inverse;
    if (!(length2 > W(0))) return std::nullopt;
    std::array<T, 3> normal, contact;
    for (std::size_t k = 0; k < 3; ++k) {
      const W outward = W(n[k]) * inverse;
      normal[k] = T(outward), contact[k] = T(W(center[k]) - outward * radius);
    }
    const double size = double(radius) + terms * double(inverse);
    return accurate_penetration<T>(T(depth), {normal[0], normal[1], normal[2]}, {contact[0], contact[1], contact[2]},
                                   size / 4, double(radius) / 8);
  }
  return std::nullopt;
}

}  // namespace collide::detail

#include <collide/detail/strict_end.hpp>
