/// Where an oracle's algorithm puts every answer that is possible; compares each with the given one.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "oracles/arithmetic.hpp"
#include "oracles/query.hpp"

namespace nearmiss::oracle {

inline Bounds bounds(const Interval& x) { return {x.inf(), x.sup()}; }
/// Tight also where the two parts of a + b sqrt(c) nearly cancel.
Bounds bounds(const Exact& x);

/// `direction . normal` lies within [low, high].
template <class N>
struct Facing {
  Vector<N> direction;
  N low, high;
};

/// The right normals where they are more than one: the unit vectors that face as listed.
template <class N>
struct Normals {
  bool many = false;
  std::vector<Facing<N>> facing;

  static Normals as_given() { return {}; }
  static Normals any() { return {true, {}}; }
  static Normals cone(std::vector<Facing<N>> f) { return {true, std::move(f)}; }
};

/// The leaves of an answer type in its order: which member each belongs to. A member without a role of its
/// own is as many members as it lists.
struct Layout {
  struct Part {
    std::size_t begin, end;
    Role role;
  };
  std::vector<Part> parts;

  template <class A>
  static Layout of() {
    Layout layout;
    A a{};
    std::size_t at = 0;
    layout.add(a, Role::inherited, at);
    return layout;
  }

 private:
  template <class S>
  void add(S& value, Role role, std::size_t& at) {
    if (role == Role::inherited) {
      if constexpr (collide::Listed<S>) {
        collide::for_each_member(value, [&](std::string_view, auto& part, Role own) { add(part, own, at); });
        return;
      } else if constexpr (requires { value.begin(); }) {
        for (auto& item : value) add(item, role, at);
        return;
      }
    }
    std::size_t n = 0;
    collide::for_each_leaf(value, [&](auto&, Role) { ++n; });
    parts.push_back({at, at + n, role});
    at += n;
  }
};

/// The part of Outcomes that does not depend on the answer's type.
class Tally {
 public:
  Tally(const Answer& about, Scalar scalar, const Layout& layout)
      : about_(about), scalar_(scalar), layout_(layout) {}

  const Enclosure& result() const { return result_; }
  /// A number of the given answer, 0 where it has none: for an oracle that must pick out of a continuum of
  /// right answers the one that is nearest to it.
  double given(std::size_t leaf) const { return std::isfinite(about_.values[leaf]) ? about_.values[leaf] : 0.0; }
  void list_in(std::vector<Alternative>* list) { list_ = list; }

 protected:
  /// One possible answer: `errors[i]` encloses exact - given. Where many normals are right, `turn`
  /// encloses how far the given one is from the nearest of them.
  void count(bool yes, std::span<const Bounds> errors, const std::optional<Bounds>& turn = std::nullopt);
  void count_everything();

  const Answer& about_;
  Scalar scalar_;
  const Layout& layout_;
  std::vector<Alternative>* list_ = nullptr;

 private:
  Enclosure result_;
  bool any_ = false;
};

/// A is the answer type over N.
template <class N, class A>
class Outcomes : public Tally {
 public:
  using Tally::Tally;

  /// A right answer is "no", with nothing else to it.
  void no() { add(false, A{}, {}, 0); }
  /// A right answer is `a`; of its leaves only the first `leaves` mean anything.
  void no(const A& a, std::size_t leaves) { add(false, a, {}, leaves); }
  void yes(const A& a, const Normals<N>& normals = Normals<N>::as_given()) {
    add(true, a, normals, Answer::capacity);
  }
  /// The same; of its leaves only the first `leaves` are held against an answer, the others may be anything.
  void yes(const A& a, const Normals<N>& normals, std::size_t leaves) { add(true, a, normals, leaves); }
  /// Nothing is known: a division by what may be zero.
  void everything() { count_everything(); }

 private:
  using Errors = std::array<Bounds, Answer::capacity>;

