#include "impl/catalogue/shape.hpp"

#include <algorithm>

#include <collide/shapes.hpp>

namespace nearmiss {

namespace {

using Edge = ShapeTraits::Edge;
using Face = ShapeTraits::Face;

constexpr std::span<const Edge> no_edges;
constexpr std::span<const Face> no_faces;
constexpr Edge one_edge[] = {{0, 1}}, three_edges[] = {{0, 1}, {1, 2}, {2, 0}},
               four_edges[] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
constexpr Face one_face[] = {{0, 1, 2}}, two_faces[] = {{0, 1, 2}, {0, 2, 3}};

/// The members that the struct lists; a struct whose members have no role of their own is one position.
template <class S>
std::vector<ShapeMember> members_of() {
  std::vector<ShapeMember> members;
  S shape{};
  std::size_t at = 0;
  bool is_position = false;
  collide::for_each_member(shape, [&](const char* name, auto& value, Role role) {
    std::size_t count = 0;
    collide::for_each_leaf(value, [&](auto&, Role) { ++count; });
    members.push_back({name, at, count, role});
    at += count;
    is_position = role == Role::inherited;
  });
  if (is_position) return {{"", 0, at, Role::position}};
  return members;
}

}  // namespace

std::span<const ShapeTraits> all_shapes() {
  static const std::vector<ShapeTraits> shapes = {
#define NEARMISS_SHAPE(name, type, words, edges, faces) \
  {Shape::name, #name, words, members_of<collide::type<double>>(), edges, faces},
#include "impl/catalogue/shapes.def"
#undef NEARMISS_SHAPE
  };
  return shapes;
}

std::optional<Shape> find_shape(std::string_view name) {
  const auto found = std::ranges::find(all_shapes(), name, &ShapeTraits::name);
  return found == all_shapes().end() ? std::nullopt : std::optional(found->shape);
}

}  // namespace nearmiss
