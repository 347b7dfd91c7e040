#include "reports/triage/hypotheses/readings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <vector>

#include "oracles/judge.hpp"
#include "oracles/requirements.hpp"
#include "oracles/touch.hpp"

namespace nearmiss {

namespace {

using Fits = std::optional<bool>;

double length(std::span<const double> x) {
  double square = 0;
  for (const double k : x) square += k * k;
  return std::sqrt(square);
}

double speed_of(const Case& c) {
  const Operands& parts = c.operands();
  return parts.velocities.empty() ? 0 : length({&c.values[parts.velocities[0]], 3});
}

/// The opinion about the answer with every number of this role replaced.
template <class Change>
Fits with_output(const Case& c, const Answer& a, Role role, const IsRight& is_right, const Change& change) {
  const Layout::Part* p = given_part(c, a, role);
  if (p == nullptr) return std::nullopt;
  Answer other = a;
  for (std::size_t i = p->begin; i < p->end; ++i) other.values[i] = change(a.values[i]);
  if (other.values == a.values) return std::nullopt;
  return is_right(c, other);
}

Fits reversed_normal(const Case& c, const Answer& a, const IsRight& is_right) {
  return with_output(c, a, Role::normal, is_right, [](double x) { return -x; });
}

/// The vector divided by its length.
Fits normalised(const Case& c, const Answer& a, const Layout::Part* p, const IsRight& is_right) {
  const double norm = p == nullptr ? 0 : length({&a.values[p->begin], p->end - p->begin});
  if (!(norm > 0) || !std::isfinite(norm)) return std::nullopt;
  return with_output(c, a, p->role, is_right, [&](double x) { return x / norm; });
}

Fits normalised_normal(const Case& c, const Answer& a, const IsRight& is_right) {
  return normalised(c, a, given_part(c, a, Role::normal), is_right);
}

Fits normalised_direction(const Case& c, const Answer& a, const IsRight& is_right) {
  return normalised(c, a, given_part(c, a, Role::direction), is_right);
}

/// The direction stretched to the length of a right one.
Fits direction_of_unit_length(const Case& c, const Answer& a, const IsRight& is_right) {
  const Layout::Part* p = given_part(c, a, Role::direction);
  if (p == nullptr) return std::nullopt;
  const std::vector<Alternative> all = truth_of(c).alternatives;
  if (all.size() != 1) return std::nullopt;
  std::array<double, 3> right{};
  for (std::size_t k = 0; k < 3; ++k)
    right[k] = all[0].values[p->begin + k].low / 2 + all[0].values[p->begin + k].high / 2;
  const double norm = length(right), given = length({&a.values[p->begin], 3});
  const bool is_longer = std::abs(given - 1) <= measure().error && norm < 1 - measure().error;
  if (!is_longer) return std::nullopt;
  return with_output(c, a, p->role, is_right, [&](double x) { return x * norm; });
}

Fits distance_for_time(const Case& c, const Answer& a, const IsRight& is_right) {
  const double speed = speed_of(c);
  if (!(speed > 0)) return std::nullopt;
  return with_output(c, a, Role::time, is_right, [&](double t) { return t / speed; });
}

Fits time_over_speed(const Case& c, const Answer& a, const IsRight& is_right) {
  const double speed = speed_of(c);
  if (!(speed > 0)) return std::nullopt;
  return with_output(c, a, Role::time, is_right, [&](double t) { return t * speed; });
}

/// Whether the answer gives a number other than 0 that is no depth: a contact.
bool gives_contact(const Case& c, const Answer& a) {
  for (const Layout::Part& p : c.query->layout.parts) {
    if (p.role != Role::normal && p.role != Role::position) continue;
    for (std::size_t i = p.begin; i < p.end; ++i) {
      if (a.gives(i) && a.values[i] != 0) return true;
    }
  }
  return false;
}

/// A subject whose decision follows from the sign of its depth calls an overlap a miss, and yet gives a contact.
Fits negative_depth(const Case& c, const Answer& a, const IsRight& is_right) {
  if (c.query->kind != Kind::depth || a.status != Answer::Status::answered) return std::nullopt;
  if (!a.yes && !gives_contact(c, a)) return std::nullopt;
  Answer other = a;
  other.yes = true;
  for (const Layout::Part& p : c.query->layout.parts) {
    if ((p.role == Role::depth || p.role == Role::distance) && a.gives(p.begin))
      other.values[p.begin] = -a.values[p.begin];
  }
  if (other.values == a.values) return std::nullopt;
  return is_right(c, other);
}

/// The place of contact moved by `distance` along the given normal.
Fits moved_place(const Case& c, const Answer& a, double distance, const IsRight& is_right) {
  const Layout::Part* place = given_part(c, a, Role::position);
  const Layout::Part* normal = given_part(c, a, Role::normal);
  if (place == nullptr || normal == nullptr || distance == 0) return std::nullopt;
  Answer other = a;
  for (std::size_t k = 0; k < 3; ++k) other.values[place->begin + k] += distance * a.values[normal->begin + k];
  return is_right(c, other);
}

/// The given place is the center at the given time, and the other numbers are right. The place is compared as the
/// measure compares: relative to the largest number.
Fits center_for_place(const Case& c, const Answer& a, const IsRight& is_right) {
  const auto& start = c.operands().start;
  const auto& velocities = c.operands().velocities;
  const Layout::Part* place = given_part(c, a, Role::position);
  const Layout::Part* time = given_part(c, a, Role::time);
  if (!start || !start->radius || velocities.empty() || place == nullptr || time == nullptr) return std::nullopt;
  Answer rest = a;
  double off = 0, largest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double center = c.values[start->place + k] + a.values[time->begin] * c.values[velocities[0] + k];
    off = std::max(off, std::abs(a.values[place->begin + k] - center));
    largest = std::max(largest, std::abs(c.values[start->place + k]));
    rest.given &= ~(std::uint64_t{1} << (place->begin + k));
  }
  if (c.values[*start->radius] == 0) return std::nullopt;
  return off <= measure().error * largest && is_right(c, rest);
}

/// The overlap, as a positive number; 0 where the answer has none.
double depth_of(const Case& c, const Answer& a) {
  const Layout::Part* depth = given_part(c, a, Role::depth);
  const Layout::Part* p = depth != nullptr ? depth : given_part(c, a, Role::distance);
  return p == nullptr ? 0 : std::abs(a.values[p->begin]);
}

Fits either(Fits a, Fits b) { return a && *a ? a : b && *b ? b : a ? a : b; }

Fits place_on_the_other(const Case& c, const Answer& a, const IsRight& is_right) {
  const double depth = depth_of(c, a);
  return either(moved_place(c, a, depth, is_right), moved_place(c, a, -depth, is_right));
}

Fits place_half_way(const Case& c, const Answer& a, const IsRight& is_right) {
  const double depth = depth_of(c, a) / 2;
  return either(moved_place(c, a, depth, is_right), moved_place(c, a, -depth, is_right));
}

/// The place of the answer, judged as that of a sphere which is so large that it touches at the start.
Fits place_of_the_start(const Case& c, const Answer& a, const IsRight& is_right) {
  const auto& start = c.operands().start;
  const Layout::Part* place = given_part(c, a, Role::position);
  if (!start || !start->radius || place == nullptr || c.query->kind != Kind::impact) return std::nullopt;
  if (!meets(c, Precondition::starts_outside)) return std::nullopt;
  double reach = 0;
  for (const double x : c.values) reach += std::abs(x);
  Case grown = c;
  grown.scalar = Scalar::float64;
  grown.values[*start->radius] = 2 * reach;
  Answer only_place = a;
  only_place.given = 0;
  for (std::size_t i = place->begin; i < place->end; ++i) only_place.given |= std::uint64_t{1} << i;
  return is_right(grown, only_place);
}

Fits strict(const Case& c, const Answer& a, const IsRight&) {
  if (a.status != Answer::Status::answered || !decides(c.query->kind) || !touches_exactly(c)) return std::nullopt;
  return !a.yes;
}

Fits start_inside_is_a_miss(const Case& c, const Answer& a, const IsRight&) {
  if (a.status != Answer::Status::answered || !starts_in_contact(c)) return std::nullopt;
  return !a.yes;
}

/// The least time of contact of a right answer, in durations of the motion or lengths of the ray's direction; empty
/// where it is a miss.
std::optional<double> least_time_of(const Case& c, const Alternative& right) {
  if (!right.yes) return std::nullopt;
  const auto& outputs = c.query->outputs;
  const auto at = [&](Role role) {
    return std::size_t(std::find_if(outputs.begin(), outputs.end(), [&](const Field& f) { return f.role == role; }) -
                       outputs.begin());
  };
  if (const std::size_t time = at(Role::time); time < outputs.size()) return right.values[time].low;
  const Operands& parts = c.operands();
  const std::size_t place = at(Role::position);
  if (!parts.start || parts.directions.empty() || place == outputs.size()) return std::nullopt;
  double along = 0, square = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double d = c.values[parts.directions[0] + k];
    along += (right.values[place + k].low - c.values[parts.start->place + k]) * d, square += d * d;
  }
  return along / square;
}

