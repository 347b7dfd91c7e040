#include "reports/triage/geometry/case_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>

#include "oracles/judge.hpp"
#include "oracles/requirements.hpp"

namespace nearmiss {

namespace {

class GeometryReader {
 public:
  GeometryReader(const Case& c, const Answer* right) : c_(c), right_(right), q_(*c.query), parts_(c.operands()) {}

  CaseGeometry result() {
    read_inputs();
    read_edges();
    read_blocks();
    read_answer();
    add_lines_of_centers();
    return std::move(g_);
  }

 private:
  LongVector at(std::size_t i) const { return {c_.values[i], c_.values[i + 1], c_.values[i + 2]}; }
  /// The operand with that number; a velocity or a direction has its own name.
  const std::string& operand_of(std::size_t i) const {
    const Operand* operand = parts_.of_number(i);
    return operand != nullptr ? operand->name : parts_.member_of(i).name;
  }
  /// "sphere.center".
  const std::string& vector_at(std::size_t i) const { return parts_.member_of(i).name; }

  void read_inputs() {
    for (const InputMember& m : parts_.members) {
      const Operand* operand = m.operand ? &parts_[*m.operand] : nullptr;
      if (operand != nullptr && operand->radius == m.begin) g_.radii.emplace_back(operand->name, c_.values[m.begin]);
      if (operand != nullptr && m.role == Role::position)
        g_.places.push_back({m.name, operand->name, at(m.begin), true, is_corner(*operand), m.begin});
      if (m.role == Role::velocity || m.role == Role::direction) g_.directions.push_back({m.name, at(m.begin)});
      if (m.role == Role::velocity && !g_.velocity) g_.velocity = at(m.begin);
      if (m.role == Role::direction && operand != nullptr && operand->offset)
        g_.planes.push_back({operand->name, at(m.begin), c_.values[*operand->offset]});
    }
  }
  static bool is_corner(const Operand& o) { return o.shape == Shape::aabox || !o.traits().edges.empty(); }
  void add_edge(std::size_t a, std::size_t b) {
    if (!edges_.insert(std::minmax(a, b)).second) return;
    const std::string& end = vector_at(b);
    const std::string name = vector_at(a) + " " + end.substr(end.find('.') + 1);
    g_.edges.push_back({name, operand_of(a), at(a), at(b), a, b});
    g_.directions.push_back({name, at(b) - at(a)});
  }
  void read_edges() {
    for (const auto& s : parts_.segments) add_edge(s[0], s[1]);
    for (const auto& t : parts_.triangles) {
      for (std::size_t k = 0; k < 3; ++k) add_edge(t[k], t[(k + 1) % 3]);
      const std::array corners{at(t[0]), at(t[1]), at(t[2])};
      g_.triangles.push_back({operand_of(t[0]), corners, t});
      g_.directions.push_back(
          {"the normal of " + operand_of(t[0]), cross(corners[1] - corners[0], corners[2] - corners[0])});
    }
  }
  void read_blocks() {
    for (const std::size_t lower : parts_.aaboxes) {
      const LongVector low = at(lower), high = at(lower + 3);
      g_.blocks.push_back({operand_of(lower), (low + high) * 0.5L, (high - low) * 0.5L});
    }
    for (const Operand& box : parts_) {
      if (box.shape != Shape::box) continue;
      g_.blocks.push_back({box.name, at(box.begin), at(*box.half), axes_at(*box.rotation)});
      for (int k = 0; k < 3; ++k)
        g_.directions.push_back(
            {"axis " + std::to_string(k) + " of " + box.name, g_.blocks.back().axes[std::size_t(k)]});
    }
  }
  std::array<LongVector, 3> axes_at(std::size_t i) const {
    long double x = c_.values[i], y = c_.values[i + 1], z = c_.values[i + 2], w = c_.values[i + 3];
    const long double n = std::sqrt(x * x + y * y + z * z + w * w);
    x /= n, y /= n, z /= n, w /= n;
    return {{{1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)},
             {2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)},
             {2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)}}};
  }

  /// The numbers of the answer; none where its decision is no.
  std::vector<long double> numbers_of_answer() const {
    if (right_ != nullptr) {
      if (right_->status != Answer::Status::answered || !right_->yes) return {};
      return {right_->values.begin(), right_->values.begin() + right_->count};
    }
    std::vector<long double> numbers;
    const Truth truth = q_.outputs.empty() ? Truth{} : truth_of(c_);
    for (const Alternative& a : truth.alternatives) {
      if (!a.yes || a.many_normals) continue;
      for (std::size_t i = 0; i < a.count; ++i)
        numbers.push_back((static_cast<long double>(a.values[i].low) + a.values[i].high) / 2);
      break;
    }
    return numbers;
  }
  void read_answer() {
    const std::vector<long double> numbers = numbers_of_answer();
    for (std::size_t k = 0; k < q_.layout.parts.size(); ++k) read_member(k, numbers);
    add_moved_place(!numbers.empty());
  }
  void read_member(std::size_t k, const std::vector<long double>& numbers) {
    const Layout::Part& p = q_.layout.parts[k];
    const auto value = [&](std::size_t i) { return i < numbers.size() ? numbers[i] : 0.0L; };
    const bool known = p.end <= numbers.size();
    const bool is_vector = p.end - p.begin == 3;
    const LongVector v = is_vector ? LongVector{value(p.begin), value(p.begin + 1), value(p.begin + 2)} : LongVector{};
    const std::string name = "the answer's " + q_.layout.parts[k].name;
    if (p.role == Role::position && is_vector) g_.places.push_back({name, "", v, known});
    if (p.role == Role::normal && is_vector) g_.directions.push_back({name, v, known});
    if (p.role == Role::time && &p == q_.layout.at(Role::time)) g_.time = std::max(0.0L, value(p.begin));
    if (p.role == Role::depth || p.role == Role::distance) g_.depth = std::abs(value(p.begin));
    if (p.role != Role::weight && p.role != Role::direction) return;
    for (std::size_t i = p.begin; i < p.end; ++i) g_.weights.emplace_back(q_.outputs[i].name, std::abs(value(i)));
  }
  /// The first place at the time of the contact, or at the given time.
  void add_moved_place(bool known) {
    if (!g_.velocity || g_.places.empty()) return;
    const InputMember* given = c_.operands().at(Role::time);
    const bool is_given = given != nullptr && q_.kind == Kind::direction;
    if (!is_given && q_.kind != Kind::impact) return;
    const long double time = is_given ? c_.values[given->begin] : g_.time;
    const CaseGeometry::Place& start = g_.places.front();
    g_.places.push_back(
        {start.name + " at the time", start.operand, start.at + *g_.velocity * time, is_given || known});
  }
  void add_lines_of_centers() {
    for (std::size_t b = 0; b < g_.places.size(); ++b) {
      for (std::size_t a = 0; a < b; ++a) {
        const auto &from = g_.places[a], &to = g_.places[b];
        if (from.is_corner || to.is_corner || from.name + " at the time" == to.name) continue;
        g_.directions.push_back({from.name + " to " + to.name, to.at - from.at, from.known && to.known});
      }
    }
  }

  const Case& c_;
  const Answer* right_;
  const Query& q_;
  const Operands& parts_;
  std::set<std::pair<std::size_t, std::size_t>> edges_;
  CaseGeometry g_;
};

}  // namespace

long double CaseGeometry::radius_of(const std::string& operand) const {
  for (const auto& [name, radius] : radii) {
    if (name == operand) return radius;
  }
  return 0;
}

CaseGeometry geometry_of(const Case& c, const Answer* right) { return GeometryReader(c, right).result(); }

}  // namespace nearmiss
