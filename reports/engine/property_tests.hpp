/// The property tests as processes: found beside the command line, run for a time, never linked.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "reports/engine/fuzz_targets.hpp"

namespace nearmiss {

/// The program, where this build has it.
std::optional<std::filesystem::path> find_property_tests();

struct PropertyBudget {
  std::filesystem::path run_folder;  ///< receives properties/ with reports and logs
  ForeignSubjects foreign;           ///< they are held to the properties as well
  std::uint64_t seed = 0;            ///< of the first pass; each further one has the next
  double seconds = 1;
  std::function<void()> tick;  ///< called about twenty times a second
  std::function<bool()> cancelled;
};

/// What became of all passes together.
struct PropertyOutcome {
  std::uint64_t passed = 0;
  std::vector<std::string> failed;  ///< names of tests
  std::vector<std::uint64_t> seeds;
  double seconds = 0;
  std::string ended;  ///< how it ended where that was no result; empty otherwise
};

/// Holds the tiers of collide, the subjects of NEARMISS_ADD and foreign ones to the properties of generated cases, and
/// the judge to its watch, with fresh seeds, in an order that the seed says, until the time is over. What a test says
/// goes to properties/SEED.log, the report of a failing one to properties/QUERY/.
PropertyOutcome run_property_tests(const std::filesystem::path& program, const PropertyBudget& budget);

}  // namespace nearmiss
