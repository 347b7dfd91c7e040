#include "corpus/generator/extreme_cases.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "corpus/generator/case_builder.hpp"
#include "corpus/generator/generator.hpp"

namespace nearmiss {

namespace {

constexpr double far_offsets[] = {0, 1, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e10, 1e12, 1e13, 1e14, 1e15};
constexpr double scales[] = {-1060, -1000, -700, -480, -300, -145, -120, -80, -40, -20,
                             0,     20,    40,   80,   120,  300,  480,  700, 1000};
constexpr double speeds[] = {1e-12, 1e-9, 1e-6, 1e-4, 1e-2, 1, 1e2, 1e4, 1e6, 1e9, 1e12};
constexpr double ratios[] = {1, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-10, 1e-12};
constexpr double angles[] = {1, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-10, 1e-12, 1e-14, 1e-16};

bool has(const Query& query, Role role) {
  return std::ranges::find(query.operands.members, role, &InputMember::role) != query.operands.members.end();
}

/// A direction, and another direction or an edge near which it is placed.
bool turns_a_direction(const Query& query) {
  const auto vectors = [&](Role role) { return std::ranges::count(query.operands.members, role, &InputMember::role); };
  return vectors(Role::direction) >= 2 || (vectors(Role::direction) > 0 && vectors(Role::position) >= 3);
}

/// The numbers of a case in double, rounded to the scalar only at the end.
class MovedCase {
 public:
  MovedCase(const Case& c, std::uint64_t seed)
      : fields_(c.fields()), operands_(c.operands()), values(c.values), random_(seed) {}

  void apply(ExtremeAxis axis, double x) {
    switch (axis) {
      case ExtremeAxis::offset: return move(x);
      case ExtremeAxis::scale: return scale(int(x));
      case ExtremeAxis::speed: return hasten(x);
      case ExtremeAxis::ratio: return resize(x);
      case ExtremeAxis::angle: return turn(x);
    }
  }

 private:
  const std::span<const Field> fields_;
  const Operands& operands_;

 public:
  std::vector<double> values;

 private:
  void move(double sizes) {
    std::array<double, 3> shift;
    for (double& s : shift) s = sizes * random_.uniform(0.5, 1) * random_.sign();
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (fields_[i].role == Role::position) values[i] += shift[axis_of(i)];
      if (fields_[i].role != Role::offset) continue;  // the offset of a plane follows its normal
      for (std::size_t k = 0; k < 3; ++k) values[i] -= values[i - 3 + k] * shift[k];
    }
  }
  void scale(int exponent) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      const Role role = fields_[i].role;
      const bool length =
          role == Role::position || role == Role::size || role == Role::velocity || role == Role::offset;
      if (length) values[i] = std::ldexp(values[i], exponent);
    }
  }
  void hasten(double factor) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (fields_[i].role == Role::velocity) values[i] *= factor;
      if (fields_[i].role == Role::time) values[i] /= factor;
    }
  }
  void resize(double factor) {
    if (operands_.sizes.empty()) return;
    for (const std::size_t i : operands_.of_number(operands_.sizes.front())->sizes) values[i] *= factor;
  }
  /// Boxes nearly unrotated; without boxes, the velocity or else a direction nearly along another vector.
  void turn(double angle) {
    if (std::any_of(fields_.begin(), fields_.end(), [](const Field& f) { return f.role == Role::rotation; })) {
      for (std::size_t i = 0; i < values.size(); ++i) {
        if (fields_[i].role != Role::rotation) continue;
        const bool is_w = operands_.member_of(i).begin + 3 == i;
        values[i] = is_w ? 1 : angle * random_.uniform(-0.5, 0.5);
      }
      return;
    }
    const Role turned = has_role(Role::velocity) ? Role::velocity : Role::direction;
    const std::size_t to = first_of(turned);
    const std::array<double, 3> along = some_direction(to);
    const double length = std::hypot(along[0], along[1], along[2]);
    for (std::size_t k = 0; k < 3; ++k) values[to + k] = along[k] + angle * length * random_.uniform(-1, 1);
  }
  /// A direction along another direction of the query, or in the plane of three of its positions.
  std::array<double, 3> some_direction(std::size_t but) {
    std::vector<std::size_t> places;
    for (const InputMember& m : operands_.members) {
      const std::size_t i = m.begin;
      if (m.role == Role::direction && i != but) return across({values[i], values[i + 1], values[i + 2]});
      if (m.role == Role::position) places.push_back(i);
    }
    std::array<double, 3> along{};
    const std::size_t origin = places[places.size() > 2 ? places.size() - 3 : 0];
    for (std::size_t at : places) {
      if (at < origin) continue;
      const double weight = random_.uniform(-1, 1);
      for (std::size_t k = 0; k < 3; ++k) along[k] += weight * (values[at + k] - values[origin + k]);
    }
    return along;
  }
  /// A velocity along a plane is perpendicular to the plane's normal; a direction is parallel to another direction.
  std::array<double, 3> across(const std::array<double, 3>& normal) {
    if (!has_role(Role::velocity)) return normal;
    std::array<double, 3> any;
    for (double& x : any) x = random_.uniform(-1, 1);
    return {normal[1] * any[2] - normal[2] * any[1], normal[2] * any[0] - normal[0] * any[2],
            normal[0] * any[1] - normal[1] * any[0]};
  }
  bool has_role(Role role) const { return first_of(role) < fields_.size(); }
  std::size_t first_of(Role role) const {
    return std::size_t(std::find_if(fields_.begin(), fields_.end(), [&](const Field& f) { return f.role == role; }) -
                       fields_.begin());
  }
  std::size_t axis_of(std::size_t i) const { return std::size_t(fields_[i].name.back() - 'x'); }

  Random random_;
};

