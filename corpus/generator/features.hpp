/// The features of a shape: the vertices, edges and faces of its core, in space. For the generator's own sources.
#pragma once

#include <vector>

#include "corpus/generator/case_builder.hpp"

namespace nearmiss {

double dot(const Numbers& a, const Numbers& b);
Numbers cross(const Numbers& a, const Numbers& b);
double norm(const Numbers& a);
/// a / |a|; zero for zero.
Numbers unit_of(const Numbers& a);

/// The unit axes of a rotation of the case.
std::array<Numbers, 3> axes_of(const CaseBuilder& d, std::size_t rotation);

/// The core of a bounded shape, and its radius. A line and a ray have one vertex and an edge that begins there, a plane
/// has a vertex, two edges in it and its normal.
struct Features {
  struct Edge {
    Numbers from, along;
  };
  std::vector<Numbers> vertices;
  std::vector<Edge> edges;
  std::vector<Numbers> normals;  ///< of faces: of any length, either way
  double radius = 0;
};
Features features_of(const CaseBuilder& d, const Operand& operand);

/// A point of the core that is furthest along the direction, up to rounding: a vertex, or between two of them.
Numbers furthest_point(CaseBuilder& d, const Features& features, const Numbers& direction);

}  // namespace nearmiss
