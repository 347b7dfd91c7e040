/// Runs the property tests as processes for a given time. The command line never links them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "reports/engine/fuzz_targets.hpp"

namespace nearmiss {

/// The test program; empty where this build has none.
std::optional<std::filesystem::path> find_property_tests();

struct PropertyBudget {
  std::filesystem::path run_folder;  ///< receives properties/ with reports and logs
  ForeignSubjects foreign;           ///< also tested
  std::uint64_t seed = 0;            ///< the seed of the first pass; each pass adds 1
  double seconds = 1;
  std::function<void()> tick;  ///< called about twenty times a second
  std::function<bool()> cancelled;
};

/// The result of all passes.
struct PropertyOutcome {
  std::uint64_t passed = 0;
  std::vector<std::string> failed;  ///< names of tests
  std::vector<std::uint64_t> seeds;
  double seconds = 0;
  std::string ended;  ///< how the program ended where it gave no result; empty otherwise
};

/// Runs the property tests of the tiers of collide, of the subjects of NEARMISS_ADD and of foreign subjects, and the
/// tests that watch the judge, in passes with fresh seeds until the time is over. The first pass asks few cases, so
/// that even a night of ten minutes asks every test. The seed also shuffles the order of the tests. Messages go to
/// properties/SEED.log, the report of a failed test to properties/QUERY/.
PropertyOutcome run_property_tests(const std::filesystem::path& program, const PropertyBudget& budget);

}  // namespace nearmiss
