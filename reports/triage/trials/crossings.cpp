#include "reports/triage/trials/crossings.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "corpus/generator/case_builder.hpp"

namespace nearmiss {

namespace {

class CrossingSearch {
 public:
  CrossingSearch(Trials& trials, const Case& wrong, std::span<const std::size_t> numbers)
      : trials_(trials), wrong_(wrong), numbers_(numbers) {}

  std::vector<Crossing> result() {
    ask_all_moves();
    std::vector<Crossing> found;
    for (const Row& row : rows_) {
      if (trials_.is_over()) break;
      if (auto crossing = crossing_in(row)) found.push_back(std::move(*crossing));
    }
    return found;
  }

 private:
  static constexpr int bisections = 16;

  /// A number's other values in one direction, from near to far.
  struct Row {
    std::size_t number;
    std::vector<Trial> trials;
  };

  bool may_move(std::size_t i) const {
    const Role role = wrong_.role(i);
    const bool is_named = numbers_.empty() || std::find(numbers_.begin(), numbers_.end(), i) != numbers_.end();
    return is_named && !is_discrete(role);
  }
  /// The largest number of the same role; 1 where all are zero.
  double scale_of(std::size_t number) const {
    double largest = 0;
    for (std::size_t i = 0; i < wrong_.values.size(); ++i) {
      if (wrong_.role(i) == wrong_.role(number)) largest = std::max(largest, std::abs(wrong_.values[i]));
    }
    return largest > 0 ? largest : 1;
  }
  Case with_value(std::size_t number, double x) const {
    Case c = wrong_;
    c.values[number] = rounded_to(c.scalar, x);
    return c;
  }
  /// Moves by shares of the largest number of the role, first fine and then coarse; sizes and times toward zero by
  /// factors.
  std::vector<double> values_of(std::size_t number, double sign) const {
    constexpr int fine = 4, coarse = 6, furthest = 38;
    const int digits = wrong_.scalar == Scalar::float32 ? 24 : 53;
    const double own = wrong_.values[number], scale = scale_of(number);
    std::vector<double> values;
    for (int k = -digits; k <= furthest; k += k < 0 ? fine : coarse)
      values.push_back(own + sign * std::ldexp(scale, k));
    const Role role = wrong_.role(number);
    const bool stays_positive = own > 0 && (role == Role::size || role == Role::time || role == Role::weight);
    if (sign > 0 || !stays_positive) return values;
    std::vector<double> smaller;
    for (int k = -digits; k < 0; k += fine) smaller.push_back(own * (1 - std::ldexp(1.0, k)));
    for (int k = 1; k <= furthest; k += coarse) smaller.push_back(std::ldexp(own, -k));
    return smaller;
  }
  void ask_all_moves() {
    for (std::size_t i = 0; i < wrong_.values.size(); ++i) {
      if (!may_move(i)) continue;
      for (const double sign : {1.0, -1.0}) rows_.push_back({i, asked_row(moves_of(i, sign))});
    }
  }
  std::vector<Case> moves_of(std::size_t number, double sign) const {
    std::vector<Case> cases;
    for (const double x : values_of(number, sign)) {
      Case c = with_value(number, x);
      if (c.values != (cases.empty() ? wrong_ : cases.back()).values) cases.push_back(std::move(c));
    }
    return cases;
  }
  /// Asks every third case, and those before the first of them without the finding: most numbers play no part.
  std::vector<Trial> asked_row(const std::vector<Case>& cases) {
    constexpr std::size_t stride = 3;
    std::vector<Case> some;
    for (std::size_t end = stride; end < cases.size() + stride; end += stride)
      some.push_back(cases[std::min(end, cases.size()) - 1]);
    std::vector<Trial> row = trials_.ask(some);
    const auto first = std::find_if(row.begin(), row.end(), [](const Trial& t) { return t.outcome != Outcome::same; });
    if (first == row.end()) return row;
    const std::size_t begin = std::size_t(first - row.begin()) * stride;
    const std::size_t end = std::min(begin + stride, cases.size()) - 1;
    std::vector<Trial> before = trials_.ask(std::span(cases).subspan(begin, end - begin));
    row.erase(first + 1, row.end());
    row.insert(row.end() - 1, std::make_move_iterator(before.begin()), std::make_move_iterator(before.end()));
    return row;
  }

  /// Whether the exact decision is that of the case.
  bool is_of_same_truth(const Trial& t) const { return t.finding.truth_yes == trials_.base().finding.truth_yes; }
  /// The first right answer behind an unbroken row of answers with the finding.
  std::optional<Crossing> crossing_in(const Row& row) {
    const auto first =
        std::find_if(row.trials.begin(), row.trials.end(), [](const Trial& t) { return t.outcome != Outcome::same; });
    if (first == row.trials.end() || first->outcome != Outcome::right || !is_of_same_truth(*first)) return std::nullopt;
    Trial wrong = first == row.trials.begin() ? trials_.ask({&wrong_, 1}).front() : *(first - 1), right = *first;
    if (wrong.outcome != Outcome::same || !bisect(row.number, wrong, right) || !jumps(wrong, right))
      return std::nullopt;
    return Crossing{wrong_, row.number, wrong.question, wrong.answer, std::move(right)};
  }
  /// False where an answer between is neither.
  bool bisect(std::size_t number, Trial& wrong, Trial& right) {
    for (int n = 0; n < bisections; ++n) {
      const double a = wrong.question.values[number], b = right.question.values[number];
      const bool is_wide = a * b > 0 && std::max(a / b, b / a) > 2;
      const double middle =
          is_wide ? std::copysign(std::sqrt(std::abs(a)) * std::sqrt(std::abs(b)), a) : a + (b - a) / 2;
      const Case c = with_value(number, middle);
      if (c.values == wrong.question.values || c.values == right.question.values) return true;
      Trial t = trials_.ask({&c, 1}).front();
      if (t.outcome != Outcome::same && t.outcome != Outcome::right) return false;
      (t.outcome == Outcome::same ? wrong : right) = std::move(t);
    }
    return true;
  }

  /// The decision changes, and the true one does not; or a number moves by half of its error.
  bool jumps(const Trial& wrong, const Trial& right) const {
    const Answer &a = wrong.answer, &b = right.answer;
    if (wrong.finding.truth_yes != right.finding.truth_yes) return false;
    if (a.status != b.status || a.yes != b.yes) return true;
    const Finding full = trials_.in_full(wrong);
    const MemberFinding* member = full.headline_member();
    if (member == nullptr || member->worst < 0) return false;
    const double by = std::abs(a.values[std::size_t(member->worst)] - b.values[std::size_t(member->worst)]);
    return !(by < member->forward_absolute / 2);
  }

  Trials& trials_;
  const Case& wrong_;
  std::span<const std::size_t> numbers_;
  std::vector<Row> rows_;
};

}  // namespace

std::vector<Crossing> crossings_of(Trials& trials, const Case& wrong, std::span<const std::size_t> numbers) {
  return CrossingSearch(trials, wrong, numbers).result();
}

}  // namespace nearmiss
