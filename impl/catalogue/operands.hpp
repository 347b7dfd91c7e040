/// The inputs of a query by their meaning: its operands, each a shape, and the members of all inputs.
///
/// All of it follows from the types of the inputs. Code that asks what an input *is* reads it here and never guesses it
/// from the names of numbers.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <collide/shapes.hpp>

#include "impl/catalogue/shape.hpp"

namespace nearmiss {

/// A shape among the inputs of a query. Indices of numbers are those of the case.
struct Operand {
  std::string name;   ///< "sphere", "box2", "fixed"
  std::string words;  ///< for people: "the sphere", "box 2", "the fixed sphere"
  Shape shape;
  std::size_t begin = 0, count = 0;  ///< its numbers
  std::vector<ShapeMember> members{};
  std::optional<std::size_t> velocity{};   ///< the first number of its velocity
  std::vector<std::size_t> positions{};    ///< the first number of each
  std::vector<std::size_t> sizes{};        ///< one entry per number
  std::optional<std::size_t> radius{};     ///< a size of one number
  std::optional<std::size_t> half{};       ///< half extents: a size of three numbers
  std::optional<std::size_t> rotation{};   ///< a quaternion
  std::optional<std::size_t> direction{};  ///< of a line, a ray, a plane
  std::optional<std::size_t> offset{};     ///< of a plane

  const ShapeTraits& traits() const { return traits_of(shape); }
  bool has(std::size_t number) const { return number >= begin && number < begin + count; }
  /// The first number of that member; empty where the shape has none: "center", "half".
  std::optional<std::size_t> member(std::string_view name) const;
};

/// A vector, a number or a quaternion among the inputs of a query.
struct InputMember {
  std::string name;  ///< "sphere.center", "velocity"
  std::size_t begin, count;
  Role role;
  std::optional<std::size_t> operand;  ///< its index; empty for a velocity and a parameter

  bool is_vector() const { return count == 3; }
};

/// The operands of a query, in order, and its inputs listed by kind. An entry of a list is the index of a first number
/// unless it says otherwise.
struct Operands {
  using Corners = std::array<std::size_t, 4>;
  /// A moving ball, a moving point or a ray, and its obstacle.
  struct Start {
    std::size_t place = 0;              ///< the mover's first number: a center, a point or a ray's origin
    std::optional<std::size_t> radius;  ///< of the mover
    Operand obstacle;
  };

  std::vector<Operand> all;
  std::vector<InputMember> members;  ///< of all inputs, in order

  std::vector<Corners> rectangles;
  std::vector<std::array<std::size_t, 3>> triangles;  ///< including those of rectangles
  std::vector<std::array<std::size_t, 2>> segments;   ///< including the axes of capsules
  std::vector<std::size_t> normals, directions, quaternions, velocities;
  std::vector<std::size_t> sizes;    ///< one entry per number
  std::vector<std::size_t> aaboxes;  ///< the lower corner; the upper corner follows it
  std::optional<Start> start;

  auto begin() const { return all.begin(); }
  auto end() const { return all.end(); }
  std::size_t size() const { return all.size(); }
  const Operand& operator[](std::size_t index) const { return all[index]; }

  /// nullptr where no operand has that name.
  const Operand* find(std::string_view name) const;
  /// The operand that has the number; nullptr for a number of a velocity or a parameter.
  const Operand* of_number(std::size_t number) const;
  /// The first member with that role; nullptr where there is none.
  const InputMember* at(Role role) const;
  /// The member that has the number.
  const InputMember& member_of(std::size_t number) const;
  /// The first operand with that shape; nullptr where there is none.
  const Operand* find(Shape shape) const;
};

/// The shape of a type of `collide`; empty for a type that is no shape. A vector is a point only where it is a
/// position.
template <class S>
inline constexpr std::optional<Shape> shape_of{};
#define NEARMISS_SHAPE(name, type, words, edges, faces) \
  template <class T>                                    \
  inline constexpr std::optional<Shape> shape_of<collide::type<T>> = Shape::name;
#include "impl/catalogue/shapes.def"
#undef NEARMISS_SHAPE

/// An input as its struct lists it.
struct ListedInput {
  std::string_view name;
  std::optional<Shape> shape;
  Role role;
  std::size_t count;                   ///< of numbers
  std::vector<ShapeMember> members{};  ///< of a shape; empty: those of its traits
};
Operands operands_of(const std::vector<ListedInput>& inputs);

/// Of inputs whose lists have the counts of these.
template <class Inputs>
Operands operands_of(Inputs inputs) {
  std::vector<ListedInput> listed;
  collide::for_each_member(inputs, [&]<class Value>(std::string_view name, Value& value, Role role) {
    static_assert(!collide::is_counted<Value>, "a list is a member of a shape");
    std::size_t count = 0;
    collide::for_each_leaf(value, [&](auto&, Role) { ++count; });
    const auto shape = shape_of<Value>;
    if (!shape || (shape == Shape::point && role != Role::position)) {
      listed.push_back({name, std::nullopt, role, count});
    } else if constexpr (shape_of<Value>.has_value()) {
      listed.push_back({name, shape, role, count, members_of(value)});
    }
  });
  return operands_of(listed);
}

/// Calls f with the operand as the struct of `collide`, from the numbers of its case; a point as a Vec3.
template <class F>
decltype(auto) with_typed(const Operand& operand, const double* values, F&& f) {
  const auto filled = [&](auto shape) -> decltype(auto) {
    const double* numbers = values + operand.begin;
    collide::for_each_leaf(shape, [&]<class Leaf>(Leaf& leaf, Role) { leaf = Leaf(*numbers++); });
    return f(shape);
  };
  switch (operand.shape) {
#define NEARMISS_SHAPE(name, type, words, edges, faces) \
  case Shape::name: return filled(collide::type<double>{});
#include "impl/catalogue/shapes.def"
#undef NEARMISS_SHAPE
  }
  throw std::logic_error("no shape");
}

}  // namespace nearmiss
