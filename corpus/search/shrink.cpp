#include "corpus/search/shrink.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <set>

namespace nearmiss {

namespace {

using Values = std::vector<double>;

std::size_t length_of(double x) {
  if (x == 0) return std::signbit(x) ? 1 : 0;
  int exponent = 0;
  const double fraction = std::frexp(std::abs(x), &exponent);
  const auto bits = static_cast<std::uint64_t>(std::ldexp(fraction, 53));
  const int significant = 53 - std::countr_zero(bits);
  const int length = 6 * significant + 2 * std::abs(exponent - significant) + (x < 0 ? 1 : 0);
  return std::size_t(length);
}

/// Simpler numbers than x, the simplest first. Rounding may lead beyond the range of the scalar.
std::vector<double> simpler(double x) {
  std::vector<double> all{0, 1, -1, 2, -2, 3, std::trunc(x), std::round(x), std::abs(x)};
  int exponent = 0;
  const double fraction = std::frexp(x, &exponent);
  for (int bits : {1, 2, 3, 4, 6, 8, 12, 16, 20, 23, 30, 40, 50, 52}) {
    all.push_back(std::ldexp(std::nearbyint(std::ldexp(fraction, bits)), exponent - bits));
    all.push_back(std::ldexp(std::trunc(std::ldexp(fraction, bits)), exponent - bits));
  }
  // Steps towards exponent 0 that halve: a few passes reach the nearest exponent with the finding.
  for (int step = exponent; step != 0; step /= 2) all.push_back(std::ldexp(fraction, exponent - step));
  std::erase_if(all, [&](double y) { return !std::isfinite(y) || length_of(y) >= length_of(x); });
  std::ranges::stable_sort(all, {}, length_of);
  return all;
}

bool is_length(const Case& c, std::size_t i) {
  return c.role(i) == Role::position || c.role(i) == Role::size || c.role(i) == Role::velocity;
}

/// The case with each length changed.
template <class Change>
Values with_lengths(const Case& c, Change change) {
  Values values = c.values;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (is_length(c, i)) values[i] = change(values[i]);
  }
  return values;
}

// The steps. Each gives the values to which step `which` may lead, the simplest first.

/// The list without one of its entries, the last ones first.
std::vector<Values> without_an_entry(const Case& c, std::size_t which) {
  std::vector<Values> all;
  for (std::size_t entry = c.query->lists.count_of(which, c.values); entry-- > 0;) {
    Case fewer = c;
    if (erase_entry(fewer, which, entry)) all.push_back(std::move(fewer.values));
  }
  return all;
}

constexpr int scales[] = {64, -64, 16, -16, 4, -4, 1, -1};

std::vector<Values> scaled_lengths(const Case& c, std::size_t which) {
  return {with_lengths(c, [&](double x) { return std::ldexp(x, scales[which]); })};
}

/// Along the axis of the number, which becomes 0.
std::vector<Values> shifted_positions(const Case& c, std::size_t which) {
  if (c.role(which) != Role::position || c.values[which] == 0) return {};
  Values values = c.values;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (c.role(i) == Role::position && c.name(i).back() == c.name(which).back()) values[i] -= c.values[which];
  }
  return {values};
}

/// The coarsest grid first: contacts survive on a grid and have simpler numbers.
std::vector<Values> rounded_lengths(const Case& c, std::size_t) {
  double largest = 0;
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    if (is_length(c, i)) largest = std::max(largest, std::abs(c.values[i]));
  }
  if (!(largest > 0) || !std::isfinite(largest)) return {};
  std::vector<Values> all;
  for (int bits = 1; bits <= 12; ++bits) {
    const int exponent = std::ilogb(largest) - bits;
    all.push_back(
        with_lengths(c, [&](double x) { return std::ldexp(std::nearbyint(std::ldexp(x, -exponent)), exponent); }));
  }
  return all;
}

Values with_member(const Case& c, const InputMember& m, const Values& value) {
  Values values = c.values;
  std::ranges::copy(value, values.begin() + std::ptrdiff_t(m.begin));
  return values;
}

std::vector<Values> simpler_members(const Case& c, std::size_t which) {
  const InputMember& m = c.operands().members[which];
  if (m.count == 1) return {};
  std::vector<Values> all{with_member(c, m, Values(m.count, 0.0))};
  for (std::size_t k = m.count; (m.role == Role::rotation || m.role == Role::direction) && k > 0; --k) {
    Values along(m.count, 0.0);
    along[k - 1] = 1;
    all.push_back(with_member(c, m, along));
  }
  for (const InputMember& other : c.operands().members) {
    if (other.begin == m.begin || other.role != m.role || other.count != m.count) continue;
    const auto begin = c.values.begin() + std::ptrdiff_t(other.begin);
    all.push_back(with_member(c, m, Values(begin, begin + std::ptrdiff_t(m.count))));
  }
  return all;
}

