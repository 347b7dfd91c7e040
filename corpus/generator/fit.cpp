#include "corpus/generator/fit.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <vector>

#include "corpus/generator/case_builder.hpp"
#include "corpus/generator/generator.hpp"
#include "oracles/requirements.hpp"

namespace nearmiss {

namespace {

using Vector = std::array<double, 3>;

Vector operator+(const Vector& a, const Vector& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Vector operator-(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vector operator*(const Vector& a, double s) { return {a[0] * s, a[1] * s, a[2] * s}; }
double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double largest(const Vector& a) { return std::max({std::abs(a[0]), std::abs(a[1]), std::abs(a[2])}); }

/// A number that depends on the case alone.
std::uint64_t hash_of(const Case& c) {
  std::uint64_t h = c.values.size();
  for (const double x : c.values) h = Random(h ^ std::bit_cast<std::uint64_t>(x)).bits();
  return h;
}

bool finite(const Case& c) {
  return std::all_of(c.values.begin(), c.values.end(), [](double x) { return std::isfinite(x); });
}

class Fitting {
 public:
  explicit Fitting(Case& c) : c_(c), parts_(c.operands()), random_(hash_of(c)) {}

  void rectangles() {
    for (const auto& r : parts_.rectangles) {
      if (random_.one_in(2)) right_angle(r);
      if (!meets(c_, Precondition::true_rectangle)) on_a_grid(r);
    }
  }
  void no_zero_sizes() {
    const double usual = usual_size();
    for (const std::size_t i : parts_.sizes) {
      if (c_.values[i] == 0) set(i, usual);
    }
    for (const std::size_t i : parts_.aaboxes) {
      for (std::size_t k = i; k < i + 3; ++k) {
        if (c_.values[k] == c_.values[k + 3]) grow(k + 3, usual, 1);
      }
    }
    for (const auto& s : parts_.segments) {
      if (get(s[0]) == get(s[1])) grow(s[1] + random_.below(3), usual, 1);
    }
    for (const auto& t : parts_.triangles) spread(t, usual);
  }
  void unit(const std::vector<std::size_t>& begins, std::size_t count) {
    for (const std::size_t begin : begins) {
      const long double length = length_of(begin, count);
      for (std::size_t i = begin; i < begin + count; ++i) set(i, double(c_.values[i] / length));
      const std::size_t offset = begin + count;  // of a plane, which keeps its place
      const bool plane = offset < c_.values.size() && c_.role(offset) == Role::offset;
      if (plane) set(offset, double(c_.values[offset] / length));
    }
  }
  void moves() {
    for (const std::size_t v : parts_.velocities) {
      if (get(v) != Vector{0, 0, 0}) continue;
      const Vector towards = parts_.start && parts_.start->obstacle.shape != Shape::plane
                                 ? get(parts_.start->obstacle.begin) - get(parts_.start->place)
                                 : Vector{};
      set(v, towards);
      if (get(v) == Vector{0, 0, 0}) set(v + random_.below(3), random_.sign());
    }
  }
  /// Moves the start back along the motion in growing steps; then outward along an axis, if the motion leads out.
  void start_outside() {
    if (!parts_.start) return;
    const Vector from = get(parts_.start->place);
    if (!parts_.velocities.empty() && leave(from, get(parts_.velocities.front()) * -1.0)) return;
    if (!parts_.directions.empty() && leave(from, get(parts_.directions.front()) * -1.0)) return;
    if (!parts_.normals.empty() && leave(from, get(parts_.normals.front()))) return;
    Vector axis{};
    axis[random_.below(3)] = random_.sign();
    if (!leave(from, axis)) set(parts_.start->place, from);
  }

  const Operands& parts() const { return parts_; }

 private:
  Vector get(std::size_t i) const { return {c_.values[i], c_.values[i + 1], c_.values[i + 2]}; }
  void set(std::size_t i, double x) { c_.values[i] = rounded_to(c_.scalar, x); }
  void set(std::size_t i, const Vector& v) {
    for (std::size_t k = 0; k < 3; ++k) set(i + k, v[k]);
  }
  long double length_of(std::size_t begin, std::size_t count) const {
    long double square = 0;
    for (std::size_t i = begin; i < begin + count; ++i) square += (long double)(c_.values[i]) * c_.values[i];
    return std::sqrt(square);
  }
  double largest_of(Role role) const {
    double most = 0;
    for (std::size_t i = 0; i < c_.values.size(); ++i) {
      if (c_.role(i) == role) most = std::max(most, std::abs(c_.values[i]));
    }
    return most;
  }
  /// Another size of the case; without one, a quarter of its largest coordinate.
  double usual_size() const {
    const double size = largest_of(Role::size), reach = largest_of(Role::position);
    return size > 0 ? size : reach / 4 > 0 ? reach / 4 : 1;
  }
  /// Adds to the number, and adds more if rounding loses the addition.
  void grow(std::size_t i, double by, double sign) {
    const double from = c_.values[i];
    for (constexpr double twice = 2; c_.values[i] == from && std::isfinite(by); by *= twice) set(i, from + sign * by);
  }
  void spread(const std::array<std::size_t, 3>& corners, double by) {
    const std::size_t first = random_.below(3);
    const Case before = c_;
    const auto flat = [&] { return !meets(c_, Precondition::no_zero_sizes); };
    for (std::size_t k = 0; k < 9 && flat(); ++k) {
      c_.values = before.values;
      grow(corners[2] + (first + k) % 3, by, 1);
      if (k >= 3) grow(corners[1] + (first + k + 1) % 3, by, 1);
    }
  }

  /// v1 stays, v2 turns to a right angle as far as rounding allows, v3 completes the parallelogram.
  void right_angle(const Operands::Corners& r) {
    const Vector e = get(r[1]) - get(r[0]), g = get(r[2]) - get(r[1]);
    if (!(dot(e, e) > 0)) return;
    set(r[2], get(r[1]) + (g - e * (dot(g, e) / dot(e, e))));
    set(r[3], get(r[0]) + (get(r[2]) - get(r[1])));
  }
  /// Exact corners: integer multiples of an orthogonal frame of small integers, on a grid.
  void on_a_grid(const Operands::Corners& r) {
    static constexpr std::array<std::array<Vector, 2>, 6> frames = {{{{{1, 0, 0}, {0, 1, 0}}},
                                                                     {{{0, 0, 1}, {1, 0, 0}}},
                                                                     {{{0, 1, 0}, {0, 0, 1}}},
                                                                     {{{3, 4, 0}, {-4, 3, 0}}},
                                                                     {{{1, 2, 2}, {2, 1, -2}}},
                                                                     {{{2, -2, 1}, {1, 2, 2}}}}};
    constexpr int steps = 8;  // bits of a coordinate: products with 4 and sums stay exact in float
    double reach = 0;
    for (const std::size_t i : r) reach = std::max(reach, largest(get(i)));
    const double step = std::ldexp(1.0, std::max(std::ilogb(reach > 0 ? reach : 1.0) - steps, least_step()));
    const auto whole = [&](double x) { return std::nearbyint(x / step) * step; };
    const auto& [u, v] = frames[random_.below(frames.size())];
    const Vector e = get(r[1]) - get(r[0]), f = get(r[3]) - get(r[0]);
    const auto multiple = [&](const Vector& of, const Vector& along) {
      const double m = std::nearbyint(dot(of, along) / dot(along, along) / step) * step;
      return along * (m != 0 ? m : std::max(1.0, std::nearbyint(largest(of) / step / 4)) * step);
    };
    const Vector corner{whole(c_.values[r[0]]), whole(c_.values[r[0] + 1]), whole(c_.values[r[0] + 2])};
    const Vector first = multiple(e, u), second = multiple(f, v);
    set(r[0], corner);
    set(r[1], corner + first);
    set(r[2], corner + first + second);
    set(r[3], corner + second);
  }
  int least_step() const { return c_.scalar == Scalar::float32 ? -149 : -1074; }

  bool leave(const Vector& from, const Vector& along) {
    const double fastest = largest(along), reach = usual_size();
    if (!(fastest > 0)) return false;
    constexpr int doublings = 12;
    double by = reach / 4 / fastest;
    for (int i = 0; i < doublings; ++i, by *= 2) {
      set(parts_.start->place, from + along * by);
      if (!finite(c_)) return false;
      if (meets(c_, Precondition::starts_outside)) return true;
    }
    return false;
  }

  Case& c_;
  const Operands& parts_;
  Random random_;
};

/// The order matters: sizes depend on corners, starts depend on all other changes.
void change(Case& c, Preconditions unmet, Preconditions required) {
  Fitting f(c);
  if (unmet.has(Precondition::true_rectangle)) f.rectangles();
  if (unmet.has(Precondition::no_zero_sizes)) f.no_zero_sizes();
  if (unmet.has(Precondition::unit_normal)) f.unit(f.parts().normals, 3);
  if (unmet.has(Precondition::unit_direction)) f.unit(f.parts().directions, 3);
  if (unmet.has(Precondition::unit_quaternion)) f.unit(f.parts().quaternions, 4);
  if (unmet.has(Precondition::moves)) f.moves();
  if (!required.has(Precondition::starts_outside) || !finite(c)) return;  // the exact oracle takes finite numbers only
  if (!meets(c, Precondition::starts_outside)) f.start_outside();
}

}  // namespace

bool fit(Case& c, Preconditions required) {
  const Preconditions unmet = unmet_by(c, required);
  if (unmet.empty()) return true;
  const std::vector<double> before = c.values;
  change(c, unmet, required);
  const bool inside = finite(c) && !c.query->broken(c.values) && unmet_by(c, required).empty();
  if (!inside) {
    c.values = before;
    return false;
  }
  c.origin += ", fitted";
  return true;
}

void generate_inside(Case& into, const Query& query, Scalar scalar, std::uint64_t seed, std::uint64_t index,
                     Preconditions required) {
  generate(into, query, scalar, seed, index);
  fit(into, required);
}

}  // namespace nearmiss
