/// Structures of arrays (SoA): an array for each number of a struct, as the batch forms of the queries read and write
/// them (batch.hpp).
///
/// A leaf of a struct is a number, flag or index in it, in the order of for_each_leaf (members.hpp): the leaves of
/// Sphere are center.x, center.y, center.z and radius. The first leaf of an answer with a stored decision is the
/// decision. Array k of a structure of arrays holds leaf k. A number or a flag by itself has one leaf.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include <collide/members.hpp>

namespace collide {

namespace detail {

template <class S>
struct LeafTypes {
  using type = std::tuple<S>;
};
template <class... A>
using JoinedTypes = decltype(std::tuple_cat(std::declval<A>()...));
template <class X, std::size_t n>
struct LeafTypes<std::array<X, n>> {
  template <std::size_t>
  using OfOne = typename LeafTypes<X>::type;
  template <std::size_t... i>
  static JoinedTypes<OfOne<i>...> join(std::index_sequence<i...>);
  using type = decltype(join(std::make_index_sequence<n>()));
};
template <Listed S>
struct LeafTypes<S> {
  template <class... Value>
  static JoinedTypes<typename LeafTypes<Value>::type...> join(const std::tuple<Member<S, Value>...>&);
  static auto all() {
    using Members = decltype(join(S::members()));
    if constexpr (requires { S::decision_member(); }) {
      return JoinedTypes<std::tuple<bool>, Members>{};
    } else {
      return Members{};
    }
  }
  using type = decltype(all());
};

/// Calls f(leaf) for each leaf of s, in the order of its arrays.
template <class S, class F>
constexpr void for_each_array_leaf(S& s, F&& f) {
  using Struct = std::remove_const_t<S>;
  if constexpr (requires { Struct::decision_member(); }) f(s.*Struct::decision_member());
  for_each_leaf(s, [&](auto& leaf, Role) { f(leaf); });
}

}  // namespace detail

/// The types of the leaves of S, as a tuple.
template <class S>
using LeafTypes = typename detail::LeafTypes<S>::type;
/// The number of leaves of S.
template <class S>
inline constexpr std::size_t leaf_count = std::tuple_size_v<LeafTypes<S>>;

/// Pointers to the arrays of `size` structs S, which another object owns. `writable` tells whether they may be written.
template <class S, bool writable>
class BasicSoaView {
 public:
  template <std::size_t k>
  using Leaf =
      std::conditional_t<writable, std::tuple_element_t<k, LeafTypes<S>>, const std::tuple_element_t<k, LeafTypes<S>>>;
  using Pointer = std::conditional_t<writable, void*, const void*>;

  BasicSoaView() = default;
  /// One pointer for each leaf, in order, each to an array of `size` elements of the type of the leaf. The arrays need
  /// no alignment beyond that of their elements.
  template <class... Arrays>
    requires(sizeof...(Arrays) == leaf_count<S> && (std::is_pointer_v<Arrays> && ...))
  explicit BasicSoaView(std::size_t size, Arrays... arrays)
      : BasicSoaView(size, std::index_sequence_for<Arrays...>(), arrays...) {}

  std::size_t size() const noexcept { return size_; }
  /// Array k.
  template <std::size_t k>
  std::span<Leaf<k>> array() const noexcept {
    return {static_cast<Leaf<k>*>(arrays_[k]), size_};
  }
  /// The `size` structs from index `first`; requires first + size <= size().
  BasicSoaView subview(std::size_t first, std::size_t size) const noexcept {
    return part(first, size, std::make_index_sequence<leaf_count<S>>());
  }
  /// The pointers without their types.
  const std::array<Pointer, leaf_count<S>>& arrays() const noexcept { return arrays_; }

 private:
  template <std::size_t... k>
  BasicSoaView part(std::size_t first, std::size_t size, std::index_sequence<k...>) const noexcept {
    return BasicSoaView(size, array<k>().data() + first...);
  }
  template <std::size_t... k, class... Arrays>
  BasicSoaView(std::size_t size, std::index_sequence<k...>, Arrays... arrays)
      : arrays_{static_cast<Leaf<k>*>(arrays)...}, size_(size) {}

