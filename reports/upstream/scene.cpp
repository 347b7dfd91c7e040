#include "reports/upstream/scene.hpp"

#include <algorithm>
#include <stdexcept>

namespace nearmiss {

namespace {

using collide::Vec3;

/// The place of the input in the query; the number of inputs where it has none of that name.
std::size_t place_of(const Query& query, std::string_view name) {
  const auto at =
      std::find_if(query.inputs.begin(), query.inputs.end(), [&](const Field& f) { return f.name == name; });
  return std::size_t(at - query.inputs.begin());
}

/// Sets the leaves of a shape from numbers in their order.
template <class S>
S filled(const double* numbers) {
  S shape;
  collide::for_each_leaf(shape, [&](auto& leaf, collide::Role) { leaf = *numbers++; });
  return shape;
}

}  // namespace

bool Scene::has(std::string_view name) const {
  return place_of(*question_.query, name) < question_.query->inputs.size();
}

double Scene::number(std::string_view name) const {
  if (!has(name)) throw std::logic_error("no input " + std::string(name));
  return question_.values[place_of(*question_.query, name)];
}

Vec3<double> Scene::vector(const std::string& name) const {
  return {number(name + ".x"), number(name + ".y"), number(name + ".z")};
}

std::vector<NamedShape> Scene::operands() const {
  std::vector<NamedShape> all;
  for (const Field& f : question_.query->inputs) {
    const std::string name = f.name.substr(0, f.name.find('.'));
    // A lone vector has three leaves of one level: "point.x". A shape has a leaf with another name, or deeper ones.
    const bool lone = f.name == name || f.name == name + ".x" || f.name == name + ".y" || f.name == name + ".z";
    if (lone || (!all.empty() && all.back().name == name)) continue;
    all.push_back({name, shape(name)});
  }
  return all;
}

Shape Scene::shape(const std::string& name) const {
  const Query& query = *question_.query;
  const auto first = std::find_if(query.inputs.begin(), query.inputs.end(),
                                  [&](const Field& f) { return f.name.starts_with(name + "."); });
  const double* numbers = question_.values.data() + (first - query.inputs.begin());
  if (has(name + ".half.x")) return filled<collide::Box<double>>(numbers);
  if (has(name + ".min.x")) return filled<collide::AABox<double>>(numbers);
  if (has(name + ".v3.x")) return filled<collide::Rectangle<double>>(numbers);
  if (has(name + ".v2.x")) return filled<collide::Triangle<double>>(numbers);
  if (has(name + ".v1.x")) return filled<collide::Segment<double>>(numbers);
  if (has(name + ".p1.x")) return filled<collide::Capsule<double>>(numbers);
  if (has(name + ".normal.x")) return filled<collide::Plane<double>>(numbers);
  if (has(name + ".origin.x")) return filled<collide::Ray<double>>(numbers);
  if (has(name + ".direction.x")) return filled<collide::Line<double>>(numbers);
  return filled<collide::Sphere<double>>(numbers);
}

}  // namespace nearmiss