/// Lengths that all became zero no longer represent their scale.
bool vanished(const Query& query, std::span<const double> before, std::span<const double> after) {
  bool had = false, has_any = false;
  const std::vector<Field>& fields = query.fields_of(before);
  for (std::size_t i = 0; i < before.size(); ++i) {
    const Role role = fields[i].role;
    if (role != Role::position && role != Role::size) continue;
    had = had || before[i] != 0;
    has_any = has_any || after[i] != 0;
  }
  return had && !has_any;
}

}  // namespace

ExtremeAxisName name_of(ExtremeAxis axis) {
  switch (axis) {
    case ExtremeAxis::offset: return {"offset", "sizes from the origin"};
    case ExtremeAxis::scale: return {"scale", "size, powers of two"};
    case ExtremeAxis::speed: return {"speed", "sizes per unit of time"};
    case ExtremeAxis::ratio: return {"ratio", "of the first size"};
    case ExtremeAxis::angle: return {"angle", "radians from parallel"};
  }
  return {"?", "?"};
}

std::span<const double> values_of(ExtremeAxis axis) {
  switch (axis) {
    case ExtremeAxis::offset: return far_offsets;
    case ExtremeAxis::scale: return scales;
    case ExtremeAxis::speed: return speeds;
    case ExtremeAxis::ratio: return ratios;
    case ExtremeAxis::angle: return angles;
  }
  return {};
}

std::vector<ExtremePlane> planes_of(const Query& query) {
  std::vector<ExtremePlane> planes{{ExtremeAxis::offset, ExtremeAxis::scale}};
  const bool sizes = has(query, Role::size), moves = has(query, Role::velocity);
  if (moves) planes.push_back({ExtremeAxis::speed, sizes ? ExtremeAxis::ratio : ExtremeAxis::offset});
  if (sizes && !moves) planes.push_back({ExtremeAxis::offset, ExtremeAxis::ratio});
  if (moves || has(query, Role::rotation) || turns_a_direction(query)) {
    planes.push_back({ExtremeAxis::offset, ExtremeAxis::angle});
  }
  return planes;
}

std::optional<Case> extreme_case(const Query& query, Scalar scalar, std::uint64_t seed, std::uint64_t index,
                                 const ExtremePlane& plane, double x, double y) {
  Case c = generate(query, scalar, seed, index);
  MovedCase moved(c, Random(seed).bits() ^ index);
  const std::vector<double> before = c.values;
  // The order: shapes, then their places, then the scale of all lengths.
  for (const ExtremeAxis axis :
       {ExtremeAxis::angle, ExtremeAxis::ratio, ExtremeAxis::speed, ExtremeAxis::offset, ExtremeAxis::scale}) {
    if (plane.x == axis) moved.apply(axis, x);
    if (plane.y == axis) moved.apply(axis, y);
  }
  for (std::size_t i = 0; i < c.values.size(); ++i) c.values[i] = rounded_to(scalar, moved.values[i]);
  const bool finite = std::all_of(c.values.begin(), c.values.end(), [](double v) { return std::isfinite(v); });
  if (!finite || vanished(query, before, c.values) || query.broken(c.values)) return std::nullopt;
  c.origin = "sweep";
  return c;
}

}  // namespace nearmiss
