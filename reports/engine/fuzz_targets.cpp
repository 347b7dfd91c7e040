#include "reports/engine/fuzz_targets.hpp"

#include <fmt/format.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>

#include "corpus/files/files.hpp"
#include "corpus/files/source_folder.hpp"
#include "corpus/storage/store.hpp"
#include "impl/host/hosts.hpp"
#include "impl/host/supervisor.hpp"
#include "reports/engine/interrupt.hpp"

namespace nearmiss {

namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
namespace fs = std::filesystem;

/// How long a target may take to end after SIGUSR1, for it executes its case to the end, and again after SIGINT.
constexpr auto grace = 3s;
/// The same where the whole run is cancelled.
constexpr auto short_grace = 300ms;
/// The most resident memory of a target, in MiB: libFuzzer stores the case and ends the target. An exact answer takes a
/// few MiB, and the address sanitizer as much again.
constexpr int most_mebibytes = 2048;
/// libFuzzer's limit for one case: beyond it, it stores the case and ends the target.
constexpr int seconds_for_one_case = 10;

/// True where the file contains an option name of libFuzzer. A target of a plain build has its own main and cannot
/// fuzz.
bool has_libfuzzer(const fs::path& file) {
  constexpr std::string_view mark("\0max_total_time\0", 16);
  std::ifstream in(file, std::ios::binary);
  std::string block(std::size_t{1} << 20, '\0');
  std::size_t kept = 0;  // the end of the previous block, where the mark may begin
  while (in.read(block.data() + kept, std::streamsize(block.size() - kept)) || in.gcount() > 0) {
    const std::size_t filled = kept + std::size_t(in.gcount());
    if (memmem(block.data(), filled, mark.data(), mark.size()) != nullptr) return true;
    kept = std::min(filled, mark.size() - 1);
    std::copy_n(block.data() + filled - kept, kept, block.data());
  }
  return false;
}

std::vector<fs::path> usual_folders() {
  std::error_code error;
  const fs::path executable = fs::read_symlink("/proc/self/exe", error);
  const fs::path build = executable.parent_path().parent_path();
  return {build / "fuzz", build.parent_path() / "fuzz" / "fuzz", fs::path(source_folder()) / "build/fuzz/fuzz"};
}

/// The targets of the queries, without their programs.
std::vector<BuiltTarget> targets_of(std::span<const Query* const> queries) {
  std::vector<BuiltTarget> all;
  for (const FuzzTarget& t : fuzz_targets()) {
    BuiltTarget chosen{&t, {}, {}};
    std::copy_if(queries.begin(), queries.end(), std::back_inserter(chosen.queries),
                 [&](const Query* q) { return t.asks(*q); });
    if (!chosen.queries.empty()) all.push_back(std::move(chosen));
  }
  return all;
}

BuiltTargets targets_in(const fs::path& folder, std::span<const Query* const> queries) {
  BuiltTargets found;
  found.where = folder.string();
  for (BuiltTarget& t : targets_of(queries)) {
    t.file = folder / fmt::format("fuzz_{}", t.target->name);
    if (!interrupted() && fs::is_regular_file(t.file) && has_libfuzzer(t.file)) {
      found.targets.push_back(std::move(t));
    } else {
      found.missing.emplace_back(t.target->name);
    }
  }
  return found;
}

/// A number of the statistics that libFuzzer prints at its end: "stat::KEY: N".
std::uint64_t statistic_in(const fs::path& log, std::string_view key) {
  std::ifstream in(log);
  for (std::string line; std::getline(in, line);) {
    const std::size_t at = line.find("stat::");
    if (at == std::string::npos || line.compare(at + 6, key.size(), key) != 0) continue;
    return std::strtoull(line.c_str() + at + 6 + key.size() + 1, nullptr, 10);
  }
  return 0;
}

std::vector<std::string> asked_in(const fs::path& log) {
  static constexpr std::string_view key = "asks:";
  std::ifstream in(log);
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with(key)) continue;
    std::istringstream names(line.substr(key.size()));
    return {std::istream_iterator<std::string>(names), {}};
  }
  return {};
}

}  // namespace

std::vector<std::string> environment_for_added(const ForeignSubjects& foreign) {
  const char* named = std::getenv("NEARMISS_SUBJECTS");
  const std::string before = named == nullptr || *named == '\0' ? "" : fmt::format("{},", named);
  return {fmt::format("NEARMISS_SUBJECTS={}added", before),
          fmt::format("{}={}", plugins_variable, fmt::join(foreign.plugins, ":")),
          fmt::format("{}={}", commands_variable, fmt::join(foreign.commands, "\n"))};
}

std::vector<std::string> environment_of_target(const BuiltTarget& target, const ForeignSubjects& foreign,
                                               const fs::path& run_folder, const std::string& profile) {
  std::vector<std::string> environment = environment_for_added(foreign);
  std::vector<std::string_view> queries;
  for (const Query* q : target.queries) queries.push_back(q->name);
  environment.push_back(fmt::format("NEARMISS_QUERIES={}", fmt::join(queries, ",")));
  environment.push_back("NEARMISS_FUZZ_REPORTS=" + (run_folder / "fuzz").string());
  if (!profile.empty()) environment.push_back("NEARMISS_PROFILE=" + fs::absolute(profile).string());
  return environment;
}

