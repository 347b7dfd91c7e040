#include "reports/triage/geometry/magnitudes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "oracles/judge.hpp"
#include "reports/triage/geometry/case_geometry.hpp"
#include "reports/triage/geometry/quantities.hpp"

namespace nearmiss {

namespace {

class MagnitudeList {
 public:
  MagnitudeList(const Case& c, const Answer* right, bool with_gap) : c_(c), g_(geometry_of(c, right)) {
    if (with_gap) add_length("the gap or overlap", gap_of(c));
  }

  Magnitudes result() {
    add_angles();
    add_components();
    add_unit_errors();
    add_weights();
    add_shares_of_time();
    add_tolerances();
    add_motion();
    add_radii();
    add_blocks();
    add_distances();
    add_planes();
    add_edges();
    add_triangles();
    add_separations();
    return std::move(all_);
  }

 private:
  static constexpr long double least_squared = 0.02L;  ///< of a sine that is no tolerance itself

  using Place = CaseGeometry::Place;
  using Block = CaseGeometry::Block;

  void add_length(std::string name, long double value, bool known = true) {
    all_.lengths.push_back({std::move(name), known ? std::abs(value) : 0});
  }
  void add_pure(std::string name, long double value, bool known = true) {
    const long double magnitude = std::abs(value);
    all_.pure.push_back({std::move(name), known && std::isfinite(magnitude) ? magnitude : 0});
  }

  // Angles and shares of vectors

  void add_angles() {
    for (std::size_t b = 0; b < g_.directions.size(); ++b) {
      for (std::size_t a = 0; a < b; ++a) {
        const auto &d = g_.directions[a], &e = g_.directions[b];
        const bool known = d.known && e.known;
        const long double product = length(d.of) * length(e.of), sine = length(cross(d.of, e.of)) / product;
        const long double cosine = std::abs(dot(d.of, e.of)) / product;
        add_pure(fmt::format("the sine of the angle between {} and {}", d.name, e.name), sine, known);
        // The square of a small sine is told by its root.
        add_pure(fmt::format("the squared sine of the angle between {} and {}", d.name, e.name), sine * sine,
                 known && sine > least_squared);
        add_pure(fmt::format("the cosine of the angle between {} and {}", d.name, e.name), cosine, known);
        add_pure(fmt::format("1 minus the cosine of the angle between {} and {}", d.name, e.name),
                 sine * sine / (1 + cosine), known);
      }
    }
  }
  void add_components() {
    for (const auto& d : g_.directions) {
      const long double largest = std::max({std::abs(d.of.x), std::abs(d.of.y), std::abs(d.of.z)});
      for (int k = 0; k < 3; ++k) {
        const std::string name = fmt::format("component {} of {}", "xyz"[k], d.name);
        add_pure(name + " over the largest", d.of[k] / largest, d.known);
        add_pure(name + " over its length", d.of[k] / length(d.of), d.known);
      }
    }
  }
  void add_unit_errors() {
    for (const InputMember& m : c_.operands().members) {
      if (m.role != Role::direction && m.role != Role::rotation) continue;
      long double square = 0;
      for (std::size_t k = m.begin; k < m.begin + m.count; ++k)
        square += static_cast<long double>(c_.values[k]) * c_.values[k];
      add_pure("the squared length of " + m.name + ", minus 1,", square - 1);
      add_pure("the length of " + m.name + ", minus 1,", (square - 1) / (std::sqrt(square) + 1));
    }
  }
  void add_weights() {
    for (const auto& [name, value] : g_.weights) add_pure("the exact " + name, value);
  }

  // Time, and numbers that are tolerances themselves

