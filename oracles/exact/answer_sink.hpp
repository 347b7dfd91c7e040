/// The sink to which an oracle's algorithm reports every possible answer. The sink compares each one with the given
/// answer.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <source_location>
#include <string_view>
#include <vector>

#include "impl/catalogue/layout.hpp"
#include "impl/subject/floating_point.hpp"
#include "oracles/exact/arithmetic.hpp"
#include "oracles/exact/decimal.hpp"
#include "oracles/exact/normals.hpp"
#include "oracles/exact/oracle.hpp"
#include "oracles/exact/scaling.hpp"

namespace nearmiss::oracle {

inline Bounds bounds(const Interval& x) { return {x.inf(), x.sup()}; }
/// Tight even where the two parts of a + b sqrt(c) nearly cancel.
Bounds bounds(const Exact& x);
/// Encloses x / 2^exponent, whatever the magnitude of x.
Bounds bounds(const Exact& x, long exponent);
/// |x| is less than 2^exponent, and about that. nullopt: x is zero.
std::optional<long> exponent_of(const Exact& x);

/// Encloses |x|.
inline Bounds magnitude_bounds(const Interval& x) {
  const Bounds b = bounds(x);
  return {b.nearest_to_zero(), b.furthest_from_zero()};
}
/// Encloses |x| by two numbers that lie on the same side of each power of two as |x|, so that they have its ulp.
Bounds magnitude_bounds(const Exact& x);

/// Exact - given, number by number.
struct Errors {
  std::array<Bounds, Answer::capacity> of{};
  /// The same for the three numbers of the normal, with the given normal divided by its length.
  std::array<Bounds, 3> of_direction{};
  /// The magnitudes of the exact numbers.
  std::array<Bounds, Answer::capacity> magnitude{};
};

/// The distance, in ulps, of the given answer from the nearest member of a set of right answers.
struct SetDistance {
  /// One vector judged alone; `begin` is its first number.
  struct Part {
    std::size_t begin;
    Bounds ulps;
  };
  NumberVector<Part> vectors;
  Bounds together{0, 0};  ///< all vectors, each compared with the same member of the set
};

/// The index of the first number of the member with that name among the numbers of an answer type.
template <class A>
consteval std::size_t begin_of(std::string_view member) {
  A a{};
  std::size_t at = 0;
  std::optional<std::size_t> begin;
  collide::for_each_member(a, [&](std::string_view name, auto& value, Role role) {
    if (name == member) begin = at;
    collide::for_each_leaf(
        value, [&](auto&, Role) { ++at; }, role);
  });
  return begin.value();  // an error of the compiler where there is no such member
}

/// The part of AnswerSink that does not depend on the answer's type: accumulates the enclosure of all reported answers.
class EnclosureAccumulator {
 public:
  EnclosureAccumulator(const Answer& about, Scalar scalar, const Layout& layout);

  const Enclosure& result() const { return result_; }
  /// True if the given answer is a yes, so that its numbers are compared. Otherwise only the decision counts.
  bool compares_yes() const { return about_.yes; }
  /// Three numbers of the given answer from `begin` on, in the units of the input. For a normal that has a direction
  /// also the normal divided by its length. The distance of the normal is that of the nearer form.
  NumberVector<GivenVector> given_vector(std::size_t begin) const;
  /// The right answers, for people; of the exact stage.
  void list_in(AlternativeList* list) { list_ = list; }
  /// The units in which the oracle reports. `scaling` must outlive this object.
  void measure_in(const Scaling& scaling) { scaling_ = scaling.any() ? &scaling : nullptr; }
  /// The inputs in the middle of those that are enclosed; empty where the oracle reports in other units.
  void widened_from(std::span<const double> middle) { middle_ = middle; }
  std::span<const double> middle() const { return scaling_ == nullptr ? middle_ : std::span<const double>(); }

