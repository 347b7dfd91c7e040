/// Counts the findings of each query and subject, and selects the findings for reports.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "impl/subject/subject.hpp"
#include "oracles/judge.hpp"
#include "reports/engine/retention.hpp"
#include "reports/engine/wrong_cases.hpp"
#include "reports/findings/finding_kind.hpp"

namespace nearmiss {

/// "X is often wrong of QUERY: only a sample was judged, and 142 answers were not (--every-answer judges all)".
std::string not_judged_text(std::string_view subject, std::string_view query, std::uint64_t answers);

/// The counts of one subject on one query. Different kinds of disagreement are never added together.
struct Tally {
  const Query* query = nullptr;
  const Subject* subject = nullptr;
  std::uint64_t cases = 0;
  std::array<std::uint64_t, verdict_count> verdicts{};
  /// Answers with a member that differs in this way, but is not proved to differ by more than promised.
  std::array<std::uint64_t, disagreement_count> not_proved{};
  /// Answers with a member that breaks the contract, or exceeds the measure, in this way. An answer with several such
  /// members counts for each way.
  std::array<std::uint64_t, disagreement_count> violations{};
  /// Breakages by kind_of_breakage(); after the first `most_kinds` kinds every other kind counts as `other_kind`.
  std::map<std::string, std::uint64_t> breakages{};
  static constexpr std::size_t most_kinds = 32;
  static constexpr const char* other_kind = "any other reason";
  std::uint64_t wrong = 0;       ///< answers with a violation other than a wrong decision
  std::uint64_t late = 0;        ///< breakages at a time limit
  std::uint64_t gave_up = 0;     ///< cases that were not asked because it was given up; not among `cases`
  std::string lost{};            ///< why its host could not be started again
  std::uint64_t not_judged = 0;  ///< answers that were not judged because too many were wrong; not among `cases`
  std::uint64_t decided_by_interval = 0, decided_by_exact = 0;
  std::uint64_t truth_yes = 0;  ///< decided cases whose exact answer is yes
  WrongCases wrong_cases{};     ///< of the generated cases; not added by add()
  double worst_backward = -1;   ///< the largest proved bound, in epsilon; negative: none
  double worst_forward = 0;     ///< in ulps, where the decision is right

  void count(const Finding& f);
  /// The kind under which a breakage is counted.
  std::string breakage_of(const Finding& f) const;
  /// Adds the counts of another query or subject.
  void add(const Tally& other);
  /// Why it was not asked `gave_up` cases, as given_up_text().
  std::string given_up() const;
  std::uint64_t of(Verdict v) const { return verdicts[std::size_t(v)]; }
  std::uint64_t violations_by(Disagreement d) const { return violations[std::size_t(d)]; }
  std::uint64_t bad() const {
    return of(Verdict::violates_contract) + of(Verdict::exceeds_measure) + of(Verdict::broke);
  }
  std::uint64_t decided() const { return decided_by_interval + decided_by_exact; }
};

nlohmann::ordered_json tally_to_json(const Tally& t);

/// Selects the findings that become reports: for each query, subject and fault of a member, or kind of breakage in the
/// tally, the first `first_few` of each variant while there are fewer than `most_of_a_kind`, and then those whose
/// proved backward bound is at least twice that of the worst kept so far. A finding with several faults is kept where
/// one of its faults is.
class FindingRetention {
 public:
  bool keep(const Tally& of, const Finding& f, const Variant& variant = {});
  /// The result of keep(), without keeping.
  bool would_keep(const Tally& of, const Finding& f, const Variant& variant) const;
  static constexpr std::uint64_t first_few = 4, most_of_a_kind = 32;

 private:
  Retention retention_;
};

}  // namespace nearmiss
