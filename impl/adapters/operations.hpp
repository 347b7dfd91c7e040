/// The operations that other libraries are asked, by the types of a query's inputs. An adapter answers an operation for
/// each pair of shapes that its library knows, so that a query about another pair needs no function of its own.
#pragma once

#include <concepts>
#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>

#include <collide/members.hpp>
#include <collide/shapes.hpp>

#include "impl/catalogue/kind.hpp"
#include "impl/catalogue/queries/moving_point_triangle_prepared.hpp"
#include "impl/subject/adapter.hpp"

namespace nearmiss::adapters {

namespace detail {
template <template <class> class Shape, class S>
inline constexpr bool is_instance = false;
template <template <class> class Shape, class T>
inline constexpr bool is_instance<Shape, Shape<T>> = true;
}  // namespace detail
template <class S>
inline constexpr bool is_vector = detail::is_instance<collide::Vec3, S>;
template <class S>
inline constexpr bool is_plane = detail::is_instance<collide::Plane, S>;
template <class S>
inline constexpr bool is_halfspace = detail::is_instance<collide::HalfSpace, S>;
template <class S>
inline constexpr bool is_sphere = detail::is_instance<collide::Sphere, S>;
template <class S>
inline constexpr bool is_box = detail::is_instance<collide::Box, S>;
template <class S>
inline constexpr bool is_aabox = detail::is_instance<collide::AABox, S>;
template <class S>
inline constexpr bool is_triangle = detail::is_instance<collide::Triangle, S>;

/// "sphere", "capsule"; of a type that moves.
template <class S>
inline constexpr const char* name_of_shape = is_sphere<S>     ? "sphere"
                                             : is_box<S>      ? "box"
                                             : is_triangle<S> ? "triangle"
                                                              : "capsule";

/// The inputs that are shapes, but for points, in their order: references to members of `q`.
template <class Q>
auto shapes_of(const Q& q) {
  const auto alone = [&](const auto& m) {
    using Value = std::remove_cvref_t<decltype(q.*(m.pointer))>;
    if constexpr (collide::Listed<Value> && !is_vector<Value>) {
      return std::tie(q.*(m.pointer));
    } else {
      return std::tuple<>();
    }
  };
  return std::apply([&](const auto&... m) { return std::tuple_cat(alone(m)...); }, Q::members());
}
template <class Q>
using ShapesOf = decltype(shapes_of(std::declval<const Q&>()));
namespace detail {
template <class Shapes, std::size_t k>
struct ShapeAt {
  using Type = void;
};
template <class Shapes, std::size_t k>
  requires(k < std::tuple_size_v<Shapes>)
struct ShapeAt<Shapes, k> {
  using Type = std::remove_cvref_t<std::tuple_element_t<k, Shapes>>;
};
}  // namespace detail
/// The type of the first shape and of the second one; void where there is none.
template <class Q>
using First = typename detail::ShapeAt<ShapesOf<Q>, 0>::Type;
template <class Q>
using Second = typename detail::ShapeAt<ShapesOf<Q>, 1>::Type;

template <class Q>
concept OfTwoShapes = std::tuple_size_v<ShapesOf<Q>> == 2;
/// One of the first two shapes is a triangle.
template <class Q>
inline constexpr bool asks_of_triangle = is_triangle<First<Q>> || is_triangle<Second<Q>>;
template <class Q>
concept OfMotion = requires(const Q& q) { q.velocity; };
template <class Q, Kind kind>
concept AnswersWith = kind_of<typename Q::Answer> == kind;

/// Whether two shapes at rest meet.
template <class Q>
concept AsksOverlap = OfTwoShapes<Q> && !OfMotion<Q> && AnswersWith<Q, Kind::decision> && Q::traits.touching_is_yes;
/// How deep two shapes overlap.
template <class Q>
concept AsksDepth = OfTwoShapes<Q> && AnswersWith<Q, Kind::depth>;
/// How far two shapes are apart, or how deep they overlap, with two points; of which one may be a point.
template <class Q>
concept TellsSignedDistance = requires(const typename Q::Answer& a) { a.distance, a.point1, a.point2; };
template <class Q>
concept AsksSignedDistance = OfTwoShapes<Q> && TellsSignedDistance<Q>;
/// When a moving shape, other than a point, meets a shape.
template <class Q>
concept AsksMotion = OfTwoShapes<Q> && OfMotion<Q> && AnswersWith<Q, Kind::impact>;
/// When a moving sphere meets a shape.
template <class Q>
concept AsksBallMotion = AsksMotion<Q> && is_sphere<First<Q>>;
/// Whether a sphere meets a shape on its way.
template <class Q>
concept AsksBallPath = OfTwoShapes<Q> && OfMotion<Q> && AnswersWith<Q, Kind::decision>;
template <class Q>
inline constexpr bool is_about_prepared = false;
template <class T>
inline constexpr bool is_about_prepared<inputs::moving_point_triangle_prepared<T>> = true;
/// When a moving point meets a shape, which is not prepared.
template <class Q>
concept AsksPointMotion = std::tuple_size_v<ShapesOf<Q>> == 1 && AnswersWith<Q, Kind::impact> && !is_about_prepared<Q>;

template <AsksPointMotion Q>
const auto& moving_point_of(const Q& q) {
  if constexpr (requires { q.point; }) {
    return q.point;
  } else {
    return q.a;
  }
}

/// The axis of two boxes is part of the answer.
template <class Q>
concept TellsAxis = requires(const typename Q::Answer& a) { a.axis; };

/// The decision, without the members that explain it, which the library does not tell.
template <class Q>
auto decided_alone(bool yes) {
  typename Q::Answer answer{};
  answer.decision = yes;
  if constexpr (std::tuple_size_v<decltype(Q::Answer::members())> == 0) {
    return answer;
  } else {
    return only(answer, {});
  }
}

}  // namespace nearmiss::adapters