 protected:
  /// Includes one possible answer; its first `given` numbers are compared with the given answer. If it stands for a
  /// set, `set` holds the distances of the vectors that belong to the set.
  void count(bool yes, const Errors& errors, std::size_t given, const SetDistance& set);
  void count_everything();
  using Place = std::source_location;
  /// Notes the branch of the algorithm that reports an answer.
  void note(const Place& from) {
    result_.branches |= std::uint64_t{1} << (from.line() * 0x9e3779b1u >> 26);
    ++result_.answers;
  }
  /// The part of `set` that remains known where the given places and the set have different units: the distances of
  /// normals.
  SetDistance without_units(SetDistance set) const;
  /// Raises each distance to that from the enclosure, because the enclosure contains the places of every member.
  void include_enclosure(const Errors& errors, SetDistance& set) const;

  const Answer& about_;
  Scalar scalar_;
  const Layout& layout_;
  AlternativeList* list_ = nullptr;
  const Scaling* scaling_ = nullptr;  ///< nullptr: the units of the input
  std::span<const double> middle_{};

  /// The given normal divided by its length, as a sum of two doubles within `direction_slack` of it in each component.
  /// `high` is below 1 where the component is. Unknown if there is no normal, or if it has no direction: it is zero, or
  /// a number of it is not given or not finite.
  struct UnitNormal {
    bool known = false;
    std::array<double, 3> high{}, low{};

    static UnitNormal of(const double* normal);
    /// The largest magnitude in `high`.
    double largest() const { return std::max({std::abs(high[0]), std::abs(high[1]), std::abs(high[2])}); }
  };
  /// At most ten operations in long double, each with a relative error of at most 2^-63 in any rounding mode.
  static constexpr double direction_slack = 0x1p-59;
  UnitNormal unit_normal_;

 private:
  struct Distance;
  /// The unit in which a member's numbers are compared: one ulp of the largest of them, given or exact. The bounds
  /// differ where the magnitudes of the exact ones enclose numbers with different ulps.
  Bounds unit_of(const Layout::Part& part, const Errors& errors, double largest_given) const;
  double largest_given(const Layout::Part& part) const;
  double least_unit(const Layout::Part& part) const;
  /// A normal without a direction is no unit vector: at least so far, in the maximum norm, from each. Otherwise 0.
  double apart_from_directions(const Layout::Part& part) const;
  Distance distance_of(const Layout::Part& part, const Errors& errors) const;
  Distance distance_of(const Layout::Part& part, const Errors& errors, const Bounds& ulps) const;
  void count_member(std::size_t member, const Distance& d);
  /// The part that contains the number.
  const Layout::Part& part_at(std::size_t number) const;

  Enclosure result_;
  bool any_ = false;
};

/// A is the answer type over N.
template <class N, class A>
class AnswerSink : public EnclosureAccumulator {
 public:
  using EnclosureAccumulator::EnclosureAccumulator;
  using Place = EnclosureAccumulator::Place;

  // `from` is the place of the call, for Enclosure::branches.

  /// "No", without further numbers, is a right answer.
  void no(const Place& from = Place::current()) { put(from, false, A{}, {}, 0); }
  /// `a` is a right answer; only its first `leaves` leaves have a meaning.
  void no(const A& a, std::size_t leaves, const Place& from = Place::current()) { put(from, false, a, {}, leaves); }
  void yes(const A& a, const Normals<N>& normals = Normals<N>::as_given(), const Place& from = Place::current()) {
    put(from, true, a, normals, Answer::capacity);
  }
  /// The same; only the first `leaves` leaves are compared, and the other ones may have any value.
  void yes(const A& a, const Normals<N>& normals, std::size_t leaves, const Place& from = Place::current()) {
    put(from, true, a, normals, leaves);
  }
  /// Every answer of a set is right: `a` is one of them or, for intervals, encloses them all.
  void yes(const A& a, const SetDistance& set, const Place& from = Place::current()) {
    put(from, true, a, Normals<N>::as_given(), Answer::capacity, set);
  }
  /// The same, with any of these normals: `set` holds the distance of a normal too.
  void yes(const A& a, const Normals<N>& normals, const SetDistance& set, const Place& from = Place::current()) {
    put(from, true, a, normals, Answer::capacity, set);
  }
  /// Any answer may be right, for example after a division by a number that may be zero.
  void everything(const Place& from = Place::current()) {
    note(from);
    count_everything();
  }

