/// Numbers found by their role.
#pragma once

#include <algorithm>
#include <optional>
#include <span>

#include "impl/catalogue/query.hpp"

namespace nearmiss {

/// The index of the first number with that role; empty where there is none. The order of the members of an answer
/// differs from type to type, so that a position says nothing about the meaning of a number.
inline std::optional<std::size_t> index_of_role(std::span<const Field> fields, Role role) {
  const auto at = std::find_if(fields.begin(), fields.end(), [&](const Field& f) { return f.role == role; });
  return at == fields.end() ? std::nullopt : std::optional(std::size_t(at - fields.begin()));
}

}  // namespace nearmiss
