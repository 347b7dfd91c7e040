#include "oracles/touch.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "oracles/exact/oracle.hpp"
#include "oracles/judge.hpp"

namespace nearmiss {

namespace {

constexpr int far_below_rounding = 300;  // 2^-300: below the lowest bit of any two doubles of one scene

/// The position inputs of the first operand that has any, so that the operand moves as a whole.
std::vector<std::size_t> places_of_first_operand(const Case& c) {
  std::vector<std::size_t> places;
  for (const Operand& o : c.operands()) {
    for (const std::size_t at : o.positions) places.insert(places.end(), {at, at + 1, at + 2});
    if (!places.empty()) break;
  }
  return places;
}

double largest_place_or_size(const Case& c) {
  double largest = 0;
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    const Role role = c.role(i);
    if (role == Role::position || role == Role::size) largest = std::max(largest, std::abs(c.values[i]));
  }
  return largest;
}

/// Whether the decision may differ for an input one rounding away. This holds for every touch.
bool may_flip_next_door(const Case& c) {
  const std::vector<double> wide = widening(*c.query, c.values, c.scalar, 1);
  return oracle_of(*c.query).interval(c.values, wide, Answer{}, c.scalar).may_be_no;
}

}  // namespace

bool touches_exactly(const Case& question) {
  const Query& query = *question.query;
  const std::vector<std::size_t> places = places_of_first_operand(question);
  const double scale = largest_place_or_size(question);
  if (!decides(query.kind) || places.empty() || scale == 0) return false;
  if (!may_flip_next_door(question)) return false;
  constexpr std::array<std::array<double, 3>, 2> directions{
      {{0.6180339887, 0.7548776662, -0.2915026221}, {-0.3027756377, 0.4142135624, 0.8546376797}}};
  std::vector<double> by(question.values.size());
  for (const auto& direction : directions) {
    for (const double sign : {1.0, -1.0}) {
      for (std::size_t i = 0; i < places.size(); ++i) by[places[i]] = sign * scale * direction[i % 3];
      if (!oracle_of(query).exact_decision(question.values, by, far_below_rounding)) return true;
    }
  }
  return false;
}

std::string_view feature_of_touch(const Case& question) {
  constexpr std::array<std::string_view, 11> touching{
      "touch-by-size",  "touch-by-position", "touch-at-edge-or-vertex", "touch-by-diagonals",
      "crossing-edges", "touching-features", "touch-by-plane",          "grazing",
      "head-on",        "start-on-surface",  "limit-at-contact"};
  for (const std::string_view move : question.moves) {
    if (std::find(touching.begin(), touching.end(), move) != touching.end()) return move;
  }
  return "other";
}

}  // namespace nearmiss
