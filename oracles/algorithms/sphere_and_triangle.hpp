/// A sphere that moves toward a one-sided triangle: every possible first contact. Shared by the oracles of queries with
/// spheres and triangles.
///
/// Signs of linear functions of time determine which feature of the triangle (face, edge or vertex) is nearest to the
/// center. Within a feature's region the squared distance is a quadratic of time, whose earlier root counts. The
/// distance from a convex set is convex along a line, so the least of these roots is the first contact.
#pragma once

#include <optional>

#include "oracles/algorithms/first_contact.hpp"
#include "oracles/algorithms/residual.hpp"

namespace nearmiss::oracle {

template <class N>
struct TriangleContact {
  collide::TriangleImpact<N> impact;
  Normals<N> normals{};
  bool any_weights = false;  ///< in a triangle without area, many weights of the corners give the location
};

template <class N>
struct TriangleContacts {
  NumberVector<TriangleContact<N>> list;
  bool may_miss = false;
  /// An upper bound of the time of contact, if the sphere touches at all.
  double surely_by = std::numeric_limits<double>::infinity();
};

inline Interval at_most(const Interval& x, double most) { return {std::min(x.inf(), most), std::min(x.sup(), most)}; }
inline const Exact& at_most(const Exact& x, double) { return x; }

template <class N>
class SphereAndTriangle {
 public:
  SphereAndTriangle(const Vector<N>& center, const N& radius, const Vector<N>& velocity,
                    const std::array<Vector<N>, 3>& corner)
      : p_(center), r_(radius), v_(velocity), corner_(corner) {
    for (int i = 0; i < 3; ++i) {
      e_[i] = minus(corner_[(i + 1) % 3], corner_[i]);
      e2_[i] = norm2(e_[i]);
    }
    n_ = cross(e_[0], minus(corner_[2], corner_[0]));
    n2_ = norm2(n_);
    for (int i = 0; i < 3; ++i) out_[i] = cross(e_[i], n_);
  }

  TriangleContacts<N> contacts() {
    if (!passes_gate()) return std::move(all_);
    if (!start()) return std::move(all_);
    near_ = Window{};
    for (int k = 0; k < 3; ++k) {
      const N low = lowest(k), high = highest(k);
      near_.clip(times_not_positive(N(low - r_ - p_[k]), N(-v_[k])));
      near_.clip(times_not_positive(N(p_[k] - high - r_), v_[k]));
    }
    if (near_.empty()) {
      all_.may_miss = true;
      return std::move(all_);
    }
    const std::size_t at_start = all_.list.size();
    for (int i = 0; i < 3; ++i) vertex_root(i);
    for (int i = 0; i < 3; ++i) edge_root(i);
    face_root();
    keep_first(at_start);
    return std::move(all_);
  }

 private:
  using Contact = TriangleContact<N>;

  N lowest(int k) const { return extreme(k, true); }
  N highest(int k) const { return extreme(k, false); }
  /// Bounds of the corners' coordinates.
  N extreme(int k, bool low) const {
    N x = corner_[0][k];
    for (int i = 1; i < 3; ++i) {
      const N& y = corner_[i][k];
      if constexpr (is_enclosure<N>) {
        x = low ? N(std::min(x.inf(), y.inf()), std::min(x.sup(), y.sup()))
                : N(std::max(x.inf(), y.inf()), std::max(x.sup(), y.sup()));
      } else if (low ? may_be_less(y, x) : may_be_less(x, y)) {
        x = y;
      }
    }
    return x;
  }

  bool may_have_area() const { return may_be_positive(n2_); }
  bool surely_has_area() const { return !may_be_zero(n2_); }
  Vector<N> from_corner(int i) const { return minus(p_, corner_[i]); }
  Vector<N> at(const N& time) const { return plus(p_, times(v_, time)); }

  /// n . v <= 0, and n . (p - v0) >= -r |n|.
  bool passes_gate() {
    const N toward = dot(n_, v_), height = dot(n_, from_corner(0));
    const N deep = square(height) - square(r_) * n2_;
    const bool may_be_behind = may_be_negative(height) && may_be_positive(deep);
    const bool may_be_before = may_be_at_least_zero(height) || may_be_at_most_zero(deep);
    if (may_be_positive(toward) || may_be_behind) all_.may_miss = true;
    surely_passes_ = !all_.may_miss;
    return may_be_at_most_zero(toward) && may_be_before;
  }

