/// Queries with a SIMD kernel in `Fast` also have a scalar kernel, for machines without SIMD and for the other tiers:
/// it keeps the same contract. A SIMD kernel computes a contact in every case and must not leave it in a miss.
#include <gtest/gtest.h>
#include <collide/tiers.hpp>

#include "corpus/generator/generator.hpp"
#include "corpus/storage/store.hpp"
#include "nearmiss/collide_functions.hpp"
#include "properties/support.hpp"

namespace nearmiss {
namespace {

/// `Fast` on a machine without SIMD lanes.
struct WithoutLanes : collide::Fast {};
static_assert(!collide::in_lanes<WithoutLanes, float> && collide::in_lanes<collide::Fast, float>);

using AnswerTo = Answer (*)(std::span<const double> inputs);

template <template <class> class Inputs, class T>
Answer answer_without_lanes(std::span<const double> inputs) {
  return erase(adapters::ask_collide<WithoutLanes>(inputs_from<Inputs<T>>(inputs.data())));
}

/// The numbers of a miss equal those of the miss that the answer's type defines.
template <template <class> class Inputs, class T>
bool misses_emptily(std::span<const double> inputs) {
  const auto answer = adapters::ask_collide<collide::Fast>(inputs_from<Inputs<T>>(inputs.data()));
  using A = std::remove_cvref_t<decltype(answer)>;
  if constexpr (kind_of<A> == Kind::impact) {
    if constexpr (requires { answer.inside; }) {
      if (answer.inside) return true;  // also describes the start
    }
    return answer.yes() || erase(answer).values == erase(A::miss()).values;
  }
  return false;  // the answer type has no miss
}

struct LanedQuery {
  const char* query;
  AnswerTo in_float, in_double;
  bool (*empty_in_float)(std::span<const double> inputs);
  bool (*empty_in_double)(std::span<const double> inputs);
};
std::ostream& operator<<(std::ostream& out, const LanedQuery& a) { return out << a.query; }

class FastWithoutLanes : public testing::TestWithParam<LanedQuery> {};

TEST_P(FastWithoutLanes, KeepsItsContract) {
  const Query& query = *find_query(GetParam().query);
  for (const Scalar scalar : scalars) {
    const bool is_float = scalar == Scalar::float32;
    const collide::Contract& contract =
        find_subject(is_float ? "collide-fast-float" : "collide-fast-double")->offering(query.name).contract;
    for (std::uint64_t i = 0; i < std::uint64_t(5000 / cost_of(query)); ++i) {
      const Case c = generate(query, scalar, stream(7), i);
      const Answer answer = (is_float ? GetParam().in_float : GetParam().in_double)(c.values);
      ASSERT_FALSE(is_violation(judge(c, answer, contract, Detail::verdict)))
          << query.name << ' ' << name_of(scalar) << ' ' << i;
    }
  }
}

class FastInLanes : public testing::TestWithParam<LanedQuery> {};

TEST_P(FastInLanes, LeavesNothingInAMiss) {
  const Query& query = *find_query(GetParam().query);
  if (query.kind != Kind::impact) GTEST_SKIP() << "has no miss";
  const auto empty = [](const Case& c) {
    return (c.scalar == Scalar::float32 ? GetParam().empty_in_float : GetParam().empty_in_double)(c.values);
  };
  for (const StoredCase& s : stored_cases(query)) EXPECT_TRUE(empty(s.question)) << s.file;
  for (const Scalar scalar : scalars) {
    for (std::uint64_t i = 0; i < 20000; ++i) {
      ASSERT_TRUE(empty(generate(query, scalar, stream(8), i))) << query.name << ' ' << name_of(scalar) << ' ' << i;
    }
  }
}

#define NEARMISS_QUERY(name)                                                                               \
  LanedQuery{#name, answer_without_lanes<inputs::name, float>, answer_without_lanes<inputs::name, double>, \
             misses_emptily<inputs::name, float>, misses_emptily<inputs::name, double>},
constexpr LanedQuery every[] = {
#include "impl/catalogue/catalogue.def"
};
#undef NEARMISS_QUERY

INSTANTIATE_FOR_EVERY_QUERY(Queries, FastWithoutLanes, testing::ValuesIn(every), testing::PrintToStringParamName());
INSTANTIATE_FOR_EVERY_QUERY(Queries, FastInLanes, testing::ValuesIn(every), testing::PrintToStringParamName());

}  // namespace
}  // namespace nearmiss
