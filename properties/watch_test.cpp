/// Tests of the judge. For an answer that is right by construction, the judge may prove no error larger than the known
/// one. An answer that is wrong by construction must be detected. The right answers come from the derivations
/// (derivation.hpp), which share no code with the oracle: the exact answer to an input moved by at most k epsilon, any
/// one if several are right, rounded, and pushed by an ulp.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "corpus/generator/generator.hpp"
#include "corpus/storage/codec.hpp"
#include "oracles/motion_numbers.hpp"
#include "properties/derivation.hpp"
#include "properties/judge/families.hpp"
#include "properties/support.hpp"

namespace nearmiss {
namespace {

using derived::Choice;
using derived::Reference;
using Numbers = std::vector<double>;

/// How many answers. CI runs the default; a long night runs more.
int answers_about(const Query& query) {
  const char* value = std::getenv("NEARMISS_WATCH_ANSWERS");
  const int usual = value != nullptr ? std::stoi(value) : 50'000;
  constexpr int least = 400;
  return std::max(least, usual / cost_of(query));
}

double rounded_to(Scalar s, double x) { return s == Scalar::float32 ? double(float(x)) : x; }

/// An answer with the first numbers of the reference. Empty if a number is beyond the scalar's range, or if a time is
/// at the end of the range: a first time beyond the largest number is a miss, a later one is infinite, and the
/// truncated reference cannot tell the two apart.
std::optional<Answer> answer_of(const Query& query, Scalar scalar, const Reference& reference) {
  Answer a;
  a.yes = reference.yes;
  a.given = 0;
  for (std::size_t i = 0; i < reference.values.size(); ++i) {
    const bool is_late = query.outputs[i].role == Role::time && reference.values[i] >= largest_finite(scalar);
    if (is_late && reference.values[i] == largest_finite(scalar)) return std::nullopt;
    if (is_late && !is_time_of_leaving(query, i)) {
      Answer miss;
      miss.given = 0;
      return miss;
    }
    a.values[i] = is_late ? HUGE_VAL : rounded_to(scalar, reference.values[i]);
    if (!is_late && !std::isfinite(a.values[i])) return std::nullopt;
    a.given |= std::uint64_t{1} << i;
  }
  return a;
}

class Watch : public testing::TestWithParam<NamedQuery> {
 protected:
  const Query& query() const { return *GetParam().query; }
  int below(int n) { return int(random_() % std::uint64_t(n)); }
  double uniform() { return std::ldexp(double(random_() >> 11), -53) * 2 - 1; }

  /// Near misses of the generator, families of shapes and sizes, lattices, where ties and touches are common, and cases
  /// one ulp away from those.
  Case draw(std::uint64_t index) {
    const Scalar scalar = scalars[index / 4 % 2];
    switch (index % 4) {
      case 0: return generate(query(), scalar, seed_, index);
      case 1: return case_of(families[index / 8 % std::size(families)], query(), scalar, seed_, index);
      case 2: return derived::lattice_case(query(), scalar, 1 + below(3), random_);
      default: return moved(derived::lattice_case(query(), scalar, 1 + below(3), random_), 1 + below(2));
    }
  }
  /// One of the right answers to a case, by the derivation.
  Reference right_answer(const Case& c) {
    const bool moderate = std::all_of(c.values.begin(), c.values.end(), [](double x) {
      return x == 0 || (std::abs(x) > 0x1p-64 && std::abs(x) < 0x1p64);
    });
    derived::set_bits(moderate ? derived::usual_bits : derived::bits_for_any_magnitude);
    return derived::derivation_of(query())(derived::Reader(c.values, Choice(random_)));
  }
  /// A valid case within k epsilon of c, exact in its scalar; c itself if none is found.
  Case moved(const Case& c, double k) {
    Case near = c;
    const Numbers most = widening(query(), c.values, c.scalar, k);
    const int corner = below(3), of_three = below(3);
    for (std::size_t i = 0; i < most.size(); ++i) {
      if (most[i] == 0 || (of_three == 0 && below(3) > 0)) continue;
      const double by = corner == 0 ? (below(2) == 0 ? 1 : -1) : uniform();
      near.values[i] = rounded_to(c.scalar, c.values[i] + by * most[i]);
      if (query().inputs[i].role == Role::size) near.values[i] = std::abs(near.values[i]);
    }
    // The bound is measured at the moved input, whose groups have other largest numbers.
    for (int again = 0; again < 3; ++again) {
      const Numbers may = widening(query(), near.values, c.scalar, k);
      bool within = true;
      for (std::size_t i = 0; i < may.size(); ++i) {
        if (std::abs(near.values[i] - c.values[i]) <= may[i] * (1 - 0x1p-49)) continue;
        near.values[i] = c.values[i], within = false;
      }
      if (within && !query().broken(near.values)) return near;
    }
    return c;
  }
  /// A rung, usually a low one.
  double any_rung() { return rung(std::min(below(32), below(32))); }

