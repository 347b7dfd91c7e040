/// The mutators of feature_pairs.cpp bring features of any two shapes into the position that their names say.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "corpus/generator/features.hpp"
#include "corpus/generator/generator.hpp"
#include "properties/support.hpp"

namespace nearmiss {
namespace {

/// The features of a case's operands.
std::vector<Features> features_of(const Case& c) {
  const Plan plan(*c.query, c.values);
  Random none(0);
  std::vector<double> values = c.values;
  const CaseBuilder d(plan, c.scalar, none, values);
  std::vector<Features> all;
  for (const Operand& body : plan.bodies) all.push_back(features_of(d, body));
  return all;
}

constexpr double at_most = 1e-5;  // for float; the scenes have sizes near 1

/// A plane has one vertex.
bool is_plane(const Features& f) { return f.vertices.size() == 1 && !f.normals.empty(); }

/// The sine of the angle between two vectors; 1 where one is zero.
double sine(const Numbers& a, const Numbers& b) {
  const double lengths = norm(a) * norm(b);
  return lengths == 0 ? 1 : norm(cross(a, b)) / lengths;
}
/// The same between a vector and the plane with a normal.
double sine_to_plane(const Numbers& a, const Numbers& normal) {
  const double lengths = norm(a) * norm(normal);
  return lengths == 0 ? 1 : std::abs(dot(a, normal)) / lengths;
}

/// An edge is parallel to a plane if it is parallel to any edge that the plane could have. No two shapes are planes.
bool have_parallel_edges(const Features& a, const Features& b, double up_to) {
  if (is_plane(a)) return have_parallel_edges(b, a, up_to);
  const auto directions = [](const Features& f) {
    std::vector<Numbers> all;
    for (const auto& e : f.edges) {
      for (const auto& other : f.edges) all.push_back(&e == &other ? e.along : plus(e.along, other.along));
    }
    return all;
  };
  const std::vector<Numbers> of_b = directions(b);
  return std::ranges::any_of(directions(a), [&](const Numbers& first) {
    if (is_plane(b)) return sine_to_plane(first, b.normals[0]) <= up_to;
    return std::ranges::any_of(of_b, [&](const Numbers& second) { return sine(first, second) <= up_to; });
  });
}

/// Whether the vertices of b lie in a plane through an edge of a; for two solids, whether two of their faces share one.
bool are_coplanar(const Features& a, const Features& b) {
  std::vector<Numbers> normals = a.normals;
  for (const auto& e : a.edges) {
    for (const Numbers& v : b.vertices) normals.push_back(cross(e.along, plus(v, e.from, -1)));
  }
  return std::ranges::any_of(a.vertices, [&](const Numbers& place) {
    return std::ranges::any_of(normals, [&](const Numbers& n) {
      const auto in_plane = std::ranges::count_if(b.vertices, [&](const Numbers& v) {
        const Numbers way = plus(v, place, -1);
        return std::abs(dot(way, n)) <= at_most * norm(n) * (1 + norm(way));
      });
      return norm(n) > at_most && std::size_t(in_plane) >= std::min<std::size_t>(b.vertices.size(), 4);
    });
  });
}

/// The distance of two segments, by their sampled parameters and the projections of these; for classification.
double distance(const Features::Edge& a, const Features::Edge& b) {
  double least = HUGE_VAL;
  for (int i = 0; i <= 8; ++i) {
    const Numbers p = plus(a.from, a.along, 0.125 * i), way = plus(p, b.from, -1);
    const double length2 = dot(b.along, b.along);
    const double share = length2 == 0 ? 0 : std::clamp(dot(way, b.along) / length2, 0.0, 1.0);
    least = std::min(least, norm(plus(way, b.along, -share)));
  }
  return least;
}

std::vector<Features::Edge> edges_or_vertices(const Features& f) {
  std::vector<Features::Edge> all = f.edges;
  for (const Numbers& v : f.vertices) all.push_back({v, {}});
  return all;
}

bool have_crossing_edges(const Features& a, const Features& b) {
  for (const auto& first : edges_or_vertices(a)) {
    for (const auto& second : edges_or_vertices(b)) {
      if (distance(first, second) <= at_most || distance(second, first) <= at_most) return true;
    }
  }
  return false;
}

/// The largest gap between the cores along directions that separate features, less the radii.
bool touch(const Features& a, const Features& b) {
  std::vector<Numbers> directions{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const Features* f : {&a, &b}) directions.insert(directions.end(), f->normals.begin(), f->normals.end());
  for (const auto& e : a.edges) {
    for (const auto& other : b.edges) directions.push_back(cross(e.along, other.along));
  }
  for (const Numbers& v : a.vertices) {
    for (const Numbers& w : b.vertices) directions.push_back(plus(w, v, -1));
  }
  const auto furthest = [](const Features& f, const Numbers& n) {
    double most = -HUGE_VAL;
    for (const Numbers& v : f.vertices) most = std::max(most, dot(v, n));
    return most;
  };
  return std::ranges::any_of(directions, [&](const Numbers& any) {
    const Numbers n = unit_of(any), back = plus({}, n, -1);
    const double apart = a.radius + b.radius;
    const double gaps[] = {-furthest(b, back) - furthest(a, n) - apart, -furthest(a, back) - furthest(b, n) - apart};
    return norm(n) > 0 && std::min(std::abs(gaps[0]), std::abs(gaps[1])) <= 0.011 * std::max(apart, 1.0);
  });
}

struct Position {
  std::string_view mutator;
  bool (*holds)(const Features&, const Features&);
};
constexpr Position positions[] = {
    {"parallel-edges", [](const Features& a, const Features& b) { return have_parallel_edges(a, b, at_most); }},
    {"nearly-parallel-edges", [](const Features& a, const Features& b) { return have_parallel_edges(a, b, 0.1); }},
    {"coplanar-features",
     [](const Features& a, const Features& b) { return are_coplanar(a, b) || are_coplanar(b, a); }},
    {"crossing-edges", have_crossing_edges},
    {"touching-features", touch},
};

const Mutator& mutator_named(std::string_view name) { return *std::ranges::find(mutators(), name, &Mutator::name); }

/// A scene with the mutator alone, at the time of a motion's start. False where it does not apply.
bool make(Case& c, const Query& query, Scalar scalar, const Mutator& mutator, std::uint64_t seed) {
  Random random(seed);
  c.query = &query;
  c.scalar = scalar;
  c.values.assign(query.numbers_of({}), 0);
  const Plan plan(query);
  CaseBuilder d(plan, scalar, random, c.values);
  draw_scene(d);
  d.unit = 1;
  return mutator.apply(d);
}

/// Two operands at rest that are no axis-aligned boxes: of these the corners are the positions.
bool is_asked(const Query& q) {
  return q.operands.size() == 2 && q.lists.empty() && q.operands.velocities.empty() &&
         q.operands.find(Shape::aabox) == nullptr && q.operands.find(Shape::ray) == nullptr;
}

TEST(FeaturePairs, AreInTheirPosition) {
  constexpr int cases = 200;
  for (const Position& position : positions) {
    const Mutator& mutator = mutator_named(position.mutator);
    int queries = 0;
    for (const Query& q : catalogue()) {
      if (!is_asked(q)) continue;
      for (const Scalar scalar : scalars) {
        int made = 0, held = 0;
        for (std::uint64_t seed = 0; seed < cases; ++seed) {
          Case c;
          if (!make(c, q, scalar, mutator, seed)) continue;
          const std::vector<Features> f = features_of(c);
          ++made, held += position.holds(f[0], f[1]);
        }
        queries += made > 0;
        EXPECT_GE(held, made * 95 / 100) << position.mutator << " " << q.name << " in " << name_of(scalar);
      }
    }
    EXPECT_GE(queries, 10) << position.mutator;
  }
}

/// The same positions do not happen by chance: the test above would see a mutator that does nothing.
TEST(FeaturePairs, AreInNoPositionByChance) {
  constexpr int cases = 200;
  constexpr Mutator nothing{"nothing", "", [](CaseBuilder&) { return true; }};
  for (const Position& position : positions) {
    const Query& q = *find_query("capsule_box_overlap");
    int held = 0;
    for (std::uint64_t seed = 0; seed < cases; ++seed) {
      Case c;
      make(c, q, Scalar::float64, nothing, seed);
      const std::vector<Features> f = features_of(c);
      held += position.holds(f[0], f[1]);
    }
    EXPECT_LE(held, cases / 2) << position.mutator;
  }
}

}  // namespace
}  // namespace nearmiss
