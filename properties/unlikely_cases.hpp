/// Cases that random numbers seldom are, for tests of bounds.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "corpus/generator/case_builder.hpp"
#include "corpus/generator/generator.hpp"
#include "oracles/requirements.hpp"
#include "properties/judge/raw_numbers.hpp"
#include "properties/support.hpp"

namespace nearmiss {

/// A raw case with a half or three quarters of its numbers 0, where that keeps the query's rules: what is left may be
/// tiny alone.
inline Case raw_case_with_zeros(const Query& query, Scalar scalar, std::uint64_t seed) {
  Case c = raw_case(query, scalar, seed);
  const std::vector<double> before = c.values;
  Random random(seed);
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    const bool stays = random.one_in(2) && (seed % 2 == 0 || random.one_in(2));
    if (!stays && query.inputs[i].role != Role::index) c.values[i] = 0;
  }
  if (query.broken(c.values)) c.values = before;
  return c;
}

/// A generated case whose positions all come close to one plane or line of coordinates: triangles become thin, and
/// places near the origin.
inline Case flattened_case(const Query& query, Scalar scalar, std::uint64_t index) {
  Case c = generate(query, scalar, stream(24), index);
  Random random(index);
  const std::array<int, 3> orders{0, -random.between(0, 60), random.one_in(2) ? 0 : -random.between(0, 60)};
  const std::size_t first = random.below(3);
  const std::vector<double> before = c.values;
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    if (query.inputs[i].role != Role::position) continue;
    const auto axis = std::size_t(query.inputs[i].name.back() - 'x');
    c.values[i] = rounded_to(scalar, std::ldexp(c.values[i], orders[(axis + first) % 3]));
  }
  if (query.broken(c.values)) c.values = before;
  return c;
}

/// The case half way between two of one scalar; a whole number, which may be an index, is that of `a`.
inline Case half_way(const Case& a, const Case& b) {
  Case middle = a;
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    if (a.values[i] == std::trunc(a.values[i])) continue;
    const double x = a.values[i] / 2 + b.values[i] / 2;
    middle.values[i] = a.scalar == Scalar::float32 ? double(float(x)) : x;
  }
  return middle;
}

/// Calls `check` for cases half way from a yes to a no again and again, from `pairs` pairs of plain scenes of the
/// stream. A bound that is too small by a few digits shows only where just as many digits cancel: here every number of
/// digits does. Ends early where `check` returns false.
template <class Check>
void check_as_the_decision_changes(const Query& query, Scalar scalar, std::uint64_t stream, int pairs,
                                   const Check& check) {
  const int digits = scalar == Scalar::float32 ? 24 : 53;
  std::optional<Case> yes, no;
  for (std::uint64_t i = 0; pairs > 0; ++i) {
    const Case c = generate(query, scalar, stream, i);
    if (!c.moves.empty()) continue;
    (truth_is_yes(c) ? yes : no) = c;
    if (!yes || !no) continue;
    for (int k = 0; k < digits; ++k) {
      const Case middle = half_way(*yes, *no);
      if (!check(middle)) return;
      (truth_is_yes(middle) ? yes : no) = middle;
    }
    yes.reset(), no.reset(), --pairs;
  }
}

}  // namespace nearmiss
