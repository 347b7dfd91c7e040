/// Groups findings into signatures: what may be one bug is one row.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "reports/findings/severity.hpp"
#include "reports/triage/causes/cause.hpp"
#include "reports/triage/examination/ordinary_scene.hpp"
#include "reports/triage/examination/sources.hpp"
#include "reports/triage/proposals.hpp"

namespace nearmiss {

/// What became of a signature since the baseline.
enum class SignatureChange {
  fresh,     ///< the baseline does not have it, and its findings are proved to be more frequent than before; or
             ///< findings in cases that the subject of the baseline answered right
  worse,     ///< the baseline has it, and its findings are proved to be more frequent, or the error of its case larger
  known,     ///< the baseline has it, or has findings of its kind in such cases
  unproved,  ///< the baseline does not have it, but at its rate the baseline's run may have missed it
  part_fixed,  ///< the baseline has it, and the subject, asked its cases again, is right now in some of them
  fixed,       ///< the baseline has it, and the subject, asked its cases again, is right now in all of them
};
inline constexpr SignatureChange all_signature_changes[] = {SignatureChange::fresh,      SignatureChange::worse,
                                                            SignatureChange::known,      SignatureChange::unproved,
                                                            SignatureChange::part_fixed, SignatureChange::fixed};
std::string_view name_of(SignatureChange c);

/// What was decided about a signature, in a line of a decisions file.
struct SignatureDecision {
  enum class Kind { accepted, upstream, reported, fixed };

  std::string id;
  Kind kind = Kind::accepted;
  std::string argument;         ///< the URL of `reported`, the version of `fixed`
  std::optional<double> bound;  ///< the relative size up to twice of which the decision holds
  std::string note;
  bool reopened = false;
};
std::string_view name_of(SignatureDecision::Kind k);

/// Findings of one kind whose simplest cases need the same regions: a part of a row.
struct FindingPart {
  FindingKind kind;
  FeatureRegions regions;
  auto operator<=>(const FindingPart&) const = default;
};

/// The findings with one signature: a row.
struct TriagedSignature {
  // The signature.
  std::string id;               ///< twelve hexadecimal digits: the same in every triage
  std::set<std::string> names;  ///< of all that was merged into the row: its id is one of them
  FindingKind kind;             ///< of the worst
  std::vector<FindingPart> parts;
  Cause cause;
  std::uint64_t branches = 0;  ///< of the oracle on the simplest case
  FeatureRegions regions;      ///< those that every one of its simplest cases needs

  /// The row of a query's findings that vanish where the same scene is asked at ordinary magnitude; empty for any
  /// other.
  std::optional<ExtremeMagnitudes> range;
  /// It may make a command exit with 1: not the row of a range, unless that is asked for.
  bool may_stand = true;

  std::string version;    ///< of the subject
  std::string asked_as;   ///< the library's own operation, where the offer names it (Offering::how)
  bool examined = false;  ///< false: the time was over, and the cause is not known
  ErrorSize size;         ///< of the worst
  double severity = 0;
  std::string headline;         ///< of the worst
  std::uint64_t findings = 0;   ///< of all cases, also those without a report
  double ordinary_share = 0;    ///< of these
  std::string worst, simplest;  ///< files; empty for what the baseline alone has
  Case case_of_simplest;
  std::optional<Case> case_of_worst;  ///< empty in a row of an older triage
  std::vector<Case> cases;            ///< of the reports; empty in a row of an older triage
  std::vector<std::string> reports;   ///< files
  std::vector<std::string> ids;       ///< of the reports

  std::optional<SignatureChange> change;  ///< empty: without a baseline
  std::string why;                        ///< the numbers that `change` follows from; may be empty
  std::optional<SignatureDecision> decision;

  /// True where the row makes a command exit with 1: new, worse or without a baseline, and no decision about it holds.
  bool stands() const;
  /// Findings that no report shows.
  std::uint64_t without_report() const { return findings - std::min<std::uint64_t>(findings, reports.size()); }
};

struct Triage {
  std::vector<std::string> sources;
  std::vector<std::pair<std::string, std::string>> skipped;
  std::vector<TriagedSignature> signatures;   ///< in the order of severity
  Sample sample;                              ///< what the runs asked and found
  SceneMeasure measure;                       ///< by which the subjects are judged that promise nothing
  std::vector<FiledReport> right_now;         ///< reports whose subject, asked again, is right
  std::uint64_t findings_right_now = 0;       ///< counted by the runs, of such reports and of their kinds
  std::uint64_t left_out = 0;                 ///< findings of rows that were taken out, as --ordinary does
  std::vector<ProposedConvention> proposals;  ///< undeclared conventions that explain rows
  bool all_examined = true;                   ///< false where the time was over or an interrupt came
};

struct TriageSettings {
  std::filesystem::path folder;  ///< for simplest cases and for what was examined before
  std::chrono::duration<double> time = std::chrono::minutes(5);
  /// Called often: what is done now, how much of it, and of how many.
  std::function<void(const std::string& activity, std::uint64_t done, std::uint64_t of)> tick;
  /// False for findings whose causes are not looked for. Without a function all are examined.
  std::function<bool(const FindingKind& kind, FeatureRegions regions)> is_examined{};
};

/// Asks the subject of every report again. Minimises a few reports of each kind (the worst, the simplest, and one of
/// each variant) and finds their causes. Findings that are probably one bug (one_bug.hpp) are one row; every other
/// report goes to the row of the examined case that is most like it. Results are kept in the folder by the id of the
/// report, and used again where the subject still gives the same answer.
///
/// The findings of all rows and those that are right now are together those that the indexes count, and one for each
/// report that none counts.
Triage triage(const Sources& sources, const TriageSettings& settings, Workers& workers);

/// The names of a part of a row with this cause. None depends on a case.
std::set<std::string> names_of_finding(const FindingPart& part, const Cause& cause);
/// The name of the row of the cases of a baseline that were right and are wrong now.
std::string name_of_wrong_now(const std::string& query, const std::string& subject);
/// The name of the row of a query's findings of extreme scenes.
std::string name_of_range(const std::string& query, const std::string& subject);
/// True where both have a name in common.
bool share_a_name(const TriagedSignature& a, const TriagedSignature& b);
/// Orders signatures: the project's own that stand first, then by severity; rows of a range last.
void rank(std::vector<TriagedSignature>& signatures);

}  // namespace nearmiss
