#include "reports/triage/readings.hpp"

#include <algorithm>
#include <cmath>

#include "oracles/judge.hpp"
#include "oracles/requirements.hpp"
#include "oracles/touch.hpp"

namespace nearmiss {

namespace {

using Fits = std::optional<bool>;

/// The first member of the answer with this role that the answer gives; nullptr if there is none.
const Layout::Part* given_part(const Case& c, const Answer& a, Role role) {
  if (a.status != Answer::Status::answered || !a.yes) return nullptr;
  for (const Layout::Part& p : c.query->layout.parts) {
    if (p.role == role && a.gives(p.begin)) return &p;
  }
  return nullptr;
}

double length(std::span<const double> x) {
  double square = 0;
  for (const double k : x) square += k * k;
  return std::sqrt(square);
}

double speed_of(const Case& c) {
  const Parts& parts = parts_of(*c.query);
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

/// The opinion about the answer to the case with every input of this role replaced.
template <class Change>
Fits with_input(const Case& c, const Answer& a, Role role, const IsRight& is_right, const Change& change) {
  Case other = c;
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    if (c.query->inputs[i].role == role) other.values[i] = change(i, c.values[i]);
  }
  if (other.values == c.values || c.query->broken(other.values)) return std::nullopt;
  return is_right(other, a);
}

Fits reversed_normal(const Case& c, const Answer& a, const IsRight& is_right) {
  return with_output(c, a, Role::normal, is_right, [](double x) { return -x; });
}

Fits normalised_normal(const Case& c, const Answer& a, const IsRight& is_right) {
  const Layout::Part* p = given_part(c, a, Role::normal);
  const double norm = p == nullptr ? 0 : length({&a.values[p->begin], p->end - p->begin});
  if (!(norm > 0) || !std::isfinite(norm)) return std::nullopt;
  return with_output(c, a, Role::normal, is_right, [&](double x) { return x / norm; });
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
    if (p.role == Role::depth && a.gives(p.begin)) other.values[p.begin] = -a.values[p.begin];
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
  const auto& start = parts_of(*c.query).start;
  const auto& velocities = parts_of(*c.query).velocities;
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
  const Layout::Part* p = given_part(c, a, Role::depth);
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
  const auto& start = parts_of(*c.query).start;
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

bool starts_in_contact(const Case& c) {
  return parts_of(*c.query).start.has_value() && !meets(c, Precondition::starts_outside);
}

Fits start_inside_is_a_miss(const Case& c, const Answer& a, const IsRight&) {
  if (a.status != Answer::Status::answered || !starts_in_contact(c)) return std::nullopt;
  return !a.yes;
}

Fits start_inside_is_a_hit(const Case& c, const Answer& a, const IsRight&) {
  if (a.status != Answer::Status::answered || !starts_in_contact(c)) return std::nullopt;
  const Layout::Part* time = given_part(c, a, Role::time);
  return a.yes && (time == nullptr || a.values[time->begin] == 0);
}

Fits ends_at_time_one(const Case& c, const Answer& a, const IsRight&) {
  const auto time = std::find_if(c.query->outputs.begin(), c.query->outputs.end(),
                                 [](const Field& f) { return f.role == Role::time; });
  if (a.status != Answer::Status::answered || !decides(c.query->kind) || time == c.query->outputs.end())
    return std::nullopt;
  for (const Alternative& right : truth_of(c).alternatives) {
    if (!right.yes || !(right.values[std::size_t(time - c.query->outputs.begin())].low > 1)) return std::nullopt;
  }
  return !a.yes;
}

void swap_vectors(Case& c, std::size_t i, std::size_t k) {
  std::swap_ranges(c.values.begin() + std::ptrdiff_t(i), c.values.begin() + std::ptrdiff_t(i) + 3,
                   c.values.begin() + std::ptrdiff_t(k));
}

/// The case with the back of the plane, triangle or rectangle as its front; empty if there is none.
std::optional<Case> seen_from_behind(const Case& c) {
  if (!c.query->traits.one_sided) return std::nullopt;
  const Parts& parts = parts_of(*c.query);
  Case other = c;
  if (!parts.rectangles.empty()) {
    swap_vectors(other, parts.rectangles[0][1], parts.rectangles[0][3]);
  } else if (!parts.triangles.empty()) {
    swap_vectors(other, parts.triangles[0][1], parts.triangles[0][2]);
  } else {
    for (std::size_t i = 0; i < c.values.size(); ++i) {
      const Role role = c.query->inputs[i].role;
      if (role == Role::direction || role == Role::offset) other.values[i] = -c.values[i];
    }
  }
  return other;
}

/// Without weights, which follow the order of the corners.
Answer without_weights(const Case& c, Answer a) {
  for (std::size_t i = 0; i < c.query->outputs.size(); ++i) {
    if (c.query->outputs[i].role == Role::weight) a.given &= ~(std::uint64_t{1} << i);
  }
  return a;
}

Fits back_for_front(const Case& c, const Answer& a, const IsRight& is_right) {
  const auto other = seen_from_behind(c);
  if (!other) return std::nullopt;
  return is_right(*other, without_weights(c, a));
}

Fits both_sides(const Case& c, const Answer& a, const IsRight& is_right) {
  const auto other = seen_from_behind(c);
  if (!other || exact_decision(c) || !exact_decision(*other)) return std::nullopt;
  return is_right(*other, without_weights(c, a));
}

bool is_half_extent(const Case& c, std::size_t i) {
  return c.query->inputs[i].name.find(".half.") != std::string::npos;
}

template <int numerator, int denominator, bool half_extents>
Fits scaled_sizes(const Case& c, const Answer& a, const IsRight& is_right) {
  return with_input(c, a, Role::size, is_right, [&](std::size_t i, double x) {
    return is_half_extent(c, i) == half_extents ? x * numerator / denominator : x;
  });
}

/// The opinion with every quaternion replaced.
template <class Change>
Fits with_rotations(const Case& c, const Answer& a, const IsRight& is_right, const Change& change) {
  Case other = c;
  for (const std::size_t i : parts_of(*c.query).quaternions) {
    const std::array<double, 4> q{c.values[i], c.values[i + 1], c.values[i + 2], c.values[i + 3]};
    const std::array<double, 4> changed = change(q);
    std::copy(changed.begin(), changed.end(), other.values.begin() + std::ptrdiff_t(i));
  }
  if (other.values == c.values || c.query->broken(other.values)) return std::nullopt;
  return is_right(other, a);
}

using Quaternion = std::array<double, 4>;

Fits inverse_rotation(const Case& c, const Answer& a, const IsRight& is_right) {
  return with_rotations(c, a, is_right, [](const Quaternion& q) { return Quaternion{-q[0], -q[1], -q[2], q[3]}; });
}
Fits w_first(const Case& c, const Answer& a, const IsRight& is_right) {
  return with_rotations(c, a, is_right, [](const Quaternion& q) { return Quaternion{q[1], q[2], q[3], q[0]}; });
}
Fits no_rotation(const Case& c, const Answer& a, const IsRight& is_right) {
  return with_rotations(c, a, is_right, [](const Quaternion& q) {
    const bool is_turned = q[0] != 0 || q[1] != 0 || q[2] != 0;
    return is_turned ? Quaternion{0, 0, 0, 1} : q;
  });
}

Fits negative_offset(const Case& c, const Answer& a, const IsRight& is_right) {
  return with_input(c, a, Role::offset, is_right, [](std::size_t, double x) { return -x; });
}
Fits reversed_velocity(const Case& c, const Answer& a, const IsRight& is_right) {
  return with_input(c, a, Role::velocity, is_right, [](std::size_t, double x) { return -x; });
}
Fits other_flag(const Case& c, const Answer& a, const IsRight& is_right) {
  return with_input(c, a, Role::flag, is_right, [](std::size_t, double x) { return 1 - x; });
}
/// A case whose flag has this value already makes no difference.
template <int value>
Fits fixed_flag(const Case& c, const Answer& a, const IsRight& is_right) {
  return with_input(c, a, Role::flag, is_right, [](std::size_t, double) { return double(value); });
}
Fits counted_from_one(const Case& c, const Answer& a, const IsRight& is_right) {
  return with_output(c, a, Role::index, is_right, [](double x) { return x - 1; });
}

constexpr Reading table[] = {
    {"normal reversed", "its normal points the other way", CauseKind::convention, false, reversed_normal},
    {"normal not of unit length", "its normal is divided by its length", CauseKind::convention, false,
     normalised_normal},
    {"distance in place of time", "its time is the distance until the contact", CauseKind::convention, false,
     distance_for_time},
    {"time over speed", "its time is divided by the speed once more", CauseKind::convention, false, time_over_speed},
    {"depth of the other sign", "its depth is negative for an overlap", CauseKind::convention, false, negative_depth},
    {"center in place of the contact", "its place is the center at the contact", CauseKind::convention, false,
     center_for_place},
    {"contact on the other body", "its place lies on the surface of the other body", CauseKind::convention, false,
     place_on_the_other},
    {"contact half way", "its place lies half way between the two surfaces", CauseKind::convention, false,
     place_half_way},
    {"nearest point of the start", "its place is the point nearest to the start", CauseKind::convention, false,
     place_of_the_start},
    {"strict instead of closed", "a touch is a miss", CauseKind::convention, true, strict},
    {"start in contact is a miss", "a start in contact is a miss", CauseKind::convention, true, start_inside_is_a_miss},
    {"start in contact is a hit", "a start in contact is a hit at time 0", CauseKind::convention, true,
     start_inside_is_a_hit},
    {"motion ends at time 1", "a contact after time 1 is a miss", CauseKind::convention, true, ends_at_time_one},
    {"both sides", "the back counts as well as the front", CauseKind::convention, true, both_sides},
    {"back for front", "the back takes the place of the front", CauseKind::convention, false, back_for_front},
    {"half extents halved", "the given half extents are full extents", CauseKind::convention, false,
     scaled_sizes<1, 2, true>},
    {"half extents doubled", "each half extent is twice the given one", CauseKind::convention, false,
     scaled_sizes<2, 1, true>},
    {"radius halved", "the given radius is a diameter", CauseKind::convention, false, scaled_sizes<1, 2, false>},
    {"radius doubled", "each radius is twice the given one", CauseKind::convention, false, scaled_sizes<2, 1, false>},
    {"rotation inverted", "each rotation is the inverse of the given one", CauseKind::convention, false,
     inverse_rotation},
    {"quaternion begins with w", "the four numbers of a quaternion are w, x, y, z", CauseKind::convention, false,
     w_first},
    {"offset of the other sign", "the plane's offset has the other sign", CauseKind::convention, false,
     negative_offset},
    {"velocity reversed", "the velocity has the other sign", CauseKind::convention, false, reversed_velocity},
    {"flag inverted", "the flag has the other value", CauseKind::convention, false, other_flag},
    {"index from 1", "its index counts from 1", CauseKind::convention, false, counted_from_one},
    {"rotation ignored", "rotations are ignored", CauseKind::unsupported, false, no_rotation},
    {"radius ignored", "radii are ignored", CauseKind::unsupported, false, scaled_sizes<0, 1, false>},
    {"flag ignored", "the flag is taken for true", CauseKind::unsupported, false, fixed_flag<1>},
    {"flag ignored", "the flag is taken for false", CauseKind::unsupported, false, fixed_flag<0>},
};

}  // namespace

std::span<const Reading> readings() { return table; }

}  // namespace nearmiss
