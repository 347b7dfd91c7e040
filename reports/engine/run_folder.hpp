/// What is in a run folder, whatever became of the run.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace nearmiss {

/// A report that was written, as an index lists it.
struct WrittenReport {
  std::string file;  ///< below the run folder
  std::string id, query, subject, verdict, disagreement, headline;
  std::string breakage{};  ///< its kind; empty for a violation
  std::optional<double> above{};
  bool earlier = false;  ///< of an earlier run in the same folder
};

nlohmann::ordered_json written_to_json(const WrittenReport& w);

/// Every report in findings/ of the folder, in the order of their names. A file that is none is passed over.
std::vector<WrittenReport> reports_on_disk(const std::filesystem::path& folder);

/// A run whose process was killed leaves an index that says that it is running. Where that is so, and nobody has the
/// folder, the index becomes that of an interrupted run that lists every report on disk, and what was half written is
/// removed. True where there was something to do. Whoever reads a run folder calls this first; what cannot be read or
/// written stays.
bool settle_run(const std::filesystem::path& folder);
/// The same for every folder directly below.
void settle_runs_below(const std::filesystem::path& parent);
/// The same for the run folder that a file lies in, if it does in one.
void settle_run_of(const std::filesystem::path& file);

}  // namespace nearmiss
