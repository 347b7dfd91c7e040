/// The members of a plain struct, listed once: serialization, checks and drawing code can use the list.
///
/// A listed struct has `static constexpr auto members()`, which returns a tuple of `member(name, pointer, role)` in
/// declaration order. A number without its own role (such as the x of a vector) takes the role of the member that
/// contains it.
#pragma once

#include <cstddef>
#include <tuple>
#include <type_traits>

namespace collide {

/// The meaning of a number. All numbers of an input with the same role form a group; a contract measures an error
/// relative to the largest number of its group (contract.hpp).
enum class Role {
  inherited,  ///< the role of the enclosing member
  position,   ///< length, from the origin
  velocity,   ///< length per unit of time
  size,       ///< length, not negative
  direction,  ///< of an input: any length, not zero; of an answer: as its comment says
  rotation,   ///< a quaternion x, y, z, w of any length, not zero
  time,       ///< displacement = velocity * time
  offset,     ///< of a plane: the length of its normal times a length, signed
  normal,     ///< part of a unit vector
  depth,      ///< length, negative when the shapes are apart
  distance,   ///< length, negative when the shapes overlap
  weight,     ///< dimensionless, barycentric
  flag,       ///< true or false
  index,      ///< a small integer
};

template <class Owner, class Value>
struct Member {
  const char* name;
  Value Owner::*pointer;
  Role role;
};

template <class Owner, class Value>
constexpr Member<Owner, Value> member(const char* name, Value Owner::*pointer, Role role = Role::inherited) {
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
    for_each_member(
        s, [&](const char*, auto& value, Role own) { for_each_leaf(value, f, own == Role::inherited ? role : own); });
  } else if constexpr (requires { s.begin(); }) {
    for (auto& item : s) for_each_leaf(item, f, role);
  } else {
    f(s, role);
  }
}

}  // namespace collide
