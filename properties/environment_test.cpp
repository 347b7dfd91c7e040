/// The floating-point environment: checked at the start, and without effect on the oracle, whatever the caller's modes
/// are.
#include <gtest/gtest.h>

#include <algorithm>
#include <cfenv>
#include <chrono>
#include <cmath>
#include <thread>

#include "corpus/generator/generator.hpp"
#include "impl/host/worker.hpp"
#include "impl/subject/floating_point.hpp"
#include "impl/subject/subject.hpp"
#include "oracles/environment.hpp"
#include "oracles/exact/oracle.hpp"
#include "oracles/judge.hpp"

namespace nearmiss {
namespace {

/// Floating-point modes that foreign code may have set in the calling thread.
struct Modes {
  const char* name;
  void (*set)();
};

class AnyModes : public testing::TestWithParam<Modes> {
 protected:
  ~AnyModes() override { FloatingPointModes::standard().set(); }
  /// Runs it in the modes of the parameter and checks that the modes are unchanged afterwards.
  template <class Work>
  static auto within_modes(Work work) {
    GetParam().set();
    const FloatingPointModes before = FloatingPointModes::current();
    auto result = work();
    const FloatingPointModes after = FloatingPointModes::current();
    FloatingPointModes::standard().set();
    EXPECT_TRUE(before == after);
    return result;
  }
};

TEST_P(AnyModes, TheSelfCheckPasses) {
  const auto broken = within_modes([] { return broken_environment(); });
  EXPECT_FALSE(broken) << *broken;
}

TEST_P(AnyModes, TheJudgeSaysTheSame) {
  // A third of the way: t = 1/3, x = 1/3, neither of which is a double.
  const Case c{find_query("closest_point_segment"), Scalar::float64, {0, 0, 0, 3, 0, 0, 1.0 / 3, 5, 5}, "", 0, 0, {}};
  Answer right, wrong;
  right.yes = wrong.yes = true;
  right.values = {1.0 / 3};
  wrong.values = {1.0 / 3 + 0x1p-52};
  const collide::Contract contract{.forward = 2};
  const auto judged = [&](const Answer& a) {
    return within_modes([&] { return judge(c, a, contract, Detail::full); });
  };
  EXPECT_EQ(judged(right).verdict, Verdict::agrees);
  EXPECT_EQ(judged(wrong).verdict, Verdict::violates_contract);
}

/// A thread inherits the modes of the thread that starts it.
TEST_P(AnyModes, AThreadOfTheirsIsToldTheSame) {
  const Case c{
      find_query("sphere_sphere_overlap"), Scalar::float64, {0, 0, 0, 0x1p-1074, 0x1p-1073, 0, 0, 0}, "", 0, 0, {}};
  Truth t;
  within_modes([&] { return std::thread([&] { t = truth_of(c); }).join(), 0; });
  EXPECT_FALSE(t.yes);  // the distance of the centers is twice the sum of the radii
}

bool same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }
bool same(const Bounds& a, const Bounds& b) { return (a.empty() && b.empty()) || (a.low == b.low && a.high == b.high); }

bool same(const Enclosure& a, const Enclosure& b) {
  const auto same_errors = [](const Bounds& x, const Bounds& y) { return same(x, y); };
  const auto same_members = [](const Enclosure::Member& x, const Enclosure::Member& y) {
    return x.may_match == y.may_match && same(x.ulps, y.ulps) && same(x.absolute, y.absolute) && x.number == y.number;
  };
  return a.may_be_yes == b.may_be_yes && a.may_be_no == b.may_be_no && a.may_match == b.may_match &&
         same(a.ulps, b.ulps) && same(a.absolute, b.absolute) && a.worst == b.worst &&
         std::equal(a.error.begin(), a.error.end(), b.error.begin(), same_errors) &&
         std::equal(a.members.begin(), a.members.end(), b.members.begin(), same_members);
}
bool same(const Finding& f, const Finding& g) {
  return f.verdict == g.verdict && f.disagreement == g.disagreement && f.truth_yes == g.truth_yes &&
         f.decided_by == g.decided_by && f.clause == g.clause && f.worst == g.worst &&
         same(f.forward_ulps, g.forward_ulps) && same(f.forward_absolute, g.forward_absolute) &&
         same(f.unit_error, g.unit_error) && f.backward.has_value() == g.backward.has_value() &&
         (!f.backward || f.backward->above == g.backward->above);
}
bool same(const Truth& t, const Truth& u) {
  return t.yes == u.yes && t.margin_at_least == u.margin_at_least &&
         std::equal(t.alternatives.begin(), t.alternatives.end(), u.alternatives.begin(), u.alternatives.end(),
                    [](const Alternative& a, const Alternative& b) {
                      return std::equal(a.values.begin(), a.values.end(), b.values.begin(),
                                        [](const Bounds& x, const Bounds& y) { return same(x, y); });
                    });
}

/// Everything that the oracle and the judge return for an answer.
struct Said {
  Finding finding;
  Truth truth;
  Enclosure interval, exact;
  std::vector<double> widening;
  bool on_surface = false;
};
Said said(const Case& c, const Answer& answer, const collide::Contract& contract) {
  const Oracle& oracle = oracle_of(*c.query);
  Said s{judge(c, answer, contract, Detail::full),  truth_of(c), {}, {},
         widening(*c.query, c.values, c.scalar, 4), false};
  s.interval = oracle.interval(c.values, s.widening, answer, c.scalar);
  s.exact = oracle.exact(c.values, answer, c.scalar, nullptr);
  if (oracle.may_be_on_surface != nullptr) {
    const auto& outputs = c.query->outputs;
    const auto place =
        std::find_if(outputs.begin(), outputs.end(), [](const Field& f) { return f.role == Role::position; });
    s.on_surface =
        oracle.may_be_on_surface(c.values, s.widening, answer, std::size_t(place - outputs.begin()), 1, c.scalar);
  }
  return s;
}
bool same(const Said& a, const Said& b) {
  return same(a.finding, b.finding) && same(a.truth, b.truth) && same(a.interval, b.interval) &&
         same(a.exact, b.exact) && a.widening == b.widening && a.on_surface == b.on_surface;
}

/// The same shapes scaled to the least positive numbers; empty if that breaks a rule.
std::optional<Case> of_subnormals(Case c) {
  double largest = 0;
  for (const double x : c.values) largest = std::max(largest, std::abs(x));
  const int least = c.scalar == Scalar::float32 ? -149 : -1074, bits = 8;
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    const Role role = c.role(i);
    if (role == Role::flag || role == Role::index) continue;
    c.values[i] = std::ldexp(std::nearbyint(std::ldexp(c.values[i], bits - std::ilogb(largest))), least);
  }
  if (c.query->broken(c.values)) return std::nullopt;
  return c;
}

