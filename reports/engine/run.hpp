/// A run: many cases through many subjects, counted, with the worst findings kept as reports.
///
/// The run folder holds index.json, which reports/run.schema.json describes (written when the run
/// begins, about every second, and at its end), and findings/QUERY/SUBJECT-FAULT-ID.json, each written
/// as soon as it is found.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "reports/engine/folder_lock.hpp"
#include "reports/engine/internal_errors.hpp"
#include "reports/engine/progress.hpp"
#include "reports/findings/report.hpp"
#include "reports/engine/run_folder.hpp"
#include "reports/engine/tally.hpp"
#include "reports/engine/touches.hpp"
#include "reports/findings/workers.hpp"

namespace nearmiss {

/// reports/runs/ of the source tree, or what the environment variable NEARMISS_RUNS says.
std::filesystem::path runs_folder();
/// "20260131T235959Z-42" within runs_folder().
std::filesystem::path new_run_folder(std::uint64_t seed);

/// Where a run was when it was last written down.
enum class RunState { running, finished, interrupted, failed };
std::string_view name_of(RunState s);

struct RunSettings {
  std::string command;  ///< as typed
  std::filesystem::path folder;
  std::vector<const Query*> queries;
  std::vector<const Subject*> subjects;
  std::uint64_t seed = 0;
  std::optional<std::chrono::steady_clock::time_point> until;  ///< when to stop, if not by number of cases
  bool by_class = false;  ///< count by the generator's moves as well, for table_by_class() and the index
};

class Run {
 public:
  using Clock = std::chrono::steady_clock;

  /// Makes the folder and writes the first index. Throws BadInput where it cannot, or where another run has the folder.
  /// The same goes for whatever is written later: the line says how far the run came.
  explicit Run(RunSettings settings);
  /// Without finish() the run has failed, and its index says so, even where no other byte can be written.
  ~Run();

  /// Asks every subject of the run that offers the query and computes in the cases' scalar. All cases
  /// are of one query and one scalar. Stops early when it should. `meanwhile` is done while the subjects answer. A case
  /// outside of what a subject requires is counted as not asked.
  void examine(std::span<const Case> cases, const std::function<void()>& meanwhile = {});
  /// Asks every subject that offers the query, whatever its scalar; a case that it cannot hold exactly
  /// is out of its domain. Calls `each` with every finding.
  void examine_by_all(const Case& question, const std::function<void(const Subject&, const Finding&)>& each = {});
  /// Cases of the generator: `cases` for each query and subject, or without a number until the time is
  /// over. Queries take turns, so that each gets the same time as long as it has cases left. Subjects that require the
  /// same get the same cases, fitted to that.
  void generate(std::optional<std::uint64_t> cases);

  /// True when it was interrupted or its time is over.
  bool should_stop() const;
  void set_until(Clock::time_point until) { settings_.until = until; }
  /// A part of the run beyond its tallies, such as "stored" or "fuzz", for the index.
  void note(const std::string& part, nlohmann::ordered_json value);
  void doing(std::string what);
  /// For work outside of this class: shows progress, and brings the index up to date from time to time.
  void tick();

  /// Writes the last index. The run is interrupted or finished.
  void finish();
  /// One line: what was asked and what came of it.
  std::string summary() const;
  /// Answers about which the judge contradicts itself: told and kept, never counted among the findings.
  const InternalErrors& internal_errors() const { return internal_errors_; }
  /// One line, where fewer cases were asked than were wanted: interrupted, or no time for a single one.
  std::optional<std::string> shortfall() const;
  /// Violations and breakages.
  std::uint64_t bad() const;
  std::uint64_t cases() const;
  /// A table for people: one row for each query and subject, and how often the exact stage had to decide; empty where
  /// nothing was asked.
  std::string table() const;
  /// For every subject its findings among the cases that each move of the generator made; with settings().by_class.
  std::string table_by_class() const;
  /// What the subjects make of exact touches: counts where some are no, and who has two conventions; empty without any.
  std::string touches_text() const;
  /// Headline and file of the worst reports, one for each query, subject and fault; empty without any.
  std::string worst_findings() const;
  const RunSettings& settings() const { return settings_; }
  /// 0, 1 for violations, 2 without any where there is a shortfall(); InternalError's where there was one.
  int exit_code() const;

 private:
  struct Pending;
  struct Notes;
  /// How often each of the oracle's stages decided, of all subjects together.
  struct Stages {
    std::uint64_t interval = 0, exact = 0;
    double exact_share() const { return exact == 0 ? 0 : double(exact) / double(interval + exact); }
  };
  Stages stages_of(const Query& query) const;
  std::string stages_text() const;
  std::string breakages_text() const;
  std::string given_up_text() const;
  Tally& tally(const Query& query, const Subject& subject);
  std::vector<const Subject*> asked(const Query& query, Scalar scalar) const;
  bool goes_on();
  void examine(const std::vector<const Subject*>& subjects, std::span<const Case> cases,
               const std::function<void()>& meanwhile);
  /// Judges the answer, counts what comes of it, and says what that is; empty where the judge contradicts itself.
  std::optional<Finding> take(const Case& question, const Subject& subject, const Answer& answer, std::string_view output);
  void count(const Case& question, const Subject& subject, const Answer& answer, const Finding& f, std::string_view output);
  void write_pending();
  void write_report(const Pending& p);
  void write_index(RunState state);
  void write(const std::filesystem::path& below, const std::string& text) const;
  std::string violated_text() const;
  std::size_t reports() const;

  RunSettings settings_;
  std::optional<FolderLock> lock_;
  std::string started_;
  Clock::time_point begin_, indexed_;
  Clock::duration indexing_{};  ///< what it took to write the index last
  Workers workers_;
  std::map<std::pair<const Query*, const Subject*>, Tally> tallies_;
  std::map<std::pair<const Subject*, std::string>, Tally> by_class_;
  Keeper keeper_;
  InternalErrors internal_errors_;
  Touches touches_;
  std::vector<Pending> pending_;
  std::vector<WrittenReport> written_;  ///< those of earlier runs in the folder first
  std::unique_ptr<Notes> notes_;
  Progress progress_;
  std::optional<std::uint64_t> total_;
  std::uint64_t cases_ = 0, bad_ = 0;
  bool finished_ = false;
};

}  // namespace nearmiss
