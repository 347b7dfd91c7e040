/// The oracle's two stages and the ladder of widenings, on which every proof of the judge rests.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "corpus/generator/generator.hpp"
#include "corpus/storage/codec.hpp"
#include "oracles/exact/oracle.hpp"
#include "oracles/judge.hpp"
#include "properties/support.hpp"

namespace nearmiss {
namespace {

class Oracles : public testing::TestWithParam<NamedQuery> {};

/// The answer of `collide`, the same slightly changed, and the opposite decision.
std::vector<Answer> answers_about(const Case& c) {
  std::vector<Answer> all(1);
  for (const Pairing& p : our_pairings()) {
    if (p.query == c.query && p.subject->scalar == c.scalar) {
      all.push_back(p.subject->offering(c.query->name).answer(c.values));
    }
  }
  Answer right = all.back();
  for (double& x : right.values) x = std::isfinite(x) ? x : 1.0;  // a miss has no time that can be wrong
  Answer off = right, opposite = right;
  for (double& x : off.values) x *= 1 + 0x1p-12;
  opposite.yes = !opposite.yes;
  all.push_back(off);
  all.push_back(opposite);
  return all;
}

Enclosure at_rung(const Case& c, const Answer& about, int k) {
  return oracle_of(*c.query).interval(c.values, widening(*c.query, c.values, c.scalar, rung(k)), about, c.scalar);
}

/// Both enclose the same number, so they intersect.
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

/// The enclosure contains the answers of every input within the widening, including the given input. So if a rung
/// excludes an answer, the exact stage must exclude the answer too.
TEST_P(Oracles, ExcludeOnNoRungWhatTheExactStageFinds) {
  const Query& query = *GetParam().query;
  const auto contradicted = [&](std::uint64_t stream) -> std::string {
    for (Scalar scalar : scalars) {
      const Case c = generate(query, scalar, stream, 0);
      for (const Answer& about : answers_about(c)) {
        const Enclosure exact = oracle_of(query).exact(c.values, about, scalar, nullptr);
        for (int k = 0; k < rungs; ++k) {
          const std::string what = contradiction(query, at_rung(c, about, k), exact);
          if (!what.empty()) return fmt::format("rung {}: {}\n{}", k, what, case_to_json(c).dump(2));
        }
      }
    }
    return {};
  };
  EXPECT_TRUE(holds_for_streams("the exact stage decides within what every rung leaves open", contradicted));
}

/// True if the next rung excludes something that this rung allows.
bool excludes_more(const Enclosure& now, const Enclosure& next) {
  return now.may_be_yes > next.may_be_yes || now.may_be_no > next.may_be_no || now.may_match > next.may_match;
}

/// Each rung is a proof of its own, so the judge is right even if a wider input happens to have the tighter enclosure.
/// Its search finds the highest rung only if that is rare. Where the share of the first cases is near the bound, the
/// share of five times as many decides.
TEST_P(Oracles, ExcludeMoreOnAHigherRungInFewerThanOneOfAHundredCases) {
  const Query& query = *GetParam().query;
  const auto least = std::min(200, 2 * cases_per_family());
  const auto first_cases = std::uint64_t(std::max(least, 8 * cases_per_family() / 5 / cost_of(query))),
             most_cases = 5 * first_cases;
  std::uint64_t strange = 0, cases = 0;
  while (cases < first_cases || (cases < most_cases && 100 * strange >= first_cases)) {
    const Case c = generate(query, scalars[cases % 2], 1, cases);
    bool more = false;
    for (const Answer& about : answers_about(c)) {
      for (int k = 0; k + 1 < rungs; ++k) more = more || excludes_more(at_rung(c, about, k), at_rung(c, about, k + 1));
    }
    strange += more;
    ++cases;
  }
  EXPECT_LT(100 * strange, cases);
}

/// What a table counts of a finding, in words. Bounds are left out.
std::string counted(const Finding& f) {
  std::string text = fmt::format("{}, {}, the truth is {}", name_of(f.verdict), name_of(f.disagreement), f.truth_yes);
  for (const MemberFinding& m : f.members) {
    if (m.breaks()) text += fmt::format("; {} of {} breaks {}", name_of(m.disagreement), m.member, int(m.broken));
  }
  const MemberFinding* head = f.headline_member();
  return text + fmt::format("; headline {}", head == nullptr ? "none" : fmt::format("{}", head->member));
}

/// One bound of the backward error, of the forward error, and exact decisions: what contracts are made of.
std::vector<Standard> standards_of_each_kind() {
  return {{{.backward = 0x1p12}, false},
          {{.backward = 64, .unit = 8}},
          {{.forward = 16}},
          {{.backward = 1024, .forward = 4, .exact_decisions = true, .unit = 8}}};
}

struct SettledFindings {
  int proved = 0, settled = 0, other_bound = 0;
  std::string contradiction;

