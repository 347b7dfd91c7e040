#include "reports/static_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace nearmiss {

namespace {

/// How the numbers of a moving query become those of a static one. A point is a ball without a radius.
struct Correspondence {
  std::string_view moving, fixed;  ///< the queries
  std::string_view mover, placed;  ///< the moving body in either
  std::string_view obstacle;       ///< the other one in the moving query; in the static one it is all the rest
};

constexpr std::array<Correspondence, 8> correspondences = {{
    {"moving_point_plane", "sphere_plane_penetration", "point", "sphere", "plane"},
    {"moving_point_triangle", "sphere_triangle_overlap", "point", "sphere", "triangle"},
    {"moving_point_sphere", "sphere_sphere_overlap", "point", "sphere1", "sphere"},
    {"moving_point_box", "sphere_box_overlap", "point", "sphere", "box"},
    {"moving_sphere_plane", "sphere_plane_penetration", "sphere", "sphere", "plane"},
    {"moving_sphere_triangle", "sphere_triangle_overlap", "sphere", "sphere", "triangle"},
    {"moving_sphere_sphere", "sphere_sphere_overlap", "sphere", "sphere1", "fixed"},
    {"moving_sphere_box", "sphere_box_overlap", "sphere", "sphere", "box"},
}};

const Correspondence* correspondence_of(const Query& moving) {
  const auto found = std::find_if(correspondences.begin(), correspondences.end(),
                                  [&](const Correspondence& c) { return c.moving == moving.name; });
  return found == correspondences.end() ? nullptr : &*found;
}

double input(const Case& c, const std::string& name) {
  const auto& fields = c.query->inputs;
  const auto found = std::find_if(fields.begin(), fields.end(), [&](const Field& f) { return f.name == name; });
  return c.values.at(std::size_t(found - fields.begin()));
}

/// The scene at that time, in double.
Case placed_at(const Case& question, const Correspondence& by, double time) {
  Case c;
  c.query = find_query(by.fixed);
  const bool point = by.mover == "point";
  for (const Field& f : c.query->inputs) {
    const std::size_t dot = f.name.find('.');
    const std::string owner = f.name.substr(0, dot), member = f.name.substr(dot + 1);
    if (owner != by.placed) {
      c.values.push_back(input(question, fmt::format("{}.{}", by.obstacle, member)));
    } else if (member == "radius") {
      c.values.push_back(point ? 0.0 : input(question, fmt::format("{}.radius", by.mover)));
    } else {  // "center.x"
      const std::string axis = member.substr(member.find('.') + 1);
      const double from = input(question, fmt::format("{}.{}", by.mover, point ? axis : member));
      c.values.push_back(from + input(question, "velocity." + axis) * time);
    }
  }
  return c;
}

/// The time in which the body moves by 2^-10 of the largest size, or else position; 0 where nothing moves.
double step_of(const Case& c) {
  double size = 0, position = 0, speed = 0;
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    const double x = std::abs(c.values[i]);
    const Role role = c.query->inputs[i].role;
    if (role == Role::size) size = std::max(size, x);
    if (role == Role::position) position = std::max(position, x);
    if (role == Role::velocity) speed = std::max(speed, x);
  }
  return speed > 0 ? (size > 0 ? size : position) / 1024 / speed : 0;
}

/// Of an answer that says yes and gives it; empty where there is none.
std::optional<double> time_in(const Query& query, const Answer& a) {
  for (std::size_t i = 0; i < query.outputs.size(); ++i) {
    if (query.outputs[i].name != "time") continue;
    const bool given = a.status == Answer::Status::answered && a.yes && a.gives(i);
    if (given && std::isfinite(a.values[i]) && a.values[i] >= 0) return a.values[i];
  }
  return std::nullopt;
}

std::optional<double> time_in(const Query& query, const Truth& truth) {
  if (!truth.yes || truth.alternatives.empty()) return std::nullopt;
  for (std::size_t i = 0; i < truth.alternatives.front().count && i < query.outputs.size(); ++i) {
    if (query.outputs[i].name == "time") return truth.alternatives.front().values[i].low;
  }
  return std::nullopt;
}

}  // namespace

std::vector<StaticCheck> static_checks(const Case& question, const Answer& answer, const Truth& truth,
                                       Workers& workers) {
  const Correspondence* by = correspondence_of(*question.query);
  if (by == nullptr) return {};
  const double step = step_of(question);
  const std::optional<double> answered = time_in(*question.query, answer), exact = time_in(*question.query, truth);
  std::vector<std::pair<std::string, double>> times;
  if (answered) times.emplace_back("answer", *answered);
  if (exact && (!answered || std::abs(*exact - *answered) > step)) times.emplace_back("truth", *exact);
  std::vector<StaticCheck> checks;
  for (const auto& [of, time] : times) {
    std::array<Case, 3> scenes;
    StaticCheck check{"", "", by->fixed, of, {std::max(0.0, time - step), time, time + step}, {}};
    for (std::size_t i = 0; i < 3; ++i) scenes[i] = placed_at(question, *by, check.times[i]);
    const bool valid = std::none_of(scenes.begin(), scenes.end(),
                                    [](const Case& c) { return c.query->broken(c.values).has_value(); });
    if (!valid) continue;  // the place is beyond the largest number
    for (const Subject& referee : subjects()) {
      if (!referee.referee || referee.offering(by->fixed).answer == nullptr) continue;
      const bool holds = std::all_of(scenes.begin(), scenes.end(),
                                     [&](const Case& c) { return in_scalar(c, referee.scalar).has_value(); });
      if (!holds) continue;
      check.referee = referee.name;
      check.version = referee.version;
      workers.send(referee, scenes);
      std::ranges::copy(workers.receive(referee), check.said.begin());
      checks.push_back(check);
    }
  }
  return checks;
}

}  // namespace nearmiss
