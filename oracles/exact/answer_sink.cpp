#include "oracles/exact/answer_sink.hpp"

#include <mpfr.h>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

#include <bit>
#include <cfenv>

namespace nearmiss::oracle {

namespace {

/// A number of 256 bits. Every operation below rounds to nearest, with a relative error of at most 2^-256.
class Wide {
 public:
  Wide() { mpfr_init2(value_, 256); }
  explicit Wide(const Rational& q) : Wide() { mpfr_set_q(value_, q.mpq(), MPFR_RNDN); }
  ~Wide() { mpfr_clear(value_); }
  Wide(const Wide&) = delete;
  Wide& operator=(const Wide&) = delete;

  mpfr_t& get() { return value_; }
  const mpfr_t& get() const { return value_; }
  /// Doubles that enclose the exact value, if at most ten operations on numbers up to `largest` made this one.
  Bounds around(const Wide& largest) const {
    Wide slack;
    mpfr_div_2ui(slack.value_, largest.value_, 250, MPFR_RNDU);
    mpfr_abs(slack.value_, slack.value_, MPFR_RNDU);
    Wide end;
    mpfr_sub(end.value_, value_, slack.value_, MPFR_RNDD);
    const double low = mpfr_get_d(end.value_, MPFR_RNDD);
    mpfr_add(end.value_, value_, slack.value_, MPFR_RNDU);
    return {low, mpfr_get_d(end.value_, MPFR_RNDU)};
  }
  bool is_at_least(const Wide& x, unsigned long over_two_to) const {
    return mpfr_zero_p(value_) == 0 && mpfr_get_exp(value_) + mpfr_exp_t(over_two_to) > mpfr_get_exp(x.value_);
  }

 private:
  mpfr_t value_;
};

/// The unit in which a member's numbers are compared: one ulp of the largest of them, given or exact.
double unit_of(const Answer& about, const Layout::Part& part, std::span<const Bounds> errors, Scalar scalar) {
  double largest = 0;
  for (std::size_t i = part.begin; i < part.end; ++i) {
    if (std::isinf(about.values[i])) return ulp(largest_finite(scalar), scalar);
    largest = std::max(largest, std::abs(about.values[i]));
    largest = std::max({largest, about.values[i] + errors[i].high, -(about.values[i] + errors[i].low)});
  }
  return ulp(std::min(largest, largest_finite(scalar)), scalar);
}

bool gives_all(const Answer& about, const Layout::Part& part) {
  bool all = true;
  for (std::size_t i = part.begin; i < part.end; ++i) all = all && about.gives(i);
  return all;
}

/// Lower bound of the distance, in the maximum norm, of these three numbers from every unit vector; 0 for a NaN.
double apart_from_unit_vectors(const double* n) {
  const long double length = std::sqrt(static_cast<long double>(n[0]) * n[0] + static_cast<long double>(n[1]) * n[1] +
                                       static_cast<long double>(n[2]) * n[2]);
  constexpr long double below_the_root_of_a_third = 0.577L;  // exceeds by far the rounding here
  const double apart = static_cast<double>(below_the_root_of_a_third * std::abs(length - 1));
  return apart > 0 ? std::min(apart, std::numeric_limits<double>::max()) : 0;
}

}  // namespace

Bounds bounds(const Exact& x) {
  if (!x.is_extended()) {
    const auto [low, high] = CGAL::to_interval(x.a0());
    return {low, high};
  }
  Wide a(x.a0()), b(x.a1()), value(x.root()), sum;
  mpfr_sqrt(value.get(), value.get(), MPFR_RNDN);
  mpfr_mul(value.get(), value.get(), b.get(), MPFR_RNDN);
  mpfr_add(sum.get(), a.get(), value.get(), MPFR_RNDN);
  if (CGAL::sign(x.a0()) * CGAL::sign(x.a1()) != CGAL::NEGATIVE) return sum.around(sum);
  constexpr unsigned long bits_to_lose = 100;  // of 250
  if (sum.is_at_least(a, bits_to_lose)) {
    const Wide& larger = mpfr_cmpabs(a.get(), value.get()) > 0 ? a : value;
    return sum.around(larger);
  }
  // Cancellation: divide the exact norm a^2 - b^2 c by the conjugate, whose terms have the same sign.
  Wide norm(Rational(x.a0() * x.a0() - x.a1() * x.a1() * x.root()));
  mpfr_sub(value.get(), a.get(), value.get(), MPFR_RNDN);
  mpfr_div(value.get(), norm.get(), value.get(), MPFR_RNDN);
  return value.around(value);
}

EnclosureAccumulator::EnclosureAccumulator(const Answer& about, Scalar scalar, const Layout& layout)
    : about_(about), scalar_(scalar), layout_(layout) {
  constexpr long double most_from_unit = 0.5L;  // beyond this, the vector is compared as given
  for (const Layout::Part& part : layout.parts) {
    if (part.role != Role::normal || !about.yes || !about.gives(part.begin)) continue;
    const double* n = &about.values[part.begin];
    const long double length = std::sqrt(static_cast<long double>(n[0]) * n[0] + static_cast<long double>(n[1]) * n[1] +
                                         static_cast<long double>(n[2]) * n[2]);
    if (!(std::abs(length - 1) < most_from_unit)) continue;
    unit_normal_.known = true;
    for (int k = 0; k < 3; ++k) {
      const long double x = n[k] / length;
      unit_normal_.high[k] = double(x);
      unit_normal_.low[k] = double(x - unit_normal_.high[k]);
    }
  }
}

SetDistance EnclosureAccumulator::without_units(SetDistance set) const {
  constexpr Bounds anything{0, HUGE_VAL};
  if (!set.vectors.empty()) set.together = anything;
  for (SetDistance::Part& of : set.vectors) {
    if (part_at(of.begin).role != Role::normal) of.ulps = anything;
  }
  return set;
}

void EnclosureAccumulator::count_everything() {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  result_.may_be_yes = result_.may_be_no = result_.may_match = true;
  result_.error.fill({-infinity, infinity});
  for (Enclosure::Member& m : result_.members) m = {true, 0, 0, -1};
  result_.ulps = result_.absolute = 0;
  result_.ulps_at_most = result_.ulps_at_most_of_any = infinity;
}

/// The distance of one member of the given answer from that of an exact one, in ulps of that member.
struct EnclosureAccumulator::Distance {
  double least = 0, most = 0;
  double absolute = 0;  ///< the least distance, not in ulps
  int number = -1;      ///< index of the number with this distance

