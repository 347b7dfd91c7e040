/// The members of an answer, each a range of its numbers. The oracle and the judge compare member by member.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <collide/members.hpp>

namespace nearmiss {

/// Assigns the leaves of an answer type, in their order, to its members. A member without a role of its own counts as
/// the members that it lists. At most one member is a normal.
struct Layout {
  struct Part {
    std::size_t begin, end;
    collide::Role role;
    std::string name;  ///< "location", "corners.2.point"
    bool is_entry;     ///< of an entry of a list

    bool is_vector() const { return end - begin == 3; }
  };
  std::vector<Part> parts;

  /// The first member with that role or name; nullptr where there is none. The order of the members differs from answer
  /// to answer, so that a position says nothing about the meaning of a number.
  const Part* at(collide::Role role) const { return found(std::ranges::find(parts, role, &Part::role)); }
  const Part* at(std::string_view name) const { return found(std::ranges::find(parts, name, &Part::name)); }

  template <class A>
  static Layout of() {
    Layout layout;
    A a{};
    std::size_t at = 0;
    layout.add(a, {0, 0, collide::Role::inherited, {}, false}, at);
    return layout;
  }

 private:
  const Part* found(std::vector<Part>::const_iterator part) const { return part == parts.end() ? nullptr : &*part; }

  /// `as` tells the role and the name of the value.
  template <class S>
  void add(S& value, const Part& as, std::size_t& at) {
    const auto inner = [&](std::string_view name) {
      return as.name.empty() ? std::string(name) : as.name + "." + std::string(name);
    };
    if (as.role == collide::Role::inherited) {
      if constexpr (collide::Listed<S>) {
        collide::for_each_member(value, [&](std::string_view name, auto& part, collide::Role own) {
          add(part, {0, 0, own, inner(name), as.is_entry}, at);
        });
        return;
      } else if constexpr (requires { value.begin(); }) {
        std::size_t index = 0;
        for (auto& item : value) add(item, {0, 0, as.role, inner(std::to_string(index++)), true}, at);
        return;
      }
    }
    std::size_t n = 0;
    collide::for_each_leaf(value, [&](auto&, collide::Role) { ++n; });
    parts.push_back({at, at + n, as.role, as.name, as.is_entry});
    at += n;
  }
};

}  // namespace nearmiss
