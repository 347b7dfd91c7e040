/// The leaves of a listed struct (collide/members.hpp) with their paths.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <type_traits>

#include <collide/members.hpp>

namespace nearmiss {

/// Calls f(path, value, role) for each leaf; path is "sphere.center.x", "contacts.0.y", "hull.vertices.count".
template <class S, class F>
void for_each_named_leaf(S& s, F&& f, const std::string& path = {}, collide::Role role = collide::Role::inherited) {
  const auto below = [&](auto name) { return path.empty() ? std::string(name) : path + "." + std::string(name); };
  if constexpr (collide::Listed<S>) {
    collide::for_each_member(s, [&](std::string_view name, auto& value, collide::Role own) {
      for_each_named_leaf(value, f, below(name), own == collide::Role::inherited ? role : own);
    });
  } else if constexpr (requires { s.begin(); }) {
    if constexpr (collide::is_counted<std::remove_const_t<S>>) f(below("count"), s.count, collide::Role::count);
    std::size_t i = 0;
    for (auto& item : s) for_each_named_leaf(item, f, below(std::to_string(i++)), role);
  } else {
    f(path, s, role);
  }
}

}  // namespace nearmiss