  /// The share of a time limit that is left after the decision changes.
  void add_shares_of_time() {
    if (!decides(c_.query->kind)) return;
    for (std::size_t i = 0; i < c_.values.size(); ++i) {
      if (c_.role(i) != Role::time) continue;
      const long double change = change_of_decision(i);
      add_pure(fmt::format("the distance of {} from the time at which the decision changes, over {},", c_.name(i),
                           c_.name(i)),
               (c_.values[i] - change) / c_.values[i], change > 0);
    }
  }
  /// The value of the number nearest below or above its own at which the exact decision changes; 0: not near.
  long double change_of_decision(std::size_t i) const {
    constexpr int finest = -46, coarsest = -4, bisections = 10;
    const double own = c_.values[i];
    const bool decision = exact_decision(c_);
    const auto changes = [&](double share) {
      Case other = c_;
      other.scalar = Scalar::float64;
      other.values[i] = own * (1 + share);
      return exact_decision(other) != decision;
    };
    for (int k = finest; k <= coarsest; k += 2) {
      for (const double sign : {-1.0, 1.0}) {
        double far = std::ldexp(sign, k), near = k == finest ? 0 : far / 4;
        if (!changes(far)) continue;
        for (int n = 0; n < bisections; ++n) {
          const double middle = (near + far) / 2;
          (changes(middle) ? far : near) = middle;
        }
        return own * (1 + static_cast<long double>(near + far) / 2);
      }
    }
    return 0;
  }
  void add_tolerances() {
    for (std::size_t i = 0; i < c_.values.size(); ++i) {
      if (c_.role(i) != Role::weight) continue;
      const long double given = c_.values[i];
      for (const auto& a : g_.directions) {
        for (const auto& b : g_.directions) {
          if (&a >= &b) continue;
          const long double product = length(a.of) * length(b.of), cosine = std::abs(dot(a.of, b.of)) / product;
          const long double sine = length(cross(a.of, b.of)) / product, below = sine * sine / (1 + cosine);
          add_pure(fmt::format("the excess over {} of 1 minus the cosine of {} and {}, over {},", c_.name(i), a.name,
                               b.name, c_.name(i)),
                   (below - given) / given);
        }
      }
    }
  }

  // Motion

  void add_motion() {
    if (!g_.velocity) return;
    const long double speed = length(*g_.velocity);
    add_length("the distance moved until the contact", g_.time * speed);
    for (const auto& d : g_.directions) {
      if (d.name == "the answer's normal")
        add_length("the distance moved along the normal until the contact",
                   g_.time * dot(d.of, *g_.velocity) / length(d.of), d.known);
    }
    add_length("the exact depth", g_.depth);
    for (const auto& t : g_.triangles) {
      const LongVector e = t.corners[1] - t.corners[0], f = t.corners[2] - t.corners[0];
      add_pure(fmt::format("the determinant of the velocity and two edges of {}, over the product of their lengths,",
                           t.operand),
               dot(cross(e, f), *g_.velocity) / (length(e) * length(f) * speed));
    }
  }

  // Lengths

