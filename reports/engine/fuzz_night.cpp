#include "reports/engine/fuzz_night.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "corpus/files/errors.hpp"
#include "corpus/storage/codec.hpp"
#include "impl/host/supervisor.hpp"

namespace nearmiss {

namespace {

namespace fs = std::filesystem;
using Clock = FuzzNight::Clock;

/// The shortest and the longest turn, in seconds. A turn starts with the execution of the whole corpus, which a long
/// turn repays; a target takes 0.2 s to start.
constexpr double shortest_turn = 0.5, longest_turn = 120;
/// A first round of half of the time must give each target this much.
constexpr double least_half = 2;
constexpr unsigned most_failures_in_a_row = 3;
/// How long the process waits for the targets before it looks again, in milliseconds.
constexpr int patience_ms = 50;

double seconds_until(Clock::time_point t) { return std::chrono::duration<double>(t - Clock::now()).count(); }

/// A target and its turns so far.
struct Contender {
  const BuiltTarget* target;
  std::optional<FuzzOutcome> sum{};
  double yield = 0;  ///< new inputs per second of the last turn
  Clock::time_point waits_since{};
  unsigned failures_in_a_row = 0;
  bool is_running = false;

  void add(const FuzzOutcome& turn) {
    yield = double(turn.new_inputs) / std::max(turn.seconds, shortest_turn);
    failures_in_a_row = turn.failed && turn.executions == 0 ? failures_in_a_row + 1 : 0;
    waits_since = Clock::now();
    is_running = false;
    if (!sum) {
      sum = turn;
      return;
    }
    sum->seconds += turn.seconds;
    sum->executions += turn.executions;
    sum->new_inputs += turn.new_inputs;
    ++sum->turns;
    if (!sum->failed) sum->ended = turn.ended;
    sum->failed = sum->failed || turn.failed;
    if (sum->asked.empty()) sum->asked = turn.asked;
  }
  bool may_run() const { return !is_running && failures_in_a_row < most_failures_in_a_row; }
  /// The rule of the order after the first round. Half an input is granted to a target without yield, so that its turn
  /// comes, too.
  double priority() const {
    const double waited = std::chrono::duration<double>(Clock::now() - waits_since).count();
    return (yield + 0.5 / longest_turn) * (shortest_turn + waited);
  }
};

/// One turn in progress.
struct Turn {
  Contender* contender;
  std::unique_ptr<RunningTarget> process;
};

class Turns {
 public:
  Turns(const std::vector<BuiltTarget>& targets, const FuzzNight& night) : night_(night) {
    for (const BuiltTarget& t : targets) contenders_.push_back({&t});
    const double each = seconds_until(night.until) * night.jobs / double(std::max<std::size_t>(1, targets.size()));
    first_round_share_ = each / 2 >= least_half ? 0.5 : 1;
  }

  void run() {
    while (true) {
      while (running_.size() < night_.jobs && start_next()) {
      }
      if (running_.empty()) break;
      wait();
    }
  }

  FuzzNightOutcome outcome() const {
    FuzzNightOutcome o;
    for (const Contender& c : contenders_) {
      if (c.sum && (c.sum->executions > 0 || c.sum->failed)) {
        o.ran.push_back(*c.sum);
      } else {
        o.no_time.emplace_back(c.target->target->name);
      }
    }
    return o;
  }

 private:
  bool start_next() {
    const double left = seconds_until(night_.until);
    if (left < shortest_turn || night_.cancelled()) return false;
    Contender* next = next_contender();
    if (next == nullptr) return false;
    if (!next->sum && night_.profile.empty()) put_seeds(*next->target, night_.run_folder);
    night_.activity(fmt::format("fuzzing {}", next->target->target->name));
    const double turn = std::min(left, next->sum ? later_turn(left) : first_turn(*next, left));
    running_.push_back({next, std::make_unique<RunningTarget>(
                                  *next->target, FuzzBudget{night_.run_folder, night_.foreign, night_.profile,
                                                            std::max(shortest_turn, turn)})});
    next->is_running = true;
    return true;
  }
  /// In the first round the targets come in their order.
  Contender* next_contender() {
    Contender* best = nullptr;
    for (Contender& c : contenders_) {
      if (!c.may_run()) continue;
      if (!c.sum) return &c;
      if (best == nullptr || c.priority() > best->priority()) best = &c;
    }
    return best;
  }
  /// What is left of the first round's share, divided among the queries of the targets without a turn.
  double first_turn(const Contender& next, double left) {
    std::size_t waiting = 0;
    for (const Contender& c : contenders_) {
      if (!c.sum && !c.is_running) waiting += c.target->queries.size();
    }
    if (!first_round_end_) first_round_end_ = left * (1 - first_round_share_);
    return (left - *first_round_end_) * night_.jobs * double(next.target->queries.size()) / double(waiting);
  }
  double later_turn(double left) const {
    return std::clamp(left * night_.jobs / double(contenders_.size()), shortest_turn, longest_turn);
  }
  void wait() {
    const int each = std::max(1, patience_ms / int(running_.size()));
    for (Turn& turn : running_) {
      if (!turn.process->has_ended(each, night_.cancelled())) continue;
      turn.contender->add(turn.process->outcome());
      turn.process.reset();
    }
    std::erase_if(running_, [](const Turn& t) { return t.process == nullptr; });
    night_.tick();
  }

