#include "corpus/search/shrink.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <set>
#include <utility>

namespace nearmiss {

namespace {

/// A measure of complexity: 0 for 0, then 1, -1, 2 ...: significant bits, distance of the exponent from 0, the sign.
int cost(double x) {
  if (x == 0) return std::signbit(x) ? 1 : 0;
  int exponent = 0;
  const double fraction = std::frexp(std::abs(x), &exponent);
  const auto bits = static_cast<std::uint64_t>(std::ldexp(fraction, 53));
  const int significant = 53 - std::countr_zero(bits);
  return 6 * significant + 2 * std::abs(exponent - significant) + (x < 0 ? 1 : 0);
}

/// The count of numbers decides first: a shape of fewer vertices is simpler, whatever their numbers.
using Cost = std::pair<std::size_t, long>;

Cost cost(const Case& c) {
  std::set<double> distinct;
  long sum = 0;
  for (double x : c.values) {
    distinct.insert(std::abs(x));
    sum += cost(x);
  }
  return {c.values.size(), 4 * sum + long(distinct.size())};
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
  std::erase_if(all, [&](double y) { return !std::isfinite(y) || cost(y) >= cost(x); });
  std::stable_sort(all.begin(), all.end(), [](double a, double b) { return cost(a) < cost(b); });
  return all;
}

class Shrinker {
 public:
  Shrinker(const Case& c, const std::function<bool(const Case&)>& keeps, int questions)
      : best_(c), cost_(cost(c)), keeps_(keeps), questions_(questions) {}

  Case run() {
    while (pass() && questions_ > 0) {
    }
    return best_;
  }

 private:
  /// True if anything became simpler.
  bool pass() {
    const Cost before = cost_;
    drop_entries();
    scale_lengths();
    shift_positions();
    round_lengths();
    for (std::size_t i = 0; i < best_.values.size(); ++i) simplify(i);
    for (std::size_t i = 0; i < best_.values.size(); ++i) copy_onto(i);
    return cost_ < before;
  }
  bool accept(const std::vector<double>& values) {
    // A shift may lead beyond the largest number.
    const bool exact = std::all_of(values.begin(), values.end(),
                                   [&](double x) { return std::isfinite(x) && representable(x, best_.scalar); });
    if (questions_ <= 0 || !exact) return false;
    Case c = best_;
    c.values = values;
    const Cost own = cost(c);
    if (own >= cost_ || c.query->broken(c.values)) return false;
    --questions_;
    if (!keeps_(c)) return false;
    best_ = std::move(c);
    cost_ = own;
    return true;
  }
  bool accept(std::size_t i, double x) {
    std::vector<double> values = best_.values;
    values[i] = x;
    return accept(values);
  }
  /// Leaves out the entries of lists that the finding does not need, the last ones first.
  void drop_entries() {
    for (std::size_t list = 0; list < best_.query->lists.size(); ++list) {
      for (std::size_t entry = best_.query->lists.count_of(list, best_.values); entry-- > 0;) {
        Case c = best_;
        if (erase_entry(c, list, entry)) (void)accept(c.values);
      }
    }
  }
  void simplify(std::size_t i) {
    if (best_.role(i) == Role::count) return;
    for (double x : simpler(best_.values[i])) {
      if (accept(i, x)) return;
    }
  }
  void copy_onto(std::size_t i) {
    const Role role = best_.role(i);
    for (std::size_t k = 0; k < best_.values.size(); ++k) {
      if (best_.role(k) == role && best_.values[k] != best_.values[i]) (void)accept(i, best_.values[k]);
    }
  }
  bool is_length(std::size_t i) const {
    const Role role = best_.role(i);
    return role == Role::position || role == Role::size || role == Role::velocity;
  }
  /// Scales all lengths by the same power of two.
  void scale_lengths() {
    for (int k : {64, 16, 4, 1, -1, -4, -16, -64}) {
      for (bool again = true; again;) {
        std::vector<double> values = best_.values;
        bool exact = true;
        for (std::size_t i = 0; i < values.size(); ++i) {
          if (!is_length(i)) continue;
          values[i] = std::ldexp(values[i], k);
          exact = exact && std::isfinite(values[i]) && representable(values[i], best_.scalar);
        }
        again = exact && accept(values);
      }
    }
  }
  /// Rounds all lengths at once to a grid, the coarsest first: contacts survive on a grid and have simpler numbers.
  void round_lengths() {
    double largest = 0;
    for (std::size_t i = 0; i < best_.values.size(); ++i) {
      if (is_length(i)) largest = std::max(largest, std::abs(best_.values[i]));
    }
    if (!(largest > 0) || !std::isfinite(largest)) return;
    for (int bits = 1; bits <= 12; ++bits) {
      const int exponent = std::ilogb(largest) - bits;
      std::vector<double> values = best_.values;
      bool exact = true;
      for (std::size_t i = 0; i < values.size(); ++i) {
        if (is_length(i)) values[i] = std::ldexp(std::nearbyint(std::ldexp(values[i], -exponent)), exponent);
        exact = exact && representable(values[i], best_.scalar);
      }
      if (exact && accept(values)) return;
    }
  }
  /// Shifts each axis of all positions so that one of them is at 0.
  void shift_positions() {
    for (std::size_t origin = 0; origin < best_.values.size(); ++origin) {
      if (best_.role(origin) != Role::position || best_.values[origin] == 0) continue;
      const char axis = best_.name(origin).back();
      const double offset = best_.values[origin];
      std::vector<double> values = best_.values;
      bool exact = true;
      for (std::size_t i = 0; i < values.size(); ++i) {
        const Field& f = best_.fields()[i];
        if (f.role == Role::position && f.name.back() == axis) values[i] -= offset;
        exact = exact && representable(values[i], best_.scalar);
      }
      if (exact) (void)accept(values);
    }
  }

  Case best_;
  Cost cost_;
  const std::function<bool(const Case&)>& keeps_;
  int questions_;
};

}  // namespace

Case shrink(const Case& c, const std::function<bool(const Case&)>& keeps, int questions) {
  return Shrinker(c, keeps, questions).run();
}

}  // namespace nearmiss