  void add_radii() {
    for (std::size_t i = 0; i < g_.radii.size(); ++i) {
      add_length("the radius of " + g_.radii[i].first, g_.radii[i].second);
      for (std::size_t k = 0; k < i; ++k) add_length("the sum of the radii", g_.radii[i].second + g_.radii[k].second);
    }
  }
  void add_blocks() {
    for (const Block& b : g_.blocks) {
      const auto [least, largest] = std::minmax({b.half.x, b.half.y, b.half.z});
      add_length("the largest half extent of " + b.operand, largest);
      add_length("the least half extent of " + b.operand, least);
      for (int k = 0; k < 3; ++k) add_length(fmt::format("half extent {} of {}", "xyz"[k], b.operand), b.half[k]);
      for (int k = 0; k < 3; ++k) add_length(fmt::format("extent {} of {}", "xyz"[k], b.operand), 2 * b.half[k]);
      add_length("half the diagonal of " + b.operand, length(b.half));
      add_length("the sum of the half extents of " + b.operand, b.half.x + b.half.y + b.half.z);
      for (const Place& p : g_.places) {
        if (p.operand != b.operand) add_in_block(b, p);
      }
    }
  }
  void add_in_block(const Block& b, const Place& p) {
    const LongVector from = p.at - b.center;
    long double outside = 0, e[3];
    for (int k = 0; k < 3; ++k) {
      e[k] = std::abs(dot(from, b.axes[std::size_t(k)])) - b.half[k];
      outside += e[k] > 0 ? e[k] * e[k] : 0;
      add_length(fmt::format("the distance of {} from the nearer face {} of {}", p.name, "xyz"[k], b.operand), e[k],
                 p.known);
      add_length(fmt::format("the distance of {} from the middle plane {} of {}", p.name, "xyz"[k], b.operand),
                 dot(from, b.axes[std::size_t(k)]), p.known);
    }
    for (int k = 0; k < 3; ++k)
      add_length(fmt::format("the difference of the distances of {} from two faces of {}", p.name, b.operand),
                 e[k] - e[(k + 1) % 3], p.known);
    const long double inside = std::max({e[0], e[1], e[2]});
    add_distance(p.name, p.operand, b.operand, outside > 0 ? std::sqrt(outside) : inside, p.known);
  }
  /// A distance, and the gaps that are left of it beside the radii.
  void add_distance(const std::string& from, const std::string& of, const std::string& to, long double distance,
                    bool known) {
    const long double r = g_.radius_of(of), s = g_.radius_of(to);
    add_length(fmt::format("the distance of {} from {}", from, to), distance, known);
    add_length(fmt::format("the gap between {} and {}", from, to), std::abs(distance) - r - s, known && r + s > 0);
    add_length(fmt::format("the gap between {} and the inside of {}", from, to), std::abs(distance) - std::abs(r - s),
               known && r + s > 0);
  }
  void add_distances() {
    for (std::size_t b = 0; b < g_.places.size(); ++b) {
      for (std::size_t a = 0; a < b; ++a) {
        const Place &p = g_.places[a], &q = g_.places[b];
        const bool is_edge = p.operand == q.operand && p.is_corner && q.is_corner;
        if (is_edge) continue;
        if (p.operand == q.operand || p.operand.empty() || q.operand.empty()) {
          add_length(fmt::format("the distance of {} from {}", p.name, q.name), length(p.at - q.at),
                     p.known && q.known);
          continue;
        }
        add_distance(p.name, p.operand, q.operand, length(p.at - q.at), p.known && q.known);
      }
    }
  }
  void add_planes() {
    for (const auto& plane : g_.planes) {
      const long double unit = length(plane.normal);
      for (const Place& p : g_.places) {
        if (p.operand != plane.operand)
          add_distance(p.name, p.operand, plane.operand, (dot(plane.normal, p.at) + plane.offset) / unit, p.known);
      }
      for (const Block& b : g_.blocks) {
        long double reach = 0;
        for (std::size_t k = 0; k < 3; ++k) reach += b.half[int(k)] * std::abs(dot(plane.normal, b.axes[k]));
        add_length(fmt::format("the gap between {} and {}", b.operand, plane.operand),
                   (dot(plane.normal, b.center) + plane.offset - reach) / unit);
      }
    }
  }
  void add_edges() {
    for (const auto& e : g_.edges) add_length("the length of " + e.name, length(e.to - e.from));
    for (const Place& p : g_.places) {
      std::vector<long double> of_operand;
      for (const auto& e : g_.edges) {
        const bool is_end = !p.operand.empty() && p.operand == e.operand;
        if (!is_end) add_at_edge(e, p, of_operand);
      }
      for (std::size_t b = 0; b < of_operand.size(); ++b) {
        for (std::size_t a = 0; a < b; ++a)
          add_length(fmt::format("the difference of the distances of {} from two edges", p.name),
                     of_operand[b] - of_operand[a], p.known);
      }
    }
  }
  void add_at_edge(const CaseGeometry::Edge& e, const Place& p, std::vector<long double>& distances) {
    const LongVector along = e.to - e.from, from = p.at - e.from;
    const long double square = dot(along, along), t = square > 0 ? dot(from, along) / square : 0;
    const bool known = p.known && square > 0;
    add_pure(fmt::format("the parameter of {} along {}", p.name, e.name), t, known);
    add_pure(fmt::format("1 minus the parameter of {} along {}", p.name, e.name), 1 - t, known);
    add_length(fmt::format("the distance of {} from the line {}", p.name, e.name),
               length(cross(along, from)) / std::sqrt(square), known);
    const LongVector rest = from - along * std::clamp(t, 0.0L, 1.0L);
    distances.push_back(length(rest));
    add_distance(p.name, p.operand, e.operand, length(rest), p.known);
  }
  void add_triangles() {
    for (const auto& t : g_.triangles) {
      const LongVector n = cross(t.corners[1] - t.corners[0], t.corners[2] - t.corners[0]);
      const long double longest = std::max({length(t.corners[1] - t.corners[0]), length(t.corners[2] - t.corners[1]),
                                            length(t.corners[0] - t.corners[2])});
      add_length("the longest edge of " + t.operand, longest);
      add_length("the least height of " + t.operand, length(n) / longest, longest > 0);
      for (const Place& p : g_.places) {
        if (p.operand == t.operand) continue;
        add_distance(p.name, p.operand, t.operand, dot(n, p.at - t.corners[0]) / length(n), p.known);
        for (std::size_t k = 0; k < 3; ++k) {
          const LongVector &a = t.corners[(k + 1) % 3], &b = t.corners[(k + 2) % 3];
          add_pure(fmt::format("the weight of corner {} of {} at {}", k, t.operand, p.name),
                   dot(cross(b - a, p.at - a), n) / dot(n, n), p.known);
        }
      }
    }
  }

