/// One case again: what every subject says to it, as a page for people.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "reports/findings/report.hpp"

namespace nearmiss {

/// The case of a case file, of a stored case or of a report. Throws BadInput.
Case read_case_or_report(const std::filesystem::path& file);
/// The same for what was read from `file` already.
Case case_of(const nlohmann::json& j, const std::string& file);
/// By what the report's subject was measured; the usual measure where the file says none. Throws BadInput.
Measure measure_of(const nlohmann::json& j, const std::string& file);

/// One case and its reports, one for each subject that was asked.
struct Replay {
  Case question;
  std::string file;
  Truth truth;
  std::vector<Report> reports;
  struct Unasked {
    std::string subject, why;
  };
  std::vector<Unasked> unasked;  ///< not offered, or the numbers are not exact in the subject's scalar
};

Replay replay(const Case& question, const std::string& file, std::span<const Subject* const> subjects,
              Workers& workers);
/// The command line that asks the subject again, from any folder, with its plugin or command where it is one.
std::string replay_command(const Subject& subject, const std::string& file);
std::string replay_text(const Replay& r);
/// A case and what is true of it, for people.
std::string case_page(const Case& question, const Truth& truth);

}  // namespace nearmiss
