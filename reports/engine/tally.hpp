/// What is counted of each query and subject, and which findings are worth a report.
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

namespace nearmiss {

/// "X was late 8 times of QUERY, and was not asked 142 more cases".
std::string given_up_text(std::string_view subject, std::string_view query, std::uint64_t late, std::uint64_t cases);

/// The counts of one subject on one query. The ways in which answers differ are never added together.
struct Tally {
  const Query* query = nullptr;
  const Subject* subject = nullptr;
  std::uint64_t cases = 0;
  std::array<std::uint64_t, verdict_count> verdicts{};
  /// Answers in which some member differs in that way, by no more than was promised as far as is proved.
  std::array<std::uint64_t, disagreement_count> not_proved{};
  /// Answers in which some member breaks the contract, or exceeds the measure, in that way. An answer of which several
  /// members do counts for each.
  std::array<std::uint64_t, disagreement_count> violations{};
  /// Breakages by kind_of_breakage(); after the first `most_kinds` any other is an `other_kind`.
  std::map<std::string, std::uint64_t> breakages{};
  static constexpr std::size_t most_kinds = 32;
  static constexpr const char* other_kind = "any other reason";
  std::uint64_t wrong = 0;    ///< answers with a violation other than a wrong decision
  std::uint64_t late = 0;     ///< of the breakages, those at a time limit
  std::uint64_t gave_up = 0;  ///< cases that were not asked any more, since too many were late; none of `cases`
  std::uint64_t decided_by_interval = 0, decided_by_exact = 0;
  std::uint64_t truth_yes = 0;  ///< of the decided ones
  double worst_backward = -1;   ///< the largest proved bound, in epsilon; negative: nothing was proved
  double worst_forward = 0;     ///< in ulps, where the decision is right

  void count(const Finding& f);
  /// The kind under which a breakage is counted.
  std::string breakage_of(const Finding& f) const;
  /// The counts of another query or subject added to these.
  void add(const Tally& other);
  std::uint64_t of(Verdict v) const { return verdicts[std::size_t(v)]; }
  std::uint64_t violations_by(Disagreement d) const { return violations[std::size_t(d)]; }
  std::uint64_t bad() const {
    return of(Verdict::violates_contract) + of(Verdict::exceeds_measure) + of(Verdict::broke);
  }
  std::uint64_t decided() const { return decided_by_interval + decided_by_exact; }
};

nlohmann::ordered_json tally_to_json(const Tally& t);

/// Says which findings are kept as reports: of each query, subject and fault of a member, or kind of breakage that the
/// tally knows, the first `first_few`, then only those whose proved backward bound is at least twice that of the worst
/// kept so far. A finding with several faults is kept where one of them is.
class FindingRetention {
 public:
  bool keep(const Tally& of, const Finding& f);
  static constexpr std::uint64_t first_few = 8;

 private:
  Retention retention_;
};

}  // namespace nearmiss
