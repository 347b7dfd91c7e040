#include "benchmarks/timed_cases.hpp"

#include <algorithm>
#include <map>
#include <random>
#include <stdexcept>

#include "corpus/generator/generator.hpp"
#include "impl/subject/subject.hpp"

namespace nearmiss::benchmarks {

namespace {

std::size_t count = 4096;

struct TimedCase {
  std::vector<double> values;
  bool yes;
};

/// The first `count` plain cases, with as many hits as misses where there are enough of both.
std::vector<TimedCase> draw(const Query& query) {
  const Offering& judge = find_subject("collide-fast-double")->offering(query.name);
  const std::size_t quota = decides(query.kind) ? count / 2 : count;
  const std::uint64_t most = 64 * count;  // of the generator's cases; half of them are plain cases
  std::vector<TimedCase> drawn, surplus;
  std::size_t of[2] = {0, 0};
  Case c;
  for (std::uint64_t i = 0; i < most && drawn.size() < count; ++i) {
    generate(c, query, Scalar::float32, 2024, i);
    if (!c.moves.empty()) continue;
    const bool yes = judge.answer(c.values).yes;
    auto& into = of[yes]++ < quota ? drawn : surplus;
    if (into.size() < count) into.push_back({c.values, yes});
  }
  for (std::size_t i = 0; drawn.size() < count && i < surplus.size(); ++i) drawn.push_back(surplus[i]);
  if (drawn.size() < count) throw std::logic_error("too few plain cases of " + std::string(query.name));
  return drawn;
}

TimedCases make(const Query& query) {
  std::vector<TimedCase> drawn = draw(query);
  std::mt19937_64 random(1);
  for (std::size_t i = drawn.size() - 1; i > 0; --i) std::swap(drawn[i], drawn[random() % (i + 1)]);
  TimedCases cases;
  for (const TimedCase& s : drawn) {
    cases.values.push_back(s.values);
    cases.yes.push_back(s.yes);
  }
  return cases;
}

}  // namespace

double TimedCases::share_of_yes() const {
  return double(std::count(yes.begin(), yes.end(), true)) / double(yes.size());
}

void set_case_count(std::size_t n) { count = n; }
std::size_t case_count() { return count; }

const TimedCases& timed_cases_of(std::string_view query) {
  static std::map<std::string, TimedCases, std::less<>> made;
  const auto known = made.find(query);
  if (known != made.end()) return known->second;
  const Query* q = find_query(query);
  if (q == nullptr) throw std::logic_error("no query " + std::string(query));
  return made.emplace(query, make(*q)).first->second;
}

}  // namespace nearmiss::benchmarks
