/// The result of a triage as files: its own JSON, SARIF 2.1.0 for code scanners, and JUnit XML for CI servers.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "reports/triage/triage.hpp"

namespace nearmiss {

/// In the form of reports/triage.schema.json.
nlohmann::ordered_json triage_to_json(const Triage& t);
/// The signatures of such JSON. Throws BadInput, with `where` in the message, where it is none.
std::vector<TriagedSignature> signatures_from_json(const nlohmann::json& j, const std::string& where);
/// What its runs asked and found; empty in a file of an older version. Throws BadInput.
Sample sample_in_triage(const nlohmann::json& j, const std::string& where);
/// How its subjects were judged that promise nothing; empty in a file of an older version. Throws BadInput.
std::optional<SceneMeasure> measure_in_triage(const nlohmann::json& j, const std::string& where);

/// SARIF 2.1.0 (OASIS): one result per signature. What does not make the command exit with 1 is a note, and suppressed
/// where a decision is the reason.
nlohmann::ordered_json triage_to_sarif(const Triage& t);
/// JUnit XML: one test per signature. It fails where the signature stands, is skipped where it is known or decided, and
/// passes where it is fixed.
std::string triage_to_junit(const Triage& t);

}  // namespace nearmiss
