/// Where an oracle's algorithm puts every answer that is possible; compares each with the given one.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "impl/catalogue/layout.hpp"
#include "impl/subject/floating_point.hpp"
#include "oracles/exact/arithmetic.hpp"
#include "oracles/exact/normals.hpp"
#include "oracles/exact/oracle.hpp"
#include "oracles/exact/scaling.hpp"

namespace nearmiss::oracle {

inline Bounds bounds(const Interval& x) { return {x.inf(), x.sup()}; }
/// Tight also where the two parts of a + b sqrt(c) nearly cancel.
Bounds bounds(const Exact& x);

/// Exact - given, number by number.
struct Errors {
  std::array<Bounds, Answer::capacity> of{};
  /// Of the normal's three numbers, where the given one is divided by its length.
  std::array<Bounds, 3> of_direction{};
};

/// How far the given answer is from the nearest of a set of right ones, in ulps.
struct SetDistance {
  /// One vector by itself, whatever is beside it; `begin` is its first number.
  struct Part {
    std::size_t begin;
    Bounds ulps;
  };
  std::vector<Part> vectors;
  Bounds together{0, 0};  ///< all of them, each with the same member of the set
};

/// The part of Outcomes that does not depend on the answer's type.
class EnclosureAccumulator {
 public:
  EnclosureAccumulator(const Answer& about, Scalar scalar, const Layout& layout);

  const Enclosure& result() const { return result_; }
  /// True where a yes is held against the given answer; else it is but a decision.
  bool compares_yes() const { return about_.yes; }
  /// The three numbers of the given answer from `begin` on, in the units of the input; a normal also divided by its
  /// length, where that is near 1. It is as near to a right one as the nearer of the two.
  std::vector<GivenVector> given_vector(std::size_t begin) const;
  void list_in(std::vector<Alternative>* list) { list_ = list; }
  /// The oracle answers in these units; `scaling` must outlive this.
  void measure_in(const Scaling& scaling) { scaling_ = scaling.any() ? &scaling : nullptr; }

 protected:
  /// One possible answer, of which the first `given` numbers are held against the given one. Where it stands for a set,
  /// the distances of the vectors that belong to it are those from the set.
  void count(bool yes, const Errors& errors, std::size_t given, const SetDistance& set);
  void count_everything();
  /// What is known of the distances where the given places are in other units than the set: those of normals.
  SetDistance without_units(SetDistance set) const;
  /// Every member's places are enclosed as well: what is further from the enclosure is further from each of them.
  void include_enclosure(const Errors& errors, SetDistance& set) const;

  const Answer& about_;
  Scalar scalar_;
  const Layout& layout_;
  std::vector<Alternative>* list_ = nullptr;
  const Scaling* scaling_ = nullptr;  ///< empty: the units of the input

  /// The given normal divided by its length, as the sum of two doubles that is within `direction_slack` of it in
  /// each component. Not known where there is none or where its length is not near 1.
  struct UnitNormal {
    bool known = false;
    std::array<double, 3> high{}, low{};
  };
  /// At most ten operations in long double, whose relative error is at most 2^-63 each, in any rounding mode.
  static constexpr double direction_slack = 0x1p-59;
  UnitNormal unit_normal_;

 private:
  struct Distance;
  Distance distance_of(const Layout::Part& part, const Errors& errors) const;
  Distance distance_of(const Layout::Part& part, const Errors& errors, const Bounds& ulps) const;
  void count_member(std::size_t member, const Distance& d);
  /// The part that has that number.
  const Layout::Part& part_at(std::size_t number) const;

  Enclosure result_;
  bool any_ = false;
};

/// A is the answer type over N.
template <class N, class A>
class AnswerSink : public EnclosureAccumulator {
 public:
  using EnclosureAccumulator::EnclosureAccumulator;

  /// A right answer is "no", with nothing else to it.
  void no() { put(false, A{}, {}, 0); }
  /// A right answer is `a`; of its leaves only the first `leaves` mean anything.
  void no(const A& a, std::size_t leaves) { put(false, a, {}, leaves); }
  void yes(const A& a, const Normals<N>& normals = Normals<N>::as_given()) { put(true, a, normals, Answer::capacity); }
  /// The same; of its leaves only the first `leaves` are held against an answer, the others may be anything.
  void yes(const A& a, const Normals<N>& normals, std::size_t leaves) { put(true, a, normals, leaves); }
  /// Every answer of a set is right: `a` is one of them or, of intervals, encloses them all.
  void yes(const A& a, const SetDistance& set) { put(true, a, Normals<N>::as_given(), Answer::capacity, set); }
  /// Nothing is known: a division by what may be zero.
  void everything() { count_everything(); }