  void add(bool yes, const A& a, const Normals<N>& normals, std::size_t leaves);
  /// Exact - given for the first `leaves` leaves, or the exact values themselves; tells how many.
  std::size_t errors_of(const A& a, bool many_normals, std::size_t leaves, bool from_zero, Errors& errors) const;
  Bounds turn_of(const Normals<N>& normals) const;
};

template <class N, class A>
std::size_t Outcomes<N, A>::errors_of(const A& a, bool many_normals, std::size_t leaves, bool from_zero,
                                      Errors& errors) const {
  std::size_t i = 0;
  collide::for_each_leaf(a, [&](const auto& leaf, Role role) {
    if (i >= leaves) return;
    const double given = from_zero ? 0.0 : about_.values[i];
    if constexpr (std::is_same_v<std::decay_t<decltype(leaf)>, N>) {
      if (role == Role::normal && many_normals) {
        errors[i] = {-1 - std::abs(given), 1 + std::abs(given)};
      } else {
        const N exact = role == Role::normal ? N(assume_within(leaf, -1.0, 1.0)) : leaf;
        if (std::isnan(given)) {
          errors[i] = {-HUGE_VAL, HUGE_VAL};
        } else if (std::isinf(given)) {  // right for every number beyond the largest finite one
          const double largest = std::copysign(largest_finite(scalar_), given);
          const Bounds short_of = bounds(N(exact - N(largest)));
          errors[i] = given > 0 ? Bounds{std::min(short_of.low, 0.0), std::min(short_of.high, 0.0)}
                                : Bounds{std::max(short_of.low, 0.0), std::max(short_of.high, 0.0)};
        } else {
          errors[i] = given == 0 ? bounds(exact) : bounds(N(exact - N(given)));
        }
      }
    } else {
      errors[i] = {double(leaf) - given, double(leaf) - given};
    }
    ++i;
  });
  return i;
}

/// The largest change that one of the faced directions needs to see in the given normal.
template <class N, class A>
Bounds Outcomes<N, A>::turn_of(const Normals<N>& normals) const {
  Bounds largest{0, 0};
  for (const Layout::Part& part : layout_.parts) {
    if (part.role != Role::normal) continue;
    const double* n = &about_.values[part.begin];
    if (!std::isfinite(n[0] + n[1] + n[2])) return {1, HUGE_VAL};  // no unit vector
    for (const Facing<N>& f : normals.facing) {
      const N component = inner(f.direction, Vector<N>{N(n[0]), N(n[1]), N(n[2])});
      const Bounds up = bounds(N(f.low - component)), down = bounds(N(f.high - component));
      Bounds change{0, 0};
      if (up.high > 0) change = {std::max(0.0, up.low), up.high};
      if (down.low < 0) change = {std::max(0.0, -down.high), -down.low};
      largest.low = std::max(largest.low, change.low);
      largest.high = std::max(largest.high, change.high);
    }
  }
  return largest;
}

template <class N, class A>
void Outcomes<N, A>::add(bool yes, const A& a, const Normals<N>& normals, std::size_t leaves) {
  if constexpr (A::kind == Kind::impact) {
    if (yes) {  // a time beyond the largest finite number is a miss
      const N beyond = a.time - N(largest_finite(scalar_));
      if (may_be_positive(beyond)) no();
      if (!may_be_at_most_zero(beyond)) return;
    }
  }
  if (list_ != nullptr) {
    Alternative alternative{yes, 0, {}, normals.many, {}};
    alternative.count = errors_of(a, normals.many, leaves, true, alternative.values);
    for (const Facing<N>& f : normals.facing) {
      alternative.facing.push_back({{bounds(f.direction[0]), bounds(f.direction[1]), bounds(f.direction[2])},
                                    {bounds(f.low).low, bounds(f.high).high}});
    }
    list_->push_back(std::move(alternative));
  }
  if (yes != about_.yes) return count(yes, {});
  Errors errors;
  const std::size_t given = errors_of(a, normals.many, leaves, false, errors);
  count(yes, {errors.data(), given}, normals.many ? std::optional(turn_of(normals)) : std::nullopt);
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

// The two stages, and the line with which an oracle's .cpp file ends.

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

/// The input, each number widened; a size stays at least zero.
template <class Q>
Q widened(std::span<const double> values, Widening widening) {
  Q q;
  std::size_t i = 0;
  collide::for_each_leaf(q, [&](auto& leaf, Role role) {
    using Leaf = std::decay_t<decltype(leaf)>;
    if constexpr (std::is_same_v<Leaf, Interval>) {
      const Interval wide = Interval(values[i]) + Interval(-widening[i], widening[i]);
      leaf = role == Role::size ? assume_at_least_zero(wide) : wide;
    } else {
      leaf = static_cast<Leaf>(values[i]);
    }
    ++i;
  });
  return q;
}

template <class Q>
Q exact_inputs(std::span<const double> values) {
  Q q;
  std::size_t i = 0;
  collide::for_each_leaf(q, [&](auto& leaf, Role) {
    using Leaf = std::decay_t<decltype(leaf)>;
    if constexpr (std::is_same_v<Leaf, Exact>) {
      leaf = Exact(Rational(values[i]));
    } else {
      leaf = static_cast<Leaf>(values[i]);
    }
    ++i;
  });
  return q;
}

/// Algorithm::run(inputs over N, Outcomes<N, A<N>>&), for any N.
template <template <class> class Inputs, template <class> class A, class Algorithm>
struct Stages {
  [[gnu::noinline]] static void run(const Inputs<Interval>& q, Outcomes<Interval, A<Interval>>& out) {
    Algorithm::run(q, out);
  }
  static const Layout& layout() {
    static const Layout l = Layout::of<A<double>>();
    return l;
  }
  static Enclosure interval(std::span<const double> values, Widening widening, const Answer& about, Scalar scalar) {
    const IntervalScope scope;
    arithmetic_barrier();
    Outcomes<Interval, A<Interval>> out(about, scalar, layout());
    run(widened<Inputs<Interval>>(values, widening), out);
    arithmetic_barrier();
    if (scope.any_invalid()) out.everything();
    return out.result();
  }
  static Enclosure exact(std::span<const double> values, const Answer& about, Scalar scalar,
                         std::vector<Alternative>* list) {
    Outcomes<Exact, A<Exact>> out(about, scalar, layout());
    out.list_in(list);
    Algorithm::run(exact_inputs<Inputs<Exact>>(values), out);
    return out.result();
  }
  template <class N>
  static bool on_surface(const Inputs<N>& q, const PlaceInAnswer& place, const Answer& about) {
    const double* x = &about.values[place.number];
    return Algorithm::on_surface(
        q, GivenPlace<N>{{N(x[0]), N(x[1]), N(x[2])}, N(place.slack), place.number, about});
  }
  /// A widening of nothing is asked about exactly as well, where the intervals cannot tell.
  static bool may_be_on_surface(std::span<const double> values, Widening widening, const Answer& about,
                                std::size_t number, double ulps, Scalar scalar) {
    const std::optional<PlaceInAnswer> place = PlaceInAnswer::of(about, layout(), number, ulps, scalar);
    if (!place) return true;
    if (!may_be_on_widened_surface(values, widening, about, *place)) return false;
    if (std::any_of(widening.begin(), widening.end(), [](double w) { return w > 0; })) return true;
    return on_surface(exact_inputs<Inputs<Exact>>(values), *place, about);
  }
  static Oracle oracle() {
    constexpr bool names_a_surface = requires(const Inputs<Exact>& q, const GivenPlace<Exact>& g) {
      Algorithm::on_surface(q, g);
    };
    if constexpr (names_a_surface) return {interval, exact, may_be_on_surface};
    return {interval, exact, nullptr};
  }

 private:
  static bool may_be_on_widened_surface(std::span<const double> values, Widening widening, const Answer& about,
                                        const PlaceInAnswer& place) {
    const IntervalScope scope;
    arithmetic_barrier();
    const bool may = on_widened_surface(widened<Inputs<Interval>>(values, widening), place, about);
    arithmetic_barrier();
    return may || scope.any_invalid();
  }
  [[gnu::noinline]] static bool on_widened_surface(const Inputs<Interval>& q, const PlaceInAnswer& place,
                                                   const Answer& about) {
    return on_surface(q, place, about);
  }
};

/// Ends an oracle's file: binds the function template `query` to its line of the catalogue, and
/// `on_surface(query's inputs, GivenPlace)` where there is one: may the place lie on the surface that the query names?
#define NEARMISS_ORACLE(query, answer_type)                                                       \
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
  Oracle query##_oracle() {                                                                       \
    return Stages<collide::inputs::query, collide::answer_type, query##_algorithm>::oracle();     \
  }

}  // namespace nearmiss::oracle
