/// The certified tier, where nothing is scene-like: numbers of any bits, of any magnitude.
#include <collide/certified.hpp>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "corpus/generator.hpp"
#include "nearmiss/catalogue_inputs.hpp"
#include "oracles/judge.hpp"
#include "properties/support.hpp"

namespace nearmiss {
namespace {

/// Any finite number, each exponent as likely as any other; one in eight is zero, one in eight repeats another.
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

/// A case of raw numbers that keeps the query's rules.
Case raw_case(const Query& query, Scalar scalar, std::uint64_t seed) {
  Case c{&query, scalar, {}, "raw numbers", seed, 0, {}};
  std::uint64_t state = seed;
  const auto bits = [&] {
    std::uint64_t z = state += 0x9e3779b97f4a7c15;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
  };
  do {
    c.values.clear();
    for (const Field& f : query.inputs) {
      double x = any_number(scalar, bits(), c.values);
      if (f.role == Role::size || f.role == Role::time) x = std::abs(x);
      if (f.role == Role::flag) x = double(bits() % 2);
      if (f.role == Role::index) x = double(bits() % 16) - 1;
      c.values.push_back(x);
    }
  } while (query.broken(c.values));
  return c;
}

class CertifiedTier : public testing::TestWithParam<Pairing> {};

TEST_P(CertifiedTier, IsRightAboutRawNumbersOfAnyMagnitude) {
  const auto [query, subject] = GetParam();
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const Case c = raw_case(*query, subject->scalar, i);
    ASSERT_FALSE(is_violation(examined(c, *subject))) << told(c, *subject);
  }
}

INSTANTIATE_TEST_SUITE_P(Certified, CertifiedTier, testing::ValuesIn([] {
                           std::vector<Pairing> certified;
                           for (const Pairing& p : our_pairings()) {
                             if (p.subject->name.starts_with("collide-certified")) certified.push_back(p);
                           }
                           return certified;
                         }()),
                         testing::PrintToStringParamName());

}  // namespace
}  // namespace nearmiss
