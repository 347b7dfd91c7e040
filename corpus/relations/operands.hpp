/// Access to a case's and an answer's numbers by name, for relations between cases.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "impl/catalogue/case.hpp"

namespace nearmiss::metamorphic {

inline std::string_view last(std::string_view name) { return name.substr(name.rfind('.') + 1); }

/// The number of fields if none has that name.
inline std::size_t index_of(std::span<const Field> fields, std::string_view name) {
  const auto at = std::find_if(fields.begin(), fields.end(), [&](const Field& f) { return f.name == name; });
  return std::size_t(at - fields.begin());
}
inline bool has(const Case& c, std::string_view name) { return index_of(c.fields(), name) < c.fields().size(); }
inline double& value(Case& c, std::string_view name) { return c.values.at(index_of(c.fields(), name)); }
inline double value(const Case& c, std::string_view name) { return c.values.at(index_of(c.fields(), name)); }

/// The output that is the time of an impact; the number of outputs without one.
inline std::size_t time_of(const Query& query) {
  const Layout::Part* time = query.layout.at(Role::time);
  return time == nullptr ? query.outputs.size() : time->begin;
}

/// The output that is a signed distance; the number of outputs without one.
inline std::size_t signed_distance_of(const Query& query) {
  const bool has_points = index_of(query.outputs, "point1.x") < query.outputs.size();
  return has_points ? index_of(query.outputs, "distance") : query.outputs.size();
}

inline Answer without(Answer a, std::size_t output) {
  a.given &= ~(std::uint64_t{1} << output);
  return a;
}

inline Answer without(Answer a, const Layout::Part& member) {
  for (std::size_t i = member.begin; i < member.end; ++i) a = without(a, i);
  return a;
}

/// Sets output `i` to output `from` of another answer, times `factor`; it is given if that one is.
inline void carry(Answer& a, std::size_t i, const Answer& own, std::size_t from, double factor = 1) {
  a.values[i] = factor * own.values[from];
  a.given = (a.given & ~(std::uint64_t{1} << i)) | (own.given >> from & 1u) << i;
}

/// A subject's number as an index from 0; -1 if it is none.
inline int as_index(double x) { return x >= 0 && x < 15 && x == std::floor(x) ? int(x) : -1; }

/// Position k of the operand takes the place of its position order[k].
inline void reorder(Case& c, const Operand& operand, std::initializer_list<std::size_t> order) {
  const std::vector<double> before = c.values;
  std::size_t k = 0;
  for (const std::size_t from : order)
    std::copy_n(&before[operand.positions[from]], 3, &c.values[operand.positions[k++]]);
}
/// Reverses the order of the corners of every triangle and rectangle: its front becomes its back.
inline void reverse_corners(Case& c) {
  for (const Operand& o : c.operands()) {
    if (o.shape == Shape::triangle) reorder(c, o, {0, 2, 1});
    if (o.shape == Shape::rectangle) reorder(c, o, {0, 3, 2, 1});
  }
}

}  // namespace nearmiss::metamorphic
