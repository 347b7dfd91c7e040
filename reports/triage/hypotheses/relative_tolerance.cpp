#include "reports/triage/hypotheses/relative_tolerance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>

#include "reports/triage/geometry/ratios.hpp"
#include "reports/triage/hypotheses/written_constant.hpp"
#include "reports/triage/trials/crossings.hpp"
#include "reports/triage/trials/scales.hpp"

namespace nearmiss {

namespace {

class RelativeTolerance {
 public:
  RelativeTolerance(Trials& trials, std::span<const Trial> similar) : trials_(trials), similar_(similar) {}

  Tested result() {
    find_crossings();
    Tested tested;
    if (const auto found = best_candidate()) tested.named = named(*found);
    if (!tested.named)
      saw(fmt::format("Numbers of {} cases were moved alone until the answer jumps.", starts_.size()),
          fmt::format("It jumps at {} borders; no ratio has one value there.", crossings_.size()));
    tested.evidence = std::move(evidence_);
    return tested;
  }

 private:
  static constexpr std::size_t least_crossings = 4, least_cases = 3, enough_cases = 4, most_cases = 7, most_numbers = 4;
  static constexpr long double spread = 1.02L;         ///< of one value
  static constexpr long double least_spread = 1.002L;  ///< of one value at few borders, or of several ratios
  static constexpr long double least_change = 1.001L;  ///< of a ratio that a move changes
  static constexpr std::size_t largest_family = 15;    ///< the axes along which two boxes may be separated
  static constexpr long double largest = 0.02L;        ///< a larger ratio is no tolerance
  static constexpr double usual_error = 1.01, least_error = 1.001;  ///< of a written constant
  static constexpr long double variety = 1.5L;  ///< a length that differs by less in all cases is no part of a ratio

  /// The ratios at a border.
  struct Measured {
    std::size_t of_case, number;
    Ratios border;
    Case at_wrong, at_right;
    Answer wrong;                            ///< that to `at_wrong`
    mutable std::optional<Ratios> before{};  ///< at `at_wrong`, where it was computed
  };
  using Family = std::vector<std::size_t>;  ///< ratios that an implementation may compare in one loop
  struct Candidate {
    Family ratios;
    std::size_t borders = 0;
    long double low = 0, high = 0;
    bool wrong_below = true;
    std::vector<std::size_t> at;                   ///< the borders
    long double least_part = 0, largest_part = 0;  ///< the numerators at the borders
    std::optional<WrittenConstant> constant;
  };

  void find_crossings() {
    std::vector<std::size_t> numbers = add(trials_.base(), {});
    for (std::size_t k = 0;
         k < similar_.size() && starts_.size() < most_cases && !trials_.is_over() && !numbers.empty(); ++k) {
      std::vector<std::size_t> some;
      for (std::size_t n = 0; n < std::min(most_numbers, numbers.size()); ++n)
        some.push_back(numbers[(k * most_numbers + n) % numbers.size()]);
      add(similar_[k], some);
      if (starts_.size() == enough_cases && best_candidate()) return;
    }
  }
  bool is_wrong_decision() const {
    const Disagreement d = trials_.base().finding.disagreement;
    return d == Disagreement::false_hit || d == Disagreement::false_miss;
  }
  /// Returns the numbers that have a crossing. A ratio of a false hit is told from the given contact: there is no exact
  /// one.
  std::vector<std::size_t> add(const Trial& t, const std::vector<std::size_t>& numbers) {
    std::vector<std::size_t> found;
    starts_.emplace_back(t.question, t.finding.truth_yes ? nullptr : &t.answer, is_wrong_decision());
    for (const Crossing& x : crossings_of(trials_, t.question, numbers)) {
      const Answer* hit = x.at_right.answer.yes ? &x.at_right.answer : &x.wrong;
      crossings_.push_back({starts_.size() - 1, x.number, Ratios(x.at_right.question, hit, is_wrong_decision()),
                            x.at_wrong, x.at_right.question, x.wrong});
      if (found.empty() || found.back() != x.number) found.push_back(x.number);
    }
    return found;
  }

