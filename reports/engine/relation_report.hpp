/// Reports of broken relations: a case, those that it is related to, and answers that do not go together.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "corpus/relations/verdict.hpp"
#include "reports/engine/replay.hpp"
#include "reports/findings/report.hpp"

namespace nearmiss {

/// Which of its relations a case is about.
struct RelationChoice {
  const Relation* relation = nullptr;
  std::uint64_t seed = 0;    ///< of the follow-ups, where there is a choice
  bool bit_for_bit = false;  ///< the subject is held to the same bits
};

struct RelationReport {
  RelationChoice choice;
  Agreement agreement = Agreement::same;
  Breach breach = Breach::none;
  std::string broken;           ///< which promise is broken, and by what
  std::string oracle;           ///< not empty: Nearmiss contradicts itself
  std::vector<Report> answers;  ///< one for each case, the case itself first
  std::string replay;           ///< the command that replays it; set by whoever writes it to a file
};

/// Asks about the case and its follow-ups, with second opinions on each. Empty: no follow-ups, or not offered.
std::optional<RelationReport> examine_relation(const RelationChoice& choice, const Case& question,
                                               const Subject& subject, Workers& workers);
/// The same for answers that the subject has given already.
RelationReport report_of(const RelationChoice& choice, const RelationFinding& found, const Subject& subject,
                         Workers& workers);

/// A broken promise: what makes a command exit with 1. A contradiction alone is none.
bool is_bad(Breach b);
/// One of "none", "contradiction", "bits", "contract", "broke", "oracle".
std::string_view breach_of(const RelationReport& r);
std::string id_of(const RelationReport& r);
std::string headline(const RelationReport& r);
/// What does not go together, which answer is wrong, and whether either of them breaks its contract.
std::string explanation(const RelationReport& r);
/// A report as reports/report.schema.json has it, of the case itself, with the member "relation".
nlohmann::ordered_json report_to_json(const RelationReport& r);

/// A report of a relation, read back. Empty where the file is none. Throws BadInput: malformed, or made by a version
/// whose table of relations leads to other follow-ups.
struct RelationCase {
  Case question;
  RelationChoice choice;
  std::string subject;
};
std::optional<RelationCase> read_relation_case(const std::filesystem::path& file);
/// The same for what was read from `file` already.
std::optional<RelationCase> read_relation_case(const nlohmann::json& j, const std::string& file);

/// What every subject says to a case and its follow-ups.
struct RelationReplay {
  std::string file;
  std::vector<RelationReport> reports;
  std::vector<Replay::Unasked> unasked;
};
RelationReplay replay(const RelationCase& related, const std::string& file, std::span<const Subject* const> subjects,
                      Workers& workers);
std::string replay_text(const RelationCase& related, const RelationReplay& r);

}  // namespace nearmiss