/// A right answer is a hit at time 0, or the query has no time.
bool is_hit_at_the_start(const Case& c) {
  const std::vector<Alternative> all = truth_of(c).alternatives;
  return std::any_of(all.begin(), all.end(),
                     [&](const Alternative& right) { return right.yes && least_time_of(c, right).value_or(0) <= 0; });
}

/// Makes no difference where a hit at the start is right already, whatever else is wrong with the answer.
Fits start_inside_is_a_hit(const Case& c, const Answer& a, const IsRight&) {
  if (a.status != Answer::Status::answered || !starts_in_contact(c) || is_hit_at_the_start(c)) return std::nullopt;
  const Layout::Part* time = given_part(c, a, Role::time);
  return a.yes && (time == nullptr || a.values[time->begin] == 0);
}

Fits ends_at_time_one(const Case& c, const Answer& a, const IsRight&) {
  if (a.status != Answer::Status::answered || !decides(c.query->kind)) return std::nullopt;
  for (const Alternative& right : truth_of(c).alternatives) {
    if (!(least_time_of(c, right).value_or(0) > 1)) return std::nullopt;
  }
  return !a.yes;
}

Fits counted_from_one(const Case& c, const Answer& a, const IsRight& is_right) {
  return with_output(c, a, Role::index, is_right, [](double x) { return x - 1; });
}

