/// A case as typed shapes, for texts about it.
#pragma once

#include <collide/shapes.hpp>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "impl/catalogue/case.hpp"

namespace nearmiss {

using TypedShape =
    std::variant<collide::Sphere<double>, collide::Box<double>, collide::Capsule<double>, collide::Plane<double>,
                 collide::Triangle<double>, collide::AABox<double>, collide::Rectangle<double>,
                 collide::Segment<double>, collide::Line<double>, collide::Ray<double>, collide::HalfSpace<double>>;

/// An input of the query that is a shape.
struct NamedShape {
  std::string name;  ///< "box", "sphere1"
  TypedShape shape;
};

/// Finds the inputs of a case by name. Refers to the case.
class CaseShapes {
 public:
  explicit CaseShapes(const Case& question) : question_(question) {}

  bool has(std::string_view name) const;
  /// The input must be there: "limit", "box.center.x".
  double number(std::string_view name) const;
  bool flag(std::string_view name) const { return number(name) != 0; }
  collide::Vec3<double> vector(const std::string& name) const;
  /// Every operand but points, in the order of the inputs.
  std::vector<NamedShape> operands() const;

 private:
  const Case& question_;
};

}  // namespace nearmiss
