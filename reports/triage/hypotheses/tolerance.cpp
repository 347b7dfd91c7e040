#include "reports/triage/hypotheses/tolerance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "oracles/judge.hpp"
#include "oracles/requirements.hpp"
#include "reports/triage/geometry/quantities.hpp"
#include "reports/triage/hypotheses/written_constant.hpp"

namespace nearmiss {

namespace {

/// A value for the key of a cause: one digit where it is known so well, or else its power of ten.
std::string stable_value(double low, double high) {
  constexpr double known = 1.1, near = 1.06;
  const double middle = std::sqrt(low * high), least = std::pow(10.0, std::floor(std::log10(middle)));
  const double digit = std::round(middle / least);
  const bool is_known = high <= known * low && std::max(middle / (digit * least), digit * least / middle) <= near;
  const int decade = int(std::lround(std::log10(is_known ? least : middle)));
  return is_known && digit < 10 ? fmt::format("{}e{}", digit, decade)
                                : fmt::format("1e{}", std::lround(std::log10(middle)));
}

class ConstantError {
 public:
  ConstantError(const Trials& trials, std::span<const ScaleScan> scans) : trials_(trials), scans_(scans) {}

  Tested result() {
    Tested tested;
    tested.named = named();
    tested.evidence = std::move(evidence_);
    return tested;
  }

 private:
  std::optional<Named> named() {
    const Finding base = trials_.in_full(trials_.base());
    const MemberFinding* member = base.headline_member();
    if (member == nullptr || member->worst < 0 || trials_.base().answer.status != Answer::Status::answered)
      return std::nullopt;
    const Role role = trials_.query().outputs[std::size_t(member->worst)].role;
    if (role == Role::time) {
      if (auto named = constant_over(scans_[0], "length", true)) return named;
      return constant_over(scans_[1], "time", false);
    }
    if (is_length(role)) return constant_over(scans_[0], "length", false);
    return std::nullopt;
  }
  /// The speed along the normal of the exact contact, for errors of a time that are lengths; the speed where the answer
  /// has no normal.
  double speed_of(const Case& c) const {
    const auto& velocities = trials_.query().operands.velocities;
    if (velocities.empty()) return 0;
    const double* v = &c.values[velocities[0]];
    const auto& outputs = trials_.query().outputs;
    const auto normal = std::size_t(
        std::find_if(outputs.begin(), outputs.end(), [](const Field& f) { return f.role == Role::normal; }) -
        outputs.begin());
    for (const Alternative& right : truth_of(c).alternatives) {
      if (!right.yes || right.many_normals || normal + 3 > right.count) continue;
      double along = 0;
      for (std::size_t k = 0; k < 3; ++k)
        along += v[k] * (right.values[normal + k].low + right.values[normal + k].high) / 2;
      return std::abs(along);
    }
    return std::hypot(v[0], v[1], v[2]);
  }
  std::optional<Named> constant_over(const ScaleScan& s, std::string_view unit, bool times_speed) {
    constexpr int least_octaves = 4;
    constexpr double most_change = 1.5;
    double low = INFINITY, high = 0;
    int first = 0, last = 0;
    for (const ScaleScan::At& a : s.trials) {
      if (a.trial.outcome != Outcome::same || std::abs(a.k) > least_octaves) continue;
      const Finding full = trials_.in_full(a.trial);
      const MemberFinding* member = full.headline_member();
      if (member == nullptr) continue;
      const double error = member->forward_absolute * (times_speed ? speed_of(a.trial.question) : 1);
      low = std::min(low, error), high = std::max(high, error);
      first = std::min(first, a.k), last = std::max(last, a.k);
    }
    if (last - first < least_octaves || !(low > 0) || high > most_change * low) return std::nullopt;
    const double middle = std::sqrt(low * high);
    saw(fmt::format("All {} were multiplied by powers of two, which changes no rounding.", s.group->name),
        fmt::format("From 2^{} to 2^{} the error{} stays between {:.3g} and {:.3g}.", first, last,
                    times_speed ? " of the time, times the speed along the normal," : "", low, high));
    return Named{
        CauseKind::absolute_tolerance, fmt::format("{} {}", stable_value(low, high), unit),
        fmt::format("The answer is off by about {:.2g} (a {}) at every scale: an absolute tolerance or margin.", middle,
                    unit)};
  }

  void saw(std::string test, std::string result) { evidence_.push_back({std::move(test), std::move(result)}); }

  const Trials& trials_;
  std::span<const ScaleScan> scans_;
  std::vector<Evidence> evidence_;
};

class ToleranceSearch {
 public:
  ToleranceSearch(Trials& trials, std::span<const ScaleScan> scans, std::span<const Trial> similar,
                  bool errs_to_both_sides)
      : trials_(trials), scans_(scans), similar_(similar), errs_to_both_sides_(errs_to_both_sides) {}

  Tested result() {
    Tested tested;
    tested.named = named();
    tested.evidence = std::move(evidence_);
    return tested;
  }

