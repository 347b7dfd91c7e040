/// Contacts of a moving sphere with an edge or a corner of a triangle, for the filter of Certified
/// (sphere_triangle_filter.hpp).
///
/// The distance between a convex shape and a point on a line of motion is a convex function of time. So a sphere first
/// touches a triangle at a time at which the distance is the radius and falls, and there is at most one such time. A
/// candidate is right if the feature that it assumes is the closest one at its time.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>

#include <collide/answers.hpp>
#include <collide/detail/wide_filters.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide::detail {

/// The first time at which speed2 t^2 - 2 closing t + outside is zero, and its error, relative to itself. The error is
/// infinite where there is no such time after 0, or where it is not certain.
template <class W>
struct FirstTime {
  W time{};
  double error = std::numeric_limits<double>::infinity();
};

/// The arguments and errors of an equation. The discriminant closing^2 - speed2 outside has the error `of_chord2`.
template <class T, class W>
FirstTime<W> first_time(const W& speed2, const W& closing, const W& outside, double of_closing, double of_outside,
                        double of_chord2) {
  using In = InW<T, W>;
  const W chord2 = closing * closing - speed2 * outside;
  const double chord2_size = In::number(chord2), outside_size = In::number(outside);
  if (!(In::number(closing) > 0 && outside_size > 0 && chord2_size > 4 * In::u * of_chord2)) return {};
  const W chord = sqrt(chord2), sum = closing + chord;
  const double of_sum = of_closing + of_chord2 / In::number(chord) + 2 * In::number(sum);
  return {outside / sum, of_outside / outside_size + of_sum / In::number(sum) + 4};
}

/// The impact with the corner `start`, from which two edges run, or nullopt.
///
/// Let w be the vector from the corner to the center and |x| the sum of the magnitudes of the numbers of x. Products of
/// w with itself and with the velocity have errors of 5 u |w|^2 and 4 u |w| |velocity|, the squared speed one of
/// 3 u |velocity|^2, and the square of the radius 1 u of itself. So the discriminant has an error of less than
/// 24 u (|w|^2 + radius^2) |velocity|^2. The vector to the center at the contact has an error of (time error + 3)
/// (|w| + way), its products with edges one of 5 more.
template <class T, class W>
std::optional<TriangleImpact<T>> corner_impact(const Sphere<T>& sphere, const Vec3<T>& velocity,
                                               const std::array<Vec3<T>, 3>& corner, std::size_t i) {
  using In = InW<T, W>;
  const Vec3<W> start = In::wide(corner[i]), step = In::wide(velocity), w = In::wide(sphere.center) - start;
  const W radius = W(sphere.radius);
  const double r = double(sphere.radius), from = In::size(w), speed = In::size(step), squares = from * from + r * r;
  const FirstTime<W> first =
      first_time<T, W>(Plain::dot(step, step), -Plain::dot(w, step), Plain::dot(w, w) - radius * radius,
                       4 * from * speed, 7 * squares, 24 * squares * speed * speed);
  if (!(first.error <= In::enough)) return std::nullopt;
  const Vec3<W> moved = step * first.time, away = w + moved;
  const double of_away = (first.error + 8) * (from + In::size(moved));
  for (std::size_t k = 1; k < 3; ++k) {
    const Vec3<W> edge = In::wide(corner[(i + k) % 3]) - start;
    if (!(-In::number(Plain::dot(away, edge)) > 2 * In::u * of_away * In::size(edge))) return std::nullopt;
  }
  if (!(of_away + 2 * r <= r * In::enough / 2)) return std::nullopt;
  std::array<T, 3> weights{};
  weights[i] = T(1);
  return TriangleImpact<T>{T(leading_part(first.time)),
                           corner[i],
                           In::rounded(away * (W(1) / radius)),
                           {weights[0], weights[1], weights[2]}};
}

/// The impact with edge i between its ends, or nullopt. `n` is the normal of the triangle, with an error of
/// 4 u `size_of_n`.
///
/// Let w be the vector from the start of the edge e to the center. The vectors w x e and velocity x e have errors of
/// 4 u |w| |e| and 3 u |velocity| |e| in each number. So `closing` has an error of 30 u |w| |velocity| |e|^2, `outside`
/// one of 34 u (|w|^2 + radius^2) |e|^2, and the discriminant one of less than 400 u (|w|^2 + radius^2) |velocity|^2
/// |e|^4. The vector to the center at the contact has an error of (time error + 3) (|w| + way).
template <class T, class W>
std::optional<TriangleImpact<T>> edge_impact(const Sphere<T>& sphere, const Vec3<T>& velocity,
                                             const std::array<Vec3<T>, 3>& corner, std::size_t i, const Vec3<W>& n,
                                             double size_of_n) {
  using In = InW<T, W>;
  const Vec3<W> start = In::wide(corner[i]), edge = In::wide(corner[(i + 1) % 3]) - start;
  const Vec3<W> step = In::wide(velocity), w = In::wide(sphere.center) - start;
  const Vec3<W> beside = Plain::cross(w, edge), across = Plain::cross(step, edge);
  const W radius = W(sphere.radius), edge2 = Plain::dot(edge, edge);
  const double r = double(sphere.radius), from = In::size(w), speed = In::size(step), length = In::size(edge);
  const double squares = (from * from + r * r) * (length * length);
  const FirstTime<W> first = first_time<T, W>(
      Plain::dot(across, across), -Plain::dot(beside, across), Plain::dot(beside, beside) - radius * radius * edge2,
      30 * from * speed * length * length, 34 * squares, 400 * squares * (speed * length) * (speed * length));
  if (!(first.error <= In::enough)) return std::nullopt;
  const Vec3<W> moved = step * first.time, at = w + moved;
  const W share = Plain::dot(at, edge) / edge2;
  const double path = from + In::size(moved), of_at = (first.error + 3) * path;
  const double of_share = (of_at + 6 * path) * (length / In::number(edge2)) + 8;
  const double along = In::number(share), doubt = 2 * In::u * of_share;
  const double inward = In::number(Plain::dot(n, Plain::cross(edge, at)));
  const double of_inward = size_of_n * length * (of_at + 12 * path);
  if (!(along > doubt && along < 1 - doubt && inward < -2 * In::u * of_inward)) return std::nullopt;
  const Vec3<W> foot = edge * share, away = at - foot;
  const double of_foot = length * (of_share + 2), of_away = of_at + of_foot + 3 * (path + length);
  const Vec3<T> place = In::rounded(start + foot);
  if (!(of_away + 2 * r <= r * In::enough / 2 && of_foot <= double(largest_magnitude(place)) * In::enough &&
        of_share <= In::enough / 2))
    return std::nullopt;
  std::array<T, 3> weights{};
  weights[i] = T(leading_part(W(1) - share)), weights[(i + 1) % 3] = T(along);
  return TriangleImpact<T>{
      T(leading_part(first.time)), place, In::rounded(away * (W(1) / radius)), {weights[0], weights[1], weights[2]}};
}

}  // namespace collide::detail

#include <collide/detail/strict_end.hpp>
