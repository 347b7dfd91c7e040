/// What the properties share: which subjects they hold to their word, and how a failure is told.
#pragma once

#include <cstdint>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "corpus/relations/verdict.hpp"
#include "impl/subject/subject.hpp"
#include "oracles/judge.hpp"

namespace nearmiss {

/// A query and a subject that answers it. Shows as <query>__<subject>, fit for a test's name.
struct Pairing {
  const Query* query;
  const Subject* subject;
};
std::ostream& operator<<(std::ostream& out, const Pairing& p);
/// Every query with every tier of `collide`, every plugin and every subject that NEARMISS_SUBJECTS names ("added":
/// those of NEARMISS_ADD), that answers it.
std::vector<Pairing> our_pairings();
/// Every query with the certified tier in each scalar.
std::vector<Pairing> certified_pairings();

/// A query; shows as its name.
struct NamedQuery {
  const Query* query;
};
std::ostream& operator<<(std::ostream& out, const NamedQuery& q);
std::vector<NamedQuery> every_query();

inline constexpr Scalar scalars[] = {Scalar::float32, Scalar::float64};

/// The subject's answer, given in this process, and the judge's word on it.
Finding examined(const Case& question, const Subject& subject);
inline bool is_violation(const Finding& f) { return f.is_proved() || f.verdict == Verdict::broke; }
/// A violation as a person needs it: the finding, its seed, the command that replays it, the shrunk case as JSON and as
/// C++. It leaves a report in properties/QUERY/ of runs_folder().
std::string told(const Case& question, const Subject& subject);
/// The same for a sentence of which `failure_of` says how a case breaks it; "" where it does not.
std::string told(const Case& question, const Subject& subject,
                 const std::function<std::string(const Case&)>& failure_of);
/// The same for a broken relation, with all cases that it is about.
std::string told(const Relation& relation, const Case& question, std::uint64_t seed, const Subject& subject);

/// The stream of generated cases that a property with the seed `usual` asks about: that one, or the one that the
/// environment variable NEARMISS_SEED makes of it.
std::uint64_t stream(std::uint64_t usual);

/// The first of `cases` cases of the stream whose answer breaks the subject's contract, as told() has it; "" where none
/// does.
std::string failure_of_agreement(const Query& query, const Subject& subject, std::uint64_t stream, std::uint64_t cases);
/// The first that breaks one of the relations.
std::string failure_of_relations(const Query& query, const Subject& subject, std::uint64_t stream, std::uint64_t cases);

/// The exact decision; the exact stage is asked only where the interval cannot tell.
bool truth_is_yes(const Case& question);

/// Checks with RapidCheck that `failure_of` says "" for 200 streams (seeds) of the generator; what it
/// says otherwise is printed with the stream. The environment variable RC_PARAMS overrides the number
/// (max_success) and RapidCheck's own seed.
bool holds_for_streams(const std::string& sentence, const std::function<std::string(std::uint64_t)>& failure_of);

}  // namespace nearmiss