 private:
  struct Flipped {
    Case at_wrong, at_right;  ///< the case at both sides of its flip
    bool is_sharp;
  };

  std::optional<Named> named() {
    for (const ScaleScan& s : scans_) {
      if (!s.has_clean_flip()) continue;
      if (auto named = tolerance_in(s)) return named;
    }
    if (std::none_of(scans_.begin(), scans_.end(), [](const ScaleScan& s) { return s.flip.has_value(); }))
      saw("Lengths, velocities, directions and quaternions were multiplied by powers of two, which changes no "
          "rounding.",
          "The answer is right at no scale.");
    return std::nullopt;
  }
  /// Right at far smaller scales alone.
  static bool is_guard(const Flip& f) {
    constexpr int far = -32;
    return f.right < f.wrong && f.right <= far;
  }
  std::vector<Flipped> flips_of(const ScaleScan& s) {
    std::vector<Flipped> all;
    const auto at = [&](const Case& c, int k) { return k == 0 ? c : *scaled(c, *s.group, k); };
    const auto add = [&](const Case& c, const Flip& f) {
      all.push_back({at(c, f.wrong), at(c, f.right), f.is_sharp()});
    };
    add(question(), *s.flip);
    for (const Trial& t : similar_) {
      if (trials_.is_over()) break;
      if (const auto flip = flip_near(trials_, t.question, *s.group, *s.flip)) add(t.question, *flip);
    }
    return all;
  }
  std::optional<Named> tolerance_in(const ScaleScan& s) {
    const std::vector<Flipped> flips = flips_of(s);
    BorderOfScale border{s.group->name, s.flip->right > s.flip->wrong, INFINITY, 0};
    for (const Flipped& f : flips) {
      const double largest = largest_of(f.at_wrong, *s.group);
      border.low = std::min(border.low, largest), border.high = std::max(border.high, largest);
    }
    const auto best = constant_quantity(flips);
    saw(fmt::format("All {} were multiplied by powers of two, which changes no rounding.", s.group->name),
        fmt::format("The finding is there with 2^{}, and the answer is right with 2^{}{}. "
                    "Of {} other cases with the finding, {} have such a flip.",
                    s.flip->wrong, s.flip->right, trials_.sets_rounding() ? ", without overflow or underflow" : "",
                    similar_.size(), flips.size() - 1));
    if (is_guard(*s.flip)) {
      saw("The scale of the change was compared with that of the case.",
          "The answer is wrong for all larger numbers, and right for much smaller ones alone: the constant keeps tiny "
          "numbers out, and is not the cause.",
          {CauseKind::absolute_tolerance});
      return std::nullopt;
    }
    const std::size_t others = flips.size() - 1;
    if (!proved_of_most(others, similar_.size()) || !most(others, similar_.size())) return std::nullopt;
    if (best) return named_tolerance(*best, flips.size(), has_further_border(s), border);
    if (errs_to_both_sides_) {
      saw("Generated cases were asked.", "There are false hits and false misses: a tolerance errs to one side.",
          {CauseKind::absolute_tolerance, CauseKind::relative_tolerance});
      return std::nullopt;
    }
    const double low = border.low, high = border.high;
    saw("The flips of these cases were compared with sizes, distances, gaps, areas and times.",
        fmt::format(
            "No such quantity has the same value at every flip. The largest of the multiplied numbers is between "
            "{:.2g} and {:.2g} there.",
            low, high));
    if (high > widest_flips * low || has_further_border(s)) return std::nullopt;
    if (!border.wrong_below) {
      saw("The side of the wrong answers was compared with that of a tolerance, which weighs more for smaller numbers.",
          "The answer is wrong for larger numbers: an unknown constant is not its cause.");
      return std::nullopt;
    }
    return Named{CauseKind::absolute_tolerance,
                 "",
                 fmt::format("The answer depends on the scale of the {}: it flips where the largest of them is between "
                             "{:.2g} and {:.2g}. The subject compares something with a constant.",
                             s.group->name, low, high),
                 {Prediction::one_border, Prediction::ends_at_a_scale, Prediction::one_side_nearby},
                 border};
  }

  /// Of the largest numbers at the flips. Lengths of ordinary cases differ by no more than about so much, and so do the
  /// largest numbers of cases in which one of them has one value.
  static constexpr double widest_flips = 0x1p10;
  /// The finding is there again at a scale beyond the right answers: a constant has one border.
  static bool has_further_border(const ScaleScan& s) {
    constexpr int furthest = 64;  // beyond, the squares of ordinary numbers leave the range of floats
    const int direction = s.flip->right > s.flip->wrong ? 1 : -1;
    return std::any_of(s.trials.begin(), s.trials.end(), [&](const ScaleScan::At& a) {
      const int beyond = (a.k - s.flip->right) * direction;
      return a.trial.outcome == Outcome::same && beyond > 0 && beyond <= furthest;
    });
  }

