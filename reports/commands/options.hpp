/// Options that several commands have, with checks that say what would be right.
#pragma once

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "impl/catalogue/query.hpp"
#include "impl/subject/subject.hpp"

namespace nearmiss {

std::vector<std::string> query_names();
std::vector<std::string> subject_names();

/// --patience, --plugin and --command, the latter repeatable; what they name is loaded before later options are
/// checked.
void declare_foreign_subjects(CLI::App& app);

/// Takes only the name of a query.
CLI::Validator known_query();

/// --query and --subject, repeatable and checked; none means all.
struct Selection {
  std::vector<std::string> query, subject;

  void declare_queries(CLI::App& app);
  /// With --plugin and --command: their subjects may be chosen too.
  void declare_subjects(CLI::App& app);
  std::vector<const Query*> queries() const;
  std::vector<const Subject*> subjects() const;
  /// Throws BadInput unless one of the subjects offers one of the queries.
  void check_offered() const;
};

/// Takes only whole numbers from `low` to `high`: 100000, 100,000 or 1e5.
CLI::Validator whole_number(std::uint64_t low, std::uint64_t high);
/// Takes only decimal numbers above zero and up to `high`.
CLI::Validator positive_number(double high);
CLI::Validator number_from(double low, double high);

/// An option whose text is a whole number, checked when it is parsed.
void add_whole_number(CLI::App& app, const std::string& name, std::optional<std::uint64_t>& value,
                      const std::string& description, std::uint64_t low, std::uint64_t high);
void add_positive_number(CLI::App& app, const std::string& name, std::optional<double>& value,
                         const std::string& description, const std::string& unit, double high);

/// An option that names a folder to write into, so never the empty text.
/// --measure, with its default in the text.
void add_measure(CLI::App& app, std::optional<double>& measure);
void add_output_folder(CLI::App& app, std::string& folder, const std::string& description);

/// `given`, or else one drawn from the system's entropy.
std::uint64_t seed_or_random(std::optional<std::uint64_t> given);

/// What commands share that ask generated cases: how many or how long, which ones, by which promise, and into which
/// folder.
struct Amount {
  std::uint64_t default_cases;
  std::optional<std::uint64_t> cases, seed;
  std::optional<double> seconds, measure;
  std::string out;

  /// --cases, --seconds, --seed, --measure and --out. `what` is what --cases counts: "Cases of each query".
  void declare(CLI::App& app, const std::string& what, const std::string& folder);
  /// Empty where there is a time instead.
  std::optional<std::uint64_t> number() const;
  /// When the time is over that begins now; empty where there is a number of cases instead.
  std::optional<std::chrono::steady_clock::time_point> until() const;
  std::filesystem::path folder(std::uint64_t chosen_seed) const;
};

}  // namespace nearmiss
