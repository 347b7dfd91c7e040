#include "corpus/scenes/measured_shape.hpp"

#include <algorithm>
#include <cmath>

namespace nearmiss::scenes {

namespace {

struct Points {
  std::vector<Vector> at;
  Vector center{};
};
Points points_at(const Case& c, const Operand& place) {
  Points p;
  for (const std::size_t at : place.positions) {
    p.at.push_back(vector_at(c, at));
    p.center = plus(p.center, p.at.back(), 1 / double(place.positions.size()));
  }
  return p;
}

double half_way(const Vector& a, const Vector& b) { return length_of(plus(a, b, -1)) / 2; }

/// The factor that brings a size into the range; 1 for a size of 0, which has no direction to grow in.
double factor_into(double size, double least, double most) {
  return size > 0 ? std::clamp(size, least, most) / size : 1;
}

void put_around(Case& c, const Operand& place, const Points& p, const std::vector<Vector>& from_center) {
  for (std::size_t i = 0; i < p.at.size(); ++i) put_vector(c, place.positions[i], plus(p.center, from_center[i]));
}

/// Corners in order: the sides of a rectangle are those from its first corner.
std::vector<Vector> resized_rectangle(const Points& p, double least, double most) {
  const Vector u = scaled(plus(p.at[1], p.at[0], -1), 0.5), v = scaled(plus(p.at[3], p.at[0], -1), 0.5);
  const double a = factor_into(length_of(u), least, most), b = factor_into(length_of(v), least, most);
  std::vector<Vector> corners;
  for (const auto& [i, j] : {std::pair(-1, -1), std::pair(1, -1), std::pair(1, 1), std::pair(-1, 1)})
    corners.push_back(plus(scaled(u, a * i), v, b * j));
  return corners;
}

std::vector<Vector> resized_aabox(const Points& p, double least, double most) {
  Vector half{};
  for (std::size_t k = 0; k < 3; ++k) half[k] = std::clamp((p.at[1][k] - p.at[0][k]) / 2, least, most);
  return {scaled(half, -1), half};
}

}  // namespace

Vector vector_at(const Case& c, std::size_t begin) {
  return {c.values[begin], c.values[begin + 1], c.values[begin + 2]};
}

void put_vector(Case& c, std::size_t begin, const Vector& v) {
  for (std::size_t k = 0; k < 3; ++k) c.values[begin + k] = rounded_to(c.scalar, v[k]);
}

double height_above(const Case& c, const Operand& plane, const Vector& point) {
  return dot(vector_at(c, plane.begin), point) + c.values[plane.begin + 3];
}

MeasuredShape measured_shape(const Case& c, const Operand& place) {
  MeasuredShape m;
  const Points p = points_at(c, place);
  m.center = p.center;
  for (const std::size_t i : place.sizes) m.stated.push_back(c.values[i]);
  switch (place.shape) {
    case Shape::capsule:
    case Shape::segment: m.derived = {half_way(p.at[0], p.at[1])}; break;
    case Shape::rectangle: m.derived = {half_way(p.at[0], p.at[1]), half_way(p.at[0], p.at[3])}; break;
    case Shape::triangle:
      m.derived = {std::max({half_way(p.at[0], p.at[1]), half_way(p.at[1], p.at[2]), half_way(p.at[2], p.at[0])})};
      break;
    case Shape::aabox:
      for (std::size_t k = 0; k < 3; ++k) m.derived.push_back((p.at[1][k] - p.at[0][k]) / 2);
      break;
    default: break;
  }
  return m;
}

void resize_shape(Case& c, const Operand& place, double least, double most) {
  const MeasuredShape m = measured_shape(c, place);
  const Points p = points_at(c, place);
  for (const std::size_t i : place.sizes) c.values[i] = rounded_to(c.scalar, std::clamp(c.values[i], least, most));
  const auto is_outside = [&](double size) { return !(least <= size && size <= most); };
  if (std::none_of(m.derived.begin(), m.derived.end(), is_outside)) return;
  if (place.shape == Shape::rectangle) return put_around(c, place, p, resized_rectangle(p, least, most));
  if (place.shape == Shape::aabox) return put_around(c, place, p, resized_aabox(p, least, most));
  std::vector<Vector> from_center;
  if (p.at.size() == 2 && m.derived[0] == 0) return put_around(c, place, p, {{-least, 0, 0}, {least, 0, 0}});
  for (const Vector& at : p.at)
    from_center.push_back(scaled(plus(at, p.center, -1), factor_into(m.derived[0], least, most)));
  put_around(c, place, p, from_center);
}

void move_shape(Case& c, const Operand& place, const Vector& by) {
  for (const std::size_t at : place.positions) put_vector(c, at, plus(vector_at(c, at), by));
}

}  // namespace nearmiss::scenes
