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

#include "corpus/codec.hpp"
#include "corpus/store.hpp"
#include "impl/host/hosts.hpp"
#include "impl/host/supervisor.hpp"
#include "reports/engine/interrupt.hpp"

namespace nearmiss {

namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
namespace fs = std::filesystem;

/// How long a target may take beyond its time: to start, and to end after SIGINT.
constexpr auto grace = 3s;
/// The same where the whole run is cancelled.
constexpr auto short_grace = 300ms;
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
  return {build / "fuzz", build.parent_path() / "fuzz" / "fuzz", fs::path(NEARMISS_SOURCE_FOLDER) / "build/fuzz/fuzz"};
}

FuzzTargets targets_in(const fs::path& folder, std::span<const Query* const> queries) {
  FuzzTargets found;
  found.where = folder.string();
  for (const Query* q : queries) {
    const fs::path file = folder / fmt::format("fuzz_{}", q->name);
    if (!interrupted() && fs::is_regular_file(file) && has_libfuzzer(file)) {
      found.targets.push_back({q, file});
    } else {
      found.missing.emplace_back(q->name);
    }
  }
  return found;
}

void put_seeds(const Query& query, const fs::path& corpus) {
  for (const StoredCase& s : stored_cases(query)) {
    const std::vector<std::uint8_t> bytes = case_to_bytes(s.question);
    write_file(corpus / ("seed-" + s.file.stem().string()),
               {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  }
}

std::uint64_t executions_in(const fs::path& log) {
  static constexpr std::string_view key = "stat::number_of_executed_units:";
  std::ifstream in(log);
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with(key)) return std::strtoull(line.c_str() + key.size(), nullptr, 10);
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

FuzzTargets find_fuzz_targets(const std::optional<fs::path>& folder, std::span<const Query* const> queries) {
  if (folder) return targets_in(*folder, queries);
  std::string searched;
  for (const fs::path& f : usual_folders()) {
    FuzzTargets found = targets_in(f, queries);
    if (!found.targets.empty()) return found;
    const std::string name = f.lexically_normal().string();
    if (searched.find(name) == std::string::npos) searched.append(searched.empty() ? "" : ", ").append(name);
  }
  FuzzTargets none;
  for (const Query* q : queries) none.missing.emplace_back(q->name);
  none.where = searched;
  return none;
}

FuzzOutcome fuzz(const FuzzTarget& target, const FuzzBudget& budget) {
  const std::string query(target.query->name);
  const fs::path corpus = budget.run_folder / "corpus" / query, reports = budget.run_folder / "fuzz";
  const fs::path artifacts = reports / query, log = reports / (query + ".log");
  fs::create_directories(corpus);
  fs::create_directories(artifacts);
  put_seeds(*target.query, corpus);
  const auto begin = Clock::now();
  const std::vector<std::string> arguments{target.file.string(),
                                           corpus.string(),
                                           fmt::format("-max_total_time={}", budget.seconds),
                                           fmt::format("-artifact_prefix={}/", artifacts.string()),
                                           "-print_final_stats=1",
                                           fmt::format("-timeout={}", seconds_for_one_case)};
  std::vector<std::string> environment = environment_for_added(budget.foreign);
  environment.push_back("NEARMISS_FUZZ_REPORTS=" + reports.string());
  Program program;
  program.arguments = arguments;
  program.environment = environment;
  program.log = log.string();
  SupervisedProcess child(program, Confinement::none());
  bool end_requested = false, is_forced = false;
  for (auto deadline = begin + std::chrono::seconds(budget.seconds) + grace; !child.has_ended(50);) {
    budget.tick();
    if (!end_requested && (Clock::now() > deadline || budget.cancelled())) {
      child.send(SIGINT);  // libFuzzer prints its statistics and leaves
      end_requested = true;
      deadline = Clock::now() + (budget.cancelled() ? short_grace : grace);
    }
    if (!end_requested || Clock::now() <= deadline) continue;
    child.end();
    is_forced = true;
  }
  FuzzOutcome o{query,
                std::chrono::duration<double>(Clock::now() - begin).count(),
                executions_in(log),
                is_forced ? "ended by force: it did not end when it was told to" : child.exit_text(),
                child.failed_to_start() != 0 || (child.exit_code() != 0 && !end_requested),
                asked_in(log)};
  return o;
}

}  // namespace nearmiss
