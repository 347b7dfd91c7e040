/// The oracle against slow, obvious derivations on small integer lattices, where touches, ties and degenerate shapes
/// are common. Compares decisions, and the derivation's numbers to one unit in the last place.
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <set>

#include "oracles/exact/oracle.hpp"
#include "properties/derivation.hpp"
#include "properties/support.hpp"

namespace nearmiss::derived {
namespace {

/// The number of different cases. CI runs the default, the nightly job NEARMISS_LATTICE_CASES.
int cases_of(const Query& query) {
  const char* value = std::getenv("NEARMISS_LATTICE_CASES");
  return (value != nullptr ? std::stoi(value) : 45000) / cost_of(query);
}

struct Compared {
  int cases = 0, hits = 0;
  std::string difference;  ///< the first one; empty if there is none
};

/// Compares decisions, and the reference's numbers to one unit in the last place, over `count` different cases, or over
/// fewer if the lattice has hardly more.
Compared compare(const Query& query, int range, int cases) {
  const Derivation derivation = derivation_of(query);
  std::mt19937_64 random(20240601 + unsigned(range));
  const std::vector<double> still(query.inputs.size(), 0.0);
  std::set<std::vector<double>> asked;
  Compared all;
  for (int draw = 0; draw < 4 * cases && all.cases < cases; ++draw) {
    const Case c = lattice_case(query, Scalar::float64, range, random);
    if (!asked.insert(c.values).second) continue;
    const Reference reference = derivation(Reader(c.values));
    Answer about;
    about.yes = reference.yes;
    about.given = (std::uint64_t{1} << reference.values.size()) - 1;
    std::copy(reference.values.begin(), reference.values.end(), about.values.begin());
    ++all.cases;
    all.hits += about.yes;
    const Enclosure exact = oracle_of(query).exact(c.values, about, c.scalar, nullptr);
    const Enclosure interval = oracle_of(query).interval(c.values, still, about, c.scalar);
    const bool same = exact.may_be_yes == about.yes && exact.may_be_no != about.yes && exact.may_match;
    const bool enclosed = (about.yes ? interval.may_be_yes : interval.may_be_no) && interval.may_match;
    if (same && enclosed) continue;
    all.difference = same ? "the interval stage excludes the truth: " : "the exact stage differs: ";
    for (const double x : c.values) all.difference += std::to_string(int(x)) + " ";
    all.difference += "reference " + testing::PrintToString(reference.values) + " " + std::to_string(reference.yes);
    return all;
  }
  return all;
}

class OracleOnLattice : public testing::TestWithParam<NamedQuery> {};

TEST_P(OracleOnLattice, AgreesWithAnIndependentDerivation) {
  const Query& query = *GetParam().query;
  const int wanted = cases_of(query);
  int asked = 0;
  for (const int range : {1, 2, 3}) {
    const Compared compared = compare(query, range, (wanted - asked) / (4 - range));
    ASSERT_EQ(compared.difference, "") << query.name << ", range " << range;
    asked += compared.cases;
    if (!decides(query.kind)) continue;
    const double share = double(compared.hits) / compared.cases;
    EXPECT_GT(share, 0.01) << "the lattice has hardly any contacts at range " << range;
    EXPECT_LT(share, 0.99) << "the lattice has hardly any misses at range " << range;
  }
  EXPECT_GE(asked, wanted);
}

TEST(Lattice, HasADerivationForEveryQuery) {
  for (const Query& query : catalogue()) EXPECT_NE(derivation_of(query), nullptr) << query.name;
}

INSTANTIATE_TEST_SUITE_P(Every, OracleOnLattice, testing::ValuesIn(derived_queries()),
                         testing::PrintToStringParamName());

}  // namespace
}  // namespace nearmiss::derived
