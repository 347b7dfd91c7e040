/// Compares the findings of two run folders without asking anything.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "reports/findings/finding_kind.hpp"

namespace nearmiss {

/// The findings of one kind in two runs.
struct KindInRuns {
  enum class Change { fresh, gone, worse, known };
  struct InRun {
    std::uint64_t findings = 0;
    std::uint64_t asked = 0;        ///< cases of the query that the subject was asked
    std::optional<double> above{};  ///< the largest proved bound of a report, in epsilon
    std::string file{};             ///< the report with this bound, below the run folder

    double rate() const { return asked == 0 ? 0 : double(findings) / double(asked); }
  };

  FindingKind kind;
  InRun before, after;
  /// `worse`: the proved bound is at least twice that of before. A kind that the later run did not ask at all is not
  /// `gone` but left out.
  Change change = Change::known;
};
std::string_view name_of(KindInRuns::Change c);

/// Every kind of either run: new, worse, known, gone; the most frequent first. Kinds of queries or subjects that one of
/// the runs did not ask are left out. Throws BadInput for a folder without the index of a run.
std::vector<KindInRuns> compare_runs(const std::filesystem::path& before, const std::filesystem::path& after);

/// In the form of reports/diff.schema.json.
nlohmann::ordered_json diff_to_json(const std::filesystem::path& before, const std::filesystem::path& after,
                                    const std::vector<KindInRuns>& kinds);
/// A table of at most 100 columns, unless names are long, and the reports of what is new or worse.
std::string diff_text(const std::filesystem::path& after, const std::vector<KindInRuns>& kinds);

}  // namespace nearmiss
