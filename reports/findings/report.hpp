/// A report: a finding with the data to verify, replay, group and fix it.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "oracles/judge.hpp"
#include "reports/findings/static_check.hpp"
#include "reports/findings/workers.hpp"

namespace nearmiss {

/// The answer of a referee to the same case, and its finding. It never changes the verdict.
struct Opinion {
  std::string referee;
  std::string version;
  Answer answer;
  Finding finding;  ///< judged without a contract: agrees, or differs
};

struct Report {
  Case question;  ///< in the subject's scalar
  std::string subject;
  std::string version;
  Answer answer;
  std::string output{};              ///< for a subject that broke: the end of its standard output and error
  std::optional<SceneLimits> scene;  ///< the requirements of the scene that replaced the measure
  Standard standard;
  std::vector<Declaration> declared{};  ///< the conventions by which the answer is judged
  Finding finding;
  Truth truth;
  std::vector<Opinion> referees;
  std::vector<StaticCheck> static_checks;  ///< checks of times of contact
  std::string replay;                      ///< the command that replays it; the writer of the file sets it
};

/// Asks the subject and the referees, judges, and collects a report. The subject must offer the query, and the case
/// must be in its scalar.
Report examine(const Case& question, const Subject& subject, Workers& workers);
/// The same for an answer that the subject has already given.
Report examine(const Case& question, const Subject& subject, const Answer& answer, Workers& workers);

/// True for a violation of the contract, an excess of the measure, or a subject that broke. Such a finding makes a
/// command exit with 1.
bool is_bad(const Finding& f);
/// The fault in one word, for file names and groups: "false-miss", "broke", "none".
std::string fault_of(const Finding& f);
/// Twelve hexadecimal digits, a hash of query, subject, fault and inputs: the same in every run.
std::string id_of(const Report& r);

/// The report in the form of reports/report.schema.json.
nlohmann::ordered_json report_to_json(const Report& r);
nlohmann::ordered_json answer_to_json(const Query& query, const Answer& answer);
nlohmann::ordered_json truth_to_json(const Query& query, Scalar scalar, const Truth& truth);
/// A line of reports/truth.schema.json: the truth of a report, after the query and the scalar. Its decimals are left
/// out, or have no sign that they are rounded, so that every language reads them.
nlohmann::ordered_json truth_line_to_json(const Case& question, const Truth& truth, bool with_decimals);
nlohmann::ordered_json finding_to_json(const Case& question, const Finding& f);
/// {"name", "unit", "position_error", "missed_depth", "time_error"}
nlohmann::ordered_json limits_to_json(const SceneLimits& limits);
/// [{"convention", "sentence"}]; the sentence is left out where none is given.
nlohmann::ordered_json declarations_to_json(const std::vector<Declaration>& declared);
/// The versions of Nearmiss and the compiler, the build type and the platform.
nlohmann::ordered_json environment_to_json();
inline constexpr int report_schema_version = 2;

/// True where an output of an answer has a meaning: it is given and, for a "no", a depth, a flag or an index.
bool is_part(const Query& query, const Answer& answer, std::size_t output);

}  // namespace nearmiss
