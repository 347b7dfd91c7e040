/// Compares the signatures of a triage with those of an earlier one, and with what was decided about them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "reports/triage/triage.hpp"

namespace nearmiss {

/// The rows of an earlier triage, and what its runs had asked and found.
struct Baseline {
  std::vector<TriagedSignature> rows;
  Sample sample;  ///< empty in a file of an older version, and where reports came without an index
  std::optional<SceneMeasure> measure{};  ///< empty in a file of an older version

  /// True where its runs asked the subject the query; in a file of an older version where it has findings.
  bool has_asked(const std::string& query, const std::string& subject) const;
};

/// That of the file of an earlier triage, or of a run folder: FOLDER/triage/triage.json where it is there; otherwise
/// its reports are triaged as `settings` say, and those whose subject is right now make rows of their own by kind.
/// Throws BadInput.
Baseline read_baseline(const std::string& name, const TriageSettings& settings, Workers& workers);

/// What has become of the cases of a row of a baseline.
struct CasesNow {
  std::size_t asked = 0;
  std::size_t wrong = 0;  ///< in the way of the row
  std::size_t gone = 0;   ///< right, or wrong in a way that another row of the baseline has

  bool is_fixed() const { return asked > 0 && gone == asked; }
  bool is_part_fixed() const { return wrong > 0 && gone > 0; }
};

/// What the subjects of now answer to the cases of a baseline. A case is right where it is right each time.
struct BaselineNow {
  using Of = std::pair<std::string, std::string>;  ///< query and subject

  std::vector<std::optional<CasesNow>> rows;  ///< by the index of the row; empty: it cannot be asked
  Sample again;                               ///< the answers to the cases of its run
  std::map<Of, std::vector<Case>> wrong_now;  ///< of these, those that were right
  std::map<Of, std::uint64_t> right_now;      ///< of these, the number of those that were wrong
  bool all_again = true;                      ///< false where the time was over before the last case of its run
};

/// Asks the cases that the baseline keeps, and then draws those of its run again, for at most the settings' time: those
/// of these queries and subjects, in this order.
BaselineNow ask_baseline(const Baseline& baseline, const std::vector<BaselineNow::Of>& order,
                         const TriageSettings& settings, Workers& workers);

/// Sets `change` of every signature, and adds the rows of the baseline that have no signature now. Returns the subjects
/// of rows that cannot be asked, which are left out.
///
/// A row of the baseline and one of now are the same where they share a name, and the subject still errs in a case of
/// the baseline's row. No name depends on a seed or on a case. The cases of the baseline's run are drawn and asked
/// again, as far as the settings have time: there, one finding more is a proof, and a case that was right and is wrong
/// now makes a new row where no other tells of it. Findings in other cases are more frequent with the error probability
/// of rates.hpp. A promise that the baseline saw kept needs no proof: one finding refutes it. What the baseline has is
/// also worse where the subject, asked the worst case of the baseline again, errs by at least twice as much.
///
/// A row of the baseline is fixed where each of its cases is gone: right each time, or wrong in the way of another row
/// of the baseline. It is fixed in part where some are gone, or where cases of the baseline's run are right now.
std::vector<std::string> compare_with(const Baseline& baseline, Triage& now, const TriageSettings& settings,
                                      Workers& workers);
/// The same with answers that are known.
std::vector<std::string> compare_with(const Baseline& baseline, const BaselineNow& asked, Triage& now,
                                      const TriageSettings& settings, Workers& workers);

/// Lines "ID accepted|upstream|reported URL|fixed VERSION [at N %]  # why"; empty lines and lines that begin with # say
/// nothing. `where` is the name of the file, for messages. Throws BadInput for any other line, and for an ID twice.
std::vector<SignatureDecision> decisions_in(const std::string& text, const std::string& where);

/// Sets `decision` of the signatures with these ids among their names. A decision is open again where the proved size
/// is at least twice that of its line, and where a signature that was fixed in a version is here in this or a later
/// version. Returns the ids of no signature.
std::vector<std::string> apply(const std::vector<SignatureDecision>& decisions, Triage& now);

}  // namespace nearmiss
