/// Validation of shapes: `checked(shape)` throws where a shape breaks a rule. The queries themselves check nothing.
#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include <collide/detail/number.hpp>
#include <collide/detail/refuse_argument.hpp>
#include <collide/shapes.hpp>

namespace collide {

/// The path of a field within a shape: "box", "half", "y".
class FieldPath {
 public:
  constexpr FieldPath() = default;
  constexpr explicit FieldPath(std::string_view name) noexcept { *this = below(name); }

  static constexpr std::size_t deepest = 8;

  /// The path extended by one name; an empty name changes nothing. A path holds at most `deepest` names.
  constexpr FieldPath below(std::string_view name) const noexcept {
    FieldPath longer = *this;
    if (!name.empty()) longer.names_[longer.size_++] = name;
    return longer;
  }
  /// "box.half.y"
  std::string text() const {
    std::string text;
    for (std::size_t i = 0; i < size_; ++i) (text += i > 0 ? "." : "") += names_[i];
    return text;
  }

 private:
  std::array<std::string_view, deepest> names_{};
  std::size_t size_ = 0;
};

/// A field whose value breaks a rule.
struct BrokenRule {
  FieldPath field;
  double value;           ///< the value of the field
  std::string_view rule;  ///< what the value must be

  /// "sphere.radius is -1: it must be not negative"
  std::string text() const {
    std::array<char, 32> digits{};  // the shortest text of a double has at most 24
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
    return field.text() + " is " + std::string(digits.data(), end) + ": it must be " + std::string(rule);
  }
};

namespace detail {

template <class S>
constexpr std::string_view name_of_shape = "";
template <class T>
constexpr std::string_view name_of_shape<Vec3<T>> = "vector";
template <class T>
constexpr std::string_view name_of_shape<Segment<T>> = "segment";
template <class T>
constexpr std::string_view name_of_shape<Line<T>> = "line";
template <class T>
constexpr std::string_view name_of_shape<Ray<T>> = "ray";
template <class T>
constexpr std::string_view name_of_shape<Plane<T>> = "plane";
template <class T>
constexpr std::string_view name_of_shape<HalfSpace<T>> = "halfspace";
template <class T>
constexpr std::string_view name_of_shape<Triangle<T>> = "triangle";
template <class T>
constexpr std::string_view name_of_shape<Rectangle<T>> = "rectangle";
template <class T>
constexpr std::string_view name_of_shape<Sphere<T>> = "sphere";
template <class T>
constexpr std::string_view name_of_shape<Capsule<T>> = "capsule";
template <class T>
constexpr std::string_view name_of_shape<AABox<T>> = "aabox";
template <class T>
constexpr std::string_view name_of_shape<Quaternion<T>> = "quaternion";
template <class T>
constexpr std::string_view name_of_shape<Box<T>> = "box";

template <class T>
constexpr bool is_vector = false;
template <class T>
constexpr bool is_vector<Vec3<T>> = true;

template <MachineNumber T>
constexpr bool finite(T x) noexcept {
  return x >= std::numeric_limits<T>::lowest() && x <= std::numeric_limits<T>::max();
}

/// "0" to "99".
class IndexNames {
 public:
  static constexpr std::size_t most = 100;

  constexpr IndexNames() noexcept {
    for (std::size_t i = 0; i < most; ++i) digits_[i] = {char('0' + i / 10), char('0' + i % 10)};
  }
  constexpr std::string_view operator[](std::size_t i) const noexcept {
    return i < 10 ? std::string_view(&digits_[i][1], 1) : std::string_view(digits_[i].data(), 2);
  }

 private:
  std::array<std::array<char, 2>, most> digits_{};
};
inline constexpr IndexNames index_names;

/// The number of names in the longest path within S.
template <class S>
constexpr std::size_t depth() noexcept {
  if constexpr (Listed<S>) {
    std::size_t deepest = 0;
    S s{};
    for_each_member(s, [&](std::string_view, const auto& value, Role) {
      deepest = std::max(deepest, depth<std::remove_cvref_t<decltype(value)>>());
    });
    return deepest + 1;
  } else if constexpr (requires { typename S::value_type; }) {
    return 1 + depth<typename S::value_type>();
  } else {
    return 0;
  }
}

/// Checks a field against the rule of its role, or against its shape's own rule; its members are checked before.
template <class S>
constexpr std::optional<BrokenRule> broken_own_rule(const S& s, const FieldPath& path, Role role) noexcept {
  if constexpr (MachineNumber<S>) {
    if (!finite(s)) return BrokenRule{path, double(s), "finite"};
    if (role == Role::size && s < S(0)) return BrokenRule{path, double(s), "not negative"};
  } else if constexpr (is_vector<S>) {
    if (role == Role::direction && s == S{}) return BrokenRule{path, 0.0, "not all of x, y, z zero"};
  } else if constexpr (requires { s.broken(); }) {
    if (const auto b = s.broken()) return BrokenRule{path.below(b->member), b->value, b->rule};
  }
  return std::nullopt;
}

template <class S>
constexpr std::optional<BrokenRule> broken_within(const S& s, const FieldPath& path, Role role) noexcept {
  std::optional<BrokenRule> found;
  if constexpr (Listed<S>) {
    for_each_member(s, [&](std::string_view name, const auto& value, Role own) {
      if (!found) found = broken_within(value, path.below(name), own == Role::inherited ? role : own);
    });
  } else if constexpr (requires { s.begin(); }) {
    if constexpr (is_counted<S>) {
      if (s.count < S::least || s.count > S::most) {
        return BrokenRule{path.below("count"), double(s.count), "a number of entries that the list can have"};
      }
    } else {
      static_assert(std::tuple_size_v<S> <= IndexNames::most);
    }
    for (std::size_t i = 0; i < s.size() && !found; ++i) found = broken_within(s[i], path.below(index_names[i]), role);
  }
  return found ? found : broken_own_rule(s, path, role);
}

}  // namespace detail

/// The first rule that a shape, or a struct of inputs, breaks; nullopt if there is none. The rules: every number is
/// finite, sizes are not negative, directions and quaternions are not zero, min <= max in an axis-aligned box, and a
/// count is within the bounds of its list.
/// Members are checked before the shape that contains them.
///
/// `name` is the first part of the field's path.
template <Listed S>
constexpr std::optional<BrokenRule> broken_rule(const S& s, std::string_view name = detail::name_of_shape<S>) noexcept {
  static_assert(1 + detail::depth<S>() + 1 <= FieldPath::deepest,
                "name, path, and the member that a shape's rule names");
  return detail::broken_within(s, FieldPath(name), Role::inherited);
}

/// Returns the shape itself. Throws std::invalid_argument if a rule is broken; the message is one line with the field,
/// its value and the rule. With -fno-exceptions this line goes to standard error and the program aborts. In a constant
/// expression a broken rule does not compile.
///
/// The queries check nothing: build the structs directly where the numbers are known to be valid.
template <Listed S>
constexpr S checked(const S& s, std::string_view name = detail::name_of_shape<S>) {
  if (const auto broken = broken_rule(s, name)) detail::refuse_argument(broken->text());
  return s;
}
/// Returns the vector; throws std::invalid_argument, or aborts, as checked() does, if it is zero or not finite:
/// checked_direction(v, "velocity").
template <MachineNumber T>
constexpr Vec3<T> checked_direction(const Vec3<T>& v, std::string_view name = "direction") {
  if (const auto broken = detail::broken_within(v, FieldPath(name), Role::direction)) {
    detail::refuse_argument(broken->text());
  }
  return v;
}

}  // namespace collide
