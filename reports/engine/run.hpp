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

#include "reports/engine/campaign.hpp"
#include "reports/engine/counts.hpp"
#include "reports/engine/folder_lock.hpp"
#include "reports/engine/kept_reports.hpp"
#include "reports/engine/progress.hpp"
#include "reports/engine/run_folder.hpp"

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
  using Clock = Campaign::Clock;

  /// Makes the folder and writes the first index. Throws IoError where it cannot, and
  /// BadInput where another run has locked the folder.
  /// The same goes for whatever is written later: the line says how far the run came.
  explicit Run(RunSettings settings);
  /// Without finish() the run has failed, and its index says so, even where no other byte can be written.
  ~Run();

  /// Asks every subject of the run that offers the query and computes in the cases' scalar. All cases
  /// are of one query and one scalar. Stops early when it should.
  void examine(std::span<const Case> cases);
  /// Asks every subject that offers the query, whatever its scalar; a case that it cannot hold exactly
  /// is out of its domain. `listener`, where there is one, takes every finding too.
  void examine_by_all(const Case& question, Sink* listener = nullptr);
  /// Cases of the generator: `cases` for each query and subject, or without a number until the time is
  /// over. Queries take turns, so that each gets the same time as long as it has cases left. Subjects that require the
  /// same get the same cases, fitted to that.
  void generate(std::optional<std::uint64_t> cases);

  /// True when it was interrupted or its time is over.
  bool should_stop() const { return campaign_.should_stop(); }
  void set_until(Clock::time_point until) { campaign_.set_until(until); }
  /// A part of the run beyond its counts, such as "stored" or "fuzz", for the index.
  void note(const std::string& part, nlohmann::ordered_json value);
  void set_activity(std::string what);
  /// For work outside of this class: shows progress, and brings the index up to date from time to time.
  void tick();

  /// Writes the last index. The run is interrupted or finished.
  void finish();
  /// One line: what was asked and what came of it.
  std::string summary() const;
  /// One line, where fewer cases were asked than were wanted: interrupted, or no time for a single one.
  std::optional<std::string> shortfall() const;
  /// Answers about which the judge contradicts itself: told and kept, never counted among the findings.
  const InternalErrors& internal_errors() const { return campaign_.internal_errors(); }
  const Counts& counts() const { return counts_; }
  const KeptReports& kept() const { return kept_; }
  const RunSettings& settings() const { return settings_; }
  /// 0, 1 for violations, 2 without any where there is a shortfall(); InternalError's where there was one.
  int exit_code() const;

 private:
  struct Notes;
  /// Hands on to whoever listens at the moment.
  struct Listener : Sink {
    Sink* to = nullptr;
    void take(const Examined& e) override {
      if (to != nullptr) to->take(e);
    }
  };
  std::vector<const Subject*> offering(const Query& query) const;
  void write_index(RunState state);
  void write(const std::filesystem::path& below, const std::string& text) const;

  RunSettings settings_;
  std::optional<FolderLock> lock_;
  std::string started_;
  Clock::time_point begin_, indexed_;
  Clock::duration indexing_{};  ///< what it took to write the index last
  std::unique_ptr<Notes> notes_;
  Progress progress_;
  std::optional<std::uint64_t> total_;
  bool finished_ = false;
  Counts counts_;
  KeptReports kept_;
  Listener listener_;
  Campaign campaign_;
};

}  // namespace nearmiss