 private:
  void put(const Place& from, bool yes, const A& a, const Normals<N>& normals, std::size_t leaves,
           const SetDistance& set = {}) {
    note(from);
    if (scaling_ == nullptr) return add(yes, a, normals, leaves, set);
    add(yes, in_units_of_the_input(a, leaves), normals, leaves, without_units(set));
  }
  /// Converts the first `leaves` leaves; the other ones need not be numbers.
  A in_units_of_the_input(A a, std::size_t leaves) const {
    std::size_t i = 0;
    collide::for_each_leaf(a, [&](auto& leaf, Role role) {
      if constexpr (std::is_same_v<std::decay_t<decltype(leaf)>, Interval>) {
        if (i < leaves) leaf = scaling_->to_answer(role, leaf);
      }
      ++i;
    });
    return a;
  }
  /// `late`: the no stands for a contact beyond the scalar's largest time.
  void add(bool yes, const A& a, const Normals<N>& normals, std::size_t leaves, const SetDistance& set,
           bool late = false);
  /// The answer for people.
  Alternative alternative(bool yes, const A& a, const Normals<N>& normals, std::size_t leaves) const;
  /// Exact - given for the first `leaves` leaves, or the exact values themselves if `from_zero`. Returns how many.
  std::size_t errors_of(const A& a, bool many_normals, std::size_t leaves, bool from_zero, Errors& errors) const;
  SetDistance from(const Normals<N>& normals) const;
  /// The leaves that a hit beyond the scalar's largest time gives with its miss: only that it starts outside.
  static constexpr std::size_t leaves_of_late_hit = requires(A a) { a.inside; } ? 1 : 0;
  static_assert(begin_of<collide::Entry<double>>("inside") == 0);
};

/// Below 1 / sqrt(3): the largest component of a unit vector has at least that magnitude.
inline constexpr double least_of_largest_component = 0.577;

/// Exact - given. A given infinity matches every exact number beyond the largest finite number.
template <class N>
Bounds error_of(const N& exact, double given, Scalar scalar) {
  if (std::isnan(given)) return {-HUGE_VAL, HUGE_VAL};
  if (std::isfinite(given)) return given == 0 ? bounds(exact) : bounds(N(exact - N(given)));
  const Bounds short_of = bounds(N(exact - N(std::copysign(largest_finite(scalar), given))));
  return given > 0 ? Bounds{std::min(short_of.low, 0.0), std::min(short_of.high, 0.0)}
                   : Bounds{std::max(short_of.low, 0.0), std::max(short_of.high, 0.0)};
}

template <class N, class A>
std::size_t AnswerSink<N, A>::errors_of(const A& a, bool many_normals, std::size_t leaves, bool from_zero,
                                        Errors& errors) const {
  std::size_t i = 0, component = 0;
  collide::for_each_leaf(a, [&](const auto& leaf, Role role) {
    if (i >= leaves) return;
    const double given = from_zero ? 0.0 : about_.values[i];
    if constexpr (std::is_same_v<std::decay_t<decltype(leaf)>, N>) {
      if (role == Role::normal && many_normals) {
        errors.of[i] = {-1 - std::abs(given), 1 + std::abs(given)};
        errors.magnitude[i] = {least_of_largest_component, 1};
      } else if (role == Role::normal) {
        const N exact = assume_within(leaf, -1.0, 1.0);
        errors.of[i] = error_of(exact, given, scalar_);
        errors.magnitude[i] = magnitude_bounds(exact);
        if (!from_zero && unit_normal_.known) {
          const Bounds off = bounds(N(N(exact - N(unit_normal_.high[component])) - N(unit_normal_.low[component])));
          errors.of_direction[component] = {off.low - direction_slack, off.high + direction_slack};
        }
        ++component;
      } else {
        errors.of[i] = error_of(N(leaf), given, scalar_);
        errors.magnitude[i] = magnitude_bounds(N(leaf));
      }
    } else {
      errors.of[i] = {double(leaf) - given, double(leaf) - given};
      errors.magnitude[i] = {std::abs(double(leaf)), std::abs(double(leaf))};
    }
    ++i;
  });
  return i;
}

template <class N, class A>
SetDistance AnswerSink<N, A>::from(const Normals<N>& normals) const {
  SetDistance set;
  for (const Layout::Part& part : layout_.parts) {
    if (part.role == Role::normal) set.vectors.push_back({part.begin, ulps_from(given_vector(part.begin), normals)});
  }
  return set;
}

/// `a` with this normal.
template <class N, class A>
A with_normal(A a, const Vector<N>& normal) {
  std::size_t k = 0;
  collide::for_each_leaf(a, [&](auto& leaf, Role role) {
    if constexpr (std::is_same_v<std::decay_t<decltype(leaf)>, N>) {
      if (role == Role::normal) leaf = normal[k++];
    }
  });
  return a;
}

template <class N, class A>
Alternative AnswerSink<N, A>::alternative(bool yes, const A& a, const Normals<N>& normals, std::size_t leaves) const {
  Alternative shown{.yes = yes, .many_normals = normals.many};
  Errors values;
  shown.count = errors_of(a, shown.many_normals, leaves, true, values);
  shown.values = values.of;
  collide::for_each_leaf(a, [&](const auto& leaf, Role) {
    if (shown.decimals.size() == shown.count) return;
    const auto exact = [&] {
      if constexpr (std::is_same_v<std::decay_t<decltype(leaf)>, N>) {
        return leaf;
      } else {
        return N(double(leaf));
      }
    }();
    shown.nearest.push_back(nearest_number(exact, scalar_));
    shown.decimals.push_back(list_->digits > 0 ? decimal_of_digits(exact, list_->digits)
                                               : decimal_of(exact, shown.nearest.back(), scalar_));
  });
  if (!shown.many_normals) return shown;
  for (const Facing<N>& f : normals.facing) {
    const N length2 = norm2(f.direction);
    if (may_be_zero(length2)) continue;
    const Vector<N> unit = times(f.direction, N(N(1) / root(length2)));
    shown.facing.push_back({{bounds(unit[0]), bounds(unit[1]), bounds(unit[2])},
                            {decimal_of(unit[0], scalar_), decimal_of(unit[1], scalar_), decimal_of(unit[2], scalar_)},
                            {double(f.low), double(f.high)}});
  }
  return shown;
}

template <class N, class A>
void AnswerSink<N, A>::add(bool yes, const A& a, const Normals<N>& normals, std::size_t leaves, const SetDistance& set,
                           bool late) {
  if constexpr (requires { collide::first_time(a); }) {
    if (yes) {  // a time beyond the largest finite number is a miss
      const N beyond = collide::first_time(a) - N(largest_finite(scalar_));
      if (may_be_positive(beyond)) add(false, A{}, {}, leaves_of_late_hit, {}, true);
      if (!may_be_at_most_zero(beyond)) return;
    }
  }
  if constexpr (!is_enclosure<N>) {
    if (const auto only = only_normal(normals)) {  // a cone of one normal is that normal
      return add(yes, with_normal(a, *only), Normals<N>::as_given(), leaves, set, late);
    }
    if (list_ != nullptr) {
      list_->all.push_back(alternative(yes, a, normals, leaves));
      list_->all.back().late = late;
    }
  }
  if (yes != about_.yes) return count(yes, {}, 0, {});
  Errors errors;
  const std::size_t given = errors_of(a, normals.many, leaves, false, errors);
  SetDistance nearest = normals.many && set.vectors.empty() ? from(normals) : set;
  if constexpr (is_enclosure<N>) include_enclosure(errors, nearest);
  count(yes, errors, given, nearest);
}

/// A place of the given answer, as on_surface() of an oracle receives it.
template <class N>
struct GivenPlace {
  Vector<N> at;
  N slack;             ///< how far off it may be
  std::size_t number;  ///< index of its first number in the answer
  const Answer& about;
};

/// Makes the name on_surface known. An oracle's file adds an overload if its query names a surface.
class NoQuery;
bool on_surface(const NoQuery&);

/// The three numbers of the answer, from `number` on, that form a place, and how far off the place may be.
struct PlaceInAnswer {
  std::size_t number;
  double slack;