 private:
  void put(bool yes, const A& a, const Normals<N>& normals, std::size_t leaves, const SetDistance& set = {}) {
    if (scaling_ == nullptr) return add(yes, a, normals, leaves, set);
    add(yes, in_units_of_the_input(a, leaves), normals, leaves, without_units(set));
  }
  /// Its first leaves; the others need not be numbers.
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
  void add(bool yes, const A& a, const Normals<N>& normals, std::size_t leaves, const SetDistance& set);
  /// Exact - given for the first `leaves` leaves, or the exact values themselves; tells how many.
  std::size_t errors_of(const A& a, bool many_normals, std::size_t leaves, bool from_zero, Errors& errors) const;
  SetDistance from(const Normals<N>& normals) const;
  /// What a hit that comes too late for the scalar says beside its miss: that it starts outside.
  static constexpr std::size_t leaves_of_late_hit = requires(A a) { a.inside; } ? 1 : 0;
};

/// Exact - given; an infinite number is right for every exact one beyond the largest finite number.
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
      } else if (role == Role::normal) {
        const N exact = assume_within(leaf, -1.0, 1.0);
        errors.of[i] = error_of(exact, given, scalar_);
        if (!from_zero && unit_normal_.known) {
          const Bounds off = bounds(N(N(exact - N(unit_normal_.high[component])) - N(unit_normal_.low[component])));
          errors.of_direction[component] = {off.low - direction_slack, off.high + direction_slack};
        }
        ++component;
      } else {
        errors.of[i] = error_of(N(leaf), given, scalar_);
      }
    } else {
      errors.of[i] = {double(leaf) - given, double(leaf) - given};
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

template <class N, class A>
void AnswerSink<N, A>::add(bool yes, const A& a, const Normals<N>& normals, std::size_t leaves, const SetDistance& set) {
  if constexpr (kind_of<A> == Kind::impact) {
    if (yes) {  // a time beyond the largest finite number is a miss
      const N beyond = a.time - N(largest_finite(scalar_));
      if (may_be_positive(beyond)) add(false, A{}, {}, leaves_of_late_hit, {});
      if (!may_be_at_most_zero(beyond)) return;
    }
  }
  Errors errors;
  if (list_ != nullptr) {
    const std::size_t count = errors_of(a, normals.many, leaves, true, errors);
    Alternative alternative{yes, count, errors.of, normals.many, {}};
    for (const Facing<N>& f : normals.facing) {
      const N length2 = norm2(f.direction);
      if (may_be_zero(length2)) continue;
      const Vector<N> unit = times(f.direction, N(N(1) / root(length2)));
      alternative.facing.push_back(
          {{bounds(unit[0]), bounds(unit[1]), bounds(unit[2])}, {double(f.low), double(f.high)}});
    }
    list_->push_back(std::move(alternative));
  }
  if (yes != about_.yes) return count(yes, errors, 0, {});
  const std::size_t given = errors_of(a, normals.many, leaves, false, errors);
  SetDistance nearest = normals.many ? from(normals) : set;
  if constexpr (is_enclosure<N>) include_enclosure(errors, nearest);
  count(yes, errors, given, nearest);
}

/// A place of the given answer: what an oracle's `on_surface` is asked about.
template <class N>
struct GivenPlace {
  Vector<N> at;
  N slack;             ///< how far off it may be
  std::size_t number;  ///< of the answer: the first of its three
  const Answer& about;
};

/// Only a name: an oracle's file adds its own where its query names a surface.
class NoQuery;
bool on_surface(const NoQuery&);

/// Which three numbers of the answer are a place, from `number` on, and how far off they may be together.
struct PlaceInAnswer {
  std::size_t number;
  double slack;

  /// Empty where that cannot be told: numbers that are not finite, or a slack as large as they are.
  static std::optional<PlaceInAnswer> of(const Answer& about, const Layout& layout, std::size_t number, double ulps,
                                         Scalar scalar);
};

// The two stages, in the standard modes of floating-point arithmetic whatever the caller's are, and the line with which
// an oracle's .cpp file ends.

/// Sets the rounding of the intervals for its lifetime and tells afterwards whether any operation was
/// invalid (infinity - infinity, 0 * infinity): then the bounds mean nothing.
class IntervalScope {
 public:
  IntervalScope();
  /// Call behind a compiler barrier, when the arithmetic is done.
  bool any_invalid() const;

 private:
  CGAL::Protect_FPU_rounding<true> upward_{CGAL_FE_UPWARD};
};

/// Keeps arithmetic from moving across a change of the floating-point environment.
inline void arithmetic_barrier() { asm volatile("" ::: "memory"); }

/// The roles of the numbers of Q.
template <class Q>
std::vector<Role> roles_of() {
  std::vector<Role> roles;
  Q q;
  collide::for_each_leaf(q, [&](auto&, Role role) { roles.push_back(role); });
  return roles;
}

/// The input, each number widened; a size stays at least zero.
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

/// The input as exact numbers, each with `by[i] * 2^-exponent` added to it, where `by` has any.
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

/// Algorithm::run(inputs over N, Outcomes<N, A<N>>&), for any N.
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
  static const std::vector<Role>& roles() {
    static const std::vector<Role> r = roles_of<Inputs<double>>();
    return r;
  }
  static Enclosure interval(std::span<const double> values, Widening widening, const Answer& about, Scalar scalar) {
    const FloatingPointScope standard_modes;
    const Scaling scaling = Scaling::of(roles(), values);
    const IntervalScope scope;
    arithmetic_barrier();
    AnswerSink<Interval, A<Interval>> out(about, scalar, layout());
    out.measure_in(scaling);
    run(widened<Inputs<Interval>>(values, widening, scaling), out);
    arithmetic_barrier();
    if (scope.any_invalid()) out.everything();
    return out.result();
  }
  static Enclosure exact(std::span<const double> values, const Answer& about, Scalar scalar,
                         std::vector<Alternative>* list) {
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
  /// A widening of nothing is asked about exactly as well, where the intervals cannot tell.
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
    const Scaling scaling = Scaling::of(roles(), values);
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

/// Ends an oracle's file: binds the function template `query` to its line of the catalogue, and
/// `on_surface(query's inputs, GivenPlace)` where there is one: may the place lie on the surface that the query names?
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
