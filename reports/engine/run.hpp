/// A run: asks many subjects many cases, counts the findings, and keeps the worst as reports.
///
/// The run folder holds index.json (reports/run.schema.json), which is written at the start, about every second and at
/// the end, and findings/QUERY/SUBJECT-FAULT-ID.json, each written at the end of its batch.
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

#include "reports/engine/campaign.hpp"
#include "reports/engine/climber.hpp"
#include "reports/engine/counts.hpp"
#include "reports/engine/folder_lock.hpp"
#include "reports/engine/kept_reports.hpp"
#include "reports/engine/progress.hpp"
#include "reports/engine/run_folder.hpp"

namespace nearmiss {

/// The folder in the environment variable NEARMISS_RUNS, or reports/runs/ of the source tree.
std::filesystem::path runs_folder();
/// A folder like "20260131T235959Z-42" in runs_folder().
std::filesystem::path new_run_folder(std::uint64_t seed);

/// The state of a run at the time of its index.
enum class RunState { running, finished, interrupted, failed };
std::string_view name_of(RunState s);

struct RunSettings {
  std::string command;  ///< as typed
  std::filesystem::path folder;
  std::vector<const Query*> queries;
  std::vector<const Subject*> subjects;
  std::uint64_t seed = 0;
  std::optional<std::chrono::steady_clock::time_point> until;  ///< when to stop; empty: by number of cases
  bool by_class = false;                 ///< also count by mutator, for table_by_class() and the index
  const scenes::Scene* scene = nullptr;  ///< where generated cases are taken from; nullptr: the generator
  bool every_answer = false;             ///< also judge every answer of a subject that is often wrong
};

class Run {
 public:
  using Clock = Campaign::Clock;

  /// Makes the folder and writes the first index. Throws IoError where it cannot, and
  /// BadInput where another run has locked the folder.
  /// Later writes throw too; the message then states how far the run came.
  explicit Run(RunSettings settings);
  /// Without a previous finish() it marks the run as failed in the index, even on a full disk.
  ~Run();

  /// Asks these subjects too from now on: all of the run so far and those that have become available.
  void extend(std::vector<const Subject*> subjects);

  /// Asks every subject of the run that offers the query and computes in the scalar of the cases. All cases are of one
  /// query and one scalar. Stops early on should_stop().
  void examine(std::span<const Case> cases);
  /// Asks those of these subjects of the run that offer the query, in any scalar; a case that the scalar cannot hold
  /// exactly is out of domain. `listener` is an additional sink, or nullptr.
  void examine_by(std::span<const Subject* const> subjects, const Case& question, Sink* listener = nullptr);
  /// The same with all subjects of the run.
  void examine_by_all(const Case& question) { examine_by(settings_.subjects, question); }
  /// Examines generated cases: `cases` for each query and subject, or without a number until the time is over. Queries
  /// take turns, so that each gets the same time while it has cases left. Subjects with the same preconditions get the
  /// same cases, which meet these preconditions. With a scene, `cases` of its mix for each subject.
  void generate(std::optional<std::uint64_t> cases);
  /// Asks the run's own subjects their stored worst cases (corpus/worst/). Asks nothing where a measure replaces the
  /// contracts, within which these cases are the worst. Throws BadInput for an invalid file.
  void ask_worst_cases();
  /// Climbs towards the worst errors, until each climb has asked its number of cases or the time is over. Notes the
  /// climbs in the index. The worst case of each climb becomes worst/QUERY/SUBJECT-KIND.json in the run folder, written
  /// when it is found, at most once for each hill.
  void climb(Climber& climber);

  /// True when the run was interrupted or its time is over.
  bool should_stop() const { return campaign_.should_stop(); }
  void set_until(Clock::time_point until) { campaign_.set_until(until); }
  /// Adds a part beyond the counts, such as "stored" or "fuzz", to the index.
  void note(const std::string& part, nlohmann::ordered_json value);
  void set_activity(std::string what);
  /// Call it during work outside this class: shows progress, and updates the index from time to time.
  void tick();

  /// Writes the last index, with the state interrupted or finished, and with the reports that have vanished.
  void finish();
  /// Writes tables.txt: the counts of each query and subject, the exact touches and the worst findings.
  void write_tables() const;
  /// One line with the number of answers, the time, the violations and the reports.
  std::string summary() const;
  /// One line where the run was interrupted, had no time for a single case, or has lost reports; empty otherwise.
  std::optional<std::string> shortfall() const;
  /// Errors of the judge itself, which are never counted as findings.
  const InternalErrors& internal_errors() const { return campaign_.internal_errors(); }
  const Counts& counts() const { return counts_; }
  const KeptReports& kept() const { return kept_; }
  /// The reports of this run alone.
  std::vector<WrittenReport> written_now() const;
  const RunSettings& settings() const { return settings_; }
  /// 0; 1 for violations; 2 for a shortfall() without violations; InternalError::exit_code after an internal error.
  int exit_code() const;

 private:
  struct Notes;
  /// Forwards to the current additional sink.
  struct Listener : Sink {
    Sink* to = nullptr;
    void take(const Examined& e) override {
      if (to != nullptr) to->take(e);
    }
    bool needs_second(const Examined& e) const override { return to != nullptr && to->needs_second(e); }
  };
  std::vector<const Subject*> offering(const Query& query, std::span<const Subject* const> subjects) const;
  void write_record(const Climb& c, std::map<const Climb*, double>& written) const;
  void write_index(RunState state);
  std::string lost_text() const;
  void write(const std::filesystem::path& below, const std::string& text) const;

  RunSettings settings_;
  std::optional<FolderLock> lock_;
  std::string started_;
  Clock::time_point begin_, indexed_;
  Clock::duration indexing_{};  ///< time of the last write of the index
  std::unique_ptr<Notes> notes_;
  Progress progress_;
  std::optional<std::uint64_t> total_;
  bool finished_ = false;
  std::vector<std::string> vanished_;  ///< found by finish(): reports that are no longer on the disk
  Counts counts_;
  KeptReports kept_;
  Listener listener_;
  Campaign campaign_;
};

}  // namespace nearmiss