  const FuzzNight& night_;
  std::vector<Contender> contenders_;
  std::vector<Turn> running_;
  double first_round_share_ = 1;
  std::optional<double> first_round_end_;  ///< seconds before the end of the night
};

// Corpora. Beside corpus/TARGET/: TARGET.merging, an unfinished result; TARGET.control, libFuzzer's record of an
// unfinished merge; TARGET.merged, a complete result that is not yet in its place; TARGET.old, what it replaces;
// TARGET.size, the number of inputs after the last merge.

fs::path beside(const fs::path& corpus, const char* suffix) { return corpus.string() + suffix; }

std::uint64_t inputs_in(const fs::path& folder) {
  std::error_code error;
  std::uint64_t n = 0;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) ++n;
  return n;
}

std::uint64_t size_after_last_merge(const fs::path& corpus) {
  const fs::path file = beside(corpus, ".size");
  return fs::exists(file) ? std::strtoull(read_file(file).c_str(), nullptr, 10) : 0;
}

void settle(const fs::path& corpus) {
  std::error_code error;  // what cannot be settled stays as it is; nothing is lost
  if (!fs::exists(corpus)) {
    const fs::path complete = beside(corpus, ".merged");
    fs::rename(fs::exists(complete) ? complete : beside(corpus, ".old"), corpus, error);
  }
  if (!fs::exists(corpus)) return;
  fs::remove_all(beside(corpus, ".merged"), error);
  fs::remove_all(beside(corpus, ".old"), error);
}

/// Puts the complete result in the place of the corpus. At each moment one of the two is complete.
void put_in_place(const fs::path& corpus) {
  fs::rename(beside(corpus, ".merging"), beside(corpus, ".merged"));
  fs::rename(corpus, beside(corpus, ".old"));
  fs::rename(beside(corpus, ".merged"), corpus);
  std::error_code error;
  fs::remove_all(beside(corpus, ".old"), error);
  fs::remove(beside(corpus, ".control"), error);
  write_file(beside(corpus, ".size"), fmt::format("{}\n", inputs_in(corpus)));
}

/// True where the merge was completed in time.
bool merge(const BuiltTarget& target, const FuzzNight& night, const fs::path& corpus) {
  const fs::path into = beside(corpus, ".merging");
  make_folder(into);
  Program p;
  p.arguments = {target.file.string(), "-merge=1", "-merge_control_file=" + beside(corpus, ".control").string(),
                 into.string(), corpus.string()};
  p.environment = environment_of_target(target, night.foreign, night.run_folder, night.profile);
  p.log = (night.run_folder / "fuzz" / (std::string(target.target->name) + "-merge.log")).string();
  SupervisedProcess child(p, Confinement::none());
  while (!child.has_ended(patience_ms)) {
    night.tick();
    if (seconds_until(night.until) < 0 || night.cancelled()) {
      child.end();
      return false;
    }
  }
  if (child.exit_code() != 0 || inputs_in(into) == 0) return false;
  try {
    put_in_place(corpus);
  } catch (const fs::filesystem_error& e) {  // settle_corpora() completes or undoes it
    throw IoError(e.what());
  }
  return true;
}

}  // namespace

FuzzNightOutcome fuzz_in_turns(const std::vector<BuiltTarget>& targets, const FuzzNight& night) {
  make_folder(night.run_folder / "fuzz");
  Turns turns(targets, night);
  turns.run();
  return turns.outcome();
}

MergeOutcome merge_corpora(const std::vector<BuiltTarget>& targets, const FuzzNight& night) {
  struct Grown {
    const BuiltTarget* target;
    fs::path corpus;
    std::uint64_t inputs;
    double factor;
  };
  make_folder(night.run_folder / "fuzz");
  settle_corpora(targets, night.run_folder);
  std::vector<Grown> grown;
  for (const BuiltTarget& t : targets) {
    const fs::path corpus = night.run_folder / "corpus" / t.target->name;
    const std::uint64_t now = inputs_in(corpus), last = size_after_last_merge(corpus);
    if (now >= 2 * std::max<std::uint64_t>(last, 64))
      grown.push_back({&t, corpus, now, double(now) / double(last + 1)});
  }
  std::sort(grown.begin(), grown.end(), [](const Grown& a, const Grown& b) { return a.factor > b.factor; });
  MergeOutcome o;
  for (const Grown& g : grown) {
    if (seconds_until(night.until) <= 0 || night.cancelled()) break;
    night.activity(fmt::format("minimising the corpus of {}", g.target->target->name));
    if (!merge(*g.target, night, g.corpus)) continue;
    o.merged.emplace_back(g.target->target->name);
    o.before += g.inputs;
    o.after += inputs_in(g.corpus);
  }
  return o;
}

void settle_corpora(const std::vector<BuiltTarget>& targets, const fs::path& run_folder) {
  for (const BuiltTarget& t : targets) settle(run_folder / "corpus" / t.target->name);
}

}  // namespace nearmiss
