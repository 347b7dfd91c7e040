/// Groups findings into signatures: what may be one bug is one row.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "reports/triage/causes/cause.hpp"
#include "reports/triage/examination/severity.hpp"
#include "reports/triage/examination/sources.hpp"

namespace nearmiss {

/// What became of a signature since the baseline.
enum class SignatureChange {
  fresh,  ///< the baseline does not have it
  worse,  ///< the proved size is at least twice that of the baseline
  known,  ///< the baseline has it
  fixed,  ///< the baseline has it, and the subject, asked its cases again, is right now
};
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

/// The findings with one signature: a row.
struct TriagedSignature {
  // The signature.
  std::string id;  ///< twelve hexadecimal digits, a hash of the signature: the same in every triage
  FindingKind kind;
  Cause cause;
  std::uint64_t branches = 0;  ///< of the oracle on the simplest case
  FeatureRegions regions;      ///< those that the finding needs: of the simplest case

  std::string version;    ///< of the subject
  bool examined = false;  ///< false: the time was over, and the cause is not known
  ErrorSize size;         ///< of the worst
  double severity = 0;
  std::string headline;         ///< of the worst
  std::uint64_t findings = 0;   ///< of all cases, also those without a report
  double ordinary_share = 0;    ///< of these
  std::string worst, simplest;  ///< files; empty for what the baseline alone has
  Case case_of_simplest;
  std::vector<std::string> reports;  ///< files
  std::vector<std::string> ids;      ///< of the reports

  std::optional<SignatureChange> change;  ///< empty: without a baseline
  std::optional<SignatureDecision> decision;

  /// True where the row makes a command exit with 1: new, worse or without a baseline, and no decision about it holds.
  bool stands() const;
};

struct Triage {
  std::vector<std::string> sources;
  std::vector<std::pair<std::string, std::string>> skipped;
  std::vector<TriagedSignature> signatures;  ///< in the order of severity
  std::vector<FiledReport> right_now;        ///< reports whose subject, asked again, is right
  bool all_examined = true;                  ///< false where the time was over or an interrupt came
};

struct TriageSettings {
  std::filesystem::path folder;  ///< for simplest cases and for what was examined before
  std::chrono::duration<double> time = std::chrono::minutes(5);
  /// Called often: what is done now, how much of it, and of how many.
  std::function<void(const std::string& activity, std::uint64_t done, std::uint64_t of)> tick;
};

/// Asks the subject of every report again. Minimises a few reports of each kind (the worst, the simplest, and one of
/// each variant), finds their causes, and puts every report to the one that is like it. Results are kept in the folder
/// by the id of the report, and used again where the subject still gives the same answer.
Triage triage(const Sources& sources, const TriageSettings& settings, Workers& workers);

/// The hash of a signature.
std::string id_of(const TriagedSignature& s);
/// True for signatures that differ at most in the key of their cause, where one of them has none: both may be one bug.
bool differs_in_key_alone(const TriagedSignature& a, const TriagedSignature& b);
/// Orders signatures: the project's own that stand first, then by severity.
void rank(std::vector<TriagedSignature>& signatures);

}  // namespace nearmiss