  // Normals for a center on the triangle.

  Normals<N> vertex_cone(int i) const { return Normals<N>::cone({{e_[i], -1, 0}, {e_[(i + 2) % 3], 0, 1}}); }
  Normals<N> edge_cone(int i) const { return Normals<N>::cone({{e_[i], 0, 0}, {out_[i], 0, 1}}); }
  Normals<N> face_cone() const { return Normals<N>::cone({{e_[0], 0, 0}, {e_[1], 0, 0}, {e_[2], 0, 0}}); }

  void set_weights(Contact& c, const Vector<N>& weights) const {
    if (surely_has_area()) {
      for (int i = 0; i < 3; ++i)
        (i == 0   ? c.impact.weights.x
         : i == 1 ? c.impact.weights.y
                  : c.impact.weights.z) = assume_within(weights[i], 0.0, 1.0);
      return;
    }
    if constexpr (is_enclosure<N>) {
      const N anything(-0x1p500, 0x1p500);
      c.impact.weights = {anything, anything, anything};
    } else {
      c.any_weights = true;
    }
  }
  static Vector<N> vertex_weights(int i) { return {N(i == 0 ? 1 : 0), N(i == 1 ? 1 : 0), N(i == 2 ? 1 : 0)}; }
  static Vector<N> edge_weights(int i, const N& along) {
    Vector<N> w{N(0), N(0), N(0)};
    w[i] = N(1) - along;
    w[(i + 1) % 3] = along;
    return w;
  }

  /// A place on the triangle's boundary or inside, and the outward normals there.
  struct Place {
    Vector<N> point, weights;
    Normals<N> cone;
  };
  Place vertex(int i) const { return {corner_[i], vertex_weights(i), vertex_cone(i)}; }
  /// The point of edge i at the same parameter as the given point.
  Place on_edge(int i, const Vector<N>& w) const {
    N along(0);
    if constexpr (is_enclosure<N>) along = N(0, 1);
    if (!may_be_zero(e2_[i])) along = assume_within(N(dot(w, e_[i]) / e2_[i]), 0.0, 1.0);
    return {plus(corner_[i], times(e_[i], along)), edge_weights(i, along), edge_cone(i)};
  }

  int longest() const {
    int l = 0;
    for (int i = 1; i < 3; ++i) {
      if (bounds(e2_[i]).low > bounds(e2_[l]).low) l = i;
    }
    return l;
  }
  /// How far the triangle extends from its longest edge; for a triangle that may have no area.
  N thickness() const {
    if constexpr (is_enclosure<N>) {
      const int l = longest();
      const N other = e2_[(l + 1) % 3];
      if (may_be_zero(e2_[l])) return N(0, root(N(std::max({e2_[0].sup(), e2_[1].sup(), e2_[2].sup()}))).sup());
      const N by_area = root(n2_) / root(e2_[l]);
      return N(0, std::min(by_area.sup(), root(other).sup()));
    } else {
      return N(0);
    }
  }
  /// The point nearest to x, which is over the face, on the line of the longest edge. It lies beyond the edge's ends by
  /// no more than the third corner's foot: if edges have nearly the same length, the given edge may not be the longest.
  Vector<N> beside_longest_edge(const Vector<N>& x) const {
    const int l = longest();
    if (may_be_zero(e2_[l])) return on_edge(l, minus(x, corner_[l])).point;
    const N third = join(join(N(0), N(1)), N(N(1) + dot(e_[l], e_[(l + 1) % 3]) / e2_[l]));
    const N along = dot(minus(x, corner_[l]), e_[l]) / e2_[l];
    return plus(corner_[l], times(e_[l], N(assume_within(along, bounds(third).low, bounds(third).high))));
  }
  /// The foot of a point on the plane, if it may lie in the face; empty otherwise. Also bounds an enclosure by its
  /// distance from the longest edge's line, at most the triangle's thickness, which tightens only thin triangles.
  std::optional<Place> in_face(const Vector<N>& x) const {
    Place place{{}, {N(0), N(0), N(0)}, face_cone()};
    if constexpr (is_enclosure<N>) {
      const N about = thickness() * N(-1, 1);
      const Vector<N> by_edge = beside_longest_edge(x);
      for (int k = 0; k < 3; ++k) place.point[k] = assume_within(by_edge[k] + about, lowest(k).inf(), highest(k).sup());
    }
    if (surely_has_area()) {
      const N up = dot(n_, minus(x, corner_[0])) / n2_;
      const Vector<N> foot = minus(x, times(n_, up));
      for (int k = 0; k < 3; ++k) {
        if (!is_enclosure<N>) place.point[k] = foot[k];
        if (!narrow(place.point[k], foot[k])) return std::nullopt;
      }
      for (int i = 0; i < 3; ++i) {
        place.weights[(i + 2) % 3] = -dot(out_[i], minus(x, corner_[i])) / n2_;
      }
    }
    return place;
  }

