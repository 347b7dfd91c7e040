/// A report: a finding with everything needed to believe, replay, group and fix it.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "oracles/judge.hpp"
#include "reports/findings/static_check.hpp"
#include "reports/findings/workers.hpp"

namespace nearmiss {

/// What a referee says to the same case, and the judge about it. It decides nothing.
struct Opinion {
  std::string referee;
  std::string version;
  Answer answer;
  Finding finding;  ///< judged with no contract: agrees, or differs
};

struct Report {
  Case question;  ///< in the subject's scalar
  std::string subject;
  std::string version;
  Answer answer;
  std::string output{};  ///< the end of what the subject had written when it broke: standard output and error
  Standard standard;
  Finding finding;
  Truth truth;
  std::vector<Opinion> referees;
  std::vector<StaticCheck> static_checks;  ///< of times of contact
  std::string replay;                      ///< the command that replays it; set by whoever writes the report to a file
};

/// Asks, judges and collects. The subject offers the query and the case is in its scalar.
Report examine(const Case& question, const Subject& subject, Workers& workers);
/// The same for an answer that the subject has given already.
Report examine(const Case& question, const Subject& subject, const Answer& answer, Workers& workers);

/// A violation of the contract, an excess of the measure, or a subject that broke: what makes a command exit with 1.
bool is_bad(const Finding& f);
/// How it is wrong, in one word for files and groups: "false-miss", "broke", "none".
std::string fault_of(const Finding& f);
/// Twelve hexadecimal digits, a hash of query, subject, fault and inputs: the same in every run.
std::string id_of(const Report& r);

/// As reports/report.schema.json has it.
nlohmann::ordered_json report_to_json(const Report& r);
nlohmann::ordered_json answer_to_json(const Query& query, const Answer& answer);
nlohmann::ordered_json truth_to_json(const Query& query, Scalar scalar, const Truth& truth);
nlohmann::ordered_json finding_to_json(const Case& question, const Finding& f);
/// Nearmiss, compiler and platform.
nlohmann::ordered_json environment_to_json();
inline constexpr int report_schema_version = 2;

/// The members of an answer that mean something: those given and, of a "no", its depth at most.
bool is_part(const Query& query, const Answer& answer, std::size_t output);

}  // namespace nearmiss
