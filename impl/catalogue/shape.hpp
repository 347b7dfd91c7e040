/// The shapes of a query's operands: the closed list shapes.def, each with what its numbers mean.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include <collide/members.hpp>

namespace nearmiss {

using collide::Role;

enum class Shape : std::uint8_t {
#define NEARMISS_SHAPE(name, type, words, edges, faces) name,
#include "impl/catalogue/shapes.def"
#undef NEARMISS_SHAPE
};

/// A vector, a number or a quaternion of a shape.
struct ShapeMember {
  std::string_view name;     ///< "center"; empty: the shape is this member
  std::size_t begin, count;  ///< its numbers, counted from the shape's first
  Role role;
};

/// What a shape consists of. Positions come first among its members.
///
/// The *core* of a bounded shape is the convex hull of its positions (of a box: of its eight corners, which its half
/// extents and its rotation give); a radius grows it. `edges` and `faces` join positions by their index.
struct ShapeTraits {
  using Edge = std::array<std::uint8_t, 2>;
  using Face = std::array<std::uint8_t, 3>;  ///< a triangle

  Shape shape;
  std::string_view name;             ///< in files and in names of queries: "aabox"
  std::string_view words;            ///< for people: "axis-aligned box"
  std::vector<ShapeMember> members;  ///< those of its struct in collide/shapes.hpp
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
