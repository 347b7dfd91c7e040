/// The oracle's two stages and the ladder of widened inputs, on which every proof of the judge rests.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "corpus/codec.hpp"
#include "corpus/generator.hpp"
#include "properties/support.hpp"

namespace nearmiss {
namespace {

class Oracles : public testing::TestWithParam<NamedQuery> {};

/// The answer of `collide`, the same a little off, and the opposite decision.
std::vector<Answer> answers_about(const Case& c) {
  std::vector<Answer> all(1);
  for (const Pairing& p : our_pairings()) {
    if (p.query == c.query && p.subject->scalar == c.scalar) {
      all.push_back(p.subject->offering(c.query->name).answer(c.values));
    }
  }
  Answer right = all.back();
  for (double& x : right.values) x = std::isfinite(x) ? x : 1.0;  // a miss has no time to be wrong by
  Answer off = right, opposite = right;
  for (double& x : off.values) x *= 1 + 0x1p-12;
  opposite.yes = !opposite.yes;
  all.push_back(off);
  all.push_back(opposite);
  return all;
}

Enclosure at_rung(const Case& c, const Answer& about, int k) {
  return c.query->oracle.interval(c.values, widening(*c.query, c.values, c.scalar, rung(k)), about, c.scalar);
}

/// "" when `outer` excludes nothing that `inner` allows: what the judge's search of the ladder rests on.
std::string excluded(const Enclosure& inner, const Enclosure& outer) {
  if (inner.may_be_yes && !outer.may_be_yes) return "may_be_yes is lost";
  if (inner.may_be_no && !outer.may_be_no) return "may_be_no is lost";
  if (inner.may_match && !outer.may_match) return "may_match is lost";
  return {};
}

TEST_P(Oracles, ExcludeNoMoreWhenTheInputIsWidened) {
  const Query& query = *GetParam().query;
  const auto shrinking = [&](std::uint64_t stream) -> std::string {
    for (Scalar scalar : scalars) {
      const Case c = generate(query, scalar, stream, 0);
      for (const Answer& about : answers_about(c)) {
        Enclosure before = at_rung(c, about, 0);
        for (int k = 1; k < rungs; ++k) {
          const Enclosure now = at_rung(c, about, k);
          const std::string lost = excluded(before, now);
          if (!lost.empty()) return fmt::format("from rung {} to {}: {}\n{}", k - 1, k, lost, case_to_json(c).dump(2));
          before = now;
        }
      }
    }
    return {};
  };
  EXPECT_TRUE(holds_for_streams("a wider input excludes nothing that a narrower one allows", shrinking));
}

/// Both enclose the same number, so they share at least one.
bool share(const Bounds& a, const Bounds& b) { return a.low <= b.high && b.low <= a.high; }

std::string contradiction(const Query& query, const Enclosure& interval, const Enclosure& exact) {
  if (!exact.decided()) return "the exact stage has not decided";
  if (exact.may_be_yes ? !interval.may_be_yes : !interval.may_be_no) return "the decision lies outside";
  if (exact.may_match && !interval.may_match) return "the exact stage matches, the interval has excluded it";
  for (std::size_t i = 0; i < query.outputs.size(); ++i) {
    if (exact.error[i].empty()) continue;
    if (interval.error[i].empty() || !share(exact.error[i], interval.error[i])) {
      return fmt::format("error of {}: [{}, {}] exactly, [{}, {}] by intervals", query.outputs[i].name,
                         exact.error[i].low, exact.error[i].high, interval.error[i].low, interval.error[i].high);
    }
  }
  return {};
}

TEST_P(Oracles, DecideExactlyWhatTheIntervalLeavesOpen) {
  const Query& query = *GetParam().query;
  const auto contradicted = [&](std::uint64_t stream) -> std::string {
    for (Scalar scalar : scalars) {
      for (std::uint64_t i = 0; i < 4; ++i) {
        const Case c = generate(query, scalar, stream, i);
        for (const Answer& about : answers_about(c)) {
          const std::string what =
              contradiction(query, at_rung(c, about, 0), query.oracle.exact(c.values, about, scalar, nullptr));
          if (!what.empty()) return what + '\n' + case_to_json(c).dump(2);
        }
      }
    }
    return {};
  };
  EXPECT_TRUE(holds_for_streams("the exact stage decides within what the interval leaves open", contradicted));
}

INSTANTIATE_TEST_SUITE_P(Every, Oracles, testing::ValuesIn(every_query()), testing::PrintToStringParamName());

}  // namespace
}  // namespace nearmiss
