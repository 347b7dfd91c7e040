/// Options of several commands. The message of a failed check states the valid values.
#pragma once

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "corpus/scenes/scene_file.hpp"
#include "impl/catalogue/query.hpp"
#include "impl/subject/subject.hpp"

namespace nearmiss {

std::vector<std::string> query_names();

/// --patience, --plugin, --command and --declare; the last three are repeatable. Plugins and commands are loaded while
/// the arguments are parsed, before later options are checked; then conventions are declared. `loaded` receives the
/// names of the loaded subjects, plugins first; with it, a subject whose name another one has gets a number.
void declare_foreign_subjects(CLI::App& app, std::vector<std::string>* loaded = nullptr);

/// Accepts the name of a query.
CLI::Validator known_query();
/// Accepts the name of a subject.
CLI::Validator known_subject();

/// --query and --subject, repeatable and checked. Without any, all are selected.
struct Selection {
  std::vector<std::string> query, subject;

  void declare_queries(CLI::App& app);
  /// Also declares --plugin and --command, whose subjects may be selected too.
  void declare_subjects(CLI::App& app);
  std::vector<const Query*> queries() const;
  std::vector<const Subject*> subjects() const;
  /// Throws BadInput unless one of the subjects offers one of the queries.
  void check_offered() const;
};

/// --scene: where cases are taken from, in place of the generator.
struct SceneOption {
  std::string name;

  void declare(CLI::App& app);
  /// Empty without the option. Throws BadInput for an unknown scene or an invalid file.
  std::optional<scenes::Scene> load() const;
};
/// Sets the measure of the process: the given one for all subjects, or what the scene requires of those that promise
/// nothing. Neither: the usual measure.
void judge_by(std::optional<double> given_measure, const scenes::Scene* scene);
/// The line that states the measure, where it applies to one of the subjects and queries; otherwise empty.
std::string measure_line(std::span<const Query* const> queries, std::span<const Subject* const> subjects);

/// A line for each convention that one of the subjects declares for one of the queries; otherwise empty.
std::string declarations_line(std::span<const Query* const> queries, std::span<const Subject* const> subjects);

/// Selects the queries that the scene asks where none are selected. Throws BadInput for a selected query that the scene
/// does not ask.
void select_queries_of(const scenes::Scene& scene, Selection& selection);

/// Accepts whole numbers from `low` to `high`: 100000, 100,000 or 1e5.
CLI::Validator whole_number(std::uint64_t low, std::uint64_t high);
/// Accepts decimal numbers above zero and up to `high`.
CLI::Validator positive_number(double high);
CLI::Validator number_from(double low, double high);

/// An option whose text is a whole number, checked when it is parsed.
void add_whole_number(CLI::App& app, const std::string& name, std::optional<std::uint64_t>& value,
                      const std::string& description, std::uint64_t low, std::uint64_t high);
void add_positive_number(CLI::App& app, const std::string& name, std::optional<double>& value,
                         const std::string& description, const std::string& unit, double high);

/// --measure, with its default in the description.
void add_measure(CLI::App& app, std::optional<double>& measure);
/// --exact, for the commands that read case files of users.
void add_exact(CLI::App& app);
/// --out, the folder to write into; refuses an empty name.
void add_output_folder(CLI::App& app, std::string& folder, const std::string& description);

/// `given`, or a random seed from the system's entropy.
std::uint64_t seed_or_random(std::optional<std::uint64_t> given);

/// The options of commands that ask generated cases: their number or the time, the seed, the measure, and the folder.
struct Amount {
  std::uint64_t default_cases;
  std::optional<std::uint64_t> cases, seed;
  std::optional<double> seconds, measure;
  std::string out;

  /// Declares --cases, --seconds, --seed, --measure and --out. `what` describes the unit of --cases: "Cases of each
  /// query".
  void declare(CLI::App& app, const std::string& what, const std::string& folder);
  /// The number of cases; empty where a time is given.
  std::optional<std::uint64_t> number() const;
  /// The end of the given time, counted from now; empty where a number of cases is given.
  std::optional<std::chrono::steady_clock::time_point> until() const;
  std::filesystem::path folder(std::uint64_t chosen_seed) const;
};

}  // namespace nearmiss
