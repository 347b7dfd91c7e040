/// Asks every subject one case again, and prints the answers as a page.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "reports/findings/report.hpp"

namespace nearmiss {

/// The case of a case file, of a stored case or of a report. Throws BadInput.
Case read_case_or_report(const std::filesystem::path& file);
/// The same for JSON that was already read from `file`.
Case case_of(const nlohmann::json& j, const std::string& file);
/// The measure of the report's subject, with what its scene required, and the conventions that the subject declared;
/// the usual measure where the file has none. Throws BadInput.
SceneMeasure measure_of(const nlohmann::json& j, const std::string& file);
/// The same of the member "measure" of a file: {"error", "for_all", "scene"}. Throws BadInput.
SceneMeasure measure_in(const nlohmann::json& measure, const std::string& file);
nlohmann::ordered_json measure_to_json(const SceneMeasure& m);
/// The same with a given measure in place of the report's own, and of its scene.
SceneMeasure measure_or(std::optional<double> given, const nlohmann::json& j, const std::string& file);

/// The subject of a report; empty for JSON that is no report. Throws BadInput where no such subject is loaded.
std::optional<const Subject*> subject_of_report(const nlohmann::json& j, const std::string& file);

/// What the command of a report adds: the options as words of the shell, and what they start.
struct AddedByReport {
  std::string options;  ///< "--command 'python3 x.py'"; empty where it adds nothing
  std::string started;
};
/// Empty where the command of the report is none that asks a subject again. Anybody may have written the report: a
/// reader is shown no other command, and is told what this one starts.
std::optional<AddedByReport> added_by(const nlohmann::json& report);

/// One case and its reports, one for each subject that was asked.
struct Replay {
  Case question;
  std::string file;
  Truth truth;
  std::vector<Report> reports;
  struct Unasked {
    std::string subject, why;
  };
  std::vector<Unasked> unasked;  ///< the subject does not offer the query, or cannot be asked the case
};

Replay replay(const Case& question, const std::string& file, std::span<const Subject* const> subjects,
              Workers& workers);
/// The command line that replays the file with this subject from any folder; it loads the subject's plugin or command.
std::string replay_command(const Subject& subject, const std::string& file);
std::string replay_text(const Replay& r);
/// The inputs of a case and its exact answer, as text.
std::string case_page(const Case& question, const Truth& truth);

}  // namespace nearmiss
