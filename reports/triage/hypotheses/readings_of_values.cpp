#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "oracles/motion_numbers.hpp"
#include "oracles/requirements.hpp"
#include "reports/triage/hypotheses/readings.hpp"

namespace nearmiss {

namespace {

using Fits = std::optional<bool>;

bool answers_yes(const Answer& a) { return a.status == Answer::Status::answered && a.yes; }

std::uint64_t bits_of(const Layout::Part& p) { return ((std::uint64_t{1} << (p.end - p.begin)) - 1) << p.begin; }

/// The answer with one member alone.
Answer only(const Answer& a, const Layout::Part& p) {
  Answer other = a;
  other.given &= bits_of(p);
  return other;
}

/// A power of two that is longer than the motion needs to pass everything that the case has; empty where nothing moves.
std::optional<double> time_beyond_all(const Case& c, const MotionNumbers& m) {
  double reach = 0;
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    const Role role = c.role(i);
    if (role == Role::position || role == Role::size || role == Role::offset) reach += std::abs(c.values[i]);
  }
  const double* v = &c.values[m.way];
  const double time = std::exp2(std::ceil(std::log2(reach / std::hypot(v[0], v[1], v[2]))) + 1);
  return std::isfinite(time) && time > 0 ? std::optional(time) : std::nullopt;
}

/// The case `time` later, in double.
Case later(const Case& c, const MotionNumbers& m, double time) {
  Case other = c;
  other.scalar = Scalar::float64;
  for (std::size_t k = 0; k < 3; ++k) other.values[m.place + k] += time * c.values[m.way + k];
  return other;
}

/// A contact before the start, judged as that of a motion which starts earlier.
Fits before_the_start(const Case& c, const Answer& a, const IsRight& is_right) {
  const auto motion = motion_numbers_of(c);
  if (!motion || !answers_yes(a)) return std::nullopt;
  const Layout::Part* place = given_part(c, a, Role::position);
  const Layout::Part* time = given_part(c, a, Role::time);
  auto earlier = time_beyond_all(c, *motion);
  if (!earlier || place == nullptr) return std::nullopt;
  double along = 0;
  for (std::size_t k = 0; k < 3; ++k)
    along += (a.values[place->begin + k] - c.values[motion->place + k]) * c.values[motion->way + k];
  const bool is_before = time == nullptr ? along < 0 : a.values[time->begin] < 0;
  if (!is_before) return std::nullopt;
  Answer other = a;
  if (time != nullptr) {
    while (*earlier < -2 * a.values[time->begin]) *earlier *= 2;
    other.values[time->begin] += *earlier;
  }
  const Case moved = later(c, *motion, -*earlier);
  return std::isfinite(*earlier) && !c.query->broken(moved.values) ? Fits(is_right(moved, other)) : std::nullopt;
}

/// The place and the time, judged as those of the reversed motion that comes from beyond everything.
Fits where_it_leaves(const Case& c, const Answer& a, const IsRight& is_right) {
  const auto motion = motion_numbers_of(c);
  if (!motion || !answers_yes(a) || c.query->traits.one_sided) return std::nullopt;
  const Layout::Part* place = given_part(c, a, Role::position);
  const Layout::Part* time = given_part(c, a, Role::time);
  const auto beyond = time_beyond_all(c, *motion);
  if (place == nullptr || !beyond || is_right(c, only(a, *place))) return std::nullopt;
  Case back = later(c, *motion, *beyond);
  for (std::size_t k = 0; k < 3; ++k) back.values[motion->way + k] = -c.values[motion->way + k];
  if (c.query->broken(back.values)) return std::nullopt;
  Answer other = a;
  other.given &= bits_of(*place) | (time == nullptr ? 0 : bits_of(*time));
  if (time != nullptr) other.values[time->begin] = *beyond - a.values[time->begin];
  return is_right(back, other);
}

/// A wrong member has the value that belongs to another one of its kind.
Fits value_of_another(const Case& c, const Answer& a, const IsRight& is_right) {
  if (!answers_yes(a)) return std::nullopt;
  const auto& parts = c.query->layout.parts;
  Fits fits;
  for (const Layout::Part& p : parts) {
    const std::size_t size = p.end - p.begin;
    if (size < 2 || !a.gives(p.begin) || is_right(c, only(a, p))) continue;
    fits = fits.value_or(false);
    for (const Layout::Part& source : parts) {
      const bool is_like = source.role == p.role && source.end - source.begin == size && source.begin != p.begin;
      if (!is_like || !a.gives(source.begin)) continue;
      Answer other = only(a, source);
      std::copy_n(a.values.begin() + std::ptrdiff_t(p.begin), size,
                  other.values.begin() + std::ptrdiff_t(source.begin));
      if (is_right(c, other)) return true;
    }
  }
  return fits;
}

Fits weights_in_another_order(const Case& c, const Answer& a, const IsRight& is_right) {
  const Layout::Part* p = given_part(c, a, Role::weight);
  if (p == nullptr || p->end - p->begin != 3) return std::nullopt;
  std::array<std::size_t, 3> order{0, 1, 2};
  while (std::next_permutation(order.begin(), order.end())) {
    Answer other = a;
    for (std::size_t k = 0; k < 3; ++k) other.values[p->begin + k] = a.values[p->begin + order[k]];
    if (other.values != a.values && is_right(c, other)) return true;
  }
  return false;
}

constexpr Reading table_of_values[] = {
    {"contact before the start", "a contact before the start counts", CauseKind::convention, false, before_the_start},
    {"contact where it leaves", "its place is that where the contact ends", CauseKind::convention, false,
     where_it_leaves},
    {"weights in another order", "its weights are those of the corners in another order", CauseKind::convention, false,
     weights_in_another_order},
    {"value of another", "one of its values is that of another one", CauseKind::logic, false, value_of_another},
};

}  // namespace

std::span<const Reading> readings_of_values() { return table_of_values; }

}  // namespace nearmiss
