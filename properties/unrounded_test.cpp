/// If no operation of a query's kernel rounds, the answer of every tier is the exact one, touches included: decision
/// and numbers. Tested on lattices of small integers and dyadic fractions, where touching contacts are common. The
/// processor's inexact flag tells whether any operation rounded.
#include <gtest/gtest.h>

#include <algorithm>
#include <cfenv>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <random>

#include "corpus/storage/codec.hpp"
#include "nearmiss/collide_functions.hpp"
#include "properties/support.hpp"

namespace nearmiss {
namespace {

/// The scalar kernel of a query, whatever other kernels `Fast` has.
struct TextAlone : collide::Fast {};

using AnswerTo = Answer (*)(std::span<const double> inputs);
template <template <class> class Inputs, class T>
Answer answer_of_text(std::span<const double> inputs) {
  return erase(adapters::ask_collide<TextAlone>(inputs_from<Inputs<T>>(inputs.data())));
}

struct Texts {
  const char* query;
  AnswerTo in_float, in_double;
};
#define NEARMISS_QUERY(name) Texts{#name, answer_of_text<inputs::name, float>, answer_of_text<inputs::name, double>},
constexpr Texts texts[] = {
#include "impl/catalogue/catalogue.def"
};
#undef NEARMISS_QUERY
std::ostream& operator<<(std::ostream& out, const Texts& t) { return out << t.query; }

/// Draws cases of numbers with few bits: lattice points, many of them equal, or apart along one axis or by a vector of
/// integer length. Half of the rotations are the identity, the others quarter turns and rotations by small integers.
class SmallLattice {
 public:
  explicit SmallLattice(std::uint64_t seed) : random_(seed) {}

  Case draw(const Query& query, Scalar scalar) {
    Case c{&query, scalar, {}, "lattice", 0, 0, {}};
    do {
      c.values.clear();
      start_case();
      while (c.values.size() < query.inputs.size()) add_next(query.inputs, c.values);
    } while (query.broken(c.values));
    return c;
  }

 private:
  int below(int n) { return int(random_() % std::uint64_t(n)); }
  int within(int n) { return below(2 * n + 1) - n; }
  double power_of_two() { return std::ldexp(1.0, below(5) - 1); }

  void start_case() {
    cell_ = below(4) == 0 ? std::ldexp(1.0, below(9) - 4) : 1.0;
    range_ = 1 + below(4);
    base_ = {0, 0, 0};
    if (below(2) == 0) base_ = {double(within(9)), double(within(9)), double(within(9))};
  }
  std::array<double, 3> vector() {
    static constexpr std::array<double, 3> of_integer_length[] = {
        {1, 2, 2}, {0, 3, 4}, {2, 3, 6}, {1, 4, 8}, {4, 4, 7}};
    std::array<double, 3> v{double(within(range_)), double(within(range_)), double(within(range_))};
    const int kind = below(10);
    if (kind > 7) v = {0, 0, 0};
    if (kind < 4) v = {(below(2) == 0 ? 1 : -1) * (below(2) == 0 ? power_of_two() : 1 + below(9)), 0, 0};
    if (kind == 4) v = of_integer_length[below(5)];
    if (kind < 5) std::shuffle(v.begin(), v.end(), random_);
    return v;
  }
  void add_next(std::span<const Field> fields, std::vector<double>& values) {
    const Field& f = fields[values.size()];
    switch (f.role) {
      case Role::flag: return values.push_back(below(2));
      case Role::index: return values.push_back(below(16) - 1);
      case Role::rotation: return add_rotation(values);
      case Role::time: return values.push_back(below(9) * 0.25);
      default: break;
    }
    if (!f.name.ends_with(".x"))
      return values.push_back((f.role == Role::size ? below(3 * range_) : within(2 * range_)) * cell_);
    const std::array<double, 3> v = vector();
    for (int k = 0; k < 3; ++k) {
      values.push_back(cell_ * (f.role == Role::position ? base_[k] + v[k]
                                : f.role == Role::size   ? std::abs(v[k])
                                                         : v[k]));
    }
  }
  void add_rotation(std::vector<double>& values) {
    const int kind = below(4), axis = below(4);
    for (int k = 0; k < 4; ++k) values.push_back(kind < 2 ? k == 3 : kind == 2 ? k == 3 || k == axis : within(1));
  }

