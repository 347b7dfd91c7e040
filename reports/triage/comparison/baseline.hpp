/// Compares the signatures of a triage with those of an earlier one, and with what was decided about them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reports/triage/triage.hpp"

namespace nearmiss {

/// The rows of an earlier triage, and what its runs had asked and found.
struct Baseline {
  std::vector<TriagedSignature> rows;
  Sample sample;  ///< empty in a file of an older version, and where reports came without an index
};

/// That of the file of an earlier triage, or of a run folder: FOLDER/triage/triage.json where it is there; otherwise
/// its reports are triaged as `settings` say, and those whose subject is right now make rows of their own by kind.
/// Throws BadInput.
Baseline read_baseline(const std::string& name, const TriageSettings& settings, Workers& workers);

/// Sets `change` of every signature, and adds the rows of the baseline that have no signature now: fixed where the
/// subject, asked their cases again, is right, otherwise known. Returns the subjects of rows that cannot be asked,
/// which are left out.
///
/// A row of the baseline and one of now are the same where they share a name, and the subject still errs in a case of
/// the baseline's row. No name depends on a seed or on a case. The cases of the baseline's run are drawn and asked
/// again, as far as the settings have time: there, one finding more is a proof. Findings in other cases are more
/// frequent with the error probability of rates.hpp. A promise that the baseline saw kept needs no proof: one finding
/// refutes it. What the baseline has is also worse where the subject, asked the worst case of the baseline again, errs
/// by at least twice as much.
std::vector<std::string> compare_with(const Baseline& baseline, Triage& now, const TriageSettings& settings,
                                      Workers& workers);

/// Lines "ID accepted|upstream|reported URL|fixed VERSION [at N %]  # why"; empty lines and lines that begin with # say
/// nothing. `where` is the name of the file, for messages. Throws BadInput for any other line, and for an ID twice.
std::vector<SignatureDecision> decisions_in(const std::string& text, const std::string& where);

/// Sets `decision` of the signatures with these ids among their names. A decision is open again where the proved size
/// is at least twice that of its line, and where a signature that was fixed in a version is here in this or a later
/// version. Returns the ids of no signature.
std::vector<std::string> apply(const std::vector<SignatureDecision>& decisions, Triage& now);

}  // namespace nearmiss
