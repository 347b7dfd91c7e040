/// Vertex-face queries of the NYU continuous-collision benchmark, as cases with a known truth.
///
/// Source: Wang, Ferguson, Schneider, Jiang, Attene, Panozzo, A Large-scale Benchmark and an
/// Inclusion-based Algorithm for Continuous Collision Detection, ACM Transactions on Graphics, 2021.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "corpus/files/errors.hpp"
#include "impl/catalogue/case.hpp"

namespace nearmiss {

/// One query of the benchmark that maps to a point moving past a fixed triangle over the closed time interval [0, 1].
/// The benchmark's truth is two-sided: if the point comes from behind, the triangle is reversed.
struct GroundTruth {
  Case question;          ///< moving_point_triangle, in double
  bool collides;          ///< the benchmark's truth
  bool parallel = false;  ///< exactly parallel to the face, so that the one-sided query has no hit by definition
  std::string where;      ///< file and first row
};

struct GroundTruths {
  std::vector<GroundTruth> fit;
  std::size_t queries = 0;  ///< in the files
  std::size_t skipped = 0;  ///< corners that move differently, or numbers that are no doubles
};

/// Reads files with 8 rows per query: x, y, z as pairs of numerator and denominator, then the truth; the vertex and
/// three face corners at time 0, then at time 1. Throws BadInput that names file and row.
GroundTruths read_nyu_ccd(const std::vector<std::filesystem::path>& files);

/// A few queries of our own in the same format (corpus/nyu-ccd/sample.csv), each with the truth that its construction
/// implies.
std::string nyu_ccd_sample();

}  // namespace nearmiss
