#include "reports/picture/picture_shapes.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <nlohmann/json.hpp>

namespace nearmiss {

double rounded(const PictureReal& x) {
  constexpr double most = std::numeric_limits<double>::max();
  return std::clamp(x.convert_to<double>(), -most, most);
}

PictureReal dot(const PictureVector& a, const PictureVector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
PictureVector cross(const PictureVector& a, const PictureVector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
PictureReal length(const PictureVector& a) { return sqrt(dot(a, a)); }
PictureVector unit(const PictureVector& a) {
  const PictureReal l = length(a);
  return l == 0 ? a : a * (1 / l);
}

namespace {

using Json = nlohmann::ordered_json;

// --- reading -------------------------------------------------------------------------------------------------------

using Values = std::span<const double>;

PictureVector vector_at(Values v, std::size_t i) { return {v[i], v[i + 1], v[i + 2]}; }

/// The axes of the rotation x, y, z, w, which need not have unit length.
std::vector<PictureVector> axes_of(Values q) {
  const PictureReal x = q[0], y = q[1], z = q[2], w = q[3], s = 2 / (x * x + y * y + z * z + w * w);
  return {{1 - s * (y * y + z * z), s * (x * y + w * z), s * (x * z - w * y)},
          {s * (x * y - w * z), 1 - s * (x * x + z * z), s * (y * z + w * x)},
          {s * (x * z + w * y), s * (y * z - w * x), 1 - s * (x * x + y * y)}};
}

PictureShape drawn(const Operand& o, Values values) {
  PictureShape s{.name = o.name, .shape = o.shape};
  for (const std::size_t at : o.positions) s.corners.push_back(vector_at(values, at));
  if (o.direction) s.axis = vector_at(values, *o.direction);
  if (o.offset) s.offset = values[*o.offset];
  if (o.radius) s.radius = values[*o.radius];
  if (o.shape == Shape::box) {
    const PictureVector half = vector_at(values, *o.half);
    s.axes = axes_of(values.subspan(*o.rotation, 4));
    s.half = {half.x, half.y, half.z};
  } else if (o.shape == Shape::aabox) {
    const PictureVector low = s.corners[0], half = (s.corners[1] - low) * PictureReal(0.5);
    s.corners = {low + half};
    s.axes = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    s.half = {half.x, half.y, half.z};
  }
  return s;
}

/// An input that is no shape: a direction is an arrow.
void add_loose(PictureInputs& inputs, const InputMember& m, Values values) {
  if (m.role == Role::time) inputs.time = values[m.begin];
  if (!m.is_vector()) return;
  if (m.role == Role::direction)
    inputs.shapes.push_back({.name = m.name, .shape = std::nullopt, .axis = vector_at(values, m.begin)});
  if (m.role != Role::velocity) return;
  inputs.velocity = vector_at(values, m.begin);
  if (!inputs.shapes.empty()) inputs.shapes.back().moves = true;
}

// --- nearest points ------------------------------------------------------------------------------------------------

PictureReal within(const PictureReal& x, const PictureReal& low, const PictureReal& high) {
  return x < low ? low : x > high ? high : x;
}

PictureVector nearest_on_carrier(const PictureVector& p, const PictureVector& from, const PictureVector& along,
                                 std::optional<double> low, std::optional<double> high) {
  const PictureReal square = dot(along, along);
  if (square == 0) return from;
  PictureReal t = dot(p - from, along) / square;
  if (low && t < *low) t = *low;
  if (high && t > *high) t = *high;
  return from + along * t;
}

PictureVector nearest_on_segment(const PictureVector& p, const PictureVector& a, const PictureVector& b) {
  return nearest_on_carrier(p, a, b - a, 0, 1);
}

const PictureVector& nearer(const PictureVector& p, const PictureVector& a, const PictureVector& b) {
  return dot(a - p, a - p) <= dot(b - p, b - p) ? a : b;
}

PictureVector nearest_on_triangle(const PictureVector& p, const PictureVector& a, const PictureVector& b,
                                  const PictureVector& c) {
  const PictureVector normal = cross(b - a, c - a);
  const PictureReal square = dot(normal, normal);
  if (square > 0) {
    const PictureVector foot = p - normal * (dot(p - a, normal) / square);
    const bool inside = dot(cross(b - a, foot - a), normal) >= 0 && dot(cross(c - b, foot - b), normal) >= 0 &&
                        dot(cross(a - c, foot - c), normal) >= 0;
    if (inside) return foot;
  }
  return nearer(p, nearest_on_segment(p, a, b), nearer(p, nearest_on_segment(p, b, c), nearest_on_segment(p, c, a)));
}

PictureVector nearest_in_ball(const PictureVector& p, const PictureVector& center, const PictureReal& radius) {
  const PictureReal distance = length(p - center);
  return distance <= radius ? p : center + (p - center) * (radius / distance);
}

PictureVector nearest_in_box(const PictureVector& p, const PictureShape& box) {
  PictureVector q = box.corners[0];
  for (std::size_t k = 0; k < 3; ++k)
    q = q + box.axes[k] * within(dot(p - box.corners[0], box.axes[k]), -box.half[k], box.half[k]);
  return q;
}

// --- writing -------------------------------------------------------------------------------------------------------

/// The line that carries a shape: its point nearest to the origin, the unit direction, and where the shape begins and
/// ends on it; null: it does not end.
Json carrier_to_json(const PictureVector& point, const PictureVector& along, const std::optional<PictureReal>& low,
                     const std::optional<PictureReal>& high) {
  const PictureVector u = unit(along);
  const PictureReal at = dot(point, u), step = length(along);
  const auto end = [&](const std::optional<PictureReal>& t) {
    return t ? Json(rounded(at + *t * step)) : Json(nullptr);
  };
  return {
      {"foot", vector_to_json(point - u * at)}, {"along", vector_to_json(u)}, {"from", end(low)}, {"to", end(high)}};
}

Json face_to_json(const PictureVector& normal, const PictureReal& d) {
  return {{"n", vector_to_json(normal)}, {"d", rounded(d)}};
}

/// A flat convex piece: its plane, and the half-spaces of its edges. Empty for points on one line.
std::optional<Json> piece_to_json(const PictureVector& a, const PictureVector& b, const PictureVector& c) {
  const PictureVector n = unit(cross(b - a, c - a));
  if (dot(n, n) == 0) return std::nullopt;
  Json piece = face_to_json(n, dot(n, a));
  const std::array corners{a, b, c};
  for (std::size_t i = 0; i < 3; ++i) {
    const PictureVector& from = corners[i];
    const PictureVector outward = unit(cross(corners[(i + 1) % 3] - from, n));
    piece["edges"].push_back(face_to_json(outward, dot(outward, from)));
  }
  return piece;
}

void add_pieces(Json& j, const std::vector<PictureVector>& c) {
  j["pieces"] = Json::array();
  for (std::size_t i = 2; i < c.size(); ++i) {
    if (const auto piece = piece_to_json(c[0], c[i - 1], c[i])) j["pieces"].push_back(*piece);
  }
  for (std::size_t i = 0; i < c.size(); ++i)
    j["sides"].push_back(carrier_to_json(c[i], c[(i + 1) % c.size()] - c[i], PictureReal(0), PictureReal(1)));
}

Json faces_to_json(const PictureShape& box) {
  Json faces = Json::array();
  for (std::size_t k = 0; k < 3; ++k) {
    for (const int sign : {1, -1}) {
      const PictureVector n = box.axes[k] * PictureReal(sign);
      faces.push_back(face_to_json(n, dot(n, box.corners[0]) + box.half[k]));
    }
  }
  return faces;
}

PictureShape divided(PictureShape s, const PictureReal& by) {
  for (PictureVector& c : s.corners) c = c * (1 / by);
  for (PictureReal& h : s.half) h /= by;
  s.radius /= by;
  return s;
}

}  // namespace

PictureInputs picture_inputs(const Case& question) {
  PictureInputs inputs;
  const Operands& operands = question.operands();
  for (const InputMember& m : operands.members) {
    if (!m.operand) {
      add_loose(inputs, m, question.values);
    } else if (m.begin == operands[*m.operand].begin) {
      inputs.shapes.push_back(drawn(operands[*m.operand], question.values));
    }
  }
  return inputs;
}

PictureVector nearest_point(const PictureShape& s, const PictureVector& p) {
  if (!s.shape) return p;
  switch (*s.shape) {
    case Shape::segment: return nearest_on_segment(p, s.corners[0], s.corners[1]);
    case Shape::ray: return nearest_on_carrier(p, s.corners[0], s.axis, 0, std::nullopt);
    case Shape::line: return nearest_on_carrier(p, s.corners[0], s.axis, std::nullopt, std::nullopt);
    case Shape::plane:
    case Shape::halfspace: return p - s.axis * ((dot(s.axis, p) + s.offset) / dot(s.axis, s.axis));
    case Shape::triangle: return nearest_on_triangle(p, s.corners[0], s.corners[1], s.corners[2]);
    case Shape::rectangle:
      return nearer(p, nearest_on_triangle(p, s.corners[0], s.corners[1], s.corners[2]),
                    nearest_on_triangle(p, s.corners[0], s.corners[2], s.corners[3]));
    case Shape::sphere: return nearest_in_ball(p, s.corners[0], s.radius);
    case Shape::capsule: return nearest_in_ball(p, nearest_on_segment(p, s.corners[0], s.corners[1]), s.radius);
    case Shape::box:
    case Shape::aabox: return nearest_in_box(p, s);
    case Shape::point: break;
  }
  return s.corners[0];
}

std::pair<PictureVector, PictureVector> meeting(const PictureShape& a, const PictureShape& b) {
  const auto gap = [&](const PictureVector& p) { return length(nearest_point(b, p) - p); };
  PictureVector p = nearest_point(a, a.corners.empty() ? PictureVector{} : a.corners[0]);
  constexpr int rounds = 64;  // a picture's center need not be the nearest point
  for (int i = 0; i < rounds && gap(p) > 0; ++i) {
    PictureVector next = nearest_point(a, nearest_point(b, p)), step = next - p;
    // Between nearly parallel shapes a projection is a small step: it is repeated and doubled while it leads nearer.
    for (PictureVector far = nearest_point(a, next + step); gap(far) < gap(next); far = nearest_point(a, next + step)) {
      next = far;
      step = step * PictureReal(2);
    }
    p = next;
  }
  return {p, nearest_point(b, p)};
}

const PictureShape* PictureInputs::moving() const {
  const auto found = std::ranges::find_if(shapes, &PictureShape::moves);
  return found == shapes.end() ? nullptr : &*found;
}

const PictureShape* PictureInputs::first_body() const {
  const auto found = std::ranges::find_if(shapes, &PictureShape::is_body);
  return found == shapes.end() ? nullptr : &*found;
}

const PictureShape* PictureInputs::other_than(const PictureShape* shape) const {
  const auto found =
      std::find_if(shapes.rbegin(), shapes.rend(), [&](const PictureShape& s) { return &s != shape && s.is_body(); });
  return found == shapes.rend() ? nullptr : &*found;
}

PictureReal PictureInputs::time_of_approach() const {
  const PictureShape *mover = moving(), *other = other_than(mover);
  if (!velocity || dot(*velocity, *velocity) == 0 || mover == nullptr || other == nullptr || mover->corners.empty())
    return 0;
  const PictureShape path{"", Shape::ray, {mover->corners[0]}, *velocity};
  const PictureVector met = meeting(path, *other).second;
  const PictureReal t = dot(nearest_point(path, met) - mover->corners[0], path.axis) / dot(path.axis, path.axis);
  return time && t > *time ? PictureReal(*time) : t;
}

PictureVector PictureInputs::where_shapes_meet() const {
  const PictureShape *first = moving() != nullptr ? moving() : first_body(), *other = other_than(first);
  if (first == nullptr) return {};
  if (other == nullptr) return nearest_point(*first, {});
  PictureShape core = *first;  // of a ball its center: the nearest point to it is where the balls meet
  if (core.shape == Shape::sphere) core.radius = 0;
  return meeting(core, *other).second;
}

void move_by(PictureShape& s, const PictureVector& by) {
  for (PictureVector& c : s.corners) c = c + by;
  if (s.has_one_plane()) s.offset -= dot(s.axis, by);
}

PictureReal reach(const PictureShape& s) {
  if (!s.is_body()) return 0;
  PictureReal most = 0;
  for (const PictureVector& c : s.corners) most = std::max<PictureReal>(most, length(c));
  if (!s.half.empty()) return most + length({s.half[0], s.half[1], s.half[2]});
  return most + s.radius;
}

Json vector_to_json(const PictureVector& v) { return Json::array({rounded(v.x), rounded(v.y), rounded(v.z)}); }

Json shape_to_json(const PictureShape& shape, const PictureReal& by) {
  const PictureShape s = divided(shape, by);
  Json j{{"name", s.name}, {"kind", s.shape ? name_of(*s.shape) : "direction"}, {"moves", s.moves}};
  for (const PictureVector& c : s.corners) j["corners"].push_back(vector_to_json(c));
  if (!s.shape) {
    j["direction"] = vector_to_json(unit(s.axis));
    return j;
  }
  switch (*s.shape) {
    case Shape::segment:
      j["sides"] = Json::array({carrier_to_json(s.corners[0], s.corners[1] - s.corners[0], 0, 1)});
      break;
    case Shape::ray:
      j["sides"] = Json::array({carrier_to_json(s.corners[0], s.axis, PictureReal(0), std::nullopt)});
      break;
    case Shape::line:
      j["sides"] = Json::array({carrier_to_json(s.corners[0], s.axis, std::nullopt, std::nullopt)});
      break;
    case Shape::plane:
    case Shape::halfspace: j["plane"] = face_to_json(unit(s.axis), -s.offset / length(s.axis) / by); break;
    case Shape::triangle:
    case Shape::rectangle: add_pieces(j, s.corners); break;
    case Shape::capsule:
      j["axis"] = carrier_to_json(s.corners[0], s.corners[1] - s.corners[0], 0, 1);
      j["axis"]["distance"] =
          rounded(length(nearest_point({"", Shape::line, {s.corners[0]}, s.corners[1] - s.corners[0]}, {})) - s.radius);
      [[fallthrough]];
    case Shape::sphere:
      j["radius"] = rounded(s.radius);
      for (const PictureVector& c : s.corners) j["distances"].push_back(rounded(length(c) - s.radius));
      break;
    case Shape::box:
    case Shape::aabox: j["faces"] = faces_to_json(s); break;
    case Shape::point: break;
  }
  return j;
}

}  // namespace nearmiss
