/// The queries of grid.def: whether two shapes overlap, their signed distance, and when and where one that moves meets
/// the other.
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

namespace grid {

/// The shapes by their names in shapes.def.
// NOLINTBEGIN(bugprone-macro-parentheses): a name that is declared has none
#define NEARMISS_SHAPE(name, type, words, edges, faces) \
  template <class T>                                    \
  using name = collide::type<T>;
#include "impl/catalogue/shapes.def"
#undef NEARMISS_SHAPE
// NOLINTEND(bugprone-macro-parentheses)

constexpr bool has_size(std::string_view shape) { return shape == "sphere" || shape == "capsule" || shape == "box"; }
constexpr bool has_edges(std::string_view shape) { return shape != "point" && shape != "sphere"; }
/// With a radius, a point of the answer follows its normal; parallel edges have many nearest points. A half-space has
/// one normal, and edges along its plane have many deepest points.
constexpr Ties ties_of(std::string_view first, std::string_view second) {
  if (second == "halfspace") return has_edges(first) ? Ties{Tie::position} : Ties{};
  const bool may_be_parallel = has_edges(first) && has_edges(second);
  return has_size(first) || has_size(second) || may_be_parallel ? Ties{Tie::position, Tie::cone} : Ties{Tie::cone};
}
constexpr Role role_of(std::string_view shape) { return shape == "point" ? Role::position : Role::inherited; }

/// Half-spaces are large: a body is more often within one, or far away, than at its plane.
constexpr Balance balance_of(std::string_view second) {
  return second == "halfspace" ? Balance{.knifes_edge_per_mille = 7} : Balance{};
}

/// The same question about two other shapes: a point is a sphere of radius 0, and a segment is a capsule of radius 0.
constexpr Link as_rounded(QueryId to, std::array<Link::Renamed, 3> renamed) {
  return {.kind = Link::Kind::same_decision, .to = to, .renamed = renamed};
}
/// A capsule whose ends are one point is a sphere.
constexpr Link as_sphere(QueryId to, std::array<Link::Renamed, 3> renamed) {
  return {.kind = Link::Kind::capsule_as_sphere, .to = to, .renamed = renamed};
}

/// The links of an overlap, by its shapes.
constexpr Link of_point_sphere[] = {
    as_rounded(query_id("sphere_sphere_overlap"), {{{"sphere1.center", "point"}, {"sphere2", "sphere"}}})};
constexpr Link of_point_capsule[] = {as_rounded(query_id("sphere_capsule_overlap"), {{{"sphere.center", "point"}}})};
constexpr Link of_point_box[] = {as_rounded(query_id("sphere_box_overlap"), {{{"sphere.center", "point"}}})};
constexpr Link of_sphere_segment[] = {
    as_rounded(query_id("sphere_capsule_overlap"), {{{"capsule.p0", "segment.v0"}, {"capsule.p1", "segment.v1"}}})};
constexpr Link of_sphere_capsule[] = {
    as_sphere(query_id("sphere_sphere_overlap"),
              {{{"sphere1", "sphere"}, {"sphere2.center", "capsule.p0"}, {"sphere2.radius", "capsule.radius"}}})};
constexpr Link of_segment_capsule[] = {
    as_rounded(query_id("capsule_capsule_overlap"),
               {{{"capsule1.p0", "segment.v0"}, {"capsule1.p1", "segment.v1"}, {"capsule2", "capsule"}}})};
constexpr Link of_segment_triangle[] = {
    as_rounded(query_id("capsule_triangle_overlap"), {{{"capsule.p0", "segment.v0"}, {"capsule.p1", "segment.v1"}}})};
constexpr Link of_segment_box[] = {
    as_rounded(query_id("capsule_box_overlap"), {{{"capsule.p0", "segment.v0"}, {"capsule.p1", "segment.v1"}}})};
constexpr Link of_capsule_capsule[] = {
    as_sphere(query_id("sphere_capsule_overlap"),
              {{{"sphere.center", "capsule1.p0"}, {"sphere.radius", "capsule1.radius"}, {"capsule", "capsule2"}}})};
constexpr Link of_capsule_triangle[] = {as_sphere(
    query_id("sphere_triangle_overlap"), {{{"sphere.center", "capsule.p0"}, {"sphere.radius", "capsule.radius"}}})};
constexpr Link of_capsule_box[] = {
    as_sphere(query_id("sphere_box_overlap"), {{{"sphere.center", "capsule.p0"}, {"sphere.radius", "capsule.radius"}}}),
    {.kind = Link::Kind::box_as_point,
     .to = query_id("sphere_capsule_overlap"),
     .renamed = {{{"sphere.center", "box.center"}, {"sphere.radius", "-"}}}}};
/// A plane and all behind it.
constexpr Link as_plane(QueryId to) {
  return {.kind = Link::Kind::same_decision, .to = to, .renamed = {{{"plane", "halfspace"}}}};
}
constexpr Link of_point_halfspace[] = {
    as_rounded(query_id("sphere_halfspace_overlap"), {{{"sphere.center", "point"}}})};
constexpr Link of_sphere_halfspace[] = {as_plane(query_id("sphere_plane_penetration"))};
constexpr Link of_segment_halfspace[] = {
    as_rounded(query_id("capsule_halfspace_overlap"), {{{"capsule.p0", "segment.v0"}, {"capsule.p1", "segment.v1"}}})};
constexpr Link of_capsule_halfspace[] = {as_sphere(
    query_id("sphere_halfspace_overlap"), {{{"sphere.center", "capsule.p0"}, {"sphere.radius", "capsule.radius"}}})};
constexpr Link of_box_halfspace[] = {as_plane(query_id("box_plane_penetration")),
                                     {.kind = Link::Kind::box_as_point,
                                      .to = query_id("sphere_halfspace_overlap"),
                                      .renamed = {{{"sphere.center", "box.center"}, {"sphere.radius", "-"}}}}};
constexpr std::span<const Link> of_triangle_triangle{}, of_triangle_box{}, of_triangle_halfspace{};

constexpr Link decided_by(QueryId overlap) { return {.kind = Link::Kind::sign_of_distance, .to = overlap}; }
/// A sphere of radius 0 is a point.
constexpr Link as_point(QueryId to, std::array<Link::Renamed, 3> renamed) {
  return {.kind = Link::Kind::sphere_as_point, .to = to, .renamed = renamed};
}

/// The links of a signed distance, by its shapes.
constexpr std::span<const Link> distance_of_point_segment{}, distance_of_segment_segment{},
    distance_of_point_triangle{};
constexpr Link distance_of_point_sphere[] = {decided_by(query_id("point_sphere_overlap"))};
constexpr Link distance_of_point_capsule[] = {
    decided_by(query_id("point_capsule_overlap")),
    as_sphere(query_id("point_sphere_signed_distance"),
              {{{"sphere.center", "capsule.p0"}, {"sphere.radius", "capsule.radius"}}})};
constexpr Link distance_of_sphere_sphere[] = {
    decided_by(query_id("sphere_sphere_overlap")),
    as_point(query_id("point_sphere_signed_distance"), {{{"point", "sphere1.center"}, {"sphere", "sphere2"}}})};
constexpr Link distance_of_sphere_segment[] = {
    decided_by(query_id("sphere_segment_overlap")),
    as_point(query_id("point_segment_signed_distance"), {{{"point", "sphere.center"}}})};
constexpr Link distance_of_sphere_capsule[] = {
    decided_by(query_id("sphere_capsule_overlap")),
    as_point(query_id("point_capsule_signed_distance"), {{{"point", "sphere.center"}}}),
    as_sphere(query_id("sphere_sphere_signed_distance"),
              {{{"sphere1", "sphere"}, {"sphere2.center", "capsule.p0"}, {"sphere2.radius", "capsule.radius"}}})};
constexpr Link distance_of_segment_capsule[] = {decided_by(query_id("segment_capsule_overlap"))};
constexpr Link distance_of_capsule_capsule[] = {
    decided_by(query_id("capsule_capsule_overlap")),
    as_sphere(query_id("sphere_capsule_signed_distance"),
              {{{"sphere.center", "capsule1.p0"}, {"sphere.radius", "capsule1.radius"}, {"capsule", "capsule2"}}})};
constexpr Link distance_of_sphere_triangle[] = {
    decided_by(query_id("sphere_triangle_overlap")),
    as_point(query_id("point_triangle_signed_distance"), {{{"point", "sphere.center"}}})};
constexpr Link distance_of_segment_triangle[] = {decided_by(query_id("segment_triangle_overlap"))};
constexpr Link distance_of_capsule_triangle[] = {
    decided_by(query_id("capsule_triangle_overlap")),
    as_sphere(query_id("sphere_triangle_signed_distance"),
              {{{"sphere.center", "capsule.p0"}, {"sphere.radius", "capsule.radius"}}})};
constexpr Link distance_of_triangle_triangle[] = {decided_by(query_id("triangle_triangle_overlap"))};
constexpr Link distance_of_point_box[] = {decided_by(query_id("point_box_overlap"))};
constexpr Link distance_of_sphere_box[] = {
    decided_by(query_id("sphere_box_overlap")),
    as_point(query_id("point_box_signed_distance"), {{{"point", "sphere.center"}}})};
constexpr Link distance_of_segment_box[] = {decided_by(query_id("segment_box_overlap"))};
constexpr Link distance_of_capsule_box[] = {
    decided_by(query_id("capsule_box_overlap")),
    as_sphere(query_id("sphere_box_signed_distance"),
              {{{"sphere.center", "capsule.p0"}, {"sphere.radius", "capsule.radius"}}})};
constexpr Link distance_of_triangle_box[] = {decided_by(query_id("triangle_box_overlap"))};
constexpr Link distance_of_box_box[] = {decided_by(query_id("box_box_overlap"))};
constexpr Link distance_of_point_halfspace[] = {decided_by(query_id("point_halfspace_overlap"))};
constexpr Link distance_of_sphere_halfspace[] = {
    decided_by(query_id("sphere_halfspace_overlap")),
    as_point(query_id("point_halfspace_signed_distance"), {{{"point", "sphere.center"}}})};
constexpr Link distance_of_segment_halfspace[] = {decided_by(query_id("segment_halfspace_overlap"))};
constexpr Link distance_of_capsule_halfspace[] = {
    decided_by(query_id("capsule_halfspace_overlap")),
    as_sphere(query_id("sphere_halfspace_signed_distance"),
              {{{"sphere.center", "capsule.p0"}, {"sphere.radius", "capsule.radius"}}})};
constexpr Link distance_of_triangle_halfspace[] = {decided_by(query_id("triangle_halfspace_overlap"))};
constexpr Link distance_of_box_halfspace[] = {decided_by(query_id("box_halfspace_overlap"))};

constexpr Link at_rest(QueryId overlap) { return {.kind = Link::Kind::at_rest, .to = overlap}; }

/// The links of a cast, by its shapes.
constexpr Link cast_of_point_halfspace[] = {at_rest(query_id("point_halfspace_overlap"))};
constexpr Link cast_of_sphere_halfspace[] = {
    at_rest(query_id("sphere_halfspace_overlap")),
    as_point(query_id("moving_point_halfspace"), {{{"point", "sphere.center"}}})};
constexpr Link cast_of_segment_halfspace[] = {at_rest(query_id("segment_halfspace_overlap"))};
constexpr Link cast_of_capsule_halfspace[] = {
    at_rest(query_id("capsule_halfspace_overlap")),
    as_sphere(query_id("moving_sphere_halfspace"),
              {{{"sphere.center", "capsule.p0"}, {"sphere.radius", "capsule.radius"}}})};
constexpr Link cast_of_triangle_halfspace[] = {at_rest(query_id("triangle_halfspace_overlap"))};
constexpr Link cast_of_box_halfspace[] = {at_rest(query_id("box_halfspace_overlap")),
                                          {.kind = Link::Kind::box_as_point,
                                           .to = query_id("moving_sphere_halfspace"),
                                           .renamed = {{{"sphere.center", "box.center"}, {"sphere.radius", "-"}}}}};

}  // namespace grid