  std::array<Pointer, leaf_count<S>> arrays_{};
  std::size_t size_ = 0;
};

/// Arrays that are read.
template <class S>
using SoaView = BasicSoaView<S, false>;
/// Arrays that are written.
template <class S>
using SoaSpan = BasicSoaView<S, true>;

/// Owns the arrays of some structs S. Growing invalidates its views and spans.
template <class S>
class Soa {
 public:
  Soa() = default;
  /// `size` structs S{}. May throw std::bad_alloc, as every function that makes it larger.
  explicit Soa(std::size_t size) { resize(size); }

  std::size_t size() const noexcept { return size_; }
  /// Keeps the structs that fit; new ones are S{}.
  void resize(std::size_t size) {
    if (size > capacity_) reallocate(size);
    for (std::size_t i = size_; i < size; ++i) put(i, S{});
    size_ = size;
  }
  void push_back(const S& s) {
    if (size_ == capacity_) reallocate(std::max<std::size_t>(16, 2 * capacity_));
    put(size_++, s);
  }
  /// Struct i; requires i < size().
  S operator[](std::size_t i) const noexcept {
    S s{};
    std::size_t k = 0;
    detail::for_each_array_leaf(s, [&](auto& leaf) {
      leaf = reinterpret_cast<const std::remove_cvref_t<decltype(leaf)>*>(memory_.data() + offsets_[k++])[i];
    });
    return s;
  }
  /// Replaces struct i; requires i < size().
  void put(std::size_t i, const S& s) noexcept {
    std::size_t k = 0;
    detail::for_each_array_leaf(s, [&](const auto& leaf) {
      reinterpret_cast<std::remove_cvref_t<decltype(leaf)>*>(memory_.data() + offsets_[k++])[i] = leaf;
    });
  }

  /// Array k.
  template <std::size_t k>
  std::span<std::tuple_element_t<k, LeafTypes<S>>> array() noexcept {
    return span().template array<k>();
  }
  SoaView<S> view() const noexcept { return view_of(std::make_index_sequence<leaf_count<S>>()); }
  SoaSpan<S> span() noexcept { return span_of(std::make_index_sequence<leaf_count<S>>()); }

 private:
  template <std::size_t k>
  using Leaf = std::tuple_element_t<k, LeafTypes<S>>;

  template <std::size_t... k>
  SoaView<S> view_of(std::index_sequence<k...>) const noexcept {
    return SoaView<S>(size_, reinterpret_cast<const Leaf<k>*>(memory_.data() + offsets_[k])...);
  }
  template <std::size_t... k>
  SoaSpan<S> span_of(std::index_sequence<k...>) noexcept {
    return SoaSpan<S>(size_, reinterpret_cast<Leaf<k>*>(memory_.data() + offsets_[k])...);
  }
  template <std::size_t... k>
  static constexpr std::array<std::size_t, leaf_count<S>> leaf_sizes(std::index_sequence<k...>) {
    return {sizeof(Leaf<k>)...};
  }
  void reallocate(std::size_t capacity) {
    // Two cache lines lie between two arrays. Elements of the same index would otherwise compete for the same lines of
    // a cache where the size of an array is a power of two.
    constexpr std::size_t line = 64, between = 2 * line;
    constexpr auto sizes = leaf_sizes(std::make_index_sequence<leaf_count<S>>());
    std::array<std::size_t, leaf_count<S>> offsets{};
    std::size_t bytes = 0;
    for (std::size_t k = 0; k < sizes.size(); ++k) {
      offsets[k] = bytes;
      bytes += (capacity * sizes[k] + line - 1) / line * line + between;
    }
    std::vector<std::byte> memory(bytes);
    for (std::size_t k = 0; k < sizes.size(); ++k)
      std::copy_n(memory_.data() + offsets_[k], size_ * sizes[k], memory.data() + offsets[k]);
    memory_ = std::move(memory), offsets_ = offsets, capacity_ = capacity;
  }

  std::vector<std::byte> memory_;
  std::array<std::size_t, leaf_count<S>> offsets_{};  ///< of the arrays in the memory
  std::size_t size_ = 0, capacity_ = 0;
};

}  // namespace collide