  void include(const Bounds& off, double unit, std::size_t i) {
    most = std::max(most, off.furthest_from_zero() / unit);
    const double at_least = off.nearest_to_zero() / unit;
    if (at_least > least || number < 0) least = at_least, absolute = off.nearest_to_zero(), number = int(i);
  }
};

/// The distance of a normal is the smaller of two: as given, and divided by its length, because its length is judged
/// separately. A vector without a direction is no normal, whatever the right normals are.
EnclosureAccumulator::Distance EnclosureAccumulator::distance_of(const Layout::Part& part, const Errors& errors) const {
  const double unit = unit_of(about_, part, errors.of, scalar_);
  Distance as_given, of_direction;
  for (std::size_t i = part.begin; i < part.end; ++i) {
    if (!about_.gives(i)) continue;
    as_given.include(errors.of[i], unit, i);
    if (part.role == Role::normal) of_direction.include(errors.of_direction[i - part.begin], unit, i);
  }
  if (part.role == Role::normal && !unit_normal_.known && gives_all(about_, part)) {
    const double apart = apart_from_unit_vectors(&about_.values[part.begin]);
    if (apart > as_given.absolute) as_given.least = apart / unit, as_given.absolute = apart;
  }
  const bool nearer = part.role == Role::normal && unit_normal_.known && of_direction.least < as_given.least;
  return nearer ? of_direction : as_given;
}

const Layout::Part& EnclosureAccumulator::part_at(std::size_t number) const {
  return *std::find_if(layout_.parts.begin(), layout_.parts.end(),
                       [&](const Layout::Part& p) { return number < p.end; });
}

void EnclosureAccumulator::include_enclosure(const Errors& errors, SetDistance& set) const {
  for (SetDistance::Part& of : set.vectors) {
    const Layout::Part& part = part_at(of.begin);
    if (part.role == Role::normal) continue;
    const double least = distance_of(part, errors).least;
    of.ulps = {std::max(of.ulps.low, least), std::max(of.ulps.high, least)};
    set.together = {std::max(set.together.low, least), std::max(set.together.high, least)};
  }
}

/// The distance of a vector that belongs to a set; `number` is the component furthest from its enclosure.
EnclosureAccumulator::Distance EnclosureAccumulator::distance_of(const Layout::Part& part, const Errors& errors,
                                                                 const Bounds& ulps) const {
  double largest = 0;
  std::size_t furthest = part.begin;
  for (std::size_t i = part.begin; i < part.end; ++i) {
    largest = std::max(largest, std::abs(about_.values[i]));
    if (errors.of[i].nearest_to_zero() > errors.of[furthest].nearest_to_zero()) furthest = i;
  }
  const double least_unit = ulp(std::min(largest, largest_finite(scalar_)), scalar_);
  return {ulps.low, ulps.high, ulps.low * least_unit, int(furthest)};
}

NumberVector<GivenVector> EnclosureAccumulator::given_vector(std::size_t begin) const {
  GivenVector g;
  g.scalar = scalar_;
  for (std::size_t k = 0; k < 3; ++k) g.high[k] = about_.values[begin + k], g.given[k] = about_.gives(begin + k);
  const bool is_normal = std::any_of(layout_.parts.begin(), layout_.parts.end(), [&](const Layout::Part& part) {
    return part.begin == begin && part.role == Role::normal;
  });
  if (!is_normal || !unit_normal_.known) return {g};
  return {g, {unit_normal_.high, unit_normal_.low, g.given, direction_slack, scalar_}};
}

void EnclosureAccumulator::count_member(std::size_t member, const Distance& d) {
  Enclosure::Member& m = result_.members[member];
  if (d.least <= 1) m.may_match = true;
  if (m.number < 0 || d.least < m.ulps) m.ulps = d.least, m.absolute = d.absolute, m.number = d.number;
}

void EnclosureAccumulator::count(bool yes, const Errors& errors, std::size_t given, const SetDistance& set) {
  (yes ? result_.may_be_yes : result_.may_be_no) = true;
  if (yes != about_.yes) return;
  Distance worst;
  bool matches = true;
  const auto include = [&](const Distance& d) {
    matches = matches && d.least <= 1;
    if (d.number >= 0 && (worst.number < 0 || d.least > worst.least)) {
      worst.least = d.least, worst.absolute = d.absolute, worst.number = d.number;
    }
    worst.most = std::max(worst.most, d.most);
  };
  for (std::size_t p = 0; p < layout_.parts.size(); ++p) {
    const Layout::Part& part = layout_.parts[p];
    if (part.end > given) {  // every value is right
      count_member(p, {0, 0, 0, int(part.begin)});
      continue;
    }
    for (std::size_t i = part.begin; i < part.end; ++i) result_.error[i].include(errors.of[i]);
    const auto of = std::find_if(set.vectors.begin(), set.vectors.end(),
                                 [&](const SetDistance::Part& v) { return v.begin == part.begin; });
    const bool in_set = of != set.vectors.end() && about_.gives(part.begin);
    const Distance d = in_set ? distance_of(part, errors, of->ulps) : distance_of(part, errors);
    count_member(p, d);
    include(d);
    if (in_set) include(distance_of(part, errors, set.together));
  }
  result_.may_match = result_.may_match || matches;
  result_.ulps_at_most_of_any = std::max(result_.ulps_at_most_of_any, worst.most);
  if (!any_ || worst.least < result_.ulps) {
    result_.ulps = worst.least;
    result_.absolute = worst.absolute;
    result_.ulps_at_most = worst.most;
    result_.worst = worst.number;
  }
  any_ = true;
}

std::optional<PlaceInAnswer> PlaceInAnswer::of(const Answer& about, const Layout& layout, std::size_t number,
                                               double ulps, Scalar scalar) {
  const auto part = std::find_if(layout.parts.begin(), layout.parts.end(),
                                 [&](const Layout::Part& p) { return p.begin <= number && number < p.end; });
  if (part == layout.parts.end() || part->role != Role::position || part->end - part->begin != 3) return std::nullopt;
  double largest = 0;
  for (std::size_t i = part->begin; i < part->end; ++i) {
    if (!about.gives(i) || !std::isfinite(about.values[i])) return std::nullopt;
    largest = std::max(largest, std::abs(about.values[i]));
  }
  // One ulp is that of the largest number, given or exact. The exact number may be larger by the slack itself.
  const double share = 4 * ulps * unit_roundoff(scalar);
  if (!(share <= 0.5)) return std::nullopt;
  const double unit = ulp(std::min(largest * (1 + share), largest_finite(scalar)), scalar);
  const double slack = ulps * unit * 1.7320508075688774;  // sqrt(3), rounded up
  if (!std::isfinite(slack)) return std::nullopt;
  return PlaceInAnswer{part->begin, std::nextafter(slack, HUGE_VAL)};
}

#if defined(__SSE2__)
namespace {
constexpr unsigned invalid_flag = 0x01;
}
IntervalScope::IntervalScope() { _mm_setcsr(_mm_getcsr() & ~invalid_flag); }
bool IntervalScope::any_invalid() const { return (_mm_getcsr() & invalid_flag) != 0; }
#else
IntervalScope::IntervalScope() { std::feclearexcept(FE_INVALID); }
bool IntervalScope::any_invalid() const { return std::fetestexcept(FE_INVALID) != 0; }
#endif

}  // namespace nearmiss::oracle
