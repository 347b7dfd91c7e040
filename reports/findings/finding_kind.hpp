/// Kinds of findings, and their variants.
#pragma once

#include <compare>
#include <string>

#include "corpus/files/file_value.hpp"
#include "corpus/generator/feature_regions.hpp"
#include "oracles/judge.hpp"

namespace nearmiss {

/// Two findings of the same query and subject with the same key are of the same kind: the same member of the
/// answer is wrong in the same way, and breaks the same clause.
struct KindKey {
  Verdict verdict = Verdict::agrees;
  Disagreement disagreement = Disagreement::none;
  int member = MemberFinding::decision;  ///< of the headline, an index in the query's layout
  Clause broken = Clause::none;
  std::string breakage;  ///< for a subject that broke: kind_of_breakage()

  auto operator<=>(const KindKey&) const = default;
};

KindKey kind_key_of(const Finding& f);

/// "backward error", "exact decisions"; "" for none.
std::string_view name_of(Clause c);

/// A kind in words, with its query and subject: the same for a finding and for the file of its report.
struct FindingKind {
  std::string query, subject;
  std::string fault;   ///< fault_of(): "false-miss", "broke"
  std::string member;  ///< "decision", "time"; empty for all members together, and for a subject that broke
  std::string clause;  ///< name_of() the broken clause; kind_of_breakage() for a subject that broke

  auto operator<=>(const FindingKind&) const = default;
};

FindingKind kind_of_finding(const Query& query, const std::string& subject, const Finding& f);
/// The kind of the finding in a report file. Throws BadInput where the file is no report.
FindingKind kind_in_report(const FileValue& report);

/// Findings of one kind whose cases lie in the same regions, take the same branches of the oracle, and have extreme
/// numbers or not.
struct Variant {
  std::uint64_t branches = 0;  ///< Finding::branches of a judgement that computes no more than the verdict needs
  FeatureRegions regions;
  bool ordinary = true;  ///< is_ordinary()

  auto operator<=>(const Variant&) const = default;
};

}  // namespace nearmiss
