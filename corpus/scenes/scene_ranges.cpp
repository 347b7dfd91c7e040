#include "corpus/scenes/scene_ranges.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "corpus/generator/fit.hpp"
#include "corpus/scenes/measured_shape.hpp"
#include "corpus/scenes/scene_cases.hpp"

namespace nearmiss::scenes {

namespace {

bool is_in(double x, const Limits& limits, double slack = 0) {
  return limits.least - slack <= x && x <= limits.most + slack;
}
double clamped(double x, const Limits& limits) { return std::clamp(x, limits.least, limits.most); }
Limits rounded_limits(const Limits& limits, Scalar scalar) {
  return {rounded_to(scalar, limits.least), rounded_to(scalar, limits.most)};
}

/// The radius of a ball around the center of the largest shape; see Solid::reach().
double largest_reach(const Shapes& shapes) {
  const double most = shapes.size.most.value;
  switch (shapes.type) {
    case Shape::point:
    case Shape::plane:
    case Shape::halfspace: return 0;
    case Shape::capsule: return 2 * most;
    case Shape::box:
    case Shape::aabox: return std::sqrt(3.0) * most;
    case Shape::rectangle: return std::sqrt(2.0) * most;
    case Shape::triangle: return 2 * most;  // its center is not that about which it was drawn
    default: return most;
  }
}

/// The rounding of lengths that follow from several numbers of the case.
double slack_of(const Case& c) {
  double largest = 0;
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    const Role role = c.role(i);
    const bool is_length = role == Role::position || role == Role::size || role == Role::offset;
    if (is_length || role == Role::velocity) largest = std::max(largest, std::abs(c.values[i]));
  }
  return 8 * (c.scalar == Scalar::float32 ? 0x1p-23 : 0x1p-52) * largest;
}

/// What scenes draw for a flag: a solid sphere, a motion with a limit.
double drawn_flag(const Field& field) { return field.name == "solid" ? 1 : 0; }

bool is_whole(const Case& c) {
  const bool finite = std::all_of(c.values.begin(), c.values.end(), [](double x) { return std::isfinite(x); });
  return finite && !c.query->broken(c.values);
}

/// Brings a vector of the case to a length within the limits; a vector of length 0 to the least along x.
void fit_length(Case& c, std::size_t begin, const Limits& limits) {
  const Vector v = vector_at(c, begin);
  const double length = length_of(v), wanted = clamped(length, limits);
  put_vector(c, begin, length > 0 ? scaled(v, wanted / length) : Vector{wanted, 0, 0});
}

}  // namespace

SceneRanges::SceneRanges(const Scene& scene, const Query& query) : scene_(scene), query_(query) {
  const MixedQuery* mixed = scene.find(query);
  if (mixed == nullptr) throw std::logic_error(fmt::format("scene {} does not ask {}", scene.name, query.name));
  const double gap = largest_gap(scene);
  if (scene.is_recorded()) {
    const Case& any = scene.recorded[mixed->recorded.front()];
    for (std::size_t i = 0; i < any.values.size(); ++i) {
      Limits limits{HUGE_VAL, -HUGE_VAL};
      for (const std::size_t at : mixed->recorded) {
        const double x = scene.recorded[at].values[i];
        limits = {std::min(limits.least, x), std::max(limits.most, x)};
      }
      const Role role = any.role(i);
      const double more = role == Role::position || role == Role::offset ? gap : 0;
      recorded_.push_back({limits.least - more, limits.most + more});
    }
    return;
  }
  plan_ = query_plan(query);
  for (const std::size_t operand : mixed->operands) shapes_.push_back(&scene.shapes[operand]);
  const double way = plan_->direction  ? scene.extent.value
                     : plan_->velocity ? shapes_[0]->speed.most.value * scene.step.value
                                       : 0;
  const double corner = std::sqrt(3.0) * scene.extent.value;  // of the cube, from its middle
  const double off_center = shapes_[1]->type == Shape::triangle ? shapes_[1]->size.most.value : 0;
  place_ = {std::max(0.0, scene.distance.least.value - corner - off_center),
            scene.distance.most.value + corner + off_center};
  apart_ = largest_reach(*shapes_[0]) + largest_reach(*shapes_[1]) + way + gap;
}

bool SceneRanges::contain(const Case& c) const {
  if (c.query != &query_ || !is_whole(c)) return false;
  return plan_ ? contain_drawn(c) : contain_recorded(c);
}

bool SceneRanges::fit(Case& c) const {
  if (contain(c)) return true;
  Case fitted = c;
  nearmiss::fit(fitted, {Precondition::unit_normal, Precondition::unit_direction, Precondition::unit_quaternion});
  if (!plan_) fit_recorded(fitted);
  if (plan_) cap_numbers(fitted);
  constexpr int attempts = 3;  // a shape that is moved a long way is rounded: the next attempt moves it a short one
  for (int i = 0; plan_ && i < attempts && !contain(fitted); ++i) fit_drawn(fitted);
  if (!contain(fitted)) return false;
  c = std::move(fitted);
  return true;
}

