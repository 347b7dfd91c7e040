#include "reports/engine/map_cases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "corpus/generator/extreme_cases.hpp"
#include "corpus/scenes/scene_cases.hpp"
#include "corpus/scenes/solids.hpp"

namespace nearmiss {

namespace {

MapAxis map_axis_of(ExtremeAxis axis) {
  const auto values = values_of(axis);
  return {std::string(name_of(axis).name), std::string(name_of(axis).unit), {values.begin(), values.end()}};
}

class GeneratedMapCases : public MapCases {
 public:
  std::vector<MapPlane> planes_of(const Query& query) const override {
    std::vector<MapPlane> planes;
    for (const ExtremePlane& p : nearmiss::planes_of(query)) planes.push_back({map_axis_of(p.x), map_axis_of(p.y)});
    return planes;
  }
  Cells cells(const Query& query, std::size_t plane, Scalar scalar, std::uint64_t seed,
              std::uint64_t cases) const override {
    const ExtremePlane p = nearmiss::planes_of(query)[plane];
    const auto xs = values_of(p.x), ys = values_of(p.y);
    return [=, &query](std::size_t cell) {
      std::vector<Case> all;
      for (std::uint64_t i = 0; i < cases; ++i) {
        auto c = extreme_case(query, scalar, seed, i, p, xs[cell % xs.size()], ys[cell / xs.size()]);
        if (c) all.push_back(std::move(*c));
      }
      return all;
    };
  }
};

// --- scenes ----------------------------------------------------------------------------------------------------------

/// What the axes of a scene's maps measure, as indices into Measures.
constexpr std::size_t by_distance = 0, by_size = 1, by_speed = 2;
constexpr std::array<const char*, 3> measure_names = {"distance", "size", "speed"};
constexpr std::array<const char*, 3> measure_units = {"{} from the origin", "{}, the largest size", "{} a second"};
using Measures = std::array<double, 3>;

/// The points of a case, each with its shape.
struct PointOfShape {
  const Operand* shape;
  scenes::Vector at;
};
std::vector<PointOfShape> points_in(const Case& c) {
  std::vector<PointOfShape> points;
  for (const Operand& shape : c.operands()) {
    for (const std::size_t i : shape.positions)
      points.push_back({&shape, {c.values[i], c.values[i + 1], c.values[i + 2]}});
  }
  return points;
}

/// The largest radius or half extent, or half of the distance between two points of a shape.
double largest_size(const Case& c, const std::vector<PointOfShape>& points) {
  double largest = 0;
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    if (c.role(i) == Role::size) largest = std::max(largest, c.values[i]);
  }
  for (const PointOfShape& a : points) {
    for (const PointOfShape& b : points) {
      if (a.shape == b.shape) largest = std::max(largest, scenes::length_of(plus(a.at, b.at, -1)) / 2);
    }
  }
  return largest;
}

Measures measures_of(const Case& c) {
  const std::vector<PointOfShape> points = points_in(c);
  scenes::Vector middle{};
  for (const PointOfShape& p : points) middle = plus(middle, p.at, 1 / double(points.size()));
  double square = 0;
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    if (c.role(i) == Role::velocity) square += c.values[i] * c.values[i];
  }
  return {scenes::length_of(middle), largest_size(c, points), std::sqrt(square)};
}

/// The range of a measure, in steps of the same width, or of the same ratio where the largest value is far from the
/// least.
class Steps {
 public:
  Steps(double least, double most)
      : least_(least),
        most_(most),
        is_logarithmic_(least > 0 && most > far * least),
        count_(least < most ? usual : 1) {}

  std::size_t count() const { return count_; }
  /// The middle of a step.
  double value(std::size_t step) const {
    const double share = (double(step) + 0.5) / double(count_);
    return is_logarithmic_ ? least_ * std::pow(most_ / least_, share) : least_ + (most_ - least_) * share;
  }
  /// The step that holds the value; values beyond the range are in the first or the last.
  std::size_t of(double x) const {
    if (count_ == 1) return 0;
    const double share = is_logarithmic_ ? std::log(std::max(x, least_) / least_) / std::log(most_ / least_)
                                         : (x - least_) / (most_ - least_);
    return std::size_t(std::clamp(share * double(count_), 0.0, double(count_ - 1)));
  }

