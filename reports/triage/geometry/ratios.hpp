/// The closed table of dimensionless ratios of a case.
#pragma once

#include <cstddef>
#include <string>
#include <utility>

#include "reports/triage/geometry/magnitudes.hpp"

namespace nearmiss {

/// The pure numbers of a case, and the quotient of each two of its lengths: the same list for every case of a query.
class Ratios {
 public:
  explicit Ratios(const Case& c, const Answer* right = nullptr, bool with_gap = false)
      : magnitudes_(magnitudes_of(c, right, with_gap)) {}

  std::size_t size() const { return pure() + lengths() * (lengths() - 1); }
  /// 0 where it has no meaning in this case.
  long double value(std::size_t i) const;
  /// "the sine of the angle between a and b", "the length of a over the radius of b".
  std::string name(std::size_t i) const;
  /// The name without the numbers of axes, corners and edges: the same for ratios that an implementation compares in
  /// one loop. Quotients of two lengths with the same numbers are a family of their own.
  std::string family(std::size_t i) const;
  /// Of a quotient; empty, and 0, for a pure number.
  std::string numerator_name(std::size_t i) const { return i < pure() ? "" : magnitudes_.lengths[pair(i).first].name; }
  long double numerator(std::size_t i) const { return i < pure() ? 0 : magnitudes_.lengths[pair(i).first].value; }

 private:
  std::size_t pure() const { return magnitudes_.pure.size(); }
  std::size_t lengths() const { return magnitudes_.lengths.size(); }
  std::pair<std::size_t, std::size_t> pair(std::size_t i) const;

  Magnitudes magnitudes_;
};

/// The name of a magnitude without the numbers of axes, corners and edges.
std::string without_numbers(const std::string& name);

}  // namespace nearmiss
