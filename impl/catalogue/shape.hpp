/// The shapes of a query's operands: the closed list shapes.def, each with what its numbers mean.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <collide/members.hpp>

namespace nearmiss {

using collide::Role;

enum class Shape : std::uint8_t {
#define NEARMISS_SHAPE(name, type, words, edges, faces) name,
#include "impl/catalogue/shapes.def"
#undef NEARMISS_SHAPE
};

/// A plane, or a half-space: a normal and an offset are its only members.
constexpr bool has_one_plane(Shape shape) { return shape == Shape::plane || shape == Shape::halfspace; }

/// A vector, a number or a quaternion of a shape.
struct ShapeMember {
  std::string name;          ///< "center", "vertices.count", "vertices.0"; empty: the shape is this member
  std::size_t begin, count;  ///< its numbers, counted from the shape's first
  Role role;
};

/// The members of a shape: those of its struct in collide/shapes.hpp, of a list its count and each of its entries. A
/// struct whose members have no role of their own is one position.
template <class S>
std::vector<ShapeMember> members_of(S shape) {
  std::vector<ShapeMember> members;
  std::size_t at = 0;
  const auto add = [&](std::string name, auto& value, Role role) {
    std::size_t count = 0;
    collide::for_each_leaf(value, [&](auto&, Role) { ++count; });
    members.push_back({std::move(name), at, count, role});
    at += count;
  };
  collide::for_each_member(shape, [&](const std::string& name, auto& value, Role role) {
    if constexpr (collide::is_counted<std::remove_cvref_t<decltype(value)>>) {
      add(name + ".count", value.count, Role::count);
      for (std::size_t i = 0; i < value.size(); ++i) add(name + "." + std::to_string(i), value[i], role);
    } else {
      add(name, value, role);
    }
  });
  if (members.back().role == Role::inherited) return {{"", 0, at, Role::position}};
  return members;
}

/// What a shape consists of. Positions come first among its members. A shape may have one list of counted members.
///
/// The *core* of a bounded shape is the convex hull of its positions (of a box: of its eight corners, which its half
/// extents and its rotation give); a radius grows it. `edges` and `faces` join positions by their index.
struct ShapeTraits {
  using Edge = std::array<std::uint8_t, 2>;
  using Face = std::array<std::uint8_t, 3>;  ///< a triangle

  Shape shape;
  std::string_view name;             ///< in files and in names of queries: "aabox"
  std::string_view words;            ///< for people: "axis-aligned box"
  std::vector<ShapeMember> members;  ///< a list has the fewest entries: an operand has its own (operands.hpp)
  std::span<const Edge> edges;       ///< of a segment, a capsule's axis, a triangle and a rectangle
  std::span<const Face> faces;

  std::size_t numbers() const { return members.back().begin + members.back().count; }
};

std::span<const ShapeTraits> all_shapes();
inline const ShapeTraits& traits_of(Shape shape) { return all_shapes()[std::size_t(shape)]; }
inline std::string_view name_of(Shape shape) { return traits_of(shape).name; }
/// Empty where no shape has that name.
std::optional<Shape> find_shape(std::string_view name);

}  // namespace nearmiss
