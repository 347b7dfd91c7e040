#include "reports/findings/static_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "corpus/relations/recast.hpp"

namespace nearmiss {

namespace {

/// The scene at time `time`, in double, as a case of the static query.
Case placed_at(const Case& question, const Link& link, double time) {
  Case there = question;
  there.scalar = Scalar::float64;
  const Operand& mover = question.operands()[0];
  for (const std::size_t place : mover.positions) {
    for (std::size_t k = 0; k < 3; ++k) there.values[place + k] += question.values[*mover.velocity + k] * time;
  }
  return metamorphic::recast(there, link);
}

/// The time in which the body moves by 2^-10 of the largest size, or of the largest position where all sizes are zero;
/// 0 without motion.
double step_of(const Case& c) {
  double size = 0, position = 0, speed = 0;
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    const double x = std::abs(c.values[i]);
    const Role role = c.role(i);
    if (role == Role::size) size = std::max(size, x);
    if (role == Role::position) position = std::max(position, x);
    if (role == Role::velocity) speed = std::max(speed, x);
  }
  return speed > 0 ? (size > 0 ? size : position) / 1024 / speed : 0;
}

/// The time in a hit that gives a finite one; empty otherwise.
std::optional<double> time_in(const Query& query, const Answer& a) {
  const Layout::Part* time = query.layout.at(Role::time);
  if (time == nullptr || a.status != Answer::Status::answered || !a.yes || !a.gives(time->begin)) return std::nullopt;
  const double t = a.values[time->begin];
  return std::isfinite(t) && t >= 0 ? std::optional(t) : std::nullopt;
}

std::optional<double> time_in(const Query& query, const Truth& truth) {
  if (!truth.yes || truth.alternatives.empty()) return std::nullopt;
  const Layout::Part* time = query.layout.at(Role::time);
  const Alternative& right = truth.alternatives.front();
  return time != nullptr && time->begin < right.count ? std::optional(right.values[time->begin].low) : std::nullopt;
}

}  // namespace

std::vector<StaticCheck> static_checks(const Case& question, const Answer& answer, const Truth& truth,
                                       Workers& workers) {
  const Link* by = metamorphic::link_of(question, Link::Kind::at_rest);
  if (by == nullptr) return {};
  const double step = step_of(question);
  const std::optional<double> answered = time_in(*question.query, answer), exact = time_in(*question.query, truth);
  std::vector<std::pair<std::string, double>> times;
  if (answered) times.emplace_back("answer", *answered);
  if (exact && (!answered || std::abs(*exact - *answered) > step)) times.emplace_back("truth", *exact);
  std::vector<StaticCheck> checks;
  for (const auto& [of, time] : times) {
    std::array<Case, 3> scenes;
    StaticCheck check{"", "", query_of(by->to).name, of, {std::max(0.0, time - step), time, time + step}, {}};
    for (std::size_t i = 0; i < 3; ++i) scenes[i] = placed_at(question, *by, check.times[i]);
    const bool valid =
        std::none_of(scenes.begin(), scenes.end(), [](const Case& c) { return c.query->broken(c.values).has_value(); });
    if (!valid) continue;  // the position overflows
    for (const Subject* referee : referees()) {
      if (referee->offering(query_of(by->to).name).answer == nullptr) continue;
      const bool holds = std::all_of(scenes.begin(), scenes.end(),
                                     [&](const Case& c) { return in_scalar(c, referee->scalar).has_value(); });
      if (!holds) continue;
      check.referee = referee->name;
      check.version = referee->version;
      workers.send(*referee, scenes);
      std::ranges::copy(workers.receive(*referee), check.said.begin());
      checks.push_back(check);
    }
  }
  return checks;
}

}  // namespace nearmiss