Limits SceneRanges::recorded_limits(std::size_t number, Scalar scalar) const {
  return rounded_limits(recorded_[number], scalar);
}

bool SceneRanges::contain_recorded(const Case& c) const {
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    if (!is_in(c.values[i], recorded_limits(i, c.scalar))) return false;
  }
  return true;
}

void SceneRanges::fit_recorded(Case& c) const {
  for (std::size_t i = 0; i < c.values.size(); ++i) c.values[i] = clamped(c.values[i], recorded_limits(i, c.scalar));
}

Limits SceneRanges::sizes_of(std::size_t operand, Scalar scalar) const {
  const Spread& size = shapes_[operand]->size;
  const bool is_triangle = shapes_[operand]->type == Shape::triangle;
  return rounded_limits({is_triangle ? 0 : size.least.value, size.most.value}, scalar);
}

bool SceneRanges::contain_drawn(const Case& c) const {
  const double slack = slack_of(c);
  std::array<MeasuredShape, 2> measured;
  for (std::size_t k = 0; k < 2; ++k) {
    measured[k] = measured_shape(c, plan_->operands[k]);
    const Limits limits = sizes_of(k, c.scalar);
    for (const double s : measured[k].stated) {
      if (!is_in(s, limits)) return false;
    }
    for (const double s : measured[k].derived) {
      if (!is_in(s, limits, slack)) return false;
    }
  }
  const Spread& speed = shapes_[0]->speed;
  if (plan_->velocity &&
      !is_in(length_of(vector_at(c, *plan_->velocity)), {speed.least.value, speed.most.value}, slack))
    return false;
  for (const std::size_t k : plan_->lone) {
    const Role role = c.role(k);
    if (role == Role::time && c.values[k] != rounded_to(c.scalar, scene_.step.value)) return false;
    if (role == Role::flag && c.values[k] != drawn_flag(c.fields()[k])) return false;
  }
  // The plane's point nearest to the first shape stands for its center.
  const double between = has_one_plane(plan_->operands[1].shape)
                             ? std::abs(height_above(c, plan_->operands[1], measured[0].center))
                             : length_of(plus(measured[0].center, measured[1].center, -1));
  if (between > apart_ + slack) return false;
  if (!has_one_plane(plan_->operands[1].shape)) return is_in(length_of(measured[1].center), place_, slack);
  return std::abs(c.values[plan_->operands[1].begin + 3]) <= place_.most + slack &&
         length_of(measured[0].center) <= place_.most + apart_ + slack;
}

void SceneRanges::cap_numbers(Case& c) const {
  const double far = 2 * (place_.most + apart_), fast = 2 * shapes_[0]->speed.most.value;
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    const Role role = c.role(i);
    const double most = role == Role::position ? far : role == Role::velocity ? fast : HUGE_VAL;
    c.values[i] = rounded_to(c.scalar, std::clamp(c.values[i], -most, most));
  }
}

void SceneRanges::fit_plane(Case& c) const {
  const Operand &first = plan_->operands[0], &plane = plan_->operands[1];
  const Vector center = measured_shape(c, first).center;
  if (const double length = length_of(center); length > place_.most)
    move_shape(c, first, scaled(center, place_.most / length - 1));
  const double height = height_above(c, plane, measured_shape(c, first).center);
  double& offset = c.values[plane.begin + 3];
  const double wanted = offset + std::clamp(height, -apart_, apart_) - height;
  offset = rounded_to(c.scalar, std::clamp(wanted, -place_.most, place_.most));
}

void SceneRanges::fit_drawn(Case& c) const {
  for (const std::size_t k : plan_->lone) {
    const Role role = c.role(k);
    if (role == Role::time) c.values[k] = rounded_to(c.scalar, scene_.step.value);
    if (role == Role::flag) c.values[k] = drawn_flag(c.fields()[k]);
  }
  for (std::size_t k = 0; k < 2; ++k) {
    const Limits limits = sizes_of(k, c.scalar);
    resize_shape(c, plan_->operands[k], limits.least, limits.most);
  }
  const Spread& speed = shapes_[0]->speed;
  if (plan_->velocity) fit_length(c, *plan_->velocity, {speed.least.value, speed.most.value});
  const Operand &first = plan_->operands[0], &second = plan_->operands[1];
  Vector center = measured_shape(c, first).center;
  if (has_one_plane(second.shape)) return fit_plane(c);
  Vector other = measured_shape(c, second).center;
  const double length = length_of(other), wanted = clamped(length, place_);
  if (wanted != length) {
    const Vector by = length > 0 ? scaled(other, wanted / length - 1) : Vector{wanted, 0, 0};
    move_shape(c, first, by);
    move_shape(c, second, by);
    center = measured_shape(c, first).center;
    other = measured_shape(c, second).center;
  }
  const Vector way = plus(center, other, -1);
  if (const double between = length_of(way); between > apart_) move_shape(c, first, scaled(way, apart_ / between - 1));
}

}  // namespace nearmiss::scenes
