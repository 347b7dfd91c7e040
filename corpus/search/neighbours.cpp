#include "corpus/search/neighbours.hpp"

#include <algorithm>
#include <cmath>

#include "corpus/generator/case_builder.hpp"
#include "corpus/search/float_order.hpp"

namespace nearmiss {

namespace {

int digits_of(Scalar s) { return s == Scalar::float32 ? 24 : 53; }

bool may_move(Role role) { return !is_discrete(role); }

bool is_valid(const Case& c) {
  return std::all_of(c.values.begin(), c.values.end(), [](double x) { return std::isfinite(x); }) &&
         !c.query->broken(c.values);
}

/// x with `bits` low bits cleared to the nearest such number, or mirrored about it.
double without_low_bits(double x, int bits, bool mirrored, Scalar scalar) {
  const double grid = std::ldexp(ulp(x, scalar), bits);
  const double cleared = std::nearbyint(x / grid) * grid;
  return rounded_to(scalar, mirrored ? cleared + (cleared - x) : cleared);
}

/// Another number of the role of number `i`, or its own value.
double number_of_same_role(const Case& c, std::size_t i, Random& random) {
  const std::size_t first = random.below(c.values.size());
  for (std::size_t k = 0; k < c.values.size(); ++k) {
    const std::size_t other = (first + k) % c.values.size();
    if (other != i && c.role(other) == c.role(i)) return c.values[other];
  }
  return c.values[i];
}

double changed(const Case& c, std::size_t i, Random& random) {
  constexpr std::size_t kinds = 10;  // six in ten are steps of ulps
  constexpr int largest_exponent_step = 3;
  const double x = c.values[i];
  switch (random.below(kinds)) {
    case 0: return rounded_to(c.scalar, std::ldexp(x, random.between(1, largest_exponent_step) * int(random.sign())));
    case 1: return random.one_in(2) ? -x : number_of_same_role(c, i, random);
    case 2: return without_low_bits(x, random.between(1, digits_of(c.scalar) - 1), true, c.scalar);
    case 3: return without_low_bits(x, random.between(1, digits_of(c.scalar) - 1), false, c.scalar);
    default: {
      const std::int64_t ulps = std::int64_t{1} << random.below(std::size_t(digits_of(c.scalar)));
      return moved_by_ulps(x, random.one_in(2) ? ulps : -ulps, c.scalar);
    }
  }
}

/// The index of a number that may move; the inputs of every query have one.
std::size_t number_that_may_move(const Case& c, Random& random) {
  std::size_t i = random.below(c.values.size());
  while (!may_move(c.role(i))) i = (i + 1) % c.values.size();
  return i;
}

}  // namespace

Case neighbour(const Case& of, int changes, std::uint64_t seed) {
  constexpr int attempts = 8;
  Random random(seed);
  Case c = of;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    for (int k = 0; k < changes; ++k) {
      const std::size_t i = number_that_may_move(c, random);
      c.values[i] = changed(c, i, random);
    }
    if (c.values != of.values && is_valid(c)) return c;
    c.values = of.values;
  }
  return c;
}

std::optional<Case> beyond(std::span<const double> before, const Case& here, double factor) {
  Case c = here;
  if (before.size() != here.values.size()) return std::nullopt;  // other counts of a list
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    if (!may_move(c.role(i))) continue;
    c.values[i] = rounded_to(c.scalar, here.values[i] + factor * (here.values[i] - before[i]));
  }
  return c.values != here.values && is_valid(c) ? std::optional(std::move(c)) : std::nullopt;
}

}  // namespace nearmiss
