/// NaN or infinity in the raw arguments of a query: the query returns and never reports a finite hit.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "corpus/generator/generator.hpp"
#include "properties/support.hpp"

namespace nearmiss {
namespace {

/// A hit, an overlap or a depth whose numbers are all finite.
bool looks_genuine(const Query& query, const Answer& answer) {
  if (!decides(query.kind) || !answer.yes) return false;
  for (std::size_t i = 0; i < query.outputs.size(); ++i) {
    if (answer.gives(i) && !std::isfinite(answer.values[i])) return false;
  }
  return true;
}

bool counts(Role role) { return role != Role::flag && role != Role::index; }

class EveryTierGiven : public testing::TestWithParam<Pairing> {};

void expect_no_genuine_hit(const Pairing& pairing, double bad) {
  const auto [query, subject] = pairing;
  const Offering& offering = subject->offering(query->name);
  for (std::uint64_t i = 0; i < 300; ++i) {
    const Case c = generate(*query, subject->scalar, 77, i);
    for (std::size_t at = 0; at < c.values.size(); ++at) {
      if (!counts(c.role(at))) continue;
      // A time limit may be infinite. It has no meaning for queries without a limit.
      if (c.name(at) == "limit" && bad == std::numeric_limits<double>::infinity()) continue;
      std::vector<double> values = c.values;
      values[at] = bad;
      for (std::size_t flag = 0; flag < values.size(); ++flag) {
        if (c.name(flag) == "forever") values[flag] = 0;
      }
      const Answer answer = offering.answer(values);
      ASSERT_FALSE(looks_genuine(*query, answer)) << c.name(at) << " = " << bad << " in case " << i << " of seed 77";
    }
  }
}

TEST_P(EveryTierGiven, NotANumberReportsNoHit) {
  expect_no_genuine_hit(GetParam(), std::numeric_limits<double>::quiet_NaN());
}

TEST_P(EveryTierGiven, InfinityReportsNoHit) {
  expect_no_genuine_hit(GetParam(), std::numeric_limits<double>::infinity());
  expect_no_genuine_hit(GetParam(), -std::numeric_limits<double>::infinity());
}

INSTANTIATE_FOR_EVERY_QUERY(Invalid, EveryTierGiven, testing::ValuesIn(our_pairings()),
                            testing::PrintToStringParamName());

}  // namespace
}  // namespace nearmiss
