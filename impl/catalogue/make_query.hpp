/// Makes a query from the struct of its inputs. For the catalogue, and for tests with queries of their own.
#pragma once

#include <cmath>
#include <concepts>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <collide/checked.hpp>

#include "impl/catalogue/named_leaves.hpp"
#include "impl/catalogue/query.hpp"

namespace nearmiss {

namespace describing {

template <class S>
std::vector<Field> fields_of(S s) {
  std::vector<Field> fields;
  for_each_named_leaf(s, [&](const std::string& path, auto&, Role role) { fields.push_back({path, role}); });
  return fields;
}

template <class S>
std::size_t count_leaves(S& s) {
  std::size_t count = 0;
  collide::for_each_leaf(s, [&](auto&, Role) { ++count; });
  return count;
}

/// Adds the lists in a part of the inputs, which begins at the number `at` and has that name.
template <class S>
void add_lists(S& s, const std::string& path, std::size_t& at, std::vector<CountedInput>& lists) {
  if constexpr (collide::is_counted<S>) {
    lists.push_back({path, at, count_leaves(s.entries.front()), S::least, S::most});
    at += count_leaves(s);
  } else if constexpr (collide::Listed<S>) {
    collide::for_each_member(s, [&](const std::string& name, auto& value, Role) {
      add_lists(value, path.empty() ? name : path + "." + name, at, lists);
    });
  } else {
    at += count_leaves(s);
  }
}

template <class Inputs>
std::vector<CountedInput> lists_of() {
  std::vector<CountedInput> lists;
  Inputs inputs{};
  std::size_t at = 0;
  add_lists(inputs, "", at, lists);
  return lists;
}

/// Inputs of zeros whose lists have these counts.
template <class Inputs>
Inputs inputs_with(std::span<const std::size_t> counts) {
  Inputs inputs{};
  std::size_t list = 0;
  collide::for_each_leaf(inputs, [&](auto& leaf, Role role) {
    if constexpr (std::same_as<std::remove_cvref_t<decltype(leaf)>, int>) {
      if (role == Role::count) leaf = int(counts[list++]);
    }
  });
  return inputs;
}

template <class Inputs>
CountedInputs counted_inputs_of() {
  return {lists_of<Inputs>(), fields_of(Inputs{}).size(), [](std::span<const std::size_t> counts) {
            const auto inputs = inputs_with<Inputs>(counts);
            return InputFields{fields_of(inputs), operands_of(inputs)};
          }};
}

template <class Inputs>
std::optional<Invalid> broken_inputs(std::span<const double> values) {
  static const std::vector<Field> all = fields_of(Inputs{});
  static const CountedInputs lists = counted_inputs_of<Inputs>();
  if (!lists.empty()) {
    if (auto invalid = lists.broken(values)) return invalid;
  }
  const std::vector<Field>& fields = lists.empty() ? all : lists.fields(values).fields;
  for (std::size_t i = 0; i < fields.size(); ++i) {  // what becomes a bool or an int must be one before
    const double x = values[i];
    if (fields[i].role == Role::flag && x != 0 && x != 1) return Invalid{fields[i].name, x, "true or false"};
    if (fields[i].role == Role::index && (x != std::floor(x) || std::abs(x) > 1e6)) {
      return Invalid{fields[i].name, x, "a small integer"};
    }
  }
  const auto broken = collide::broken_rule(inputs_from<Inputs>(values.data()));
  if (!broken) return std::nullopt;
  return Invalid{broken->field.text(), broken->value, std::string(broken->rule)};
}

}  // namespace describing

/// `Inputs` is the struct over double; its traits may name other queries.
template <class Inputs>
Query make_query(QueryId id, std::string_view name) {
  using A = typename Inputs::Answer;
  return {id,
          name,
          kind_of<A>,
          describing::fields_of(Inputs{}),
          describing::fields_of(A{}),
          operands_of(Inputs{}),
          Layout::of<A>(),
          describing::broken_inputs<Inputs>,
          Inputs::traits,
          0,
          describing::counted_inputs_of<Inputs>()};
}

}  // namespace nearmiss
