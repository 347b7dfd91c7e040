#include "reports/triage/relative_tolerance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "reports/triage/crossings.hpp"
#include "reports/triage/ratios.hpp"
#include "reports/triage/written_constant.hpp"

namespace nearmiss {

namespace {

class RelativeTolerance {
 public:
  RelativeTolerance(Trials& trials, std::span<const Trial> similar) : trials_(trials), similar_(similar) {}

  Tested result() {
    find_crossings();
    Tested tested;
    if (crossings_.size() >= least_crossings) tested.named = named();
    if (!tested.named)
      saw(fmt::format("Numbers of {} cases were moved alone until the answer jumps.", starts_.size()),
          fmt::format("It jumps at {} borders; no ratio has one value there.", crossings_.size()));
    tested.evidence = std::move(evidence_);
    return tested;
  }

 private:
  static constexpr std::size_t least_crossings = 4, least_cases = 3, most_cases = 7, most_numbers = 4;
  static constexpr long double spread = 1.02L;                      ///< of one value
  static constexpr long double largest = 0.2L;                      ///< a larger ratio is no tolerance
  static constexpr double usual_error = 1.01, least_error = 1.001;  ///< of a written constant
  static constexpr long double variety = 1.5L;  ///< a length that differs by less in all cases is no part of a ratio

  /// The ratios at a border.
  struct Measured {
    std::size_t of_case, number;
    Ratios border;
  };
  struct Candidate {
    std::size_t ratio = 0, borders = 0;
    long double low = 0, high = 0;
    bool wrong_below = true;
    WrittenConstant constant;
  };

  void find_crossings() {
    std::vector<std::size_t> numbers = add(trials_.base().question, {});
    for (std::size_t k = 0;
         k < similar_.size() && starts_.size() < most_cases && !trials_.is_over() && !numbers.empty(); ++k) {
      std::vector<std::size_t> some;
      for (std::size_t n = 0; n < std::min(most_numbers, numbers.size()); ++n)
        some.push_back(numbers[(k * most_numbers + n) % numbers.size()]);
      add(similar_[k].question, some);
    }
  }
  /// Returns the numbers that have a crossing.
  std::vector<std::size_t> add(const Case& c, const std::vector<std::size_t>& numbers) {
    std::vector<std::size_t> found;
    starts_.emplace_back(c);
    for (const Crossing& x : crossings_of(trials_, c, numbers)) {
      crossings_.push_back({starts_.size() - 1, x.number, Ratios(x.at_right.question, &x.at_right.answer)});
      if (found.empty() || found.back() != x.number) found.push_back(x.number);
    }
    return found;
  }