  // Separating axes

  void add_separations() {
    for (std::size_t b = 0; b < g_.blocks.size(); ++b) {
      for (std::size_t a = 0; a < b; ++a) add_box_separations(g_.blocks[a], g_.blocks[b]);
    }
    for (const Block& b : g_.blocks) {
      for (const auto& t : g_.triangles) add_triangle_separations(b, t);
    }
  }
  static long double reach_of(const Block& b, const LongVector& axis) {
    long double reach = 0;
    for (std::size_t k = 0; k < 3; ++k) reach += b.half[int(k)] * std::abs(dot(axis, b.axes[k]));
    return reach;
  }
  void add_box_separations(const Block& a, const Block& b) {
    std::vector<LongVector> axes(a.axes.begin(), a.axes.end());
    axes.insert(axes.end(), b.axes.begin(), b.axes.end());
    for (const LongVector& u : a.axes) {
      for (const LongVector& v : b.axes) axes.push_back(cross(u, v));
    }
    for (std::size_t k = 0; k < axes.size(); ++k) {
      const long double unit = length(axes[k]), between = std::abs(dot(b.center - a.center, axes[k]));
      const long double of_a = reach_of(a, axes[k]), of_b = reach_of(b, axes[k]);
      add_length(fmt::format("the gap along axis {}", k), (between - of_a - of_b) / unit, unit > 0);
      add_length(fmt::format("the reach of {} along axis {}", a.operand, k), of_a / unit, unit > 0);
      add_length(fmt::format("the reach of {} along axis {}", b.operand, k), of_b / unit, unit > 0);
    }
  }
  void add_triangle_separations(const Block& b, const CaseGeometry::Triangle& t) {
    std::vector<LongVector> axes(b.axes.begin(), b.axes.end());
    axes.push_back(cross(t.corners[1] - t.corners[0], t.corners[2] - t.corners[0]));
    for (std::size_t k = 0; k < 3; ++k) {
      for (const LongVector& u : b.axes) axes.push_back(cross(u, t.corners[(k + 1) % 3] - t.corners[k]));
    }
    for (std::size_t k = 0; k < axes.size(); ++k) {
      const long double unit = length(axes[k]);
      const auto at = [&](std::size_t i) { return dot(t.corners[i] - b.center, axes[k]); };
      const auto [low, high] = std::minmax({at(0), at(1), at(2)});
      add_length(fmt::format("the gap along axis {}", k), (std::max(low, -high) - reach_of(b, axes[k])) / unit,
                 unit > 0);
    }
  }

  const Case& c_;
  CaseGeometry g_;
  Magnitudes all_;
};

}  // namespace

Magnitudes magnitudes_of(const Case& c, const Answer* right, bool with_gap) {
  return MagnitudeList(c, right, with_gap).result();
}

}  // namespace nearmiss
