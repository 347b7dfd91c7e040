#include "reports/findings/severity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/findings/text.hpp"

namespace nearmiss {

namespace {

double largest_of(const Case& c, std::initializer_list<Role> roles) {
  double largest = 0;
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    const bool counts = std::find(roles.begin(), roles.end(), c.role(i)) != roles.end();
    if (counts) largest = std::max(largest, std::abs(c.values[i]));
  }
  return largest;
}

double extent_of(const Case& c) { return largest_of(c, {Role::position, Role::size}); }

/// The forward error of a member, relative to the scene; empty where it has none. A vector whose length is not 1
/// differs from every unit vector by the difference of the lengths, also where many normals are right.
std::optional<double> forward_share(const Case& c, const Finding& f, const MemberFinding& m) {
  if (m.member < 0 || m.worst < 0 || !(m.forward_ulps > 0)) return std::nullopt;
  const double extent = extent_of(c);
  switch (c.query->outputs[std::size_t(m.worst)].role) {
    case Role::position:
    case Role::size:
    case Role::distance:
    case Role::depth: return extent > 0 ? std::optional(m.forward_absolute / extent) : std::nullopt;
    case Role::time: {
      const double covered = m.forward_absolute * largest_of(c, {Role::velocity});
      return extent > 0 ? std::optional(covered / extent) : std::nullopt;
    }
    case Role::flag:
    case Role::index:
    case Role::count: return std::nullopt;
    case Role::normal: return std::max(m.forward_absolute, std::abs(f.unit_error) * unit_roundoff(c.scalar));
    default: return m.forward_absolute;  // of weights and parts of unit vectors
  }
}

/// The forward error in its own unit where that is what is known, otherwise the widening of lengths.
void set_amount(ErrorSize& size, const Case& c, const MemberFinding* m, bool is_forward) {
  if (is_forward && m != nullptr) {
    const Role role = c.query->outputs[std::size_t(m->worst)].role;
    size.unit = role == Role::time ? "units of time" : is_length(role) ? "units of length" : "";
    size.amount = size.unit.empty() ? 0 : m->forward_absolute;
  } else if (extent_of(c) > 0) {
    size.unit = "units of length";
    size.amount = size.relative * extent_of(c);
  }
}

/// Bits of the error above the rounding of a double, as a share of those up to 1.
double share_of_bits(double relative) {
  constexpr double bits = 53;
  if (!(relative > 0)) return 1 / (bits + 1);
  return (1 + std::clamp(bits + std::log2(relative), 0.0, bits)) / (bits + 1);
}

/// Each kind of harm counts twice as much as the next.
double harm_of(const Finding& f) {
  if (f.verdict == Verdict::broke) return 1;
  if (f.disagreement == Disagreement::false_miss) return 0.5;
  if (f.disagreement == Disagreement::false_hit) return 0.25;
  return 0.125;
}

}  // namespace

ErrorSize error_size(const Case& question, const Finding& f) {
  ErrorSize size;
  const double epsilon = unit_roundoff(question.scalar);
  const MemberFinding* m = f.headline_member();
  const std::optional<Backward>& bound = m != nullptr ? m->backward : f.backward;
  if (bound) size.above_epsilon = bound->above;
  if (f.verdict == Verdict::broke || f.disagreement == Disagreement::not_finite) {
    size.relative = 1;
    return size;
  }
  if (f.disagreement == Disagreement::not_unit) {
    size.relative = std::min(1.0, std::abs(f.unit_error) * epsilon);
    return size;
  }
  // An unknown forward error is infinite: it is never the smaller one.
  const double forward = m != nullptr ? forward_share(question, f, *m).value_or(HUGE_VAL) : HUGE_VAL;
  const double backward = bound ? bound->above * epsilon : 0;
  const bool is_forward = std::isfinite(forward) && (!bound || bound->above == 0 || forward < backward);
  size.relative = is_forward ? forward : backward;
  set_amount(size, question, m, is_forward);
  return size;
}

double severity_of(const Finding& f, const ErrorSize& size, double ordinary_share) {
  const double ordinary = (1 + 3 * ordinary_share) / 4;
  return 100 * harm_of(f) * share_of_bits(size.relative) * ordinary;
}

std::string share_text(double share) {
  const double percent = 100 * share;
  if (percent == 0 || percent >= 10) return fmt::format("{:.0f} %", percent);
  return percent >= 1e-4 ? fmt::format("{:.2g} %", percent) : fmt::format("{:.0e} %", percent);
}

std::string size_text(const ErrorSize& size) {
  if (size.relative == 0) return "on a knife's edge";
  std::string text = size.relative < 1 ? share_text(size.relative) + " of the scene" : "all of the scene";
  if (size.amount > 0) text += fmt::format(", {:.2g} {}", size.amount, size.unit);
  if (size.above_epsilon) text += fmt::format(" (> {} epsilon)", epsilons_text(*size.above_epsilon));
  return text;
}

}  // namespace nearmiss