  bool may_be_at_vertex(int i, const Vector<N>& x) const {
    const Vector<N> w = minus(x, corner_[i]);
    return may_be_at_most_zero(N(dot(w, e_[i]))) && may_be_at_least_zero(N(dot(w, e_[(i + 2) % 3])));
  }
  bool may_be_at_edge(int i, const Vector<N>& x) const {
    const Vector<N> w = minus(x, corner_[i]);
    const N along = dot(w, e_[i]);
    return may_be_positive(e2_[i]) && may_be_at_least_zero(along) && may_be_at_most(along, e2_[i]) &&
           may_be_at_least_zero(N(dot(w, out_[i])));
  }
  bool may_be_over_face(const Vector<N>& x) const {
    bool may = may_have_area();
    for (int i = 0; i < 3; ++i) may = may && may_be_at_most_zero(N(dot(minus(x, corner_[i]), out_[i])));
    return may;
  }

  /// Reports contacts at time 0. Returns whether the sphere may start apart.
  bool start() {
    bool may_start_apart = false;
    const auto from = [&](const Place& place, const N& tighter2, bool over_face) {
      const Vector<N> away = minus(p_, place.point);
      const N distance2 = meet(norm2(away), tighter2);
      const N outside = distance2 - square(r_);
      if (may_be_positive(outside)) may_start_apart = true;
      if (!may_be_at_most_zero(outside)) return;
      Contact c{{N(0), answer_vector(place.point), {}, {}}};
      set_weights(c, place.weights);
      if (may_be_zero(distance2)) {  // a triangle has an outward normal against every motion
        const bool surely_on_it = surely_zero(distance2) || surely_zero(r_);
        c.normals = surely_on_it ? place.cone.against(v_) : place.cone;
        all_.list.push_back(c);
        return;
      }
      const N leaving = dot(away, v_);
      if (may_be_zero(outside) && may_be_positive(leaving)) all_.may_miss = true;
      if (!may_be_negative(outside) && !may_be_at_most_zero(leaving)) return;
      const Vector<N> unit = times(away, N(N(1) / root(distance2)));
      const auto add = [&](Vector<N> normal) {
        for (N& x : normal) x = assume_within(x, -1.0, 1.0);
        c.impact.normal = answer_vector(normal);
        all_.list.push_back(c);
      };
      if (!over_face || !surely_has_area()) return add(unit);
      const N height = dot(n_, from_corner(0)), length = root(n2_);
      if (may_be_at_least_zero(height)) add(times(n_, N(length / n2_)));
      if (may_be_at_most_zero(height)) add(times(n_, N(-length / n2_)));
    };
    for (int i = 0; i < 3; ++i) {
      if (may_be_at_vertex(i, p_)) from(vertex(i), norm2(from_corner(i)), false);
      if (!may_be_at_edge(i, p_)) continue;
      const Place place = on_edge(i, from_corner(i));
      N tighter2 = norm2(minus(p_, place.point));
      if (!may_be_zero(e2_[i])) tighter2 = meet(tighter2, N(norm2(cross(from_corner(i), e_[i])) / e2_[i]));
      from(place, tighter2, false);
    }
    const std::optional<Place> foot = may_be_over_face(p_) ? in_face(p_) : std::nullopt;
    if (foot) {
      N tighter2 = norm2(minus(p_, foot->point));
      if (surely_has_area()) tighter2 = meet(tighter2, N(square(dot(n_, from_corner(0))) / n2_));
      from(*foot, tighter2, true);
    }
    if constexpr (is_enclosure<N>) {  // if an edge may have no length, little is known about the nearest feature
      if (may_start_apart && surely_overlaps_at_start()) return false;
    }
    return may_start_apart;
  }

