/// Access to a case's and an answer's numbers by name, for relations between cases.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "impl/catalogue/case.hpp"

namespace nearmiss::metamorphic {

inline std::string_view last(std::string_view name) { return name.substr(name.rfind('.') + 1); }

/// The number of fields if none has that name.
inline std::size_t index_of(const std::vector<Field>& fields, std::string_view name) {
  const auto at = std::find_if(fields.begin(), fields.end(), [&](const Field& f) { return f.name == name; });
  return std::size_t(at - fields.begin());
}
inline bool has(const Case& c, std::string_view name) {
  return index_of(c.query->inputs, name) < c.query->inputs.size();
}
inline double& value(Case& c, std::string_view name) { return c.values.at(index_of(c.query->inputs, name)); }
inline double value(const Case& c, std::string_view name) { return c.values.at(index_of(c.query->inputs, name)); }

/// Three consecutive numbers with the names x, y, z.
inline bool vector_at(const std::vector<Field>& fields, std::size_t i) {
  return i + 2 < fields.size() && last(fields[i].name) == "x" && last(fields[i + 1].name) == "y" &&
         last(fields[i + 2].name) == "z";
}
inline bool is_quaternion(const std::vector<Field>& fields, std::size_t i) {
  return fields[i].role == Role::rotation && last(fields[i].name) == "x";
}

inline Answer without(Answer a, std::size_t output) {
  a.given &= ~(std::uint64_t{1} << output);
  return a;
}

/// Sets output `i` to output `from` of another answer, times `factor`; it is given if that one is.
inline void carry(Answer& a, std::size_t i, const Answer& own, std::size_t from, double factor = 1) {
  a.values[i] = factor * own.values[from];
  a.given = (a.given & ~(std::uint64_t{1} << i)) | (own.given >> from & 1u) << i;
}

/// A subject's number as an index from 0; -1 if it is none.
inline int as_index(double x) { return x >= 0 && x < 15 && x == std::floor(x) ? int(x) : -1; }

/// Exchanges the components of two vectors of a case.
inline void exchange(Case& c, const std::string& a, const std::string& b) {
  for (const char* k : {".x", ".y", ".z"}) std::swap(value(c, a + k), value(c, b + k));
}

/// The names of the operands with these points: "triangle" for v0, v1, v2.
inline std::vector<std::string> operands_with(const Case& c, std::string_view point, std::string_view and_not) {
  std::vector<std::string> names;
  for (const Field& f : c.query->inputs) {
    const std::string ending = fmt::format(".{}.x", point);
    if (!f.name.ends_with(ending)) continue;
    const std::string operand = f.name.substr(0, f.name.size() - ending.size());
    if (!has(c, fmt::format("{}.{}.x", operand, and_not))) names.push_back(operand);
  }
  return names;
}
inline std::vector<std::string> triangles_of(const Case& c) { return operands_with(c, "v2", "v3"); }
inline std::vector<std::string> rectangles_of(const Case& c) { return operands_with(c, "v3", "v4"); }

}  // namespace nearmiss::metamorphic