  /// A quantity that has about the same value at every flip, and different values in the cases.
  struct Constant {
    std::string name, unit;
    double low = 0, high = INFINITY;
    double spread = 1;
  };
  std::optional<Constant> constant_quantity(const std::vector<Flipped>& flips) {
    const bool with_gap = decides(trials_.query().kind);
    std::vector<Constant> all;
    for (const Flipped& f : flips) {
      if (!f.is_sharp) continue;
      const auto a = quantities_of(f.at_wrong, with_gap), b = quantities_of(f.at_right, with_gap);
      all.resize(a.size());
      for (std::size_t i = 0; i < a.size(); ++i) {
        all[i].name = a[i].name, all[i].unit = a[i].unit;
        all[i].low = std::max(all[i].low, std::min(a[i].value, b[i].value));
        all[i].high = std::min(all[i].high, std::max(a[i].value, b[i].value));
      }
    }
    const auto sharp = std::count_if(flips.begin(), flips.end(), [](const Flipped& f) { return f.is_sharp; });
    return widest(std::move(all), std::size_t(sharp), with_gap);
  }
  /// Of the quantities that are equal at every flip, the one that differs most between the cases at one scale. A
  /// quantity that differs in a few of the cases alone may be equal by chance.
  std::optional<Constant> widest(std::vector<Constant> all, std::size_t flips, bool with_gap) {
    constexpr std::size_t least_flips = 5, least_different = 4;
    constexpr double error_of_estimates = 1.02;
    if (flips < least_flips) return std::nullopt;
    const auto own = quantities_of(question(), with_gap);
    std::vector<std::size_t> different(all.size(), 0);
    std::vector<double> furthest(all.size(), 1);
    for (const Trial& t : similar_) {
      const auto q = quantities_of(t.question, with_gap);
      for (std::size_t i = 0; i < q.size(); ++i) {
        const double factor = std::max(q[i].value / own[i].value, own[i].value / q[i].value);
        different[i] += factor > std::numbers::sqrt2;
        furthest[i] = std::max(furthest[i], factor);
      }
    }
    std::optional<Constant> best;
    for (std::size_t i = 0; i < all.size(); ++i) {
      all[i].spread = furthest[i];
      const bool is_constant = all[i].low > 0 && all[i].low <= all[i].high * error_of_estimates;
      const bool is_finite = std::isfinite(all[i].spread) && std::isfinite(all[i].high);
      if (is_constant && is_finite && different[i] >= least_different && (!best || furthest[i] > best->spread))
        best = all[i];
    }
    return best;
  }
  /// A constant that no one would write is a chance where the finding has another border.
  std::optional<Named> named_tolerance(const Constant& q, std::size_t cases, bool has_further_border,
                                       const BorderOfScale& border) {
    constexpr double error_of_estimates = 1.05, widest = 1.1;
    const double middle = std::sqrt(q.low * q.high);
    const int decade = int(std::lround(std::log10(middle)));
    const double round = std::pow(10.0, decade);
    const bool is_round = q.low <= round * error_of_estimates && round <= q.high * error_of_estimates;
    const bool is_written =
        is_round || (q.high <= widest * q.low && written_constant(q.low, q.high, error_of_estimates));
    const double value = is_round ? round : middle;
    saw(fmt::format("The flips of {} cases were compared with sizes, distances, gaps, areas and times.", cases),
        fmt::format("At each flip {} is between {:.3g} and {:.3g}, while it differs by a factor of {:.3g} between the "
                    "cases.",
                    q.name, q.low, q.high, q.spread));
    if (!is_written && (has_further_border || !border.wrong_below)) return std::nullopt;
    if (!is_written)
      return Named{CauseKind::absolute_tolerance,
                   "",
                   "The subject compares something with a constant: no quantity is a round number at every flip.",
                   {Prediction::one_border, Prediction::ends_at_a_scale, Prediction::one_side_nearby},
                   border};
    return Named{CauseKind::absolute_tolerance,
                 fmt::format("{} {}", is_round ? fmt::format("1e{}", decade) : stable_value(q.low, q.high), q.unit),
                 fmt::format("The subject has an absolute tolerance of about {:.2g} ({}) that {} is compared with.",
                             value, q.unit, q.name),
                 {Prediction::one_border, Prediction::ends_at_a_scale, Prediction::one_side_nearby},
                 border};
  }
  const Case& question() const { return trials_.base().question; }
  void saw(std::string test, std::string result, std::vector<CauseKind> against = {}) {
    evidence_.push_back({std::move(test), std::move(result), std::move(against)});
  }

  Trials& trials_;
  std::span<const ScaleScan> scans_;
  std::span<const Trial> similar_;
  bool errs_to_both_sides_;
  std::vector<Evidence> evidence_;
};

}  // namespace

Tested constant_error_of(const Trials& trials, std::span<const ScaleScan> scans) {
  return ConstantError(trials, scans).result();
}

Tested tolerance_of(Trials& trials, std::span<const ScaleScan> scans, std::span<const Trial> similar,
                    bool errs_to_both_sides) {
  return ToleranceSearch(trials, scans, similar, errs_to_both_sides).result();
}

}  // namespace nearmiss
