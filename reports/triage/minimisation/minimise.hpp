/// Reduces the case of a finding to a simpler one with the same finding, and measures which of its numbers matter.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "corpus/files/file_value.hpp"
#include "reports/findings/report.hpp"

namespace nearmiss {

/// A range of values of one number of a case, around its own value. With every asked value of the range, and all other
/// numbers as they are, the subject's answer has the same finding. Asked were the ends, and values from the number on
/// at distances that double.
struct SameFinding {
  std::size_t number = 0;    ///< index among the query's inputs
  double low = 0, high = 0;  ///< numbers of the case's scalar
  /// The end is that of the valid values: the next number beyond it breaks a rule of the input, or is infinite.
  bool to_lowest = false, to_highest = false;

  /// The finding is the same with every asked value.
  bool plays_no_part() const { return to_lowest && to_highest; }
};

struct Minimised {
  /// What ended the search for a simpler case.
  enum class End { simplest, questions, time, interrupted };
  /// What ended the search for ranges; `not_sought`: nothing asked for them, or a file does not say.
  enum class RangesEnd { all, not_sought, time, interrupted };

  Report report;                    ///< of the simplest case found
  std::vector<SameFinding> ranges;  ///< of each number but flags and indices, in order
  RangesEnd ranges_end = RangesEnd::not_sought;
  std::uint64_t questions = 0;  ///< how often the subject was asked
  End end = End::simplest;
};

struct MinimiseLimits {
  std::uint64_t questions = 20000;
  std::chrono::duration<double> time = std::chrono::minutes(1);
  /// First leaves each region (corpus/generator/feature_regions.hpp) that the finding does without, then enters no
  /// other. So the simplest case of one mistake does not become a case of another, and its regions are those that the
  /// finding needs.
  bool stays_in_regions = false;
  bool finds_ranges = true;  ///< false: `ranges` stays empty; add_ranges() finds them
};

/// Empty where nothing is to be found against the subject's answer. The subject must offer the query, and the case must
/// be in its scalar and meet its preconditions. The limits are those of the search for a simpler case; the ranges get
/// the same time again. Deterministic, unless the time ends. `tick` is called after each question with their number.
std::optional<Minimised> minimise(const Case& question, const Subject& subject, const MinimiseLimits& limits,
                                  Workers& workers, const std::function<void(std::uint64_t)>& tick);

/// The ranges of the numbers of a case, for at most this time, and how often the subject was asked for them. Empty
/// where nothing is to be found against the subject's answer.
std::optional<Minimised> ranges_around(const Case& question, const Subject& subject, std::chrono::duration<double> time,
                                       Workers& workers, const std::function<void(std::uint64_t)>& tick);

std::string_view name_of(Minimised::End end);
std::string_view name_of(Minimised::RangesEnd end);
/// A list for the member "same_finding" of "minimised".
nlohmann::ordered_json ranges_to_json(const std::vector<SameFinding>& ranges, const Case& question);
/// The report with the member "minimised" (reports/report.schema.json).
nlohmann::ordered_json minimised_to_json(const Minimised& m);
/// The inverse for the member "minimised" of a report. A number that the query does not have is left out. Throws
/// BadInput.
Minimised minimised_from_json(const FileValue& minimised, const Report& report);
/// Which numbers matter, as a table.
std::string ranges_text(const Minimised& m);

}  // namespace nearmiss
