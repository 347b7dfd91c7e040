#include "reports/upstream/case_shapes.hpp"

#include <algorithm>
#include <stdexcept>

namespace nearmiss {

namespace {

using collide::Vec3;

/// The place of the input in the case; the number of inputs where it has none of that name.
std::size_t place_of(const Case& c, std::string_view name) {
  return std::size_t(std::ranges::find(c.fields(), name, &Field::name) - c.fields().begin());
}

}  // namespace

bool CaseShapes::has(std::string_view name) const { return place_of(question_, name) < question_.fields().size(); }

double CaseShapes::number(std::string_view name) const {
  if (!has(name)) throw std::logic_error("no input " + std::string(name));
  return question_.values[place_of(question_, name)];
}

Vec3<double> CaseShapes::vector(const std::string& name) const {
  return {number(name + ".x"), number(name + ".y"), number(name + ".z")};
}

std::vector<NamedShape> CaseShapes::operands() const {
  std::vector<NamedShape> all;
  for (const Operand& o : question_.operands()) {
    with_typed(o, question_.values.data(), [&]<class S>(const S& shape) {
      if constexpr (!std::is_same_v<S, Vec3<double>>) all.push_back({o.name, shape});
    });
  }
  return all;
}

}  // namespace nearmiss