BuiltTargets find_fuzz_targets(const std::optional<fs::path>& folder, std::span<const Query* const> queries) {
  if (folder) return targets_in(*folder, queries);
  std::string searched;
  for (const fs::path& f : usual_folders()) {
    BuiltTargets found = targets_in(f, queries);
    if (!found.targets.empty()) return found;
    const std::string name = f.lexically_normal().string();
    if (searched.find(name) == std::string::npos) searched.append(searched.empty() ? "" : ", ").append(name);
  }
  BuiltTargets none;
  for (const BuiltTarget& t : targets_of(queries)) none.missing.emplace_back(t.target->name);
  none.where = searched;
  return none;
}

void put_seeds(const BuiltTarget& target, const fs::path& run_folder) {
  const fs::path corpus = run_folder / "corpus" / target.target->name;
  make_folder(corpus);
  for (const Query* q : target.queries) {
    for (const StoredCase& s : stored_cases(*q)) {
      const std::vector<std::uint8_t> bytes = target.target->bytes_of(s.question);
      write_file(corpus / fmt::format("seed-{}-{}", q->name, s.file.stem().string()),
                 {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    }
  }
}

namespace {

std::string without_leaks() {
  const char* named = std::getenv("ASAN_OPTIONS");
  return fmt::format("ASAN_OPTIONS={}{}detect_leaks=0", named == nullptr ? "" : named, named == nullptr ? "" : ":");
}

Program program_of(const BuiltTarget& target, const FuzzBudget& budget, const fs::path& log) {
  const fs::path reports = budget.run_folder / "fuzz";
  Program p;
  p.arguments = {target.file.string(),
                 (budget.run_folder / "corpus" / target.target->name).string(),
                 fmt::format("-artifact_prefix={}/", (reports / target.target->name).string()),
                 "-print_final_stats=1",
                 fmt::format("-timeout={}", seconds_for_one_case),
                 fmt::format("-rss_limit_mb={}", most_mebibytes)};
  p.environment = environment_of_target(target, budget.foreign, budget.run_folder, budget.profile);
  p.environment.push_back(without_leaks());
  p.log = log.string();
  return p;
}

/// The first of fuzz/TARGET-1.log, fuzz/TARGET-2.log … that does not exist.
fs::path free_name_like(const fs::path& log) {
  for (int n = 1;; ++n) {
    const fs::path name = log.parent_path() / fmt::format("{}-{}.log", log.stem().string(), n);
    if (!fs::exists(name)) return name;
  }
}

/// How a target was told to end. SIGUSR1 and SIGINT make libFuzzer print its statistics and leave: after the present
/// case, and at once.
enum class Asked { no, after_its_case, at_once, by_force };

}  // namespace

struct RunningTarget::State {
  State(const BuiltTarget& target, const FuzzBudget& budget)
      : name(target.target->name),
        log(budget.run_folder / "fuzz" / (name + ".log")),
        deadline(begin + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(budget.seconds))),
        child(program_of(target, budget, log), Confinement::none()) {}

  std::string name;
  fs::path log;
  Clock::time_point begin = Clock::now(), deadline;
  SupervisedProcess child;
  Asked asked_to_end = Asked::no;
};

RunningTarget::RunningTarget(const BuiltTarget& target, const FuzzBudget& budget) {
  make_folder(budget.run_folder / "corpus" / target.target->name);
  make_folder(budget.run_folder / "fuzz" / target.target->name);
  state_ = std::make_unique<State>(target, budget);
}

RunningTarget::~RunningTarget() = default;

bool RunningTarget::has_ended(int milliseconds, bool cancelled) {
  State& s = *state_;
  if (s.child.has_ended(milliseconds)) return true;
  if (cancelled && s.asked_to_end < Asked::at_once) s.deadline = Clock::now();
  if (Clock::now() < s.deadline) return false;
  s.deadline = Clock::now() + (cancelled ? Clock::duration(short_grace) : Clock::duration(grace));
  switch (s.asked_to_end) {
    case Asked::no:
      s.asked_to_end = cancelled ? Asked::at_once : Asked::after_its_case;
      s.child.send(cancelled ? SIGINT : SIGUSR1);
      break;
    case Asked::after_its_case:
      s.asked_to_end = Asked::at_once;
      s.child.send(SIGINT);
      break;
    case Asked::at_once:
      s.asked_to_end = Asked::by_force;
      s.child.end();
      break;
    case Asked::by_force: break;
  }
  return false;
}

FuzzOutcome RunningTarget::outcome() {
  State& s = *state_;
  FuzzOutcome o;
  o.target = s.name;
  o.seconds = std::chrono::duration<double>(Clock::now() - s.begin).count();
  o.executions = statistic_in(s.log, "number_of_executed_units");
  o.new_inputs = statistic_in(s.log, "new_units_added");
  o.ended =
      s.asked_to_end == Asked::by_force ? "ended by force: it did not end when it was told to" : s.child.exit_text();
  o.failed = s.child.failed_to_start() != 0 || (s.child.exit_code() != 0 && s.asked_to_end == Asked::no);
  o.asked = asked_in(s.log);
  std::error_code error;
  if (o.failed) fs::copy_file(s.log, free_name_like(s.log), error);  // the next turn replaces the log
  return o;
}

}  // namespace nearmiss
