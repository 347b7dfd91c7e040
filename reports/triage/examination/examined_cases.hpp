/// The simplest cases and causes of findings, kept in files so that a triage goes on where an earlier one ended.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "reports/triage/causes/cause.hpp"
#include "reports/triage/examination/sources.hpp"

namespace nearmiss {

/// A finding that was minimised, and its cause.
struct ExaminedCase {
  Case simplest;
  std::filesystem::path file;  ///< the report of the simplest case
  std::uint64_t branches = 0;  ///< of the oracle on it
  FeatureRegions regions;
  Cause cause;
};

class ExaminedCases {
 public:
  /// Reports of simplest cases are written to FOLDER/simplest/QUERY/SUBJECT-FAULT-ID.json, and what else is known to
  /// FOLDER/examined/ID.json, where the last ID is that of the report that was minimised.
  ExaminedCases(std::filesystem::path folder, Workers& workers) : folder_(std::move(folder)), workers_(workers) {}

  /// What was found before; empty where nothing was, and where the subject has another version or gives another answer
  /// to the simplest case.
  std::optional<ExaminedCase> earlier(const FiledReport& of);
  /// Minimises the report's case, or a plainer one with the same fault, and finds the cause, at most in about so much
  /// time. Empty where the subject is right now, or after an interrupt.
  std::optional<ExaminedCase> examine(const FiledReport& of, const Case& plain, std::chrono::duration<double> time,
                                      const std::function<void(std::uint64_t)>& tick);
  /// Adds the ranges of the numbers to the report of the simplest case, which examine() leaves out: most simplest cases
  /// are no row's. A report that has ranges stays as it is.
  void add_ranges(const ExaminedCase& e, const Subject& subject, std::chrono::duration<double> time,
                  const std::function<void(std::uint64_t)>& tick);

 private:
  std::filesystem::path file_of(const FiledReport& r) const { return folder_ / "examined" / (r.id + ".json"); }

  std::filesystem::path folder_;
  Workers& workers_;
};

}  // namespace nearmiss
