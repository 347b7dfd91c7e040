/// Shared by the properties: the subjects under test, and the text of a failure.
#pragma once

#include <cstdint>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "corpus/relations/verdict.hpp"
#include "impl/subject/subject.hpp"
#include "oracles/judge.hpp"

/// INSTANTIATE_TEST_SUITE_P for a suite whose tests run for every query, each named after its query: CMake lists these
/// tests (cmake/PerQueryTests.cmake), and `nearmiss list` shows them.
#define INSTANTIATE_FOR_EVERY_QUERY(prefix, suite, ...) INSTANTIATE_TEST_SUITE_P(prefix, suite, __VA_ARGS__)

namespace nearmiss {

/// A query and a subject that answers it. Prints as <query>__<subject>, valid in a test's name.
struct Pairing {
  const Query* query;
  const Subject* subject;
};
std::ostream& operator<<(std::ostream& out, const Pairing& p);
/// Every query with each subject that answers it: every tier of `collide`, every plugin, and every subject that
/// NEARMISS_SUBJECTS names ("added": those of NEARMISS_ADD).
std::vector<Pairing> our_pairings();
/// Every query with the certified tier in each scalar.
std::vector<Pairing> certified_pairings();

/// A query; prints as its name.
struct NamedQuery {
  const Query* query;
};
std::ostream& operator<<(std::ostream& out, const NamedQuery& q);
std::vector<NamedQuery> every_query();

/// A contract that only the exact answer, rounded once, keeps.
inline constexpr collide::Contract strict{.backward = 0, .forward = 1, .exact_decisions = true, .unit = 4};

inline constexpr Scalar scalars[] = {Scalar::float32, Scalar::float64};

/// The subject's answer, computed in this process, and its finding.
Finding examined(const Case& question, const Subject& subject);
inline bool is_violation(const Finding& f) { return f.is_proved() || f.verdict == Verdict::broke; }
/// The text of a violation: the finding, its seed, the command that replays it, the shrunk case as JSON and as C++.
/// Leaves a report in properties/QUERY/ of runs_folder().
std::string failure_text(const Case& question, const Subject& subject);
/// The same for a property that `failure_of` checks: it returns how a case violates the property, "" if it does not.
std::string failure_text(const Case& question, const Subject& subject,
                         const std::function<std::string(const Case&)>& failure_of);
/// The same for a broken relation, with all of its cases.
std::string failure_text(const Relation& relation, const Case& question, std::uint64_t seed, const Subject& subject);

/// How many cases of each family a property about enclosures asks; other counts are multiples. The environment variable
/// NEARMISS_FAMILY_CASES changes it: the test presets that ask a sample have a small one.
int cases_per_family();

/// A property that asks the oracle or a derivation is asked one case in so many: the pairs of vertices of a signed
/// distance with a triangle or a box, since the exact answer searches pairs of their features; 1 for other queries.
int cost_of(const Query& query);

/// The stream of generated cases for a property whose default seed is `usual`. The environment variable NEARMISS_SEED
/// changes it.
std::uint64_t stream(std::uint64_t usual);

/// The text, by failure_text(), of the first of `cases` cases of the stream whose answer breaks the subject's contract;
/// "" if there is none.
std::string failure_of_agreement(const Query& query, const Subject& subject, std::uint64_t stream, std::uint64_t cases);
/// The text of the first case that breaks one of the relations.
std::string failure_of_relations(const Query& query, const Subject& subject, std::uint64_t stream, std::uint64_t cases);

/// The exact decision. Asks the exact stage only if the intervals cannot tell.
bool truth_is_yes(const Case& question);

/// Checks with RapidCheck that `failure_of` returns "" for 200 streams (seeds) of the generator. Prints any other
/// result with its stream. The environment variable RC_PARAMS overrides the number (max_success) and RapidCheck's own
/// seed.
bool holds_for_streams(const std::string& sentence, const std::function<std::string(std::uint64_t)>& failure_of);

}  // namespace nearmiss
