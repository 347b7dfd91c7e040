/// A check of continuous integration: what has changed since a baseline.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "reports/triage/comparison/baseline.hpp"

namespace nearmiss {

struct CheckSettings {
  std::string command;           ///< as typed
  std::filesystem::path folder;  ///< of the run of fresh cases; its triage is in triage/
  std::uint64_t seed = 0;        ///< of the fresh cases
  std::chrono::duration<double> time = std::chrono::minutes(1);
  std::function<void(const std::string& activity, std::uint64_t done, std::uint64_t of)> tick;
};

/// What was asked, and the rows that follow.
struct Check {
  Triage triage;  ///< of the fresh cases, compared with the baseline
  CasesNow kept;  ///< of all rows of the baseline
  Sample again;   ///< the answers to the cases of the baseline's run
  bool all_again = true;
  std::uint64_t seed = 0;
  std::string without_fresh;           ///< why no fresh cases were asked; empty where they were
  std::vector<std::string> not_asked;  ///< subjects of the baseline that cannot be asked here
};

/// Asks the cases that the baseline keeps; then those of its run, for at most two fifths of the time; then fresh ones
/// of its queries and subjects, for three tenths. The rest is for the causes of what may be new. The first two ask the
/// same in every check. Throws BadInput where no subject of the baseline can be asked, and IoError.
Check check_against(const Baseline& baseline, const CheckSettings& settings, Workers& workers);

/// One screen: what was asked, and the rows that are new, worse, open again or fixed.
std::string check_text(const Check& check);

}  // namespace nearmiss
