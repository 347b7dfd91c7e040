/// A sweep: every float in the place of one number of a case. Subjects are asked in this process, each decision is
/// compared with the proved truth of its slice, and each answer that differs goes to the judge.
///
/// The folder holds sweep.json (reports/sweep.schema.json), the result and the state: written at the start, about twice
/// a second and at the end. A sweep in the same folder goes on where the last one ended, in whatever way that one
/// ended.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "impl/subject/subject.hpp"
#include "reports/engine/folder_lock.hpp"
#include "reports/engine/internal_errors.hpp"
#include "reports/engine/progress.hpp"
#include "reports/engine/run_folder.hpp"
#include "reports/engine/slice.hpp"
#include "reports/engine/sweep_counts.hpp"

namespace nearmiss {

struct SweepSettings {
  std::string command;  ///< as typed
  std::filesystem::path folder;
  Slice slice;
  std::vector<Subject> subjects;                 ///< of scalar float; functions of this process answer
  std::uint64_t begin = 0, end = finite_floats;  ///< positions of floats (float_at)
  unsigned jobs = 1;
};

/// Floats without gap that every subject was asked.
struct SweptRange {
  std::uint64_t begin, end;
  std::vector<TruthRange> truth;
};

/// Adds a range to an ordered list of ranges that do not overlap; joins it with its neighbours.
void insert(std::vector<SweptRange>& done, const SweptRange& range);

class Sweep {
 public:
  /// Floats in the unit of work: an eighth of those between two powers of two.
  static constexpr std::uint64_t chunk = 1u << 20;

  /// Makes or opens the folder. Throws IoError where it cannot, and BadInput where another process holds it, where it
  /// has the state of another sweep, and where that state cannot be true.
  explicit Sweep(SweepSettings settings);

  /// Asks what is left; an interrupt stops it early. Then writes the reports and the final state.
  void run();

  /// Every float of the given range was asked, except those that break a rule of the query.
  bool is_complete() const;
  /// The same for all finite floats.
  bool is_exhaustive() const;
  const std::vector<SweptRange>& done() const { return done_; }
  const std::vector<SweepCounts>& counts() const { return counts_; }

  /// The counts of each subject.
  std::string table() const;
  /// One sentence for each subject, and one about the floats at which the decision changes.
  std::string summary() const;
  /// Where the sweep is not complete: how to go on.
  std::optional<std::string> shortfall() const;
  /// 0; 1 for violations; 2 after an interrupt without violations; InternalError::exit_code after an internal error.
  int exit_code() const;
  nlohmann::ordered_json to_json() const;

 private:
  struct ChunkResult {
    SweptRange range;
    std::vector<SweepCounts> counts;
    std::vector<std::pair<std::size_t, InternalError>> internal_errors;  ///< with the index of the subject
  };

  nlohmann::ordered_json identity() const;
  /// Reads the state. Throws BadInput where it is that of another sweep or where a part of it cannot be true.
  void load();
  void check_identity(const FileValue& state) const;
  void load_counts(const FileValue& subjects);
  void check_truth(const std::string& file) const;
  bool is_done(std::uint64_t position) const;
  std::vector<SweptRange> left() const;
  void work(const std::vector<SweptRange>& chunks);
  void work_or_fail(const std::vector<SweptRange>& chunks);
  std::optional<ChunkResult> examine(const SweptRange& floats) const;
  void wait_for_threads(std::uint64_t floats);
  void collect();
  void take(const ChunkResult& result);
  void write();
  void write_reports();
  bool stopping() const;
  std::uint64_t floats_done(bool valid) const;
  std::uint64_t bad() const;
  std::uint64_t internal_errors() const;
  double seconds() const;
  std::string coverage_text() const;
  std::string sentence(std::size_t subject) const;
  std::string changes_text() const;
  std::vector<std::string> table_row(std::size_t subject) const;
  nlohmann::ordered_json truth_to_json() const;

  SweepSettings settings_;
  std::optional<FolderLock> lock_;
  Progress progress_;
  InternalErrors internal_errors_;
  std::vector<SweptRange> done_;
  std::vector<SweepCounts> counts_;
  std::vector<WrittenReport> reports_;
  double seconds_before_ = 0;  ///< of earlier sessions
  std::chrono::steady_clock::time_point started_, written_;

  // Shared with the threads.
  std::atomic<std::size_t> next_{0};
  std::atomic<unsigned> working_{0};
  std::atomic<bool> failed_{false};
  std::mutex mutex_;
  std::vector<ChunkResult> finished_;  ///< not yet collected
  std::exception_ptr failure_;
};

}  // namespace nearmiss