  /// Empty if that is undefined: a number is not finite, or the slack is as large as the numbers.
  static std::optional<PlaceInAnswer> of(const Answer& about, const Layout& layout, std::size_t number, double ulps,
                                         Scalar scalar);
};

// The two stages. They run in the standard floating-point modes, whatever the caller's modes are. At the end: the macro
// that ends an oracle's .cpp file.

/// Sets the intervals' rounding mode for its lifetime. any_invalid() then tells whether an operation was invalid
/// (infinity - infinity, 0 * infinity), so that the bounds mean nothing.
class IntervalScope {
 public:
  IntervalScope();
  /// Call it after a compiler barrier, when the arithmetic is done.
  bool any_invalid() const;

 private:
  CGAL::Protect_FPU_rounding<true> upward_{CGAL_FE_UPWARD};
};

/// Keeps arithmetic from moving across a change of the floating-point environment.
inline void arithmetic_barrier() { asm volatile("" ::: "memory"); }

/// The roles of the numbers of the inputs.
template <class Q>
std::vector<Role> roles_of(Q q) {
  std::vector<Role> roles;
  collide::for_each_leaf(q, [&](auto&, Role role) { roles.push_back(role); });
  return roles;
}

/// The input with each number widened; a size stays at least zero.
template <class Q>
Q widened(std::span<const double> values, Widening widening, const Scaling& scaling) {
  Q q;
  std::size_t i = 0;
  collide::for_each_leaf(q, [&](auto& leaf, Role role) {
    using Leaf = std::decay_t<decltype(leaf)>;
    if constexpr (std::is_same_v<Leaf, Interval>) {
      Interval middle(values[i]), around(-widening[i], widening[i]);
      if (scaling.any()) middle = scaling.input(i, middle), around = scaling.input(i, around);
      const Interval wide = middle + around;
      leaf = role == Role::size ? assume_at_least_zero(wide) : wide;
    } else {
      leaf = static_cast<Leaf>(values[i]);
    }
    ++i;
  });
  return q;
}

/// The input as exact numbers, each plus `by[i] * 2^-exponent` where `by` is not empty.
template <class Q>
Q exact_inputs(std::span<const double> values, std::span<const double> by = {}, int exponent = 0) {
  const Rational unit = by.empty() ? Rational(0) : Rational(1) / Rational(std::ldexp(1.0, exponent));
  Q q;
  std::size_t i = 0;
  collide::for_each_leaf(q, [&](auto& leaf, Role) {
    using Leaf = std::decay_t<decltype(leaf)>;
    if constexpr (std::is_same_v<Leaf, Exact>) {
      leaf = Exact(by.empty() || by[i] == 0 ? Rational(values[i])
                                            : Rational(Rational(values[i]) + Rational(by[i]) * unit));
    } else {
      leaf = static_cast<Leaf>(values[i]);
    }
    ++i;
  });
  return q;
}

/// Runs Algorithm::run(inputs over N, AnswerSink<N, A<N>>&) for each N.
template <template <class> class Inputs, class Algorithm>
struct Stages {
  template <class N>
  using A = typename Inputs<N>::Answer;

