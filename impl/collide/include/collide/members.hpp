/// The members of a plain struct, listed once: serialization, checks and drawing code can use the list.
///
/// A listed struct has `static constexpr auto members()`, which returns a tuple of `member(name, pointer, role)` in
/// declaration order. A number without its own role (such as the x of a vector) takes the role of the member that
/// contains it.
#pragma once

#include <array>
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
  count,      ///< of the entries of a list that follow
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

/// A list in place of `least_count` to `most_count` entries. The first `count` ones exist; what is stored behind them
/// is part of no value.
template <class X, int most_count, int least_count = 1>
struct Counted {
  using value_type = X;
  static constexpr int least = least_count, most = most_count;
  static_assert(0 <= least && least <= most && most < 100);

  int count = least;
  std::array<X, std::size_t(most)> entries{};

  /// The count; its nearest bound where the count is beyond the bounds.
  constexpr std::size_t size() const noexcept {
    return std::size_t(count < least ? least : count > most ? most : count);
  }
  constexpr X* begin() noexcept { return entries.data(); }
  constexpr X* end() noexcept { return begin() + size(); }
  constexpr const X* begin() const noexcept { return entries.data(); }
  constexpr const X* end() const noexcept { return begin() + size(); }
  constexpr X& operator[](std::size_t i) noexcept { return entries[i]; }
  constexpr const X& operator[](std::size_t i) const noexcept { return entries[i]; }
};

template <class S>
inline constexpr bool is_counted = false;
template <class X, int most, int least>
inline constexpr bool is_counted<Counted<X, most, least>> = true;

/// Calls f(name, value, role) for each direct member of s, in order.
template <Listed S, class F>
constexpr void for_each_member(S& s, F&& f) {
  std::apply([&](const auto&... m) { (f(m.name, s.*(m.pointer), m.role), ...); }, std::remove_const_t<S>::members());
}

/// Calls f(value, role) for each leaf (number, bool, int) of a listed struct, depth first, in order. A list of counted
/// entries has its count as its first leaf: where f sets it, the entries that it now counts follow.
template <class S, class F>
constexpr void for_each_leaf(S& s, F&& f, Role role = Role::inherited) {
  if constexpr (Listed<S>) {
    for_each_member(
        s, [&](const char*, auto& value, Role own) { for_each_leaf(value, f, own == Role::inherited ? role : own); });
  } else if constexpr (is_counted<std::remove_const_t<S>>) {
    f(s.count, Role::count);
    for (auto& entry : s) for_each_leaf(entry, f, role);
  } else if constexpr (requires { s.begin(); }) {
    for (auto& item : s) for_each_leaf(item, f, role);
  } else {
    f(s, role);
  }
}

}  // namespace collide