  static std::string text(const Case& c, const Answer& a, const Finding& f) {
    std::string out = fmt::format("{}\nanswer {}", case_to_json(c).dump(), a.yes ? "yes" : "no");
    for (std::size_t i = 0; i < c.query->outputs.size(); ++i) {
      if (a.gives(i)) out += fmt::format(", {} = {}", c.query->outputs[i].name, a.values[i]);
    }
    out += fmt::format("\ntold: {}, {}, {} ulps", name_of(f.verdict), name_of(f.disagreement), f.forward_ulps);
    if (f.backward) out += fmt::format(", more than {} epsilon", f.backward->above);
    for (const MemberFinding& m : f.members) {
      out += fmt::format("\n  {} by {} ulps", name_of(m.disagreement), m.forward_ulps);
      if (m.backward) out += fmt::format(", more than {} epsilon", m.backward->above);
    }
    return out;
  }

  const std::uint64_t seed_ = stream(71);
  std::mt19937_64 random_{seed_};
};

/// A correctly rounded answer: the contract with exactly that bound is kept, and no larger error is proved.
std::string false_word(const Finding& f, double k) {
  if (f.is_proved()) return "breaks a promise that it keeps: " + f.clause;
  if (f.backward && f.backward->above >= k) return "is told to be further off than it is";
  for (const MemberFinding& m : f.members) {
    if (m.backward && m.backward->above >= k) return "has a member that is told to be further off than it is";
  }
  if (k == 0 && f.verdict != Verdict::agrees) return "is told to differ";
  return "";
}

TEST_P(Watch, NothingIsProvedAgainstWhatIsRight) {
  constexpr int answers_to_a_case = 8;
  const int wanted = answers_about(query());
  int asked = 0, by_k[rungs] = {}, yes = 0;
  for (std::uint64_t index = 0; asked < wanted; ++index) {
    ASSERT_LT(index, std::uint64_t(wanted)) << "hardly any case has an answer in range";
    const Case there = draw(index);
    const std::optional<Answer> exact = answer_of(query(), there.scalar, right_answer(there));
    if (!exact) continue;
    for (int i = 0; i < answers_to_a_case; ++i) {
      double k = i < 2 ? 0 : any_rung();
      const Case here = k == 0 ? there : moved(there, k);
      if (here.values == there.values) k = 0;
      const collide::Contract promise{
          .backward = k, .forward = k == 0 ? 1 : HUGE_VAL, .exact_decisions = k == 0, .unit = 8};
      const Finding f = judge(here, *exact, promise, i % 2 == 0 ? Detail::full : Detail::verdict);
      ASSERT_EQ(false_word(f, k), "") << "k = " << k << "\n"
                                      << text(here, *exact, f) << "\nright for " << case_to_json(there).dump();
      ++asked, ++by_k[k == 0 ? 0 : 1 + std::ilogb(k)], yes += exact->yes;
    }
  }
  constexpr int enough_for_every_rung = 2500;  // the first pass of a night asks fewer
  for (int k = 0; k < 16 && asked >= enough_for_every_rung; ++k)
    EXPECT_GT(by_k[k], asked / 500) << "hardly any answer at rung " << k;
  if (!decides(query().kind)) return;
  EXPECT_TRUE(yes > asked / 100 && yes < asked) << yes << " of " << asked;
}

/// This test can fail: for every query it detects a judge that reports 64 times the error.
TEST_P(Watch, SeesAJudgeThatTellsTooMuch) {
  constexpr double too_much = 64;
  constexpr int cases = 4000;
  int seen = 0;
  for (std::uint64_t index = 0; index < cases && seen == 0; ++index) {
    const Case there = draw(index);
    const std::optional<Answer> exact = answer_of(query(), there.scalar, right_answer(there));
    const double k = any_rung();
    if (!exact || k == 0) continue;
    const Finding f =
        judge(moved(there, too_much * k), *exact, collide::Contract{.backward = k, .unit = 8}, Detail::verdict);
    seen += !false_word(f, k).empty();
  }
  EXPECT_GT(seen, 0);
}

double next_to(double x, int way, Scalar s) {
  if (way == 0) return x;
  return s == Scalar::float32 ? double(std::nextafter(float(x), way * HUGE_VALF)) : std::nextafter(x, way * HUGE_VAL);
}

/// Moves each number up or down by an ulp, or not at all; flags, indices and infinities stay.
Answer pushed(const Query& query, Scalar scalar, Answer a, std::mt19937_64& random) {
  for (std::size_t i = 0; i < query.outputs.size(); ++i) {
    const Role role = query.outputs[i].role;
    if (!a.gives(i) || role == Role::flag || role == Role::index || std::isinf(a.values[i])) continue;
    a.values[i] = next_to(a.values[i], int(random() % 3) - 1, scalar);
  }
  return a;
}

TEST_P(Watch, APushByAnUlpIsToldAsNoMore) {
  const int wanted = answers_about(query()) / 8;
  for (std::uint64_t index = 0, asked = 0; asked < std::uint64_t(wanted); ++index) {
    ASSERT_LT(index, 8u * std::uint64_t(wanted)) << "hardly any case has an answer in range";
    const Case c = draw(index);
    const std::optional<Answer> exact = answer_of(query(), c.scalar, right_answer(c));
    if (!exact) continue;
    ++asked;
    const Answer answer = pushed(query(), c.scalar, *exact, random_);
    if (query().kind == Kind::depth && answer.yes && answer.values[0] < 0) continue;  // the push moved the boxes apart
    // A derivation's doubles are truncated, not rounded to nearest.
    const double ulps = c.scalar == Scalar::float32 ? 1.5 : 2;
    const Finding f =
        judge(c, answer, collide::Contract{.forward = ulps * (1 + 0x1p-20), .exact_decisions = true}, Detail::full);
    ASSERT_FALSE(f.is_proved()) << text(c, answer, f);
  }
}

/// All drawn right answers have the same value of this member.
bool alike(const std::vector<Reference>& all, const Layout::Part& part) {
  for (const Reference& r : all) {
    if (r.values.size() < part.end) return false;
    for (std::size_t i = part.begin; i < part.end; ++i) {
      if (r.values[i] != all.front().values[i]) return false;
    }
  }
  return true;
}

/// The component of a unit vector whose change rotates it most; its length is judged separately.
std::size_t across(const Layout::Part& part, const Answer& a) {
  std::size_t least = part.begin;
  for (std::size_t i = part.begin; i < part.end; ++i) {
    if (std::abs(a.values[i]) < std::abs(a.values[least])) least = i;
  }
  return least;
}

TEST_P(Watch, WhatIsWrongIsTold) {
  // For two equally near faces, or a cone of normals whose edges are drawn one time in six, forty draws are equal once
  // in 10^11 cases.
  constexpr std::size_t draws = 40;
  constexpr double least = 16, told_at_least = 7;  // an ulp of the pushed number may be two of the exact one
  const int wanted = answers_about(query()) / 8;
  int asked = 0, by_part[32] = {};
  const std::vector<Layout::Part>& parts = query().layout.parts;
  for (std::uint64_t index = 0; asked < wanted; ++index) {
    ASSERT_LT(index, 8u * std::uint64_t(wanted)) << "hardly any case has an answer in range";
    const Case c = draw(index);
    const std::mt19937_64 before = random_;
    std::vector<Reference> all{right_answer(c)};
    const bool has_choice = random_ != before;  // otherwise this answer is the only one
    const auto have_in_common = [&](const Layout::Part& part) {
      const bool is_unique =
          part.role == Role::time || part.role == Role::distance || (part.role == Role::depth && all.front().yes);
      if (is_unique) return true;
      while (has_choice && all.size() < draws && alike(all, part)) all.push_back(right_answer(c));
      return alike(all, part);
    };
    const std::optional<Answer> exact = answer_of(query(), c.scalar, all.front());
    if (!exact) continue;
    const collide::Contract promise{.forward = told_at_least, .exact_decisions = true};
    if (decides(query().kind)) {
      Answer other;
      other.yes = !exact->yes, other.given = 0;
      const Finding f = judge(c, other, promise, Detail::full);
      ASSERT_TRUE(f.has(other.yes ? Disagreement::false_hit : Disagreement::false_miss)) << text(c, other, f);
      ++asked;
    }
    if (exact->yes != all.front().yes) continue;  // so late that it is a miss
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const Layout::Part& part = parts[k];
      if (part.role == Role::index || part.end > all.front().values.size() || !have_in_common(part)) continue;
      Answer wrong = *exact;
      std::size_t i = part.begin + std::size_t(below(int(part.end - part.begin)));
      if (part.role == Role::normal) i = across(part, wrong);
      if (part.role == Role::flag) {
        wrong.values[i] = wrong.values[i] == 0 ? 1 : 0;
      } else {
        double largest = 0;
        for (std::size_t j = part.begin; j < part.end; ++j) largest = std::max(largest, std::abs(wrong.values[j]));
        const double by = least * std::ldexp(1 + std::abs(uniform()), below(12)) * ulp(largest, c.scalar);
        wrong.values[i] = rounded_to(c.scalar, wrong.values[i] + (below(2) == 0 ? by : -by));
        if (!std::isfinite(wrong.values[i])) continue;
        if (part.role == Role::time && wrong.values[i] < 0) continue;
        if (query().kind == Kind::depth && k == 0 && wrong.yes != (wrong.values[0] >= 0)) continue;
      }
      const Finding f = judge(c, wrong, promise, Detail::full);
      ASSERT_TRUE(f.is_proved()) << query().outputs[i].name << " was " << exact->values[i] << "\n" << text(c, wrong, f);
      ++asked, ++by_part[k];
    }
  }
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (parts[k].role == Role::index) continue;
    EXPECT_GT(by_part[k], 0) << query().outputs[parts[k].begin].name << " was never wrong";
  }
}

INSTANTIATE_TEST_SUITE_P(Every, Watch, testing::ValuesIn(derived::derived_queries()),
                         testing::PrintToStringParamName());

}  // namespace
}  // namespace nearmiss