  /// A value of a ratio at a border.
  struct At {
    long double value;
    std::size_t border, ratio;
    friend bool operator<(const At& a, const At& b) { return a.value < b.value; }
  };
  using Window = std::span<const At>;

  /// A ratio has one value on both sides of a border. Where it has not, it is a few ulps there: the border is at zero,
  /// which is a case distinction and no tolerance.
  bool is_known_at(const Measured& m, std::size_t i) const {
    if (!m.before) {
      const bool has_contact = trials_.base().finding.truth_yes;
      m.before.emplace(m.at_wrong, has_contact ? nullptr : &m.wrong, is_wrong_decision());
    }
    const long double a = m.before->value(i), b = m.border.value(i);
    return std::max(a, b) <= spread * std::min(a, b);
  }
  /// The same at nearly all borders of a window.
  bool is_known(Window window) const {
    std::set<std::size_t> borders, known;
    for (const At& a : window) {
      borders.insert(a.border);
      if (is_known_at(crossings_[a.border], a.ratio)) known.insert(a.border);
    }
    return nearly_all(known.size(), borders.size());
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
    if (start * least_change < value) return Passed{value, true};
    return start > least_change * value ? std::optional(Passed{value, false}) : std::nullopt;
  }

  std::optional<Candidate> candidate(const Family& family) const {
    std::vector<At> below, above;
    for (std::size_t k = 0; k < crossings_.size(); ++k) {
      for (const std::size_t i : family) {
        const auto p = passed(crossings_[k], i);
        if (p && p->value < largest) (p->wrong_below ? below : above).push_back({p->value, k, i});
      }
    }
    std::optional<Candidate> best;
    for (auto* values : {&below, &above}) {
      std::sort(values->begin(), values->end());
      for (const long double widest : {spread, least_spread}) {
        if (family.size() > 1 && widest > least_spread) continue;
        const auto c = in_widest_window(family, *values, widest, values == &below);
        if (c && (!best || is_better(*c, *best))) best = c;
      }
    }
    return best;
  }
  /// The most borders at which a ratio of the family has one value.
  std::optional<Candidate> in_widest_window(const Family& family, Window values, long double widest,
                                            bool wrong_below) const {
    if (!are_enough(values.size())) return std::nullopt;
    std::vector<int> count(crossings_.size(), 0);
    std::size_t begin = 0, borders = 0, best_begin = 0, best_end = 0, most = 0;
    for (std::size_t end = 0; end < values.size(); ++end) {
      borders += count[values[end].border]++ == 0;
      for (; values[end].value > widest * values[begin].value; ++begin) borders -= --count[values[begin].border] == 0;
      if (borders > most) most = borders, best_begin = begin, best_end = end + 1;
    }
    const Window window = values.subspan(best_begin, best_end - best_begin);
    if (!are_enough(most) || !is_of_several(window)) return std::nullopt;
    Candidate c{family, most, window.front().value, window.back().value, wrong_below, {}, 0, 0, {}};
    add_parts(window, c);
    const bool varied = c.least_part == 0 || c.largest_part >= variety * c.least_part;
    const bool usual = are_many(most) && widest > least_spread && varied;
    // What is known more precisely must be the constant more precisely.
    const double known = std::max(least_error, std::pow(double(c.high / c.low), 3));
    const auto constant =
        written_constant(double(c.low), double(c.high), usual ? std::min(usual_error, known) : least_error);
    const bool may_be_any = are_many(most) && varied && written_constant(double(c.low), double(c.high), least_error);
    const bool is_constant = constant && constant->value >= epsilon() && (constant->rank == 0 || may_be_any);
    if (is_constant && is_known(window)) c.constant = constant;
    return c;
  }
  /// Where no part of a quotient differs between the borders, only a close power of ten tells a ratio from others with
  /// the same numerator.
  void add_parts(Window window, Candidate& c) const {
    std::set<std::size_t> borders;
    c.least_part = std::numeric_limits<long double>::infinity();
    for (const At& a : window) {
      const long double part = crossings_[a.border].border.numerator(a.ratio);
      c.least_part = std::min(c.least_part, part), c.largest_part = std::max(c.largest_part, part);
      borders.insert(a.border);
    }
    c.at.assign(borders.begin(), borders.end());
  }
  /// Of the scalar: a smaller ratio is a rounding error.
  double epsilon() const { return 2 * unit_roundoff(trials_.base().question.scalar); }
  /// A third of the borders.
  bool are_many(std::size_t borders) const { return 3 * borders >= crossings_.size(); }
  /// An eighth of the borders: at the others the answer jumps for its own reasons, such as the end of a false contact.
  bool are_enough(std::size_t borders) const { return borders >= least_crossings && 8 * borders >= crossings_.size(); }
  /// The borders are of several cases and moved numbers.
  bool is_of_several(Window window) const {
    std::set<std::size_t> cases, numbers;
    for (const At& a : window) cases.insert(crossings_[a.border].of_case), numbers.insert(crossings_[a.border].number);
    return cases.size() >= least_cases && numbers.size() >= 2;
  }
  /// Of the ratios alone or, where none passes, of families of ratios.
  std::optional<Candidate> best_candidate() {
    if (crossings_.size() < least_crossings) return std::nullopt;
    std::vector<Family> alone(crossings_.front().border.size());
    for (std::size_t i = 0; i < alone.size(); ++i) alone[i] = {i};
    std::size_t most = 0;
    if (auto best = best_of(alone, most)) return best;
    if (families_.empty()) find_families();
    return best_of(families_, most);
  }
  /// None where more than twice as many borders have one value of another ratio: the constant is one by chance then.
  /// `most` becomes the most borders with one value.
  std::optional<Candidate> best_of(const std::vector<Family>& families, std::size_t& most) const {
    std::optional<Candidate> best;
    for (const Family& family : families) {
      const auto c = candidate(family);
      if (!c || is_guard(*c)) continue;
      most = std::max(most, c->borders);
      if (c->constant && (!best || is_better(*c, *best)) && divides_starts(*c)) best = c;
    }
    return best && most <= 2 * best->borders ? best : std::nullopt;
  }
  /// A small value above which answers are wrong keeps tiny ratios out, and is not the cause.
  static bool is_guard(const Candidate& c) { return !c.wrong_below && c.high < 0x1p-10L; }
  void find_families() {
    const Ratios& ratios = crossings_.front().border;
    std::map<std::string, Family> by_name;
    for (std::size_t i = 0; i < ratios.size(); ++i) by_name[ratios.family(i)].push_back(i);
    for (auto& [name, family] : by_name) {
      if (family.size() > 1 && family.size() <= largest_family) families_.push_back(std::move(family));
    }
  }
  std::optional<Named> named(const Candidate& c) {
    const Ratios& ratios = crossings_.front().border;
    const std::string value = c.constant->text, of_others = ", or that of another axis, corner or edge,";
    const std::string name = ratios.name(c.ratios.front()) + (c.ratios.size() > 1 ? of_others : "");
    saw(fmt::format("Numbers of {} cases were moved alone until the answer jumps.", starts_.size()),
        fmt::format("At {} of {} borders, {} is between {:.5g} and {:.5g}, and the exact decision is the same on both "
                    "sides. The answers are wrong {} it.",
                    c.borders, crossings_.size(), name, double(c.low), double(c.high),
                    c.wrong_below ? "below" : "above"));
    if (!follows_scales(c)) return absolute(c);
    if (is_of_floats(c.constant->value))
      return Named{
          CauseKind::rounding,
          "single precision",
          fmt::format("The answers jump where {} is {}, half a unit in the last place of a float near 1 or its "
                      "root: the subject compares floats.",
                      name, value),
          {Prediction::small_error}};
    return Named{
        CauseKind::relative_tolerance,
        value,
        fmt::format("The subject has a relative tolerance of {} (unit 1) that {} is compared with.", value, name),
        {Prediction::at_every_scale, Prediction::one_side_nearby}};
  }
  /// Half a unit in the last place of a float above or below 1, or the sine of an angle whose cosine is so close to 1.
  bool is_of_floats(double value) const {
    const bool is_one = value == 0x1p-24 || value == 0x1p-25 || value == 0x1p-12;
    return is_one && trials_.base().question.scalar == Scalar::float64;
  }
  /// The numerator alone, where it has one value at the borders that is a power of ten.
  std::optional<Named> absolute(const Candidate& c) {
    if (!(c.least_part > 0) || c.largest_part > spread * c.least_part) return std::nullopt;
    const auto constant = written_constant(double(c.least_part), double(c.largest_part), usual_error);
    if (!constant || constant->rank > 0) return std::nullopt;
    const std::string name = crossings_.front().border.numerator_name(c.ratios.front());
    return Named{CauseKind::absolute_tolerance,
                 constant->text + " length",
                 fmt::format("The subject has an absolute tolerance of {} (length) that {} is compared with.",
                             constant->text, name),
                 {Prediction::one_side_nearby}};
  }
  static bool is_better(const Candidate& a, const Candidate& b) {
    if (!a.constant || !b.constant) return a.constant.has_value() || (!b.constant && a.borders > b.borders);
    if (a.constant->rank != b.constant->rank) return a.constant->rank < b.constant->rank;
    return a.borders > b.borders;
  }
  /// Whether both sides of the borders keep their outcomes at other scales of lengths and of velocities, as they do for
  /// a ratio. Directions have a scale of their own: they may have to be of unit length.
  bool follows_scales(const Candidate& c) {
    constexpr std::size_t most_borders = 4;
    std::vector<Case> cases;
    std::vector<Outcome> expected;
    for (std::size_t k = 0; k < std::min(most_borders, c.at.size()); ++k) {
      const Measured& m = crossings_[c.at[k]];
      for (const ScaleGroup& group : scale_groups().first(2)) {
        for (const int by : {-6, 6}) {
          const auto wrong = scaled(m.at_wrong, group, by), right = scaled(m.at_right, group, by);
          if (!wrong || !right) continue;
          cases.insert(cases.end(), {*wrong, *right});
          expected.insert(expected.end(), {Outcome::same, Outcome::right});
        }
      }
    }
    const std::vector<Trial> asked = trials_.ask(cases);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < asked.size(); ++i) kept += asked[i].outcome == expected[i];
    saw("The cases at the borders were multiplied by powers of two.",
        fmt::format("{} of {} keep their outcomes.", kept, asked.size()));
    return asked.empty() || nearly_all(kept, asked.size());
  }
  /// Nearly all cases with the finding lie on the wrong side of the value.
  bool divides_starts(const Candidate& c) const {
    const auto on_side = std::count_if(starts_.begin(), starts_.end(), [&](const Ratios& r) {
      return std::any_of(c.ratios.begin(), c.ratios.end(), [&](std::size_t i) {
        return c.wrong_below ? r.value(i) <= c.high * spread : r.value(i) * spread >= c.low;
      });
    });
    return nearly_all(std::size_t(on_side), starts_.size());
  }
  void saw(std::string test, std::string result) { evidence_.push_back({std::move(test), std::move(result)}); }

  Trials& trials_;
  std::span<const Trial> similar_;
  std::vector<Measured> crossings_;
  std::vector<Ratios> starts_;  ///< of the cases whose numbers were moved
  std::vector<Family> families_;
  std::vector<Evidence> evidence_;
};

}  // namespace

Tested relative_tolerance_of(Trials& trials, std::span<const Trial> similar) {
  return RelativeTolerance(trials, similar).result();
}

}  // namespace nearmiss
