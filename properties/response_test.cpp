/// Directions after a contact have the right lengths: 1 for a bounce, at most 1 for a slide. No other input has another
/// length. So an answer that is exact for some input, to one unit in the last place of each number, has the right
/// length to the same precision. The oracle's enclosures are too wide to test that.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "corpus/generator/generator.hpp"
#include "properties/support.hpp"

namespace nearmiss {
namespace {

using Number = long double;

Number length(const Answer& a) {
  const Number x = a.values[0], y = a.values[1], z = a.values[2];
  return std::sqrt(x * x + y * y + z * z);
}

/// The change of a length if each component changes by one unit in the last place of the largest, plus the rounding of
/// the length itself.
Number slack(const Answer& a, Scalar scalar) {
  const double x = std::abs(a.values[0]), y = std::abs(a.values[1]), z = std::abs(a.values[2]);
  const Number change = ulp(std::max({x, y, z}), scalar), sum = Number(x) + y + z;
  return change * sum / length(a) + 2 * change * change + 8 * std::numeric_limits<Number>::epsilon();
}

/// What is wrong with the length of an answer; "" if it is right.
std::string fault(const Case& c, const Answer& a) {
  if (length(a) == 0) return "";
  const Number excess = length(a) - 1;
  const bool is_wrong =
      excess > slack(a, c.scalar) || (c.query->name == "bounce_direction" && -excess > slack(a, c.scalar));
  return is_wrong ? fmt::format("a length of 1 + {}", double(excess)) : "";
}

class Response : public testing::TestWithParam<Pairing> {};

TEST_P(Response, HasTheLengthOfADirection) {
  const auto [query, subject] = GetParam();
  const auto answer = [offering = &subject->offering(query->name)](const Case& c) {
    return offering->answer(c.values);
  };
  int moving = 0;
  for (std::uint64_t i = 0; i < 100000; ++i) {
    const Case c = generate(*query, subject->scalar, stream(21), i);
    if (has_extreme_mutator(c)) continue;
    moving += length(answer(c)) > 0;
    ASSERT_EQ(fault(c, answer(c)), "") << failure_text(c, *subject,
                                                       [&](const Case& other) { return fault(other, answer(other)); });
  }
  EXPECT_GT(moving, 10000);
}

INSTANTIATE_TEST_SUITE_P(Every, Response, testing::ValuesIn([] {
                           std::vector<Pairing> responses = our_pairings();
                           std::erase_if(responses,
                                         [](const Pairing& p) { return !p.query->name.ends_with("_direction"); });
                           return responses;
                         }()),
                         testing::PrintToStringParamName());

}  // namespace
}  // namespace nearmiss