 private:
  static constexpr std::size_t usual = 8;
  static constexpr double far = 8;
  double least_, most_;
  bool is_logarithmic_;
  std::size_t count_;
};

class SceneMapCases : public MapCases {
 public:
  explicit SceneMapCases(const scenes::Scene& scene) : scene_(scene) {}

  std::vector<MapPlane> planes_of(const Query& query) const override {
    const std::array<Steps, 3> steps = steps_of(query);
    std::vector<MapPlane> planes;
    for (const auto& [x, y] : measured_planes(query)) planes.push_back({axis(x, steps[x]), axis(y, steps[y])});
    return planes;
  }
  Cells cells(const Query& query, std::size_t plane, Scalar scalar, std::uint64_t seed,
              std::uint64_t cases) const override {
    const auto sorted = std::make_shared<std::vector<std::vector<Case>>>(
        sorted_cases(query, measured_planes(query)[plane], scalar, seed, cases));
    return [sorted](std::size_t cell) { return (*sorted)[cell]; };
  }

 private:
  using Plane = std::pair<std::size_t, std::size_t>;  ///< x and y, by_distance and so on

  static bool moves(const Query& query) { return !query.operands.velocities.empty(); }
  static std::vector<Plane> measured_planes(const Query& query) {
    std::vector<Plane> planes{{by_distance, by_size}};
    if (moves(query)) planes.push_back({by_distance, by_speed});
    return planes;
  }
  MapAxis axis(std::size_t measure, const Steps& steps) const {
    MapAxis a{measure_names[measure], fmt::format(fmt::runtime(measure_units[measure]), scene_.unit), {}};
    for (std::size_t i = 0; i < steps.count(); ++i) a.values.push_back(steps.value(i));
    return a;
  }
  /// The ranges of the measures over the first cases of a fixed seed, so that every run of a scene has the same axes.
  std::array<Steps, 3> steps_of(const Query& query) const {
    constexpr std::uint64_t drawn = 4096, seed_of_axes = 1;
    Measures least = measures_of(scenes::draw_case(scene_, query, scene_.scalar, seed_of_axes, 0)), most = least;
    for (std::uint64_t i = 1; i < drawn; ++i) {
      const Measures m = measures_of(scenes::draw_case(scene_, query, scene_.scalar, seed_of_axes, i));
      for (std::size_t k = 0; k < m.size(); ++k) least[k] = std::min(least[k], m[k]), most[k] = std::max(most[k], m[k]);
    }
    return {Steps(least[0], most[0]), Steps(least[1], most[1]), Steps(least[2], most[2])};
  }
  /// Draws cases of the scene until each cell is full, but no more than a bounded number: some cells may be rare.
  std::vector<std::vector<Case>> sorted_cases(const Query& query, const Plane& plane, Scalar scalar, std::uint64_t seed,
                                              std::uint64_t cases) const {
    constexpr std::uint64_t draws_for_each = 16;
    const std::array<Steps, 3> steps = steps_of(query);
    const Steps &x = steps[plane.first], &y = steps[plane.second];
    std::vector<std::vector<Case>> cells(x.count() * y.count());
    std::size_t full = 0;
    for (std::uint64_t i = 0; i < draws_for_each * cells.size() * cases && full < cells.size(); ++i) {
      Case c = scenes::draw_case(scene_, query, scalar, seed, i);
      const Measures m = measures_of(c);
      std::vector<Case>& cell = cells[y.of(m[plane.second]) * x.count() + x.of(m[plane.first])];
      if (cell.size() >= cases) continue;
      cell.push_back(std::move(c));
      full += cell.size() == cases ? 1 : 0;
    }
    return cells;
  }

  const scenes::Scene& scene_;
};

}  // namespace

std::shared_ptr<const MapCases> generated_map_cases() { return std::make_shared<GeneratedMapCases>(); }

std::shared_ptr<const MapCases> scene_map_cases(const scenes::Scene& scene) {
  return std::make_shared<SceneMapCases>(scene);
}

}  // namespace nearmiss