/// For each query, every entry of the oracle and the judge: the caller's modes change no bit of the result.
TEST_P(AnyModes, EveryQueryIsJudgedTheSame) {
  constexpr std::uint64_t cases = 40;
  int by_exact = 0, wrong = 0, subnormal = 0;
  for (const Query& query : catalogue()) {
    for (std::uint64_t i = 0; i < cases; ++i) {
      Case c = generate(query, i % 2 ? Scalar::float32 : Scalar::float64, 14, i);
      const std::optional<Case> least = i % 8 < 4 ? std::nullopt : of_subnormals(c);
      if (least) c = *least, ++subnormal;
      const Subject& fast = *find_subject(i % 2 ? "collide-fast-float" : "collide-fast-double");
      const Offering& offering = fast.offering(query.name);
      Answer answer = offering.answer(c.values);
      if (i % 4 > 1) answer.yes = !answer.yes;
      const collide::Contract contract{.backward = 4, .forward = 4, .unit = 4};
      const Said before = said(c, answer, contract);
      const Said after = within_modes([&] { return said(c, answer, contract); });
      ASSERT_TRUE(same(before, after)) << query.name << ", case " << i;
      by_exact += before.finding.decided_by == Stage::exact;
      wrong += before.finding.backward.has_value();
    }
  }
  EXPECT_GT(by_exact, 0);
  EXPECT_GT(wrong, 100);
  EXPECT_GT(subnormal, 500);
}

/// A host process starts in the standard modes, and the process that asks measures its waiting time in them.
TEST_P(AnyModes, AWorkerHasTheStandardOnes) {
  Worker worker;
  const AnswerFunction tells_its_modes = [](std::span<const double>) {
    std::this_thread::sleep_for(std::chrono::milliseconds(150));  // long enough for a check of the time limit
    Answer a;
    a.yes = FloatingPointModes::current() == FloatingPointModes::standard();
    return a;
  };
  const Offering offering{"", Offer::answers, "", {}, tells_its_modes};
  EXPECT_TRUE(within_modes([&] { return worker.ask(offering, std::vector<double>{0}, 1).front().yes; }));
}

constexpr Modes all_modes[] = {
    {"standard", [] {}},
    {"upward", [] { std::fesetround(FE_UPWARD); }},
    {"downward", [] { std::fesetround(FE_DOWNWARD); }},
    {"toward_zero", [] { std::fesetround(FE_TOWARDZERO); }},
#if defined(__SSE2__)
    {"flush_to_zero", [] { _mm_setcsr(_mm_getcsr() | 0x8000u); }},
    {"denormals_are_zero", [] { _mm_setcsr(_mm_getcsr() | 0x0040u); }},
    {"all_that_fast_math_sets_and_upward", [] { std::fesetround(FE_UPWARD), _mm_setcsr(_mm_getcsr() | 0x8040u); }},
    {"long_double_as_float",
     [] {
       const unsigned short word = 0x007f;
       asm volatile("fldcw %0" : : "m"(word));
     }},
#endif
#if defined(__GLIBC__)
    {"traps", [] { feenableexcept(FE_ALL_EXCEPT); }},
#if defined(__SSE2__)
    {"a_trap_pending",
     [] {
       const volatile long double three = 3;
       [[maybe_unused]] const volatile long double third = 1 / three;
       feenableexcept(FE_ALL_EXCEPT);
     }},
#endif
#endif
};

INSTANTIATE_TEST_SUITE_P(Every, AnyModes, testing::ValuesIn(all_modes),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace nearmiss