  /// The value of a ratio at a border, and the side on which the answers are wrong; empty where the move did not change
  /// the ratio.
  struct Passed {
    long double value;
    bool wrong_below;
  };
  std::optional<Passed> passed(const Measured& m, std::size_t i) const {
    const long double start = starts_[m.of_case].value(i), value = m.border.value(i);
    if (!(value > 0)) return std::nullopt;
    if (start * spread < value) return Passed{value, true};
    return start > spread * value ? std::optional(Passed{value, false}) : std::nullopt;
  }
  std::optional<Candidate> candidate(std::size_t i) const {
    std::vector<std::pair<long double, std::size_t>> below, above;
    for (std::size_t k = 0; k < crossings_.size(); ++k) {
      const auto p = passed(crossings_[k], i);
      if (p && p->value < largest) (p->wrong_below ? below : above).emplace_back(p->value, k);
    }
    auto best = widest_window(i, below, true);
    const auto other = widest_window(i, above, false);
    if (other && (!best || other->borders > best->borders)) best = other;
    return best;
  }
  /// The most borders at which the ratio has one value.
  std::optional<Candidate> widest_window(std::size_t i, std::vector<std::pair<long double, std::size_t>>& values,
                                         bool wrong_below) const {
    if (!are_most(values.size())) return std::nullopt;
    std::sort(values.begin(), values.end());
    std::size_t begin = 0, best_begin = 0, best_end = 0;
    for (std::size_t end = 1; end <= values.size(); ++end) {
      while (values[end - 1].first > spread * values[begin].first) ++begin;
      if (end - begin > best_end - best_begin) best_begin = begin, best_end = end;
    }
    const std::span window(values.data() + best_begin, best_end - best_begin);
    if (!are_most(window.size()) || !is_of_several(window)) return std::nullopt;
    Candidate c{i, window.size(), window.front().first, window.back().first, wrong_below, {}};
    const auto constant =
        written_constant(double(c.low), double(c.high), is_varied(i, window) ? usual_error : least_error);
    if (!constant || (!is_varied(i, window) && constant->rank > 0)) return std::nullopt;
    c.constant = *constant;
    return c;
  }
  bool are_most(std::size_t borders) const { return borders >= least_crossings && 3 * borders >= crossings_.size(); }
  using Window = std::span<const std::pair<long double, std::size_t>>;
  /// The borders are of several cases and moved numbers.
  bool is_of_several(Window window) const {
    std::set<std::size_t> cases, numbers;
    for (const auto& [value, k] : window) cases.insert(crossings_[k].of_case), numbers.insert(crossings_[k].number);
    return cases.size() >= least_cases && numbers.size() >= 2;
  }
  /// No part of a quotient is the same at all of the borders. Where both are, only a close power of ten tells a ratio
  /// from others with the same numerator.
  bool is_varied(std::size_t i, Window window) const {
    long double low = std::numeric_limits<long double>::infinity(), high = 0;
    for (const auto& [value, k] : window) {
      const long double part = crossings_[k].border.numerator(i);
      low = std::min(low, part), high = std::max(high, part);
    }
    const bool is_pure = high == 0;
    return is_pure || high >= variety * low;
  }

  std::optional<Named> named() {
    std::optional<Candidate> best;
    for (std::size_t i = 0; i < crossings_.front().border.size(); ++i) {
      const auto c = candidate(i);
      if (c && (!best || is_better(*c, *best)) && divides_starts(*c)) best = c;
    }
    if (!best) return std::nullopt;
    const std::string name = crossings_.front().border.name(best->ratio), value = best->constant.text;
    saw(fmt::format("Numbers of {} cases were moved alone until the answer jumps.", starts_.size()),
        fmt::format("At {} of {} borders, {} is between {:.5g} and {:.5g}, and the exact decision is the same on both "
                    "sides. The answers are wrong {} it.",
                    best->borders, crossings_.size(), name, double(best->low), double(best->high),
                    best->wrong_below ? "below" : "above"));
    return Named{
        CauseKind::relative_tolerance, value,
        fmt::format("The subject has a relative tolerance of {} (unit 1) that {} is compared with.", value, name)};
  }
  static bool is_better(const Candidate& a, const Candidate& b) {
    if (a.constant.rank != b.constant.rank) return a.constant.rank < b.constant.rank;
    return a.borders > b.borders;
  }
  /// Nearly all cases with the finding lie on the wrong side of the value.
  bool divides_starts(const Candidate& c) const {
    const auto on_side = std::count_if(starts_.begin(), starts_.end(), [&](const Ratios& r) {
      const long double value = r.value(c.ratio);
      return c.wrong_below ? value <= c.high * spread : value * spread >= c.low;
    });
    return nearly_all(std::size_t(on_side), starts_.size());
  }
  void saw(std::string test, std::string result) { evidence_.push_back({std::move(test), std::move(result)}); }

  Trials& trials_;
  std::span<const Trial> similar_;
  std::vector<Measured> crossings_;
  std::vector<Ratios> starts_;  ///< of the cases whose numbers were moved
  std::vector<Evidence> evidence_;
};

}  // namespace

Tested relative_tolerance_of(Trials& trials, std::span<const Trial> similar) {
  return RelativeTolerance(trials, similar).result();
}

}  // namespace nearmiss