  // Roots.

  /// The time at which a point at w with velocity u comes within sqrt(`reach2`) of the origin; `moment2` is |w x u|^2.
  /// Empty if it never does.
  std::optional<N> root_time(const Vector<N>& w, const Vector<N>& u, const N& reach2, const N& moment2,
                             const Window& window, bool& surely) const {
    const N closing = -dot(w, u);
    const N chord2 = norm2(u) * reach2 - moment2;
    if (!may_be_positive(closing) || !may_be_at_least_zero(chord2)) return std::nullopt;
    const N far = assume_at_least_zero(closing) + root(chord2);
    const std::optional<N> time = time_within(window, N(norm2(w) - reach2), far);
    if (!time || !may_be_at_least_zero(*time)) return std::nullopt;
    surely = !may_be_negative(chord2) && !may_be_at_most_zero(closing) && !may_be_negative(*time);
    return N(assume_at_least_zero(*time));
  }
  N moment2(const Vector<N>& w) const { return norm2(cross(w, v_)); }
  /// |(w x e) x (v x e)|^2 = |e|^2 (e . (w x v))^2.
  N moment2_about(int i, const Vector<N>& w) const { return e2_[i] * square(dot(e_[i], cross(w, v_))); }

  /// `away` is the vector from the place to the center.
  void add_root(const N& time, const Place& place, const Vector<N>& away, bool surely) {
    Contact c{{time, answer_vector(place.point), {}, {}}};
    set_weights(c, place.weights);
    if (may_be_zero(r_)) {
      c.normals = place.cone.against(v_);
    } else {
      Vector<N> unit = times(away, N(N(1) / r_));
      for (N& y : unit) y = assume_within(y, -1.0, 1.0);
      c.impact.normal = answer_vector(unit);
    }
    if (surely) surely_by_ = std::min(surely_by_, bounds(time).high);
    all_.list.push_back(std::move(c));
  }

  void vertex_root(int i) {
    const Vector<N> w = from_corner(i);
    Window window = near_;
    window.clip(times_not_positive(N(dot(w, e_[i])), N(dot(v_, e_[i]))));
    window.clip(times_not_positive(N(-dot(w, e_[(i + 2) % 3])), N(-dot(v_, e_[(i + 2) % 3]))));
    bool surely = false;
    if (is_enclosure<N>) {  // the ball about the vertex is an upper bound in every region
      const auto bound = root_time(w, v_, square(r_), moment2(w), near_, surely);
      if (bound && surely) surely_by_ = std::min(surely_by_, bounds(*bound).high);
    }
    if (window.empty()) return;
    const auto time = root_time(w, v_, square(r_), moment2(w), window, surely);
    if (!time) return;
    N narrowed = *time;
    if constexpr (is_enclosure<N>) {
      if (!narrow_to_reach(w, v_, nullptr, N(0), r_, narrowed)) return;
    }
    const Vector<N> x = at(narrowed);
    if (may_be_at_vertex(i, x)) add_root(narrowed, vertex(i), minus(x, corner_[i]), false);
  }