/// The index of another one of three edges, or of three axes of a box, in cyclic order: an edge may have the number of
/// the vertex at its end, or of the opposite one.
template <int steps>
Fits of_another(const Case& c, const Answer& a, const IsRight& is_right) {
  return with_output(c, a, Role::index, is_right,
                     [](double x) { return x < 0 ? x : x - std::fmod(x, 3) + std::fmod(x + steps, 3); });
}

constexpr Reading of_answers[] = {
    {"normal reversed", text_of(Convention::normal_reversed).what, CauseKind::convention, false, reversed_normal,
     Convention::normal_reversed},
    {"normal not of unit length", "its normal is divided by its length", CauseKind::convention, false,
     normalised_normal},
    {"direction not of unit length", "its direction is divided by its length", CauseKind::convention, false,
     normalised_direction},
    {"direction of unit length", "its direction is multiplied by the length of the right one", CauseKind::convention,
     false, direction_of_unit_length},
    {"distance in place of time", "its time is the distance until the contact", CauseKind::convention, false,
     distance_for_time},
    {"time over speed", "its time is divided by the speed once more", CauseKind::convention, false, time_over_speed},
    {"depth of the other sign", "its depth is negative for an overlap", CauseKind::convention, false, negative_depth},
    {"center in place of the contact", text_of(Convention::center_for_contact).what, CauseKind::convention, false,
     center_for_place, Convention::center_for_contact},
    {"contact on the other body", "its place lies on the surface of the other body", CauseKind::convention, false,
     place_on_the_other},
    {"contact half way", "its place lies half way between the two surfaces", CauseKind::convention, false,
     place_half_way},
    {"nearest point of the start", "its place is the point nearest to the start", CauseKind::convention, false,
     place_of_the_start},
    {"strict instead of closed", text_of(Convention::strict_touch).what, CauseKind::convention, true, strict,
     Convention::strict_touch},
    {"start in contact is a miss", text_of(Convention::start_is_miss).what, CauseKind::convention, true,
     start_inside_is_a_miss, Convention::start_is_miss},
    {"start in contact is a hit", text_of(Convention::start_is_hit).what, CauseKind::convention, true,
     start_inside_is_a_hit, Convention::start_is_hit},
    {"motion ends at time 1", text_of(Convention::ends_at_time_one).what, CauseKind::convention, true, ends_at_time_one,
     Convention::ends_at_time_one},
    {"index from 1", "its index counts from 1", CauseKind::convention, false, counted_from_one},
    {"index of the one before", "its index is that of the one before", CauseKind::convention, false, of_another<1>},
    {"index of the next one", "its index is that of the next one", CauseKind::convention, false, of_another<2>},
};

/// After all others: a flag that is ignored says more.
constexpr Reading of_starts[] = {
    {"start in contact is a hit", text_of(Convention::start_is_hit).what, CauseKind::convention, false,
     start_inside_is_a_hit, Convention::start_is_hit},
};

}  // namespace

const Layout::Part* given_part(const Case& c, const Answer& a, Role role) {
  if (a.status != Answer::Status::answered || !a.yes) return nullptr;
  const auto& parts = c.query->layout.parts;
  const auto found = std::find_if(parts.begin(), parts.end(),
                                  [&](const Layout::Part& p) { return p.role == role && a.gives(p.begin); });
  return found == parts.end() ? nullptr : &*found;
}

std::vector<Prediction> predictions_of(const Reading& reading) {
  return reading.decides ? std::vector<Prediction>{} : std::vector{Prediction::in_every_mode};
}

std::span<const Reading> readings() {
  static const std::vector<Reading> table = [] {
    std::vector<Reading> all(std::begin(of_answers), std::end(of_answers));
    for (const auto more : {readings_of_frames(), readings_of_inputs(), readings_of_values(), readings_of_contacts()})
      all.insert(all.end(), more.begin(), more.end());
    all.insert(all.end(), std::begin(of_starts), std::end(of_starts));
    return all;
  }();
  return table;
}

std::span<const Reading> readings_of_answers() {
  static const std::vector<Reading> table = [] {
    std::vector<Reading> all(std::begin(of_answers), std::end(of_answers));
    for (const auto more : {readings_of_values(), readings_of_contacts()})
      all.insert(all.end(), more.begin(), more.end());
    return all;
  }();
  return table;
}

bool starts_in_contact(const Case& c) {
  return c.operands().start.has_value() && !meets(c, Precondition::starts_outside);
}

}  // namespace nearmiss
