/// Reads a run folder, and repairs it after a run that was killed.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace nearmiss {

/// Of the index of a run (reports/run.schema.json).
inline constexpr int run_schema_version = 2;

/// A written report, as an index lists it.
struct WrittenReport {
  std::string file;  ///< its path below the run folder
  std::string id, query, subject, verdict, disagreement, headline;
  std::string breakage{};  ///< the kind of a breakage; empty for a violation
  std::optional<double> above{};
  bool earlier = false;  ///< written by an earlier run in the same folder
};

nlohmann::ordered_json written_to_json(const WrittenReport& w);

/// Every report in findings/ of the folder, in the order of names. Skips other files.
std::vector<WrittenReport> reports_on_disk(const std::filesystem::path& folder);

/// Those of the files that are no longer on the disk, by their paths below the folder: others have removed them.
std::vector<std::string> vanished_from(const std::filesystem::path& folder, const std::vector<std::string>& files);
/// "2 of 64 reports have vanished from FOLDER, the first is findings/…"; empty without any.
std::string vanished_text(const std::vector<std::string>& vanished, std::size_t of,
                          const std::filesystem::path& folder);

/// Repairs a folder whose run was killed: its index says "running", but no process holds the lock. The index becomes
/// that of an interrupted run and lists every report on disk; partial files are removed. Returns true where it repaired
/// the folder. Call it before reading a run folder. Leaves files that cannot be read or written.
bool settle_run(const std::filesystem::path& folder);
/// The same for every subfolder of `parent`.
void settle_runs_below(const std::filesystem::path& parent);
/// The same for the run folder that contains `file`, if any.
void settle_run_of(const std::filesystem::path& file);

}  // namespace nearmiss
