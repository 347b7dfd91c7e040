/// The members of a plain struct, listed once, so that codecs, generators, checks and drawings can
/// all be derived from the struct itself.
///
/// A listed struct offers `static constexpr auto members()`, a tuple of `member(name, pointer, role)`
/// in the order of declaration. Numbers without a role of their own (the x of a vector) take the role
/// of the member that holds them.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>

namespace collide {

/// What a number stands for. Positions, velocities, sizes, directions, rotations, times and
/// offsets of an input are also the groups within which a perturbation is measured (docs/semantics.md, "Backward
/// error").
enum class Role {
  inherited,  ///< the role of the enclosing member
  position,   ///< length, from the origin
  velocity,   ///< length per unit of time
  size,       ///< length, not negative
  direction,  ///< any length, not zero
  rotation,   ///< a quaternion x, y, z, w of any length, not zero
  time,       ///< displacement = velocity * time
  offset,     ///< of a plane: the length of its normal times a length, signed
  normal,     ///< a unit vector
  depth,      ///< length, negative when apart
  weight,     ///< dimensionless, barycentric
  flag,       ///< true or false
  index,      ///< a small integer
};

template <class Owner, class Value>
struct Member {
  std::string_view name;
  Value Owner::*pointer;
  Role role;
};

template <class Owner, class Value>
constexpr Member<Owner, Value> member(std::string_view name, Value Owner::*pointer, Role role = Role::inherited) {
  return {name, pointer, role};
}

template <class S>
concept Listed = requires { std::remove_cvref_t<S>::members(); };

/// Calls f(name, value, role) for each direct member of s, in order.
template <Listed S, class F>
constexpr void for_each_member(S& s, F&& f) {
  std::apply([&](const auto&... m) { (f(m.name, s.*(m.pointer), m.role), ...); }, std::remove_const_t<S>::members());
}

/// Calls f(value, role) for each leaf (number, bool, int) of a listed struct, depth first, in order.
template <class S, class F>
constexpr void for_each_leaf(S& s, F&& f, Role role = Role::inherited) {
  if constexpr (Listed<S>) {
    for_each_member(s, [&](std::string_view, auto& value, Role own) {
      for_each_leaf(value, f, own == Role::inherited ? role : own);
    });
  } else if constexpr (requires { s.begin(); }) {
    for (auto& item : s) for_each_leaf(item, f, role);
  } else {
    f(s, role);
  }
}

/// Calls f(path, value, role) for each leaf; path is "sphere.center.x", "contacts.0.y".
template <class S, class F>
void for_each_named_leaf(S& s, F&& f, const std::string& path = {}, Role role = Role::inherited) {
  const auto below = [&](auto name) { return path.empty() ? std::string(name) : path + "." + std::string(name); };
  if constexpr (Listed<S>) {
    for_each_member(s, [&](std::string_view name, auto& value, Role own) {
      for_each_named_leaf(value, f, below(name), own == Role::inherited ? role : own);
    });
  } else if constexpr (requires { s.begin(); }) {
    std::size_t i = 0;
    for (auto& item : s) for_each_named_leaf(item, f, below(std::to_string(i++)), role);
  } else {
    f(path, s, role);
  }
}

}  // namespace collide