  [[gnu::noinline]] static void run(const Inputs<Interval>& q, AnswerSink<Interval, A<Interval>>& out) {
    Algorithm::run(q, out);
  }
  static const Layout& layout() {
    static const Layout l = Layout::of<A<double>>();
    return l;
  }
  /// The roles of the values: where the inputs have lists, those of this case.
  static const std::vector<Role>& roles(std::span<const double> values) {
    static const std::vector<Role> of_all = roles_of(Inputs<double>{});
    static const bool has_lists = std::find(of_all.begin(), of_all.end(), Role::count) != of_all.end();
    if (!has_lists) return of_all;
    static thread_local std::vector<Role> of_case;
    return of_case = roles_of(inputs_from<Inputs<double>>(values.data()));
  }
  static Enclosure interval(std::span<const double> values, Widening widening, const Answer& about, Scalar scalar) {
    const FloatingPointScope standard_modes;
    const Scaling scaling = Scaling::of(roles(values), values);
    const IntervalScope scope;
    arithmetic_barrier();
    AnswerSink<Interval, A<Interval>> out(about, scalar, layout());
    out.measure_in(scaling);
    out.widened_from(values);
    run(widened<Inputs<Interval>>(values, widening, scaling), out);
    arithmetic_barrier();
    if (scope.any_invalid()) out.everything();
    return out.result();
  }
  static Enclosure exact(std::span<const double> values, const Answer& about, Scalar scalar, AlternativeList* list) {
    const FloatingPointScope standard_modes;
    AnswerSink<Exact, A<Exact>> out(about, scalar, layout());
    out.list_in(list);
    Algorithm::run(exact_inputs<Inputs<Exact>>(values), out);
    return out.result();
  }
  static bool exact_decision(std::span<const double> values, std::span<const double> by, int exponent) {
    const FloatingPointScope standard_modes;
    const Answer none{};
    AnswerSink<Exact, A<Exact>> out(none, Scalar::float64, layout());
    Algorithm::run(exact_inputs<Inputs<Exact>>(values, by, exponent), out);
    return out.result().may_be_yes;
  }
  template <class N>
  static bool on_surface(const Inputs<N>& q, const PlaceInAnswer& place, const Answer& about) {
    const double* x = &about.values[place.number];
    return Algorithm::on_surface(q, GivenPlace<N>{{N(x[0]), N(x[1]), N(x[2])}, N(place.slack), place.number, about});
  }
  /// If the widening is zero and the intervals cannot tell, asks the exact stage too.
  static bool may_be_on_surface(std::span<const double> values, Widening widening, const Answer& about,
                                std::size_t number, double ulps, Scalar scalar) {
    const FloatingPointScope standard_modes;
    const std::optional<PlaceInAnswer> place = PlaceInAnswer::of(about, layout(), number, ulps, scalar);
    if (!place) return true;
    if (!may_be_on_widened_surface(values, widening, about, *place)) return false;
    if (std::any_of(widening.begin(), widening.end(), [](double w) { return w > 0; })) return true;
    return on_surface(exact_inputs<Inputs<Exact>>(values), *place, about);
  }
  static Oracle oracle() {
    constexpr bool names_a_surface =
        requires(const Inputs<Exact>& q, const GivenPlace<Exact>& g) { Algorithm::on_surface(q, g); };
    if constexpr (names_a_surface) return {interval, exact, may_be_on_surface, exact_decision};
    return {interval, exact, nullptr, exact_decision};
  }

