#include "oracles/exact/answer_sink.hpp"

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

#include <bit>
#include <cfenv>

#include "oracles/exact/wide.hpp"

namespace nearmiss::oracle {

namespace {

bool gives_all(const Answer& about, const Layout::Part& part) {
  bool all = true;
  for (std::size_t i = part.begin; i < part.end; ++i) all = all && about.gives(i);
  return all;
}

/// Lower bound of the distance, in the maximum norm, of these three numbers from every unit vector; 0 for a NaN.
double apart_from_unit_vectors(const double* n) {
  const long double length = std::sqrt(static_cast<long double>(n[0]) * n[0] + static_cast<long double>(n[1]) * n[1] +
                                       static_cast<long double>(n[2]) * n[2]);
  // The factor is below 1 / sqrt(3) by far more than the rounding here.
  const double apart = static_cast<double>(least_of_largest_component * std::abs(length - 1));
  return apart > 0 ? std::min(apart, std::numeric_limits<double>::max()) : 0;
}

}  // namespace

Bounds bounds(const Exact& x) {
  if (!x.is_extended()) {
    const auto [low, high] = CGAL::to_interval(x.a0());
    return {low, high};
  }
  constexpr mpfr_prec_t bits = 256;
  Wide low(bits), high(bits);
  enclose(x, low, high);
  return {mpfr_get_d(low.get(), MPFR_RNDD), mpfr_get_d(high.get(), MPFR_RNDU)};
}

Bounds bounds(const Exact& x, long exponent) {
  constexpr mpfr_prec_t bits = 256;
  Wide low(bits), high(bits);
  enclose(x, low, high);
  mpfr_mul_2si(low.get(), low.get(), -exponent, MPFR_RNDD);
  mpfr_mul_2si(high.get(), high.get(), -exponent, MPFR_RNDU);
  return {mpfr_get_d(low.get(), MPFR_RNDD), mpfr_get_d(high.get(), MPFR_RNDU)};
}

std::optional<long> exponent_of(const Exact& x) {
  constexpr mpfr_prec_t bits = 256;
  Wide low(bits), high(bits);
  enclose(x, low, high);
  const mpfr_t& furthest = mpfr_cmpabs(low.get(), high.get()) > 0 ? low.get() : high.get();
  if (mpfr_zero_p(furthest) != 0) return std::nullopt;
  return mpfr_get_exp(furthest);
}

Bounds magnitude_bounds(const Exact& x) {
  const Bounds b = bounds(x);
  Bounds m{b.nearest_to_zero(), b.furthest_from_zero()};
  if (!(m.high > 0) || std::isinf(m.high)) return m;
  const double border = std::ldexp(1.0, std::ilogb(m.high));  // the only power of two that the bounds may enclose
  if (m.low >= border) return m;
  (may_be_at_most(Exact(border), magnitude(x)) ? m.low : m.high) = border;
  if (m.high == border) m.high = std::nextafter(border, 0.0);
  return m;
}

EnclosureAccumulator::EnclosureAccumulator(const Answer& about, Scalar scalar, const Layout& layout)
    : about_(about), scalar_(scalar), layout_(layout) {
  for (const Layout::Part& part : layout.parts) {
    if (part.role != Role::normal || !about.yes || !gives_all(about, part)) continue;
    unit_normal_ = UnitNormal::of(&about.values[part.begin]);
  }
}

EnclosureAccumulator::UnitNormal EnclosureAccumulator::UnitNormal::of(const double* normal) {
  UnitNormal unit;
  double largest = 0;
  for (int k = 0; k < 3; ++k) {
    if (!std::isfinite(normal[k])) return unit;
    largest = std::max(largest, std::abs(normal[k]));
  }
  if (largest == 0) return unit;
  // Multiplied by a power of two, so that no square overflows. What underflows here is far below the slack.
  std::array<long double, 3> x;
  for (int k = 0; k < 3; ++k) x[k] = std::ldexp(normal[k], -std::ilogb(largest));
  const long double length = std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
  const bool along_axis = std::count(normal, normal + 3, 0.0) == 2;
  constexpr double below_one = 1 - 0x1p-53;
  unit.known = true;
  for (int k = 0; k < 3; ++k) {
    const long double component = x[k] / length;
    unit.high[k] = double(component);
    if (!along_axis) unit.high[k] = std::clamp(unit.high[k], -below_one, below_one);
    unit.low[k] = double(component - unit.high[k]);
  }
  return unit;
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

  void include(const Bounds& off, const Bounds& unit, std::size_t i) {
    most = std::max(most, off.furthest_from_zero() / unit.low);
    const double at_least = off.nearest_to_zero() / unit.high;
    if (at_least > least || number < 0) least = at_least, absolute = off.nearest_to_zero(), number = int(i);
  }
  /// Raises the distance to at least `apart`, which is not in ulps.
  void raise_to(double apart, const Bounds& unit) {
    if (apart > absolute) absolute = apart, least = std::max(least, apart / unit.high), most = std::max(most, least);
  }
};

double EnclosureAccumulator::largest_given(const Layout::Part& part) const {
  double largest = 0;
  for (std::size_t i = part.begin; i < part.end; ++i) largest = std::max(largest, std::abs(about_.values[i]));
  return largest;
}

Bounds EnclosureAccumulator::unit_of(const Layout::Part& part, const Errors& errors, double largest_given) const {
  Bounds largest{largest_given, largest_given};
  for (std::size_t i = part.begin; i < part.end; ++i) {
    largest.low = std::max(largest.low, errors.magnitude[i].low);
    largest.high = std::max(largest.high, errors.magnitude[i].high);
  }
  const auto unit = [&](double x) { return ulp(std::min(x, largest_finite(scalar_)), scalar_); };
  return {unit(largest.low), unit(largest.high)};
}

double EnclosureAccumulator::apart_from_directions(const Layout::Part& part) const {
  const bool lacks_direction = part.role == Role::normal && !unit_normal_.known && gives_all(about_, part);
  return lacks_direction ? apart_from_unit_vectors(&about_.values[part.begin]) : 0;
}

/// The distance of a normal is the smaller of two: as given, and divided by its length, because its length is judged
/// separately. A vector without a direction is no normal, whatever the right normals are.
EnclosureAccumulator::Distance EnclosureAccumulator::distance_of(const Layout::Part& part, const Errors& errors) const {
  const bool has_direction = part.role == Role::normal && unit_normal_.known;
  const Bounds unit = unit_of(part, errors, largest_given(part));
  Distance as_given, of_direction;
  for (std::size_t i = part.begin; i < part.end; ++i) {
    if (about_.gives(i)) as_given.include(errors.of[i], unit, i);
  }
  if (const double apart = apart_from_directions(part); apart > 0) as_given.raise_to(apart, unit);
  if (!has_direction) return as_given;
  const Bounds unit_of_direction = unit_of(part, errors, unit_normal_.largest());
  for (std::size_t i = part.begin; i < part.end; ++i) {
    of_direction.include(errors.of_direction[i - part.begin], unit_of_direction, i);
  }
  return of_direction.least < as_given.least ? of_direction : as_given;
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

/// Lower bound of the unit of a vector that belongs to a set; of a normal, in either of its forms. A normal of the set
/// has a component of more than 1/2.
double EnclosureAccumulator::least_unit(const Layout::Part& part) const {
  const auto unit = [&](double largest) { return ulp(std::min(largest, largest_finite(scalar_)), scalar_); };
  const double given = largest_given(part);
  if (part.role != Role::normal) return unit(given);
  const double as_given = unit(std::max(given, least_of_largest_component));
  return unit_normal_.known ? std::min(as_given, unit(unit_normal_.largest())) : as_given;
}

/// The distance of a vector that belongs to a set; `number` is the component furthest from its enclosure.
EnclosureAccumulator::Distance EnclosureAccumulator::distance_of(const Layout::Part& part, const Errors& errors,
                                                                 const Bounds& ulps) const {
  std::size_t furthest = part.begin;
  for (std::size_t i = part.begin; i < part.end; ++i) {
    if (errors.of[i].nearest_to_zero() > errors.of[furthest].nearest_to_zero()) furthest = i;
  }
  Distance d{ulps.low, ulps.high, ulps.low * least_unit(part), int(furthest)};
  d.raise_to(apart_from_directions(part), unit_of(part, errors, largest_given(part)));
  return d;
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
  const bool is_place = part != layout.parts.end() && (part->role == Role::position || part->role == Role::size);
  if (!is_place || part->end - part->begin != 3) return std::nullopt;
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
