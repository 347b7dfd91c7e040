#include "reports/engine/property_tests.hpp"

#include <fmt/format.h>

#include <chrono>
#include <fstream>

#include "impl/host/supervisor.hpp"
#include "reports/engine/fuzz_targets.hpp"

namespace nearmiss {

namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
namespace fs = std::filesystem;

/// The tests whose cases depend on the seed.
constexpr std::string_view with_seeds =
    "*EveryTier.AnswersKeepTheirContract*:*EveryTierRelated*:*CertifiedPostconditions*:*CertifiedTier*:*Watch*";

/// With at least this many seconds, the tests that watch the judge use twenty times as many answers for each query.
constexpr double time_for_long_watch = 3 * 3600;
constexpr std::string_view long_watch = "NEARMISS_WATCH_ANSWERS=1000000";

/// The first pass asks few cases, so that a short night has every test once; the others ask as many as the tests do by
/// themselves.
constexpr int cases_of_first_pass = 4, cases_of_a_pass = 200;
constexpr std::string_view first_watch = "NEARMISS_WATCH_ANSWERS=500";

/// Counts the lines of GoogleTest: "[       OK ] NAME (12 ms)", or FAILED in place of OK.
void count(const fs::path& log, PropertyOutcome& o) {
  std::ifstream in(log);
  for (std::string line; std::getline(in, line);) {
    const std::size_t name = line.find("] "), time = line.rfind(" (");
    if (name == std::string::npos || time == std::string::npos || !line.ends_with(" ms)")) continue;
    if (line.starts_with("[       OK ]")) ++o.passed;
    if (!line.starts_with("[  FAILED  ]")) continue;
    o.failed.push_back(line.substr(name + 2, std::min(time, line.find(", where ")) - name - 2));
  }
}

}  // namespace

std::optional<fs::path> find_property_tests() {
  std::error_code error;
  const fs::path executable = fs::read_symlink("/proc/self/exe", error);
  const fs::path program = executable.parent_path().parent_path() / "properties" / "nearmiss_properties";
  return fs::is_regular_file(program, error) ? std::optional(program) : std::nullopt;
}

PropertyOutcome run_property_tests(const fs::path& program, const PropertyBudget& budget) {
  const auto begin = Clock::now();
  const auto end = begin + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(budget.seconds));
  const fs::path folder = budget.run_folder / "properties";
  fs::create_directories(folder);
  PropertyOutcome o;
  for (std::uint64_t seed = budget.seed; Clock::now() + 1s < end && !budget.cancelled() && o.ended.empty(); ++seed) {
    const fs::path log = folder / fmt::format("{}.log", seed);
    std::vector<std::string> environment = environment_for_added(budget.foreign);
    environment.push_back(fmt::format("NEARMISS_SEED={}", seed));
    environment.push_back(fmt::format("NEARMISS_RUNS={}", budget.run_folder.string()));
    const bool is_first = seed == budget.seed;
    if (is_first) environment.emplace_back(first_watch);
    if (!is_first && budget.seconds >= time_for_long_watch) environment.emplace_back(long_watch);
    environment.push_back(fmt::format("RC_PARAMS=seed={} max_success={} noshrink=1", seed,
                                      is_first ? cases_of_first_pass : cases_of_a_pass));
    // GoogleTest accepts seeds for its order up to 99999.
    Program tests;
    tests.arguments = {program.string(), fmt::format("--gtest_filter={}", with_seeds), "--gtest_shuffle",
                       "--gtest_color=no", fmt::format("--gtest_random_seed={}", 1 + seed % 99999)};
    tests.environment = std::move(environment);
    tests.log = log.string();
    SupervisedProcess child(tests, Confinement::none());
    bool stopped = false;
    while (!child.has_ended(50)) {
      budget.tick();
      if (Clock::now() < end && !budget.cancelled()) continue;
      child.end();  // an unfinished test has no result
      stopped = true;
    }
    o.seeds.push_back(seed);
    count(log, o);
    if (stopped) break;
    // A test program of GoogleTest exits with 0 or 1.
    if (child.exit_code().value_or(2) > 1) o.ended = fmt::format("{}, see {}", child.exit_text(), log.string());
    if (child.exit_code() == 0 && o.passed == 0) o.ended = fmt::format("no test ran, see {}", log.string());
  }
  o.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  return o;
}

}  // namespace nearmiss
