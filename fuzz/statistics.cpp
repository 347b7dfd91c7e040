#include "fuzz/statistics.hpp"

#include <algorithm>
#include <bitset>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "fuzz/feedback.hpp"
#include "fuzz/fuzzed_query.hpp"

namespace nearmiss::fuzz {

namespace {

using Clock = std::chrono::steady_clock;

struct OfSubject {
  std::uint64_t answers = 0;
  std::optional<double> backward;  ///< the worst bound that is proved, refined
  double promised = 0;
};

struct Statistics {
  std::string file;
  std::uint64_t executions = 0;
  Clock::time_point start;
  std::bitset<feature_counters> features;
  std::map<std::string, OfSubject> subjects;
};

Statistics& statistics() {
  static Statistics all = [] {
    const char* file = std::getenv("NEARMISS_FUZZ_STATISTICS");
    Statistics s;
    s.file = file == nullptr ? "" : file;
    return s;
  }();
  return all;
}

nlohmann::json number_or_null(double x) { return std::isfinite(x) ? nlohmann::json(x) : nlohmann::json(); }

nlohmann::json to_json(const Statistics& s) {
  const double seconds = std::chrono::duration<double>(Clock::now() - s.start).count();
  nlohmann::json subjects = nlohmann::json::object();
  for (const auto& [name, of] : s.subjects) {
    subjects[name] = {{"answers", of.answers},
                      {"backward", of.backward ? nlohmann::json(*of.backward) : nlohmann::json()},
                      {"promised", number_or_null(of.promised)}};
  }
  return {{"query", fuzzed_query},
          {"feedback", feedback_is_on()},
          {"executions", s.executions},
          {"seconds", s.executions == 0 ? 0 : seconds},
          {"executions_per_second", s.executions == 0 ? 0 : double(s.executions) / std::max(seconds, 1e-9)},
          {"features", s.features.count()},
          {"subjects", std::move(subjects)}};
}

}  // namespace

bool statistics_are_asked() {
  static const bool asked = !statistics().file.empty();
  return asked;
}

void count_execution() {
  if (!statistics_are_asked()) return;
  if (statistics().executions++ > 0) return;
  statistics().start = Clock::now();
  std::atexit(write_statistics);
}

void count_feature(std::size_t counter) {
  if (statistics_are_asked()) statistics().features.set(counter);
}

void count_answer(const Asked& asked, const Case& c, const Answer& answer, const Finding& finding) {
  if (!statistics_are_asked()) return;
  OfSubject& of = statistics().subjects[asked.subject->name];
  ++of.answers;
  of.promised = asked.standard.contract.backward;
  if (answer.status != Answer::Status::answered || !finding.backward) return;
  if (of.backward && finding.backward->above <= *of.backward) return;
  of.backward = finer_backward(c, answer, *finding.backward, asked.standard.required);
}

void write_statistics() {
  if (!statistics_are_asked()) return;
  std::ofstream out(statistics().file);
  out << to_json(statistics()).dump(2) << '\n';
  if (!out.flush()) {
    std::fprintf(stderr, "fuzz_%s: cannot write the statistics to %s\n", fuzzed_query, statistics().file.c_str());
    std::_Exit(2);
  }
}

}  // namespace nearmiss::fuzz