  std::mt19937_64 random_;
  double cell_ = 1;
  int range_ = 1;
  std::array<double, 3> base_{};
};

struct Reply {
  Answer answer;
  bool rounded;
};
Reply ask(const AnswerFunction& answer_to, const Case& c) {
  std::feclearexcept(FE_ALL_EXCEPT);
  const Answer answer = answer_to(c.values);
  return {answer, std::fetestexcept(FE_INEXACT) != 0};
}

/// The axis that the answers name: among several right axes a tier may choose one along which it has to round.
bool name_the_same(const Query& query, const Answer& a, const Answer& b) {
  for (std::size_t i = 0; i < query.outputs.size(); ++i) {
    if (query.outputs[i].role == Role::index && a.values[i] != b.values[i]) return false;
  }
  return true;
}
bool same(const Answer& a, const Answer& b) { return a.yes == b.yes && a.given == b.given && a.values == b.values; }

/// Cases per query and scalar. CI runs fewer, the nightly job NEARMISS_LATTICE_CASES.
int cases_per_query() {
  const char* value = std::getenv("NEARMISS_LATTICE_CASES");
  return value != nullptr ? std::atoi(value) : 4000;
}

struct Counts {
  int cases = 0, unrounded = 0, yes = 0;
};

class WhereNothingRounds : public testing::TestWithParam<Texts> {
 protected:
  /// If a tier, or its kernel, did not round, the tier's answer is exact.
  void expect_exact(const Case& c, const char* who, const Answer& answer) {
    const Finding f = judge(c, answer, collide::Contract{.forward = 0, .exact_decisions = true}, Detail::full);
    truth_yes_ = f.truth_yes;
    EXPECT_EQ(f.verdict, Verdict::agrees) << who << ": " << name_of(f.disagreement) << ", " << f.clause << "\n"
                                          << case_to_json(c).dump(2) << "\n"
                                          << case_to_cpp(c);
  }
  void examine(const Case& c, Counts& counts) {
    const bool is_float = c.scalar == Scalar::float32;
    const Reply text = ask(is_float ? GetParam().in_float : GetParam().in_double, c);
    std::vector<Answer> exact;
    const auto look = [&](const char* who, const Reply& asked) {
      if (asked.rounded && (text.rounded || !name_the_same(*c.query, asked.answer, text.answer))) return;
      if (std::any_of(exact.begin(), exact.end(), [&](const Answer& a) { return same(a, asked.answer); })) return;
      expect_exact(c, who, asked.answer);
      exact.push_back(asked.answer);
    };
    look("the text", text);
    for (const char* tier : {"fast", "accurate", "decisive", "certified"}) {
      const Subject& subject = *find_subject(std::string("collide-") + tier + (is_float ? "-float" : "-double"));
      look(tier, ask(subject.offering(c.query->name).answer, c));
    }
    ++counts.cases;
    if (exact.empty()) return;
    ++counts.unrounded;
    counts.yes += truth_yes_;
  }

 private:
  bool truth_yes_ = false;
};

/// Of all cases of a query, or of more where a kernel seldom answers without rounding.
constexpr int fewest = 50, most_cases = 40'000;

TEST_P(WhereNothingRounds, EveryTierIsExact) {
  const Query& query = *find_query(GetParam().query);
  for (const Scalar scalar : scalars) {
    SmallLattice lattice(stream(11));
    Counts counts;
    const auto are_enough = [&] { return counts.cases >= cases_per_query() && counts.unrounded >= fewest; };
    while (!are_enough() && counts.cases < std::max(most_cases, cases_per_query()) && !HasFailure())
      examine(lattice.draw(query, scalar), counts);
    EXPECT_GE(counts.unrounded, fewest) << "the lattice has hardly any cases that need no rounding";
    if (!decides(query.kind)) continue;
    EXPECT_GE(counts.yes, 1) << "the lattice has no contacts";
    EXPECT_LT(counts.yes, counts.unrounded) << "the lattice has no misses";
  }
}

INSTANTIATE_FOR_EVERY_QUERY(Queries, WhereNothingRounds, testing::ValuesIn(texts), testing::PrintToStringParamName());

}  // namespace
}  // namespace nearmiss
