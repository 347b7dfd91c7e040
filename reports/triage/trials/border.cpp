#include "reports/triage/trials/border.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace nearmiss {

namespace {

/// The moves of the numbers of one case, each as a share of its largest move, and 1 for the distance of the plane.
struct Point {
  std::vector<double> at;
  bool with_finding;
};

std::vector<Point> points_of(const Case& about, std::span<const Trial> trials) {
  std::vector<double> largest(about.values.size(), 0);
  for (const Trial& t : trials) {
    for (std::size_t i = 0; i < largest.size(); ++i)
      largest[i] = std::max(largest[i], std::abs(t.question.values[i] - about.values[i]));
  }
  std::vector<Point> points;
  for (const Trial& t : trials) {
    if (t.outcome == Outcome::none) continue;
    Point p{{1.0}, t.outcome == Outcome::same};
    for (std::size_t i = 0; i < largest.size(); ++i) {
      if (largest[i] > 0) p.at.push_back((t.question.values[i] - about.values[i]) / largest[i]);
    }
    points.push_back(std::move(p));
  }
  return points;
}

}  // namespace

/// Source: the perceptron (Rosenblatt, 1958), which ends where a plane separates the points.
bool are_on_two_sides(const Case& about, std::span<const Trial> trials) {
  constexpr int most_rounds = 2000;
  const std::vector<Point> points = points_of(about, trials);
  if (points.empty()) return false;
  std::vector<double> plane(points.front().at.size(), 0);
  for (int round = 0; round < most_rounds; ++round) {
    bool separates = true;
    for (const Point& p : points) {
      double side = 0;
      for (std::size_t k = 0; k < plane.size(); ++k) side += plane[k] * p.at[k];
      if ((side > 0) == p.with_finding && side != 0) continue;
      separates = false;
      for (std::size_t k = 0; k < plane.size(); ++k) plane[k] += p.with_finding ? p.at[k] : -p.at[k];
    }
    if (separates) return true;
  }
  return false;
}

}  // namespace nearmiss