#define NEARMISS_OVERLAP(first, second)                                                                   \
  template <class T>                                                                                      \
  struct first##_##second##_overlap {                                                                     \
    using Answer = collide::Decision<T>;                                                                  \
                                                                                                          \
    grid::first<T> a{};                                                                                   \
    grid::second<T> b{};                                                                                  \
                                                                                                          \
    static constexpr bool alike = std::string_view(#first) == #second;                                    \
    static constexpr auto members() {                                                                     \
      return std::tuple(                                                                                  \
          member(alike ? #first "1" : #first, &first##_##second##_overlap::a, grid::role_of(#first)),     \
          member(alike ? #second "2" : #second, &first##_##second##_overlap::b, grid::role_of(#second))); \
    }                                                                                                     \
                                                                                                          \
    static constexpr Traits traits{.grows = grid::has_size(#first) || grid::has_size(#second),            \
                                   .exchange = alike ? Exchange::always : Exchange::none,                 \
                                   .balance = grid::balance_of(#second),                                  \
                                   .links = grid::of_##first##_##second};                                 \
  };
#include "impl/catalogue/grid.def"

#define NEARMISS_SIGNED_DISTANCE(first, second)                                                                   \
  template <class T>                                                                                              \
  struct first##_##second##_signed_distance {                                                                     \
    using Answer = collide::SignedDistance<T>;                                                                    \
                                                                                                                  \
    grid::first<T> a{};                                                                                           \
    grid::second<T> b{};                                                                                          \
                                                                                                                  \
    static constexpr bool alike = std::string_view(#first) == #second;                                            \
    static constexpr auto members() {                                                                             \
      return std::tuple(                                                                                          \
          member(alike ? #first "1" : #first, &first##_##second##_signed_distance::a, grid::role_of(#first)),     \
          member(alike ? #second "2" : #second, &first##_##second##_signed_distance::b, grid::role_of(#second))); \
    }                                                                                                             \
                                                                                                                  \
    static constexpr Traits traits{.exchange = alike ? Exchange::always : Exchange::none,                         \
                                   .ties = grid::ties_of(#first, #second),                                        \
                                   .links = grid::distance_of_##first##_##second};                                \
  };
#include "impl/catalogue/grid.def"

#define NEARMISS_CAST_AS(query, first, second)                                                 \
  template <class T>                                                                           \
  struct query {                                                                               \
    using Answer = collide::Impact<T>;                                                         \
                                                                                               \
    grid::first<T> a{};                                                                        \
    Vec3<T> velocity{};                                                                        \
    grid::second<T> b{};                                                                       \
                                                                                               \
    static constexpr bool alike = std::string_view(#first) == #second;                         \
    static constexpr auto members() {                                                          \
      return std::tuple(member(#first, &query::a, grid::role_of(#first)),                      \
                        member("velocity", &query::velocity, Role::velocity),                  \
                        member(alike ? "fixed" : #second, &query::b, grid::role_of(#second))); \
    }                                                                                          \
                                                                                               \
    static constexpr Traits traits{.grows = grid::has_size(#first) || grid::has_size(#second), \
                                   .ties = grid::ties_of(#first, #second),                     \
                                   .balance = grid::balance_of(#second),                       \
                                   .links = grid::cast_of_##first##_##second};                 \
  };
#include "impl/catalogue/grid.def"

}  // namespace nearmiss::inputs
