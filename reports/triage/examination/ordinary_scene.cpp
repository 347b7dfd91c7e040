#include "reports/triage/examination/ordinary_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "corpus/generator/case_builder.hpp"
#include "reports/findings/text.hpp"
#include "reports/triage/trials/trials.hpp"

namespace nearmiss {

namespace {

/// Numbers of a case that are multiplied together. The exact answer follows.
enum class Dimension { length, speed, direction, rotation };
constexpr std::array dimensions{Dimension::length, Dimension::speed, Dimension::direction, Dimension::rotation};

/// A scene has no larger and no smaller numbers than 2^20 and 2^-20 (is_ordinary() of feature_regions.hpp).
constexpr int ordinary_exponents = 20;
/// The rounding error of a double is 2^-53 of the number.
constexpr int digits = 53;

/// The exponent of the quantity's unit in the unit of a number.
int order(Dimension q, Role role) {
  switch (role) {
    case Role::position:
    case Role::size:
    case Role::depth:
    case Role::distance: return q == Dimension::length ? 1 : 0;
    case Role::velocity: return q == Dimension::speed ? 1 : 0;
    case Role::time: return q == Dimension::length ? 1 : q == Dimension::speed ? -1 : 0;
    case Role::direction:
    case Role::normal: return q == Dimension::direction ? 1 : 0;
    case Role::offset: return q == Dimension::length || q == Dimension::direction ? 1 : 0;
    case Role::rotation: return q == Dimension::rotation ? 1 : 0;
    default: return 0;
  }
}

/// The largest number that has this unit alone. Where none has it, that of all that have it among others.
double largest_of(const Case& c, Dimension q) {
  double alone = 0, among = 0;
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    const Role role = c.role(i);
    if (order(q, role) == 0 || role == Role::time) continue;
    double& largest = role == Role::offset ? among : alone;
    largest = std::max(largest, std::abs(c.values[i]));
  }
  return alone > 0 ? alone : among;
}

bool is_ordinary_size(double x) {
  return std::abs(x) >= std::ldexp(1.0, -ordinary_exponents) && std::abs(x) <= std::ldexp(1.0, ordinary_exponents);
}

double largest_of_role(const Case& c, Role role) {
  double largest = 0;
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    if (c.role(i) == role) largest = std::max(largest, std::abs(c.values[i]));
  }
  return largest;
}

bool is_counted(Role role) { return !is_discrete(role); }

/// Too small to change the largest number of its role.
bool is_lost(const Case& c, std::size_t i) {
  const double x = std::abs(c.values[i]);
  return x > 0 && is_counted(c.role(i)) && x < std::ldexp(largest_of_role(c, c.role(i)), -digits);
}

bool has_lost_numbers(const Case& c) {
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    if (is_lost(c, i)) return true;
  }
  return false;
}

/// What to multiply the dimension by, as a power of two: none where it is ordinary.
int step_to_one(const Case& c, Dimension q) {
  const double largest = largest_of(c, q);
  return largest == 0 || is_ordinary_size(largest) ? 0 : -std::ilogb(largest);
}

Case near_one(const Case& question) {
  Case c = question;
  for (const Dimension q : dimensions) {
    const int step = step_to_one(question, q);
    for (std::size_t i = 0; i < c.values.size() && step != 0; ++i) {
      c.values[i] = rounded_to(c.scalar, std::ldexp(c.values[i], step * order(q, c.role(i))));
    }
  }
  return c;
}

/// Numbers that are too small become this power of two of the largest of their role, or 0.
Case without_lost_numbers(const Case& question, std::optional<int> exponent) {
  Case c = question;
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    if (!is_lost(question, i)) continue;
    const double size = exponent ? std::ldexp(largest_of_role(question, c.role(i)), *exponent) : 0;
    c.values[i] = rounded_to(c.scalar, std::copysign(size, c.values[i]));
  }
  return c;
}

bool is_odd(double x) {
  constexpr double least = 0x1p-10, most = 0x1p10;
  return x != 0 && (std::abs(x) < least || std::abs(x) > most);
}

}  // namespace

void ExtremeMagnitudes::add(const ExtremeMagnitudes& other) {
  if (other.up_from > 0) up_from = up_from > 0 ? std::min(up_from, other.up_from) : other.up_from;
  down_from = std::max(down_from, other.down_from);
}

bool is_extreme_scene(const Case& question) {
  const bool has_extreme_dimension =
      std::any_of(dimensions.begin(), dimensions.end(), [&](Dimension q) { return step_to_one(question, q) != 0; });
  return has_extreme_dimension || has_lost_numbers(question);
}

ExtremeMagnitudes magnitudes_of(const Case& question) {
  double most = 0, least = HUGE_VAL;
  for (std::size_t i = 0; i < question.values.size(); ++i) {
    const double x = std::abs(question.values[i]);
    if (x == 0 || !is_counted(question.role(i))) continue;
    most = std::max(most, x), least = std::min(least, x);
  }
  return most > std::ldexp(1.0, ordinary_exponents) ? ExtremeMagnitudes{most, 0} : ExtremeMagnitudes{0, least};
}

std::vector<Case> at_ordinary_magnitude(const Case& question) {
  const Case scaled = near_one(question);
  std::vector<Case> scenes;
  if (has_lost_numbers(scaled)) {
    scenes = {without_lost_numbers(scaled, std::nullopt), without_lost_numbers(scaled, -ordinary_exponents)};
  } else {
    scenes = {scaled};
  }
  std::erase_if(scenes, [](const Case& c) { return !is_valid(c); });
  return scenes;
}

Plainness plainness_of(const Case& question) {
  const std::set<double> numbers(question.values.begin(), question.values.end());
  Plainness p;
  for (const double x : numbers) {
    p.odd_numbers += is_odd(x);
    p.digits += number_text(x, question.scalar).size();
  }
  return p;
}

}  // namespace nearmiss