  void add(const Case& c, const Answer& answer, const Standard& standard) {
    const Finding first = judge(c, answer, standard, Detail::verdict);
    proved += first.is_proved();
    if (!first.is_proved() || !first.settled) return;
    ++settled;
    const Finding full = judge(c, answer, standard, Detail::full);
    if (counted(first) != counted(full) || full.forward_ulps > first.forward_at_most)
      contradiction = fmt::format("{} ({} ulps at most)\n{} ({} ulps)\n{}", counted(first), first.forward_at_most,
                                  counted(full), full.forward_ulps, case_to_json(c).dump());
    const auto above = [](const Finding& f) { return f.backward ? f.backward->above : 0; };
    other_bound += above(first) != above(full);
  }
};

/// A run counts a settled finding without a second judgement. That one would be counted alike, most findings of wrong
/// answers are settled, and bounds differ as rarely as a higher rung excludes more.
TEST_P(Oracles, SettleWhatIsCountedAtTheFirstLook) {
  const Query& query = *GetParam().query;
  SettledFindings found;
  for (std::uint64_t i = 0; i < 120 && found.contradiction.empty(); ++i) {
    const Case c = generate(query, scalars[i % 2], 2, i);
    for (const Answer& answer : answers_about(c)) {
      for (const Standard& s : standards_of_each_kind()) found.add(c, answer, s);
    }
  }
  EXPECT_EQ(found.contradiction, "");
  EXPECT_GT(found.settled, found.proved / 2);
  EXPECT_LE(found.other_bound, found.settled / 100);
}

INSTANTIATE_FOR_EVERY_QUERY(Every, Oracles, testing::ValuesIn(every_query()), testing::PrintToStringParamName());

/// A sliver, and a normal that a wide enclosure excludes and a narrow one does not. Where the search for the widest one
/// begins must not depend on the detail: the judgement in full confirms the first one.
TEST(Ladder, GivesTheSameBoundForEveryDetail) {
  const Case c{find_query("moving_sphere_triangle"),
               Scalar::float64,
               {2.673568372020115, -4.210780566366187, 0.970226339084638, 0.7359656483765311, -2594.9245215392007,
                -1895.623435166865, -7048.872840423524, 2.880987193299314, -4.178365306874187, 1.3983350347480976,
                2.3278703373937164, -4.264805998852852, 0.25671184632599875, 2.327870337406373, -4.264805999385797,
                0.2567118463943404},
               "test",
               0,
               0,
               {}};
  Answer a;
  a.yes = true;
  const double given[] = {0,
                          0x1.56377d09443f5p+1,
                          -0x1.0d7d6dc5cdda3p+2,
                          0x1.f0c181b72032cp-1,
                          -0x1.cd0467a6cf55fp-1,
                          0x1.1863474dda324p-5,
                          0x1.bc127da5e5d58p-2,
                          0x1.3fffffff0b484p-1,
                          0x1.80000001e96f9p-2,
                          0};
  std::copy(std::begin(given), std::end(given), a.values.begin());
  Standard promise;
  promise.contract = collide::Contract{.backward = 128, .unit = 4};
  promise.promised = true;
  const Finding first = judge(c, a, promise, Detail::verdict), full = judge(c, a, promise, Detail::full);
  EXPECT_EQ(first.verdict, Verdict::violates_contract);
  EXPECT_EQ(full.verdict, first.verdict);
  ASSERT_TRUE(first.backward && full.backward);
  EXPECT_EQ(full.backward->above, first.backward->above);
}

}  // namespace
}  // namespace nearmiss