 private:
  static bool may_be_on_widened_surface(std::span<const double> values, Widening widening, const Answer& about,
                                        const PlaceInAnswer& place) {
    const Scaling scaling = Scaling::of(roles(values), values);
    const IntervalScope scope;
    arithmetic_barrier();
    const bool may = on_widened_surface(widened<Inputs<Interval>>(values, widening, scaling), place, about, scaling);
    arithmetic_barrier();
    return may || scope.any_invalid();
  }
  [[gnu::noinline]] static bool on_widened_surface(const Inputs<Interval>& q, const PlaceInAnswer& place,
                                                   const Answer& about, const Scaling& scaling) {
    if (!scaling.any()) return on_surface(q, place, about);
    const auto scaled = [&](double x) { return scaling.to_oracle(Role::position, Interval(x)); };
    const double* x = &about.values[place.number];
    return Algorithm::on_surface(
        q, GivenPlace<Interval>{{scaled(x[0]), scaled(x[1]), scaled(x[2])}, scaled(place.slack), place.number, about});
  }
};

/// Ends an oracle's file. Binds the function template `query` to its line of the catalogue, and on_surface(inputs,
/// GivenPlace) if the file defines it: whether the place may lie on the surface that the query names.
#define NEARMISS_ORACLE(query)                                                                    \
  namespace {                                                                                     \
  struct query##_algorithm {                                                                      \
    template <class Q, class Out>                                                                 \
    static void run(const Q& q, Out& out) {                                                       \
      query(q, out);                                                                              \
    }                                                                                             \
    template <class Q, class N>                                                                   \
      requires requires(const Q& q, const GivenPlace<N>& place) { oracle::on_surface(q, place); } \
    static bool on_surface(const Q& q, const GivenPlace<N>& place) {                              \
      return oracle::on_surface(q, place);                                                        \
    }                                                                                             \
  };                                                                                              \
  }                                                                                               \
  Oracle query##_oracle() { return Stages<inputs::query, query##_algorithm>::oracle(); }

}  // namespace nearmiss::oracle
