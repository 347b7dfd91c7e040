#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "oracles/judge.hpp"
#include "oracles/requirements.hpp"
#include "oracles/seen_from_behind.hpp"
#include "reports/triage/hypotheses/readings.hpp"

namespace nearmiss {

namespace {

using Fits = std::optional<bool>;

/// The case with the back of the plane, triangle or rectangle as its front; empty if there is none. A plane has a front
/// in every query.
std::optional<Case> with_back_for_front(const Case& c) {
  const bool has_front = c.query->traits.one_sided || c.operands().find(Shape::plane) != nullptr;
  return has_front ? seen_from_behind(c) : std::nullopt;
}

/// Without weights, which follow the order of the corners.
Answer without_weights(const Case& c, Answer a) {
  for (std::size_t i = 0; i < c.query->outputs.size(); ++i) {
    if (c.query->outputs[i].role == Role::weight) a.given &= ~(std::uint64_t{1} << i);
  }
  return a;
}

/// Where the center of the last sphere or box begins in the inputs.
std::optional<std::size_t> last_center(const Case& c) {
  std::optional<std::size_t> center;
  for (const Operand& o : c.operands()) {
    if (o.shape == Shape::sphere || o.shape == Shape::box) center = o.positions[0];
  }
  return center;
}

/// Whether the center of a sphere or box lies behind the plane of the case.
bool is_behind_plane(const Case& c) {
  const auto center = last_center(c);
  const Operand* plane = c.operands().find(Shape::plane);
  if (!center || plane == nullptr) return false;
  double height = 0;
  for (std::size_t k = 0; k < 3; ++k) height += c.values[*plane->direction + k] * c.values[*center + k];
  return height + c.values[*plane->offset] < 0;
}

/// A plane without a solid side: what lies behind it is pushed out at the back.
Fits plane_with_two_fronts(const Case& c, const Answer& a, const IsRight& is_right) {
  if (c.query->kind != Kind::depth || !is_behind_plane(c)) return std::nullopt;
  return is_right(*seen_from_behind(c), a);
}

Fits back_for_front(const Case& c, const Answer& a, const IsRight& is_right) {
  const auto other = with_back_for_front(c);
  if (!other) return std::nullopt;
  return is_right(*other, without_weights(c, a));
}

/// The normal points the other way.
Answer with_reversed_normal(const Case& c, Answer a) {
  const Layout::Part* p = given_part(c, a, Role::normal);
  for (std::size_t i = 0; p != nullptr && i < p->end - p->begin; ++i) a.values[p->begin + i] *= -1;
  return a;
}

/// Of a hit from behind, the normal points against the motion or is that of the front.
Fits both_sides(const Case& c, const Answer& a, const IsRight& is_right) {
  const auto other = c.query->traits.one_sided ? seen_from_behind(c) : std::nullopt;
  if (!other || exact_decision(c) || !exact_decision(*other)) return std::nullopt;
  const Answer read = without_weights(c, a);
  return is_right(*other, read) || is_right(*other, with_reversed_normal(c, read));
}

/// The back takes the place of the front, and the normal is that of the front.
Fits back_with_front_normal(const Case& c, const Answer& a, const IsRight& is_right) {
  if (given_part(c, a, Role::normal) == nullptr) return std::nullopt;
  return back_for_front(c, with_reversed_normal(c, a), is_right);
}

/// A vector turned by the first rotation of the case; empty where there is none, or where it turns nothing.
std::optional<std::array<double, 3>> turned_as_box(const Case& c, const double* v) {
  const auto& all = c.operands().quaternions;
  if (all.empty()) return std::nullopt;
  const double *q = &c.values[all.front()], n = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
  if (!(n > 0) || (q[0] == 0 && q[1] == 0 && q[2] == 0)) return std::nullopt;
  const auto crossed = [&](const std::array<double, 3>& a) {
    return std::array{(q[1] * a[2] - q[2] * a[1]) / n, (q[2] * a[0] - q[0] * a[2]) / n,
                      (q[0] * a[1] - q[1] * a[0]) / n};
  };
  const std::array<double, 3> given{v[0], v[1], v[2]}, once = crossed(given), twice = crossed(once);
  std::array<double, 3> result;
  for (std::size_t k = 0; k < 3; ++k) result[k] = given[k] + 2 * (q[3] / n * once[k] + twice[k]);
  return result;
}

/// The normal is compared as the measure compares: the turn rounds.
Fits normal_in_frame(const Case& c, const Answer& a, const IsRight& is_right) {
  const Layout::Part* p = given_part(c, a, Role::normal);
  const auto normal = p == nullptr ? std::nullopt : turned_as_box(c, &a.values[p->begin]);
  if (!normal) return std::nullopt;
  Answer other = a;
  std::copy(normal->begin(), normal->end(), other.values.begin() + std::ptrdiff_t(p->begin));
  return is_right(c, other);
}

/// The place as a vector from the center of the fixed operand, in the frame of that operand or not.
template <bool in_frame>
Fits place_from_center(const Case& c, const Answer& a, const IsRight& is_right) {
  const Layout::Part* p = given_part(c, a, Role::position);
  const auto center = last_center(c);
  if (p == nullptr || !center) return std::nullopt;
  std::optional<std::array<double, 3>> from{{a.values[p->begin], a.values[p->begin + 1], a.values[p->begin + 2]}};
  if (in_frame) from = turned_as_box(c, &a.values[p->begin]);
  if (!from) return std::nullopt;
  Answer other = a;
  for (std::size_t k = 0; k < 3; ++k) other.values[p->begin + k] = (*from)[k] + c.values[*center + k];
  if (other.values == a.values) return std::nullopt;
  return is_right(c, other);
}

/// The length of the candidate separating axis of a query about it; empty where the query is about another thing.
std::optional<double> length_of_axis(const Case& c) {
  static const Query* const axes = find_query("box_box_separating_axis");
  const auto same_name = [](const Field& a, const Field& b) { return a.name == b.name; };
  if (!std::equal(c.fields().begin(), c.fields().end(), axes->inputs.begin(), axes->inputs.end(), same_name))
    return std::nullopt;
  Case of_axis = c;
  of_axis.query = axes;
  for (const Alternative& right : truth_of(of_axis).alternatives) {
    std::array<double, 3> direction{};
    for (std::size_t k = 0; k < 3; ++k) direction[k] = (right.values[k].low + right.values[k].high) / 2;
    return std::hypot(direction[0], direction[1], direction[2]);
  }
  return std::nullopt;
}

/// A number along an axis that is divided by the length of the axis once more.
Fits along_unit_axis(const Case& c, const Answer& a, const IsRight& is_right) {
  constexpr double nearly_one = 1 - 1e-9;
  const Layout::Part* distance = c.query->layout.at(Role::distance);
  if (c.query->outputs.size() != 1 || distance == nullptr || a.status != Answer::Status::answered) return std::nullopt;
  const auto length = length_of_axis(c);
  if (!length || !(*length > 0 && *length < nearly_one)) return std::nullopt;
  Answer other = a;
  other.values[distance->begin] *= *length;
  return is_right(c, other);
}

constexpr Reading table_of_frames[] = {
    {"both sides", text_of(Convention::two_sided).what, CauseKind::convention, true, both_sides, Convention::two_sided},
    {"back for front", "the back takes the place of the front", CauseKind::convention, false, back_for_front},
    {"back for front", "the back takes the place of the front, and its normal points the other way",
     CauseKind::convention, false, back_with_front_normal},
    {"plane with two fronts", "a plane has a front on both sides", CauseKind::convention, false, plane_with_two_fronts},
    {"normal in the frame of the box", "its normal is turned by the rotation of the box", CauseKind::convention, false,
     normal_in_frame},
    {"contact from the center", "its place is a vector from the center", CauseKind::convention, false,
     place_from_center<false>},
    {"contact in the frame of the box", "its place is turned, and moved to the center, as the box is",
     CauseKind::convention, false, place_from_center<true>},
    {"along a unit axis", "its number is that along the axis divided by its length", CauseKind::convention, false,
     along_unit_axis},
};

}  // namespace

std::span<const Reading> readings_of_frames() { return table_of_frames; }

}  // namespace nearmiss
