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

}  // namespace

std::span<const ShapeTraits> all_shapes() {
  static const std::vector<ShapeTraits> shapes = {
#define NEARMISS_SHAPE(name, type, words, edges, faces) \
  {Shape::name, #name, words, members_of(collide::type<double>{}), edges, faces},
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
