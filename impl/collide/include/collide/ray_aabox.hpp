/// Whether and where a ray meets an axis-aligned box.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/enter_box.hpp>
#include <collide/frame.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// A ray that is asked about many boxes; made by `prepare_ray`. One that is not finite starts at -infinity: it meets
/// nothing.
template <class T>
struct PreparedRay {
  Ray<T> ray{};
  Vec3<T> inverse{};  ///< 1 / direction in each coordinate, at most the largest number; +infinity for 0
};

template <class T>
PreparedRay<T> prepare_ray(const Ray<T>& ray) noexcept {
  if constexpr (MachineNumber<T>) {
    using limits = std::numeric_limits<T>;
    constexpr T infinity = limits::infinity();
    if (!all_finite(ray)) return {{{-infinity, -infinity, -infinity}, {T(1), T(1), T(1)}}, {T(1), T(1), T(1)}};
    const auto inverse = [](T x) { return x == T(0) ? infinity : clamped(T(1) / x, -limits::max(), limits::max()); };
    return {ray, {inverse(ray.direction.x), inverse(ray.direction.y), inverse(ray.direction.z)}};
  } else {
    const auto inverse = [](const T& x) { return x == T(0) ? T(0) : T(T(1) / x); };  // 0 is not used
    return {ray, {inverse(ray.direction.x), inverse(ray.direction.y), inverse(ray.direction.z)}};
  }
}

/// A box that is asked about many rays; made by `prepare_aabox`.
template <class T>
struct PreparedAABox {
  AABox<T> aabox{};  ///< its six numbers +infinity where one of them is not finite: nothing meets it
};

template <class T>
PreparedAABox<T> prepare_aabox(const AABox<T>& aabox) noexcept {
  if constexpr (MachineNumber<T>) {
    constexpr T infinity = std::numeric_limits<T>::infinity();
    if (!all_finite(aabox)) return {{{infinity, infinity, infinity}, {infinity, infinity, infinity}}};
  }
  return {aabox};
}

#if defined(COLLIDE_LANES)

namespace detail {

/// Three numbers of a prepared thing, with any number in the fourth lane: `other` has one behind them, `last` before
/// them.
template <class Prepared>
Lanes<float> three_of(const Prepared& prepared, const Vec3<float>& other) noexcept {
  const char* const whole = reinterpret_cast<const char*>(&prepared);
  return Lanes<float>::load(whole + (reinterpret_cast<const char*>(&other) - whole));
}
template <class Prepared>
Lanes<float> last_three_of(const Prepared& prepared, const Vec3<float>& last) noexcept {
  const char* const whole = reinterpret_cast<const char*>(&prepared);
  return Lanes<float>::load(whole + (reinterpret_cast<const char*>(&last) - whole) - sizeof(float))
      .shuffled<1, 2, 3, 3>();
}
template <class Prepared>
Lanes<double> three_of(const Prepared&, const Vec3<double>& other) noexcept {
  return lanes(other);
}
template <class Prepared>
Lanes<double> last_three_of(const Prepared&, const Vec3<double>& last) noexcept {
  return lanes(last);
}

/// The ray is in the box from the last entry of a pair of faces to the first exit. A pair that it is parallel to it
/// enters and leaves at an infinite time, of the one sign where it starts beside the pair, of both where it starts
/// between; the time to a face that it lies in is NaN, and does not count.
///
/// Every time is off by 3 eps of itself, as if the gap were: faces and origin explain that.
template <class T>
inline RayHit<T> ray_aabox_in_lanes(const PreparedRay<T>& prepared, const PreparedAABox<T>& box) noexcept {
  using L = Lanes<T>;
  using P = Pair<T>;
  const L origin = three_of(prepared, prepared.ray.origin), direction = three_of(prepared, prepared.ray.direction);
  const L inverse = last_three_of(prepared, prepared.inverse);
  const L low = three_of(box, box.aabox.min), high = last_three_of(box, box.aabox.max);
  const L to_low = (low - origin) * inverse, to_high = (high - origin) * inverse;
  // Of two numbers of which one is NaN, the first. No exit is infinite, so that no infinite entry comes before it.
  const L entries = larger(L::all(T(0)), smaller(to_low, to_high));
  const L exits = smaller(L::all(std::numeric_limits<T>::max()), larger(to_high, to_low));
  const P time = largest_of(entries), exit = smallest_of(exits);
  const bool hit = time.first() <= exit.first();
  const L location = smaller(larger(origin + direction * every(time), low), high) & every(time <= exit);
  return {first_three(location), hit, (int(hit) & int(time.first() == T(0))) != 0};
}

}  // namespace detail

#endif

/// Whether `ray` meets the closed `aabox`, and where it enters. A ray that starts in the box meets it there.
///
/// 1. location == origin + direction * t for some t >= 0 (exactly, in real numbers), a point of the box
/// 2. inside exactly when the origin is in the box; then location == origin
///
/// The inverse saves divisions and never changes the answer. Source: the face planes in front of the origin, the
/// last one reached (Woo, Fast Ray-Box Intersection, in Graphics Gems, 1990).
template <class Tier = Fast, class T>
inline RayHit<T> ray_aabox(const PreparedRay<T>& ray, const PreparedAABox<T>& box) noexcept {
#if defined(COLLIDE_LANES)
  if constexpr (in_lanes<Tier, T>) return detail::ray_aabox_in_lanes(ray, box);
#endif
  if constexpr (Tier::template lifts<T>) {
    const auto text = [&](auto by, const auto& r, const auto& b) {
      if constexpr (Tier::template keeps<T>)
        return ray_aabox<decltype(by)>(ray, box);
      else
        return ray_aabox<decltype(by)>(prepare_ray(r), prepare_aabox(b));
    };
    return Tier::lift(text, ray.ray, box.aabox);
  }
  const std::array<T, 3> at = components(ray.ray.origin), step = components(ray.ray.direction);
  const std::array<T, 3> low = components(box.aabox.min), high = components(box.aabox.max);
  bool inside = true;
  for (int i = 0; i < 3; ++i) inside = inside && low[i] <= at[i] && at[i] <= high[i];
  if (inside) return {ray.ray.origin, true, true};
  const std::array<T, 3> inverse = components(ray.inverse);
  const auto entry = detail::enter_box(at, step, low, high, [&](const T& gap, int i) -> T { return gap * inverse[i]; });
  if (entry.axis < 0) return {};
  return {{entry.at[0], entry.at[1], entry.at[2]}, true, false};
}

namespace contracts {

/// First order, G the largest position: a gap is known to 1 eps of 2 G, inverse and product add 1 eps each,
/// product and sum 1 eps each of a way of at most 2 G. Origin and faces move by 5 * 2 eps G at most.
template <class Tier = Fast, class T = double>
constexpr Contract ray_aabox() {
  return Tier::template contract<T>({.backward = 10, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
