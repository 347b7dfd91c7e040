/// The certified tier on cases unlike any scene: numbers with any bits, of any magnitude.
#include <gtest/gtest.h>
#include <collide/certified.hpp>

#include "nearmiss/catalogue_inputs.hpp"
#include "oracles/judge.hpp"
#include "properties/judge/raw_numbers.hpp"
#include "properties/support.hpp"

namespace nearmiss {
namespace {

class CertifiedTier : public testing::TestWithParam<Pairing> {};

TEST_P(CertifiedTier, IsRightAboutRawNumbersOfAnyMagnitude) {
  const auto [query, subject] = GetParam();
  for (std::uint64_t i = 0; i < std::uint64_t(2000 / cost_of(*query)); ++i) {
    const Case c = raw_case(*query, subject->scalar, i);
    ASSERT_FALSE(is_violation(examined(c, *subject))) << failure_text(c, *subject);
  }
}

INSTANTIATE_FOR_EVERY_QUERY(Certified, CertifiedTier, testing::ValuesIn(certified_pairings()),
                            testing::PrintToStringParamName());

}  // namespace
}  // namespace nearmiss
