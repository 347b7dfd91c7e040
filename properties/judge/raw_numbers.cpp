#include "properties/judge/raw_numbers.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "corpus/generator/case_builder.hpp"
#include "corpus/generator/generator.hpp"

namespace nearmiss {

namespace {

double any_number(Scalar scalar, std::uint64_t bits, std::span<const double> others) {
  if (bits % 8 == 0) return bits % 16 == 0 ? 0.0 : -0.0;
  if (bits % 8 == 1 && !others.empty()) return others[(bits >> 8) % others.size()];
  if (scalar == Scalar::float32) {
    const float x = std::bit_cast<float>(std::uint32_t(bits >> 32));
    return std::isfinite(x) ? x : 1.0f;
  }
  const double x = std::bit_cast<double>(bits);
  return std::isfinite(x) ? x : 1.0;
}

/// The group that shares a power of two: the numbers of "box.half", those of "sphere.radius".
std::string_view vector_of(std::string_view field) { return field.substr(0, field.find_last_of('.')); }

}  // namespace

Case raw_case(const Query& query, Scalar scalar, std::uint64_t seed) {
  Case c{&query, scalar, {}, "raw numbers", seed, 0, {}};
  Random random(seed);
  do {
    c.values.clear();
    for (const Field& f : query.inputs) {
      double x = any_number(scalar, random.bits(), c.values);
      if (f.role == Role::size || f.role == Role::time) x = std::abs(x);
      if (f.role == Role::flag) x = double(random.bits() % 2);
      if (f.role == Role::index) x = double(random.bits() % 16) - 1;
      c.values.push_back(x);
    }
  } while (query.broken(c.values));
  return c;
}

Case far_scaled_case(const Query& query, Scalar scalar, std::uint64_t seed, std::uint64_t index) {
  Case c = generate(query, scalar, seed, index);
  c.origin = "far-scaled numbers";
  Random random(Random(seed).bits() ^ index);
  const int reach = scalar == Scalar::float32 ? 120 : 1000;
  const std::vector<double> before = c.values;
  for (std::size_t i = 0; i < c.values.size();) {
    const Role role = c.role(i);
    std::size_t end = i;
    while (end < c.values.size() && c.role(end) == role && vector_of(c.name(end)) == vector_of(c.name(i))) {
      ++end;
    }
    const int exponents[] = {0, reach, -reach, -reach - 60, random.between(-reach, reach)};
    const int exponent = exponents[random.below(std::size(exponents))];
    for (; i < end; ++i) {
      if (role == Role::flag || role == Role::index) continue;
      const double x = rounded_to(scalar, std::ldexp(c.values[i], exponent));
      if (std::isfinite(x)) c.values[i] = x;
    }
  }
  if (query.broken(c.values)) c.values = before;
  return c;
}

}  // namespace nearmiss