  void edge_root(int i) {
    if (!may_be_positive(e2_[i])) return;
    const Vector<N> w = from_corner(i);
    bool surely = false;
    if (may_be_zero(e2_[i])) return tiny_edge_root(i);
    Window window = near_;
    window.clip(times_not_positive(N(-dot(w, e_[i])), N(-dot(v_, e_[i]))));
    window.clip(times_not_positive(N(dot(w, e_[i]) - e2_[i]), N(dot(v_, e_[i]))));
    if constexpr (is_enclosure<N>) window.clip(times_near_edge(i, r_));
    if (window.empty()) return;
    const auto of_line =
        root_time(cross(w, e_[i]), cross(v_, e_[i]), N(square(r_) * e2_[i]), moment2_about(i, w), Window{}, surely);
    if (!of_line) return;
    N time = *of_line;
    if constexpr (is_enclosure<N>) {
      // Whether the line is certainly touched between the edge's ends. The window assumes so, hence the check comes
      // afterwards.
      const bool bounded = time.sup() < std::numeric_limits<double>::infinity();
      if (surely && bounded && surely_between(i, at(time))) surely_by_ = std::min(surely_by_, time.sup());
      window.clip({0, surely_by_});
      if (window.empty() || !narrow(time, N(window.from, window.to))) return;
    }
    const Vector<N> x = at(time);
    if (!may_be_at_edge(i, x)) return;
    Place place = on_edge(i, minus(x, corner_[i]));
    Vector<N> away = minus(x, place.point);
    if (edge_about_middle(i, time, place, away)) add_root(time, place, away, false);
  }
  /// A center within reach of an edge is at most reach plus the edge's length away from the edge's start. The line of a
  /// short edge, whose direction is hardly known, passes near much that the edge does not.
  Window times_near_edge(int i, const N& reach) const {
    const Vector<N> w = from_corner(i);
    return times_within(w, v_, square(N(reach + root(e2_[i]))), moment2(w));
  }
  bool surely_between(int i, const Vector<N>& x) const {
    const N along = dot(minus(x, corner_[i]), e_[i]);
    return !may_be_negative(along) && !may_be_positive(N(along - e2_[i]));
  }

  // The same contacts about a fixed time and a fixed place on the feature; false if the intersection is empty.

  bool all_moderate(const N& time) const {
    if constexpr (is_enclosure<N>) {
      bool all = is_moderate(p_) && is_moderate(v_) && is_moderate(time) && is_moderate(r_);
      for (const Vector<N>& c : corner_) all = all && is_moderate(c);
      return all;
    } else {
      return true;
    }
  }

  bool edge_about_middle(int i, N& time, Place& place, Vector<N>& away) const {
    if constexpr (is_enclosure<N>) {
      const int j = (i + 1) % 3;
      if (!all_moderate(time) || !is_moderate(N(N(1) / e2_[i]))) return true;
      const N s0(near_middle(place.weights[j]));
      const Vector<N> middle = plus(times(corner_[i], N(N(1) - s0)), times(corner_[j], s0)), from = minus(p_, middle);
      if (!narrow_to_reach(from, v_, &e_[i], e2_[i], r_, time)) return false;
      const Vector<N> center = plus(from, times(v_, time));
      const N further = dot(center, e_[i]) / e2_[i];
      const Vector<N> on = times(e_[i], further);
      return narrow(place.point, plus(middle, on)) && narrow(away, minus(center, on)) &&
             narrow(place.weights[j], N(s0 + further)) && narrow(place.weights[i], N(N(1) - s0 - further));
    }
    return true;
  }

  bool face_about_middle(N& time, Place& place) const {
    if constexpr (is_enclosure<N>) {
      if (!all_moderate(time) || !is_moderate(N(N(1) / n2_))) return true;
      const double t0 = near_middle(time);
      std::array<double, 3> x0;
      for (int k = 0; k < 3; ++k) x0[k] = near_middle(p_[k]) + near_middle(v_[k]) * t0;
      const std::array<double, 2> weight = near_weights(corner_, x0);
      if (!(std::abs(weight[0]) < 0x1p20 && std::abs(weight[1]) < 0x1p20)) return true;
      const Vector<N> middle = combined(corner_, weight), from = minus(p_, middle);
      // The squared height is the squared distance minus that within the plane, which is about zero.
      const Vector<N> at_t0 = plus(from, times(v_, N(t0))), at_any = plus(from, times(v_, join(time, N(t0))));
      const N beyond = norm2(at_t0) - norm2(cross(n_, at_t0)) / n2_ - square(r_);
      const N slope = dot(n_, v_) * dot(n_, at_any) / n2_;
      if (!may_be_zero(slope) && is_moderate(beyond)) {
        if (!narrow(time, N(N(t0) - beyond / (N(2) * slope)))) return false;
      }
      const Vector<N> center = plus(from, times(v_, time));
      if (!narrow(place.point, plus(middle, minus(center, times(n_, N(dot(n_, center) / n2_)))))) return false;
      const Vector<N> fixed{N(N(1) - N(weight[0]) - N(weight[1])), N(weight[0]), N(weight[1])};
      for (int i = 0; i < 3; ++i) {
        const int k = (i + 2) % 3;
        if (!narrow(place.weights[k], N(fixed[k] - dot(out_[i], center) / n2_))) return false;
      }
    }
    return true;
  }