Values with_number(const Case& c, std::size_t i, double x) {
  Values values = c.values;
  values[i] = x;
  return values;
}

std::vector<Values> simpler_numbers(const Case& c, std::size_t which) {
  if (c.role(which) == Role::count) return {};
  std::vector<Values> all;
  for (const double x : simpler(c.values[which])) all.push_back(with_number(c, which, x));
  return all;
}

std::vector<Values> equal_numbers(const Case& c, std::size_t which) {
  if (c.role(which) == Role::count) return {};
  std::vector<Values> all;
  for (std::size_t k = 0; k < c.values.size(); ++k) {
    const bool other = c.role(k) == c.role(which) && c.values[k] != c.values[which];
    if (other) all.push_back(with_number(c, which, c.values[k]));
  }
  return all;
}

struct StepKind {
  std::vector<Values> (*leads_to)(const Case& c, std::size_t which);
  std::size_t (*count)(const Case& c);  ///< of steps of this kind
  bool repeats = false;                 ///< a step that led to a simpler case is tried again at once
};

std::size_t one(const Case&) { return 1; }
std::size_t numbers(const Case& c) { return c.values.size(); }

constexpr StepKind step_kinds[] = {
    {without_an_entry, [](const Case& c) { return c.query->lists.size(); }, true},
    {scaled_lengths, [](const Case&) { return std::size(scales); }, true},
    {shifted_positions, numbers},
    {rounded_lengths, one},
    {simpler_members, [](const Case& c) { return c.operands().members.size(); }},
    {simpler_numbers, numbers},
    {equal_numbers, numbers},
};

/// Whether the case is simpler than `than`, valid, and exact in its scalar: a step may lead beyond the largest number.
bool is_candidate(const Case& c, const Simplicity& than) {
  const bool exact =
      std::ranges::all_of(c.values, [&](double x) { return std::isfinite(x) && representable(x, c.scalar); });
  return exact && simplicity_of(c) < than && !c.query->broken(c.values);
}

class Shrinker {
 public:
  Shrinker(const Case& c, const std::function<bool(const Case&)>& keeps, int questions)
      : best_(c), simplicity_(simplicity_of(c)), keeps_(keeps), questions_(questions) {}

  Case run() {
    while (pass() && questions_ > 0) {
    }
    return best_;
  }

 private:
  /// Tries every step. True if any led to a simpler case.
  bool pass() {
    const Simplicity before = simplicity_;
    for (const StepKind& kind : step_kinds) {
      for (std::size_t which = 0; which < kind.count(best_); ++which) {
        while (step(kind, which) && kind.repeats) {
        }
      }
    }
    return simplicity_ < before;
  }
  bool step(const StepKind& kind, std::size_t which) {
    const std::vector<Values> all = kind.leads_to(best_, which);
    return std::ranges::any_of(all, [&](const Values& values) { return accept(values); });
  }
  bool accept(const Values& values) {
    if (questions_ <= 0) return false;
    Case c = best_;
    c.values = values;
    if (!is_candidate(c, simplicity_)) return false;
    --questions_;
    if (!keeps_(c)) return false;
    best_ = std::move(c);
    simplicity_ = simplicity_of(best_);
    return true;
  }

  Case best_;
  Simplicity simplicity_;
  const std::function<bool(const Case&)>& keeps_;
  int questions_;
};

}  // namespace

Simplicity simplicity_of(const Case& c) {
  Simplicity s{c.values.size()};
  std::set<double> magnitudes;
  for (const double x : c.values) {
    s.not_zero += x != 0;
    s.length += length_of(x);
    magnitudes.insert(std::abs(x));
  }
  s.magnitudes = magnitudes.size();
  return s;
}

std::vector<Case> simpler_by_one_step(const Case& c) {
  std::vector<Case> all;
  for (const StepKind& kind : step_kinds) {
    for (std::size_t which = 0; which < kind.count(c); ++which) {
      for (Values& values : kind.leads_to(c, which)) {
        Case step = c;
        step.values = std::move(values);
        if (is_candidate(step, simplicity_of(c))) all.push_back(std::move(step));
      }
    }
  }
  return all;
}

Case shrink(const Case& c, const std::function<bool(const Case&)>& keeps, int questions) {
  return Shrinker(c, keeps, questions).run();
}

}  // namespace nearmiss
