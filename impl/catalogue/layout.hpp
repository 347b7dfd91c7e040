/// The members of an answer, each a range of its numbers. The oracle and the judge compare member by member.
#pragma once

#include <cstddef>
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
  };
  std::vector<Part> parts;

  template <class A>
  static Layout of() {
    Layout layout;
    A a{};
    std::size_t at = 0;
    layout.add(a, collide::Role::inherited, at);
    return layout;
  }

 private:
  template <class S>
  void add(S& value, collide::Role role, std::size_t& at) {
    if (role == collide::Role::inherited) {
      if constexpr (collide::Listed<S>) {
        collide::for_each_member(value, [&](std::string_view, auto& part, collide::Role own) { add(part, own, at); });
        return;
      } else if constexpr (requires { value.begin(); }) {
        for (auto& item : value) add(item, role, at);
        return;
      }
    }
    std::size_t n = 0;
    collide::for_each_leaf(value, [&](auto&, collide::Role) { ++n; });
    parts.push_back({at, at + n, role});
    at += n;
  }
};

}  // namespace nearmiss