  /// An edge that may be a point: within its length of the ball about its vertex.
  void tiny_edge_root(int i) {
    if constexpr (is_enclosure<N>) {
      const Vector<N> w = from_corner(i);
      Window times = times_near_edge(i, r_);
      times.clip(near_);
      times.clip({0, surely_by_});
      if (times.empty()) return;
      const N time(times.from, times.to);
      const Place place = on_edge(i, w);
      add_root(time, place, minus(at(time), place.point), false);
    }
  }

  void face_root() {
    const N approach = -dot(n_, v_), height = dot(n_, from_corner(0));
    if (!may_have_area() || !may_be_positive(approach) || !may_be_at_least_zero(height)) return;
    if (!surely_has_area()) return thin_face_root();
    Window window = near_;
    for (int i = 0; i < 3; ++i) {
      window.clip(times_not_positive(N(dot(from_corner(i), out_[i])), N(dot(v_, out_[i]))));
    }
    if (window.empty()) return;
    const N length = root(n2_);
    const std::optional<N> crossing = time_within(window, N(height - r_ * length), approach);
    if (!crossing || !may_be_at_least_zero(*crossing)) return;
    N time = assume_at_least_zero(*crossing);
    const Vector<N> x = at(time);
    if (!may_be_over_face(x)) return;
    std::optional<Place> foot = in_face(x);
    if (!foot) return;
    Place& place = *foot;
    const Vector<N> touching = minus(x, times(n_, N(r_ * length / n2_)));
    for (int k = 0; k < 3; ++k) {
      if (!narrow(place.point[k], touching[k])) return;
    }
    if (!face_about_middle(time, place)) return;
    Window near_edge = times_near_longest_edge();
    near_edge.clip(near_);
    if (near_edge.empty()) return;
    Contact c{{time, answer_vector(place.point), {}, {}}};
    set_weights(c, place.weights);
    Vector<N> unit = times(n_, N(length / n2_));
    for (N& y : unit) y = assume_within(y, -1.0, 1.0);
    c.impact.normal = answer_vector(unit);
    all_.list.push_back(std::move(c));
  }

  /// How far the triangle extends from its longest edge: the distance of its third corner from the line, or from an
  /// end.
  double reach_from_longest_edge() const {
    const int l = longest();
    const double most = std::min(root(e2_[(l + 1) % 3]).sup(), root(e2_[(l + 2) % 3]).sup());
    if (may_be_zero(e2_[l])) return most;
    const N third = N(1) + dot(e_[l], e_[(l + 1) % 3]) / e2_[l];
    const bool beside = !may_be_negative(third) && !may_be_positive(N(third - N(1)));
    return beside ? std::min(most, N(root(n2_) / root(e2_[l])).sup()) : most;
  }
  /// The sphere touches the triangle only while the center is within the radius plus the triangle's extent of the
  /// longest edge. This holds for every triangle, but tightens only thin ones.
  Window times_near_longest_edge() const {
    Window times;
    if constexpr (is_enclosure<N>) {
      const int l = longest();
      const Vector<N> w = from_corner(l), other = from_corner((l + 1) % 3);
      const N reach = r_ + N(reach_from_longest_edge());
      if (may_be_zero(e2_[l])) return times_near_edge(l, reach);
      times = times_within(w, v_, square(reach), moment2(w));
      times.include(times_within(other, v_, square(reach), moment2(other)));
      Window beside = times_within(cross(w, e_[l]), cross(v_, e_[l]), N(square(reach) * e2_[l]), moment2_about(l, w));
      beside.clip(times_not_positive(N(-dot(w, e_[l])), N(-dot(v_, e_[l]))));
      beside.clip(times_not_positive(N(dot(w, e_[l]) - e2_[l]), N(dot(v_, e_[l]))));
      beside.clip(times_near_edge(l, reach));
      times.include(beside);
    }
    return times;
  }

