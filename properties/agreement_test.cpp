/// Each tier of `collide` keeps its contract, as far as the oracle can prove.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "corpus/generator/generator.hpp"
#include "properties/support.hpp"

namespace nearmiss {
namespace {

constexpr std::uint64_t cases_per_stream = 500;  // of 200 streams: 100,000 cases for each query and tier

class EveryTier : public testing::TestWithParam<Pairing> {};

TEST_P(EveryTier, AnswersKeepTheirContract) {
  const auto [query, subject] = GetParam();
  const auto first_violation = [query = query, subject = subject](std::uint64_t stream) {
    return failure_of_agreement(*query, *subject, stream, cases_per_stream / std::uint64_t(cost_of(*query)));
  };
  EXPECT_TRUE(holds_for_streams("answers agree with the oracle within the contract", first_violation));
}

TEST_P(EveryTier, PromisesSomethingAboutMostCases) {
  const auto [query, subject] = GetParam();
  const int cases = std::max(200, 2000 / cost_of(*query));
  int covered = 0;
  for (int i = 0; i < cases; ++i) {
    covered +=
        examined(generate(*query, subject->scalar, 1, std::uint64_t(i)), *subject).verdict != Verdict::out_of_domain;
  }
  EXPECT_GE(covered, cases * 8 / 10) << "of " << cases << " cases within the contract's domain";
}

/// A value rounded to float must be a float at its destination, despite any optimization on the way.
TEST_P(EveryTier, AnswersInNumbersOfItsScalar) {
  const auto [query, subject] = GetParam();
  const Offering& offering = subject->offering(query->name);
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const Case c = generate(*query, subject->scalar, 1, i);
    const Answer answer = offering.answer(c.values);
    for (std::size_t k = 0; k < query->outputs.size(); ++k) {
      const double x = answer.values[k];
      ASSERT_TRUE(!std::isfinite(x) || representable(x, subject->scalar)) << query->outputs[k].name << ", case " << i;
    }
  }
}

INSTANTIATE_FOR_EVERY_QUERY(Agreement, EveryTier, testing::ValuesIn(our_pairings()), testing::PrintToStringParamName());

}  // namespace
}  // namespace nearmiss
