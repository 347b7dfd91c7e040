/// Reports of broken relations: a case, its follow-ups, and answers that contradict each other.
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

/// The relation by which a case is examined.
struct RelationChoice {
  const Relation* relation = nullptr;
  std::uint64_t seed = 0;    ///< selects the follow-ups, where the relation has a choice
  bool bit_for_bit = false;  ///< the subject must give the same bits
};

struct RelationReport {
  RelationChoice choice;
  Agreement agreement = Agreement::same;
  Breach breach = Breach::none;
  std::string broken;           ///< the broken promise and the finding that breaks it
  std::string oracle;           ///< not empty: an error of Nearmiss itself
  std::vector<Report> answers;  ///< one for each case, the original case first
  std::string replay;           ///< the command that replays it; the writer of the file sets it
};

/// Examines the case and its follow-ups, with second opinions on each. Empty where there are no follow-ups, or the
/// subject does not offer their query.
std::optional<RelationReport> examine_relation(const RelationChoice& choice, const Case& question,
                                               const Subject& subject, Workers& workers);
/// The same for answers that the subject has already given.
RelationReport report_of(const RelationChoice& choice, const RelationFinding& found, const Subject& subject,
                         Workers& workers);

/// True for a broken promise, which makes a command exit with 1. A contradiction alone breaks no promise.
bool is_bad(Breach b);
/// One of "none", "contradiction", "bits", "contract", "broke", "oracle".
std::string_view breach_of(const RelationReport& r);
std::string id_of(const RelationReport& r);
std::string headline(const RelationReport& r);
/// The contradiction, the wrong answers, and whether any of them breaks its contract.
std::string explanation(const RelationReport& r);
/// The report of the original case in the form of reports/report.schema.json, with the member "relation".
nlohmann::ordered_json report_to_json(const RelationReport& r);

/// A case and relation, read from a report. read_relation_case() returns empty for a file of another kind. It throws
/// BadInput for a malformed file, and where the relation of this version leads to other follow-ups.
struct RelationCase {
  Case question;
  RelationChoice choice;
  std::string subject;
};
std::optional<RelationCase> read_relation_case(const std::filesystem::path& file);
/// The same for JSON that was already read from `file`.
std::optional<RelationCase> read_relation_case(const nlohmann::json& j, const std::string& file);

/// The reports of every subject on a case and its follow-ups.
struct RelationReplay {
  std::string file;
  std::vector<RelationReport> reports;
  std::vector<Replay::Unasked> unasked;
};
RelationReplay replay(const RelationCase& related, const std::string& file, std::span<const Subject* const> subjects,
                      Workers& workers);
std::string replay_text(const RelationCase& related, const RelationReplay& r);

}  // namespace nearmiss