  /// The same for the place that a sphere at x touches: near it is a place on the longest edge, within reach of x.
  /// False if there is none.
  bool narrow_to_longest_edge(const Vector<N>& x, Vector<N>& place) const {
    if constexpr (is_enclosure<N>) {
      const int l = longest();
      if (may_be_zero(e2_[l])) return true;
      const double off = reach_from_longest_edge();
      const Vector<N> w = minus(corner_[l], x);
      Window along = times_within(w, e_[l], square(N(r_ + N(off))), norm2(cross(w, e_[l])));
      along.clip({0, 1});
      if (along.empty()) return false;
      for (int k = 0; k < 3; ++k) {
        if (!narrow(place[k], N(corner_[l][k] + e_[l][k] * N(along.from, along.to) + N(-off, off)))) return false;
      }
    }
    return true;
  }

  /// A face that may have no area.
  void thin_face_root() {
    if constexpr (is_enclosure<N>) {
      Window times = times_near_longest_edge();
      times.clip(near_);
      times.clip({0, surely_by_});
      if (times.empty()) return;
      const N time(times.from, times.to);
      const Vector<N> x = at(time);
      std::optional<Place> place = in_face(x);
      if (place && narrow_to_longest_edge(x, place->point)) add_root(time, *place, minus(x, place->point), false);
    }
  }

  /// The least of the exact roots. Of enclosures, each root may be the least, except those after a contact that is
  /// certain.
  void keep_first(std::size_t at_start) {
    NumberVector<Contact>& list = all_.list;
    if constexpr (is_enclosure<N>) {
      const bool hits =
          surely_by_ < std::numeric_limits<double>::infinity() || center_surely_crosses() || surely_overlaps();
      if (!hits) all_.may_miss = true;
      if (surely_passes_) all_.surely_by = surely_by_;
      NumberVector<Contact> kept(list.begin(), list.begin() + std::ptrdiff_t(at_start));
      for (std::size_t i = at_start; i < list.size(); ++i) {
        if (list[i].impact.time.inf() > surely_by_) continue;
        list[i].impact.time = at_most(list[i].impact.time, surely_by_);
        kept.push_back(list[i]);
      }
      list = std::move(kept);
    } else {
      if (list.empty()) all_.may_miss = true;
      const NumberVector<Contact> before = list;
      list.clear();
      for (const Contact& c : before) {
        const bool first = std::none_of(before.begin(), before.end(), [&](const Contact& other) {
          return may_be_less(other.impact.time, c.impact.time);
        });
        if (first) list.push_back(c);
      }
    }
  }

  /// Whether the center certainly passes through the triangle from the front, however small the sphere.
  bool center_surely_crosses() const {
    if (may_be_at_least_zero(N(dot(n_, v_))) || may_be_at_most_zero(N(dot(n_, from_corner(0))))) return false;
    bool within = true;
    for (int i = 0; i < 3; ++i) {
      const N moment = -dot(v_, cross(from_corner(i), from_corner((i + 1) % 3)));
      within = within && !may_be_negative(moment);
    }
    return within;
  }

  // Certain overlap, at a time and a place found in plain doubles. How they are found proves nothing.

