/// Scaling by powers of two, and quaternions times -1.
#include <algorithm>
#include <array>
#include <cmath>

#include "corpus/generator/case_builder.hpp"
#include "corpus/relations/follow_ups.hpp"
#include "corpus/relations/operands.hpp"

namespace nearmiss::metamorphic {

namespace {

/// The largest difference of two positions in one coordinate.
double apart(const double* a, const double* b) {
  return std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])});
}

/// Whether any two positions are equal or at least `least` apart.
bool places_are_apart(const Case& c, double least) {
  std::vector<const double*> places;
  for (const InputMember& m : c.operands().members) {
    if (m.role == Role::position) places.push_back(&c.values[m.begin]);
  }
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double d = apart(places[i], places[j]);
      if (d != 0 && d < least) return false;
    }
  }
  return true;
}

/// Range for every product of eight numbers of the case and of the distances of its positions: in float, positions
/// within 2^6 may be 2^-29 apart, and the product of eight such distances would underflow.
bool far_from_overflow_and_underflow(const Case& c) {
  const bool is_float = c.scalar == Scalar::float32;
  const int orders = is_float ? 6 : 80, orders_apart = is_float ? 13 : 110;
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    const double x = std::abs(c.values[i]);
    if (x != 0 && (x < std::ldexp(1.0, -orders) || x > std::ldexp(1.0, orders))) return false;
  }
  return places_are_apart(c, std::ldexp(1.0, -orders_apart));
}

int length_order(Role role) { return is_length(role) || role == Role::velocity ? 1 : 0; }

/// Multiplies each input and each output by 2^(orders of its role).
template <class Orders>
std::optional<FollowUps> scaled(const Case& c, Orders orders) {
  if (!far_from_overflow_and_underflow(c)) return std::nullopt;
  Case other = c;
  bool any = false;
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    const int k = orders(c.fields()[i]);
    other.values[i] = std::ldexp(c.values[i], k);
    any = any || (k != 0 && c.values[i] != 0);
  }
  if (!any || !far_from_overflow_and_underflow(other)) return std::nullopt;
  const Query& query = *c.query;
  return counterpart_if_valid(std::move(other), [&query, orders](Answer a) {
    for (std::size_t i = 0; i < query.outputs.size(); ++i) {
      const Role role = query.outputs[i].role;
      if (is_length(role) || role == Role::time) {
        a.values[i] = std::ldexp(a.values[i], orders(query.outputs[i]));
      }
    }
    return a;
  });
}

int draw_order(const Case& c, std::uint64_t seed) {
  Random random(seed);
  const int k = random.between(1, c.scalar == Scalar::float32 ? 3 : 40);
  return random.one_in(2) ? k : -k;
}

}  // namespace

std::optional<FollowUps> scaled_lengths(const Case& c, std::uint64_t seed) {
  const int k = draw_order(c, seed);
  return scaled(c, [k](const Field& f) { return f.role == Role::offset ? k : k * length_order(f.role); });
}

std::optional<FollowUps> scaled_time(const Case& c, std::uint64_t seed) {
  const int k = draw_order(c, seed);
  return scaled(c, [k](const Field& f) { return f.role == Role::velocity ? k : f.role == Role::time ? -k : 0; });
}

std::optional<FollowUps> scaled_directions(const Case& c, std::uint64_t seed) {
  const int k = draw_order(c, seed);
  return scaled(c, [k](const Field& f) { return f.role == Role::direction || f.role == Role::offset ? k : 0; });
}

std::optional<FollowUps> scaled_rotations(const Case& c, std::uint64_t seed) {
  const int k = draw_order(c, seed);
  return scaled(c, [k](const Field& f) { return f.role == Role::rotation ? k : 0; });
}

std::optional<FollowUps> negated_rotations(const Case& c, std::uint64_t) {
  if (c.operands().quaternions.empty()) return std::nullopt;
  Case other = c;
  for (const std::size_t i : c.operands().quaternions) {
    for (std::size_t k = i; k < i + 4; ++k) other.values[k] = -c.values[k];
  }
  return counterpart(std::move(other), [](const Answer& a) { return a; });
}

}  // namespace nearmiss::metamorphic
