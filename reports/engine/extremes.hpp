/// Maps the worst errors of a subject over distance, size, speed, ratio of sizes and angle; over the ranges of a scene
/// with the scene's own cases.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "impl/subject/subject.hpp"
#include "reports/engine/campaign.hpp"
#include "reports/engine/map_cases.hpp"
#include "reports/engine/progress.hpp"

namespace nearmiss {

struct ExtremesSettings {
  std::string command;  ///< as typed
  std::filesystem::path folder;
  std::vector<const Query*> queries;
  std::vector<const Subject*> subjects;
  std::uint64_t seed = 1;
  std::uint64_t cases = 50;  ///< in each cell
  std::string scene;         ///< its name; empty: generated cases
  std::shared_ptr<const MapCases> source = generated_map_cases();
};

/// What is proved against the answers to the cases of one cell of a map. Contracts play no part: cells where nothing is
/// promised are measured too.
struct ExtremesCell {
  std::uint64_t cases = 0;       ///< answered; fewer where some cases do not fit the scalar
  std::uint64_t false_hits = 0;  ///< never added to the false misses
  std::uint64_t false_misses = 0;
  std::uint64_t not_finite = 0;  ///< answers with NaN or infinity
  std::uint64_t broke = 0;       ///< exception, abort, crash, limit
  std::uint64_t no_answer = 0;   ///< the subject reported that it has no answer
  std::uint64_t not_asked = 0;   ///< the case does not meet the subject's preconditions
  std::uint64_t gave_up =
      0;                    ///< not asked after too many time-outs in the row or in the map, or where it always breaks
  double forward_ulps = 0;  ///< lower bound for the worst number of an answer with the right decision
  double backward_epsilon = -1;  ///< largest proved bound; negative where nothing is proved
};

struct ExtremesMap {
  const Query* query;
  const Subject* subject;
  MapPlane plane;
  std::size_t number_of_plane;      ///< among those of the query
  std::vector<ExtremesCell> cells;  ///< row by row: y selects the row, x the column
  std::uint64_t time_outs = 0, time_outs_in_row = 0;
  std::uint64_t answered = 0, broke = 0;  ///< cases so far
  bool always_breaks = false;             ///< in the first most_broken cases, and in the most ordinary cell

  /// After this many time-outs the subject is given up: in the row, and in the whole map.
  static constexpr std::uint64_t most_in_row = 3, most = 12;
  /// After this many breakages without an answer the most ordinary cell is asked: a map begins in a corner of extreme
  /// numbers, where a subject may break that answers elsewhere.
  static constexpr std::uint64_t most_broken = Dispatcher::most_broken_in_row;
  bool given_up() const { return always_breaks || time_outs_in_row >= most_in_row || time_outs >= most; }
};

class Extremes {
 public:
  /// Makes the folder. Throws IoError where it cannot.
  explicit Extremes(ExtremesSettings settings);
  ~Extremes();

  /// Fills the maps; an interrupt stops it early.
  void fill();
  /// Writes extremes.json (reports/extremes.schema.json) and, where this build has the drawing library, the page
  /// extremes.html.
  void write() const;

  /// A table with the worst cell of each query and subject.
  std::string table() const;
  std::string summary() const;
  /// 0; 2 after an interrupt; InternalError::exit_code after an internal error.
  int exit_code() const;
  nlohmann::ordered_json to_json() const;
  /// The page with its data and library; empty where the build did not find the drawing library.
  static std::optional<std::string> page(const nlohmann::ordered_json& report);

 private:
  void fill(const Query& query, Scalar scalar, std::size_t plane);
  void ask(const std::vector<ExtremesMap*>& maps, std::size_t cell, std::span<const Case> cases);
  /// Tells whether the subject breaks in the most ordinary cell, too.
  void look_whether_it_always_breaks(ExtremesMap& m, std::span<const Case> ordinary);
  ExtremesSettings settings_;
  std::vector<ExtremesMap> maps_;
  Progress progress_;
  std::uint64_t done_ = 0, total_ = 0, asked_ = 0;
  class Place;
  std::unique_ptr<Place> place_;
  Campaign campaign_;
};

}  // namespace nearmiss