  struct Doubles {
    double p[3], v[3], c[3][3];
  };
  static double middle(const N& x) {
    const Bounds b = bounds(x);
    return 0.5 * b.low + 0.5 * b.high;
  }
  /// The weights of corners 1 and 2 at the point nearest to x, rounded to multiples of 2^-50, whose sums are exact.
  static std::array<double, 2> nearest_weights(const Doubles& d, const double* x) {
    double a[3], b[3], w[3];
    for (int k = 0; k < 3; ++k) a[k] = d.c[1][k] - d.c[0][k], b[k] = d.c[2][k] - d.c[0][k], w[k] = x[k] - d.c[0][k];
    const auto dot = [](const double* s, const double* t) { return s[0] * t[0] + s[1] * t[1] + s[2] * t[2]; };
    const double aa = dot(a, a), ab = dot(a, b), bb = dot(b, b), aw = dot(a, w), bw = dot(b, w);
    const double det = aa * bb - ab * ab;
    std::array<double, 2> best{0, 0};
    double best2 = std::numeric_limits<double>::infinity();
    const auto consider = [&](double s, double t) {
      s = std::floor(s * 0x1p50) * 0x1p-50, t = std::floor(t * 0x1p50) * 0x1p-50;
      if (!(s >= 0 && t >= 0 && s + t <= 1)) return;
      double distance2 = 0;
      for (int k = 0; k < 3; ++k) distance2 += (w[k] - s * a[k] - t * b[k]) * (w[k] - s * a[k] - t * b[k]);
      if (distance2 < best2) best2 = distance2, best = {s, t};
    };
    const auto clamp01 = [](double s) { return s > 0 ? std::min(s, 1.0) : 0.0; };
    if (det > 0) consider((aw * bb - bw * ab) / det, (bw * aa - aw * ab) / det);
    const auto share = [&](double part, double whole) { return whole > 0 ? clamp01(part / whole) : 0.0; };
    consider(share(aw, aa), 0), consider(0, share(bw, bb));
    const double along = share(bw - aw + aa - ab, aa - 2 * ab + bb);
    consider(1 - along, along);
    return best;
  }
  Doubles middles() const {
    Doubles d;
    for (int k = 0; k < 3; ++k) {
      d.p[k] = middle(p_[k]), d.v[k] = middle(v_[k]);
      for (int i = 0; i < 3; ++i) d.c[i][k] = middle(corner_[i][k]);
    }
    return d;
  }
  /// The squared distance, at that time, of the center from the place with those weights of corners 1 and 2, minus the
  /// squared radius.
  N beyond(double time, const std::array<double, 2>& weights) const {
    const Vector<N> q =
        plus(corner_[0], plus(times(e_[0], N(weights[0])), times(minus(corner_[2], corner_[0]), N(weights[1]))));
    return norm2(minus(at(N(time)), q)) - square(r_);
  }
  bool surely_overlaps_at_start() const {
    const Doubles d = middles();
    return !may_be_at_least_zero(beyond(0, nearest_weights(d, d.p)));
  }
  bool surely_overlaps() const {
    const Doubles d = middles();
    double from = near_.from, to = near_.to < Window{}.to ? near_.to : near_.from;
    const auto weights_at = [&](double t) {
      const double x[3] = {d.p[0] + d.v[0] * t, d.p[1] + d.v[1] * t, d.p[2] + d.v[2] * t};
      return nearest_weights(d, x);
    };
    constexpr int steps = 52;
    for (int step = 0; step < steps && from < to; ++step) {
      const double t = 0.5 * from + 0.5 * to;
      const auto [s, u] = weights_at(t);
      double slope = 0;
      for (int k = 0; k < 3; ++k) {
        const double q = d.c[0][k] + s * (d.c[1][k] - d.c[0][k]) + u * (d.c[2][k] - d.c[0][k]);
        slope += d.v[k] * (d.p[k] + d.v[k] * t - q);
      }
      (slope < 0 ? from : to) = t;
    }
    return !may_be_positive(beyond(from, weights_at(from)));
  }

  Vector<N> p_;
  N r_;
  Vector<N> v_;
  std::array<Vector<N>, 3> corner_, e_, out_;
  std::array<N, 3> e2_;
  Vector<N> n_;
  N n2_;
  bool surely_passes_ = false;
  Window near_;
  double surely_by_ = std::numeric_limits<double>::infinity();
  TriangleContacts<N> all_;
};

}  // namespace nearmiss::oracle
