#include "reports/page/scene_shapes.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

namespace nearmiss {

double rounded(const SceneReal& x) {
  constexpr double most = std::numeric_limits<double>::max();
  return std::clamp(x.convert_to<double>(), -most, most);
}

SceneReal dot(const SceneVector& a, const SceneVector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
SceneVector cross(const SceneVector& a, const SceneVector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
SceneReal length(const SceneVector& a) { return sqrt(dot(a, a)); }
SceneVector unit(const SceneVector& a) {
  const SceneReal l = length(a);
  return l == 0 ? a : a * (1 / l);
}

namespace {

using Json = nlohmann::ordered_json;
using Form = SceneShape::Form;

// --- reading -------------------------------------------------------------------------------------------------------

/// An input of a query: the numbers of each of its members by name. A vector or number without members has "".
struct SceneOperand {
  std::string name;
  std::map<std::string, std::vector<double>> members{};
  std::map<std::string, Role> roles{};

  SceneVector vector(const std::string& member) const {
    const std::vector<double>& v = members.at(member);
    return {v.at(0), v.at(1), v.at(2)};
  }
  bool is_vector(const std::string& member) const { return members.at(member).size() == 3; }
  bool has_exactly(std::initializer_list<const char*> names) const {
    return members.size() == names.size() &&
           std::all_of(names.begin(), names.end(), [&](const char* n) { return members.contains(n); });
  }
};

/// Splits "box.center.x" into the operand "box", its member "center" and a component; "velocity.x" has the member "".
std::vector<SceneOperand> operands_of(const Query& query, std::span<const double> values) {
  std::vector<SceneOperand> operands;
  for (std::size_t i = 0; i < query.inputs.size(); ++i) {
    const std::string& name = query.inputs[i].name;
    const std::string head = name.substr(0, name.find('.'));
    std::string member = head.size() == name.size() ? "" : name.substr(head.size() + 1);
    const std::size_t component = member.rfind('.');
    if (component != std::string::npos) {
      member.resize(component);
    } else if (member.size() == 1) {
      member.clear();
    }
    if (operands.empty() || operands.back().name != head) operands.push_back({head});
    operands.back().members[member].push_back(values[i]);
    operands.back().roles[member] = query.inputs[i].role;
  }
  return operands;
}

/// The axes of the rotation x, y, z, w, which need not have unit length.
std::vector<SceneVector> axes_of(const std::vector<double>& q) {
  const SceneReal x = q.at(0), y = q.at(1), z = q.at(2), w = q.at(3), s = 2 / (x * x + y * y + z * z + w * w);
  return {{1 - s * (y * y + z * z), s * (x * y + w * z), s * (x * z - w * y)},
          {s * (x * y - w * z), 1 - s * (x * x + z * z), s * (y * z + w * x)},
          {s * (x * z + w * y), s * (y * z - w * x), 1 - s * (x * x + y * y)}};
}

SceneShape box_between(const std::string& name, const SceneVector& low, const SceneVector& high) {
  const SceneVector half = (high - low) * SceneReal(0.5);
  return {.name = name,
          .kind = Form::box,
          .kind_name = "aabox",
          .corners = {low + half},
          .axes = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
          .half = {half.x, half.y, half.z}};
}

/// The shape of an operand with these members; empty where they are no shape's.
std::optional<SceneShape> known_shape(const SceneOperand& o) {
  const auto at = [&](const char* member) { return o.vector(member); };
  if (o.has_exactly({"center", "radius"}))
    return SceneShape{o.name, Form::sphere, "sphere", {at("center")}, {}, 0, o.members.at("radius")[0]};
  if (o.has_exactly({"p0", "p1", "radius"}))
    return SceneShape{o.name, Form::capsule, "capsule", {at("p0"), at("p1")}, {}, 0, o.members.at("radius")[0]};
  if (o.has_exactly({"center", "half", "orientation"})) {
    const SceneVector half = at("half");
    return SceneShape{.name = o.name,
                      .kind = Form::box,
                      .kind_name = "box",
                      .corners = {at("center")},
                      .axes = axes_of(o.members.at("orientation")),
                      .half = {half.x, half.y, half.z}};
  }
  if (o.has_exactly({"min", "max"})) return box_between(o.name, at("min"), at("max"));
  if (o.has_exactly({"v0", "v1"})) return SceneShape{o.name, Form::segment, "segment", {at("v0"), at("v1")}};
  if (o.has_exactly({"v0", "v1", "v2"}))
    return SceneShape{o.name, Form::triangle, "triangle", {at("v0"), at("v1"), at("v2")}};
  if (o.has_exactly({"v0", "v1", "v2", "v3"}))
    return SceneShape{o.name, Form::rectangle, "rectangle", {at("v0"), at("v1"), at("v2"), at("v3")}};
  if (o.has_exactly({"origin", "direction"}))
    return SceneShape{o.name, Form::ray, "ray", {at("origin")}, at("direction")};
  if (o.has_exactly({"point", "direction"}))
    return SceneShape{o.name, Form::line, "line", {at("point")}, at("direction")};
  if (o.has_exactly({"normal", "offset"}))
    return SceneShape{o.name, Form::plane, "plane", {}, at("normal"), o.members.at("offset")[0]};
  return std::nullopt;
}

/// An operand that is no shape: its positions are points, and its directions arrows.
void add_loose(SceneInputs& scene, const SceneOperand& o) {
  for (const auto& [member, role] : o.roles) {
    const std::string name = member.empty() ? o.name : o.name + "." + member;
    if (role == Role::time) scene.time = o.members.at(member)[0];
    if (!o.is_vector(member)) continue;
    if (role == Role::position) scene.shapes.push_back({name, Form::point, "point", {o.vector(member)}});
    if (role == Role::direction) scene.shapes.push_back({name, Form::direction, "direction", {}, o.vector(member)});
    if (role != Role::velocity) continue;
    scene.velocity = o.vector(member);
    if (!scene.shapes.empty()) scene.shapes.back().moves = true;
  }
}

// --- nearest points ------------------------------------------------------------------------------------------------

SceneReal within(const SceneReal& x, const SceneReal& low, const SceneReal& high) {
  return x < low ? low : x > high ? high : x;
}

SceneVector nearest_on_carrier(const SceneVector& p, const SceneVector& from, const SceneVector& along,
                               std::optional<double> low, std::optional<double> high) {
  const SceneReal square = dot(along, along);
  if (square == 0) return from;
  SceneReal t = dot(p - from, along) / square;
  if (low && t < *low) t = *low;
  if (high && t > *high) t = *high;
  return from + along * t;
}

SceneVector nearest_on_segment(const SceneVector& p, const SceneVector& a, const SceneVector& b) {
  return nearest_on_carrier(p, a, b - a, 0, 1);
}

const SceneVector& nearer(const SceneVector& p, const SceneVector& a, const SceneVector& b) {
  return dot(a - p, a - p) <= dot(b - p, b - p) ? a : b;
}

SceneVector nearest_on_triangle(const SceneVector& p, const SceneVector& a, const SceneVector& b,
                                const SceneVector& c) {
  const SceneVector normal = cross(b - a, c - a);
  const SceneReal square = dot(normal, normal);
  if (square > 0) {
    const SceneVector foot = p - normal * (dot(p - a, normal) / square);
    const bool inside = dot(cross(b - a, foot - a), normal) >= 0 && dot(cross(c - b, foot - b), normal) >= 0 &&
                        dot(cross(a - c, foot - c), normal) >= 0;
    if (inside) return foot;
  }
  return nearer(p, nearest_on_segment(p, a, b), nearer(p, nearest_on_segment(p, b, c), nearest_on_segment(p, c, a)));
}

SceneVector nearest_in_ball(const SceneVector& p, const SceneVector& center, const SceneReal& radius) {
  const SceneReal distance = length(p - center);
  return distance <= radius ? p : center + (p - center) * (radius / distance);
}

SceneVector nearest_in_box(const SceneVector& p, const SceneShape& box) {
  SceneVector q = box.corners[0];
  for (std::size_t k = 0; k < 3; ++k)
    q = q + box.axes[k] * within(dot(p - box.corners[0], box.axes[k]), -box.half[k], box.half[k]);
  return q;
}

// --- writing -------------------------------------------------------------------------------------------------------

/// The line that carries a shape: its point nearest to the origin, the unit direction, and where the shape begins and
/// ends on it; null: it does not end.
Json carrier_to_json(const SceneVector& point, const SceneVector& along, const std::optional<SceneReal>& low,
                     const std::optional<SceneReal>& high) {
  const SceneVector u = unit(along);
  const SceneReal at = dot(point, u), step = length(along);
  const auto end = [&](const std::optional<SceneReal>& t) { return t ? Json(rounded(at + *t * step)) : Json(nullptr); };
  return {
      {"foot", vector_to_json(point - u * at)}, {"along", vector_to_json(u)}, {"from", end(low)}, {"to", end(high)}};
}

Json face_to_json(const SceneVector& normal, const SceneReal& d) {
  return {{"n", vector_to_json(normal)}, {"d", rounded(d)}};
}

/// A flat convex piece: its plane, and the half-spaces of its edges. Empty for points on one line.
std::optional<Json> piece_to_json(const SceneVector& a, const SceneVector& b, const SceneVector& c) {
  const SceneVector n = unit(cross(b - a, c - a));
  if (dot(n, n) == 0) return std::nullopt;
  Json piece = face_to_json(n, dot(n, a));
  const std::array corners{a, b, c};
  for (std::size_t i = 0; i < 3; ++i) {
    const SceneVector& from = corners[i];
    const SceneVector outward = unit(cross(corners[(i + 1) % 3] - from, n));
    piece["edges"].push_back(face_to_json(outward, dot(outward, from)));
  }
  return piece;
}

void add_pieces(Json& j, const std::vector<SceneVector>& c) {
  j["pieces"] = Json::array();
  for (std::size_t i = 2; i < c.size(); ++i) {
    if (const auto piece = piece_to_json(c[0], c[i - 1], c[i])) j["pieces"].push_back(*piece);
  }
  for (std::size_t i = 0; i < c.size(); ++i)
    j["sides"].push_back(carrier_to_json(c[i], c[(i + 1) % c.size()] - c[i], SceneReal(0), SceneReal(1)));
}

Json faces_to_json(const SceneShape& box) {
  Json faces = Json::array();
  for (std::size_t k = 0; k < 3; ++k) {
    for (const int sign : {1, -1}) {
      const SceneVector n = box.axes[k] * SceneReal(sign);
      faces.push_back(face_to_json(n, dot(n, box.corners[0]) + box.half[k]));
    }
  }
  return faces;
}

SceneShape divided(SceneShape s, const SceneReal& by) {
  for (SceneVector& c : s.corners) c = c * (1 / by);
  for (SceneReal& h : s.half) h /= by;
  s.radius /= by;
  return s;
}

}  // namespace

SceneInputs scene_inputs(const Query& query, std::span<const double> values) {
  SceneInputs scene;
  for (const SceneOperand& o : operands_of(query, values)) {
    if (auto shape = known_shape(o)) {
      scene.shapes.push_back(std::move(*shape));
    } else {
      add_loose(scene, o);
    }
  }
  return scene;
}

SceneVector nearest_point(const SceneShape& s, const SceneVector& p) {
  switch (s.kind) {
    case Form::segment: return nearest_on_segment(p, s.corners[0], s.corners[1]);
    case Form::ray: return nearest_on_carrier(p, s.corners[0], s.axis, 0, std::nullopt);
    case Form::line: return nearest_on_carrier(p, s.corners[0], s.axis, std::nullopt, std::nullopt);
    case Form::plane: return p - s.axis * ((dot(s.axis, p) + s.offset) / dot(s.axis, s.axis));
    case Form::triangle: return nearest_on_triangle(p, s.corners[0], s.corners[1], s.corners[2]);
    case Form::rectangle:
      return nearer(p, nearest_on_triangle(p, s.corners[0], s.corners[1], s.corners[2]),
                    nearest_on_triangle(p, s.corners[0], s.corners[2], s.corners[3]));
    case Form::sphere: return nearest_in_ball(p, s.corners[0], s.radius);
    case Form::capsule: return nearest_in_ball(p, nearest_on_segment(p, s.corners[0], s.corners[1]), s.radius);
    case Form::box: return nearest_in_box(p, s);
    case Form::point:
    case Form::direction: break;
  }
  return s.corners.empty() ? p : s.corners[0];
}

void move_by(SceneShape& s, const SceneVector& by) {
  for (SceneVector& c : s.corners) c = c + by;
  if (s.kind == Form::plane) s.offset -= dot(s.axis, by);
}

SceneReal reach(const SceneShape& s) {
  if (s.kind == Form::direction) return 0;
  SceneReal most = 0;
  for (const SceneVector& c : s.corners) most = std::max<SceneReal>(most, length(c));
  if (s.kind == Form::box) return most + length({s.half[0], s.half[1], s.half[2]});
  return most + s.radius;
}

Json vector_to_json(const SceneVector& v) { return Json::array({rounded(v.x), rounded(v.y), rounded(v.z)}); }

Json shape_to_json(const SceneShape& shape, const SceneReal& by) {
  const SceneShape s = divided(shape, by);
  Json j{{"name", s.name}, {"kind", s.kind_name}, {"moves", s.moves}};
  for (const SceneVector& c : s.corners) j["corners"].push_back(vector_to_json(c));
  switch (s.kind) {
    case Form::segment:
      j["sides"] = Json::array({carrier_to_json(s.corners[0], s.corners[1] - s.corners[0], 0, 1)});
      break;
    case Form::ray:
      j["sides"] = Json::array({carrier_to_json(s.corners[0], s.axis, SceneReal(0), std::nullopt)});
      break;
    case Form::line:
      j["sides"] = Json::array({carrier_to_json(s.corners[0], s.axis, std::nullopt, std::nullopt)});
      break;
    case Form::plane: j["plane"] = face_to_json(unit(s.axis), -s.offset / length(s.axis) / by); break;
    case Form::triangle:
    case Form::rectangle: add_pieces(j, s.corners); break;
    case Form::capsule:
      j["axis"] = carrier_to_json(s.corners[0], s.corners[1] - s.corners[0], 0, 1);
      j["axis"]["distance"] = rounded(
          length(nearest_point({"", Form::line, "", {s.corners[0]}, s.corners[1] - s.corners[0]}, {})) - s.radius);
      [[fallthrough]];
    case Form::sphere:
      j["radius"] = rounded(s.radius);
      for (const SceneVector& c : s.corners) j["distances"].push_back(rounded(length(c) - s.radius));
      break;
    case Form::box: j["faces"] = faces_to_json(s); break;
    case Form::direction: j["direction"] = vector_to_json(unit(s.axis)); break;
    case Form::point: break;
  }
  return j;
}

}  // namespace nearmiss
