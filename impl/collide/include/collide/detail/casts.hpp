/// The kernel of the casts of a rounded polytope against another one: points, spheres, segments, capsules, triangles
/// and boxes.
///
/// The signed distance D(t) of two shapes of which one is translated is convex, because the gap along each direction is
/// linear in time. So Newton's method from a time before the contact never passes it: a step goes as far as the gap
/// along the present normal allows. It ends where the motion does not lead along the normal, which is a miss, or at a
/// distance that may be its own rounding error: shapes without thickness are nowhere nearer when they meet.
///
/// Exact numbers prove what doubles propose. A direction along which the shapes are apart, and along which the motion
/// does not lead, proves a miss. Two features prove a contact: they give its time in closed form, and no vertex is
/// further along the way between them.
#pragma once

#include <optional>
#include <utility>

#include <collide/detail/contact.hpp>
#include <collide/detail/signed_distances.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

struct Certified;  // certified.hpp

namespace detail {

template <class T>
Vec3<T> translated(const Vec3<T>& point, const Vec3<T>& way) {
  return point + way;
}
template <class T>
Sphere<T> translated(const Sphere<T>& sphere, const Vec3<T>& way) {
  return {sphere.center + way, sphere.radius};
}
template <class T>
Segment<T> translated(const Segment<T>& segment, const Vec3<T>& way) {
  return {segment.v0 + way, segment.v1 + way};
}
template <class T>
Capsule<T> translated(const Capsule<T>& capsule, const Vec3<T>& way) {
  return {capsule.p0 + way, capsule.p1 + way, capsule.radius};
}
template <class T>
Triangle<T> translated(const Triangle<T>& triangle, const Vec3<T>& way) {
  return {triangle.v0 + way, triangle.v1 + way, triangle.v2 + way};
}
template <class T>
Box<T> translated(const Box<T>& box, const Vec3<T>& way) {
  return {box.center + way, box.half, box.orientation};
}

/// The largest magnitude of a coordinate or a size.
template <class T>
T largest_length(const Vec3<T>& point) {
  return largest(point);
}
template <class T>
T largest_length(const Sphere<T>& sphere) {
  return larger(largest(sphere.center), sphere.radius);
}
template <class T>
T largest_length(const Segment<T>& segment) {
  return larger(largest(segment.v0), largest(segment.v1));
}
template <class T>
T largest_length(const Capsule<T>& capsule) {
  return larger(larger(largest(capsule.p0), largest(capsule.p1)), capsule.radius);
}
template <class T>
T largest_length(const Triangle<T>& triangle) {
  return larger(larger(largest(triangle.v0), largest(triangle.v1)), largest(triangle.v2));
}
template <class T>
T largest_length(const Box<T>& box) {
  return larger(largest(box.center), largest(box.half));
}

template <class Shape>
double radius_in(const Shape& shape) {
  if constexpr (requires { shape.radius; }) {
    return shape.radius;
  } else {
    return 0;
  }
}

/// The contact that a signed distance describes: on the second shape, with a normal out of it.
template <class T>
Impact<T> contact_of(const T& time, const SignedDistance<T>& d) {
  return contact(time, d.point2, -d.normal);
}

/// What doubles say of a cast, for other numbers to prove: the shapes start in contact, or a direction along which they
/// stay apart, or features that meet.
struct CastGuess {
  enum class Kind { starts, misses, hits } kind = Kind::hits;
  Vec3<double> aside{};
  /// Whether doubles cannot tell that the shapes start apart. Otherwise they do: the distance has at most half of the
  /// bound's error (contracts::signed_distance).
  bool may_start_in_contact = true;
  struct Features {
    Vertices of, to;
  };
  std::array<Features, 4> features{};
  int count = 0;

  void add(Vertices of, Vertices to) {
    if (of != 0 && to != 0) features[count++] = {of, to};
  }
};

/// What is proved of a cast.
struct ProvedCast {
  CastGuess::Kind kind;
  CastGuess::Features features;
};

/// A contact of two cores: its time, the unit normal from the first one to the second one, and the point of the second
/// one.
template <class T>
struct MetCores {
  T time;
  Vec3<T> normal, on_b;
};

/// Whether 0 is between two numbers, or one of them.
template <class T>
bool has_zero_between(const T& first, const T& second) {
  return first >= T(0) ? second <= T(0) : second >= T(0);
}

/// Where the features that have a facet meet, a vertex and a face or two edges, when they are `radii` apart. None where
/// numbers that prove find that they do not.
template <class Tier, class A, class B, class T>
[[gnu::noinline]] std::optional<MetCores<T>> met_along_facet(const A& a, const B& b, const Vec3<T>& velocity,
                                                             const T& radii, const CastGuess::Features& features,
                                                             int facet) {
  constexpr bool proves = !FollowsDecisions<T>;
  const auto& [of, to] = features;
  const Vec3<T>&on_a = vertex_of(a, std::countr_zero(of)), &on_b = vertex_of(b, std::countr_zero(to));
  Vec3<T> direction = facet_of<Tier>(a, b, facet);
  const T length2 = Tier::dot(direction, direction);
  if constexpr (proves) {
    if (!(length2 > T(0))) return std::nullopt;
  }
  T approach = Tier::dot(direction, velocity);
  if (!(approach > T(0))) {
    if (!(approach < T(0))) return std::nullopt;
    direction = -direction, approach = -approach;
  }
  if constexpr (proves) {
    if (!is_furthest<Tier>(a, of, direction) || !is_furthest<Tier>(b, to, -direction)) return std::nullopt;
  }
  const T length = sqrt(length2), ahead = Tier::dot(direction, on_b - on_a) - radii * length;
  if constexpr (proves) {
    if (!(ahead > T(0))) return std::nullopt;
  }
  const T time = ahead / approach;
  const Vec3<T> way = velocity * time, then = on_a + way, normal = direction * (T(1) / length);
  const bool is_of_a = facet < a.count_of_normals,
             is_of_b = !is_of_a && facet < a.count_of_normals + b.count_of_normals;
  if (is_of_a || is_of_b) {
    if constexpr (proves) {
      if (is_of_a ? !is_across_face<Tier>(a, of, on_b - way) : !is_across_face<Tier>(b, to, then)) return std::nullopt;
    }
    return MetCores<T>{time, normal, is_of_a ? on_b : then + normal * radii};
  }
  if constexpr (A::most_edges > 0 && B::most_edges > 0) {
    const Vec3<T>&d = direction_at(a, direction_number(a, of)), &e = direction_at(b, direction_number(b, to));
    const Vec3<T> between = on_b - then, beside_b = Tier::cross(e, direction), beside_a = Tier::cross(d, direction);
    if constexpr (proves) {
      const Vec3<T>&end_a = vertex_of(a, last_of(of)), &end_b = vertex_of(b, last_of(to));
      if (!has_zero_between(Tier::dot(beside_b, between), Tier::dot(beside_b, on_b - (end_a + way))) ||
          !has_zero_between(Tier::dot(beside_a, between), Tier::dot(beside_a, end_b - then)))
        return std::nullopt;
    }
    // The point of the second edge that is across the first one.
    const T at = Tier::dot(beside_a, between) / Tier::dot(beside_a, e);
    return MetCores<T>{time, normal, on_b - e * at};
  }
  return std::nullopt;
}

/// The lesser root of a t^2 - 2 b t + c, where a and b are positive.
template <class T>
std::optional<T> first_root(const T& a, const T& b, const T& c) {
  if constexpr (!FollowsDecisions<T>) {
    if (!(a > T(0)) || !(b > T(0))) return std::nullopt;
  }
  const T discriminant = b * b - a * c;
  if constexpr (!FollowsDecisions<T>) {
    if (!(discriminant >= T(0))) return std::nullopt;
  }
  return c / (b + sqrt(discriminant));
}

/// Where a vertex meets a vertex or an edge of the other core, when they are `radii` apart.
template <class Tier, class A, class B, class T>
[[gnu::noinline]] std::optional<MetCores<T>> met_along_way(const A& a, const B& b, const Vec3<T>& velocity,
                                                           const T& radii, const CastGuess::Features& features) {
  constexpr bool proves = !FollowsDecisions<T>;
  const auto& [of, to] = features;
  if (std::popcount(of) + std::popcount(to) > 3) return std::nullopt;
  if constexpr (proves) {
    if (!(radii > T(0))) return std::nullopt;
  }
  const Vec3<T>&on_a = vertex_of(a, std::countr_zero(of)), &on_b = vertex_of(b, std::countr_zero(to));
  const Vec3<T> between = on_b - on_a;
  const auto along_edge = [&](const Vec3<T>& along, const Vec3<T>& first,
                              const Vec3<T>& last) -> std::optional<std::pair<T, Vec3<T>>> {
    const T length2 = Tier::dot(along, along);
    if constexpr (proves) {
      if (!(length2 > T(0))) return std::nullopt;
    }
    const Vec3<T> across = Tier::cross(between, along), turning = Tier::cross(velocity, along);
    const auto time = first_root<T>(Tier::dot(turning, turning), Tier::dot(across, turning),
                                    Tier::dot(across, across) - radii * radii * length2);
    if (!time) return std::nullopt;
    const Vec3<T> then = between - velocity * *time;
    if constexpr (proves) {
      if (!has_zero_between(Tier::dot(along, then + first), Tier::dot(along, then + last))) return std::nullopt;
    }
    return std::pair(*time, then - along * (Tier::dot(then, along) / length2));
  };
  std::optional<std::pair<T, Vec3<T>>> met;
  const Vec3<T> nowhere{};
  if constexpr (A::most_edges > 0) {
    if (std::popcount(of) == 2)
      met = along_edge(direction_at(a, direction_number(a, of)), nowhere, on_a - vertex_of(a, last_of(of)));
  }
  if constexpr (B::most_edges > 0) {
    if (std::popcount(to) == 2)
      met = along_edge(direction_at(b, direction_number(b, to)), nowhere, vertex_of(b, last_of(to)) - on_b);
  }
  if (std::popcount(of) == 1 && std::popcount(to) == 1) {
    const auto time = first_root<T>(Tier::dot(velocity, velocity), Tier::dot(between, velocity),
                                    Tier::dot(between, between) - radii * radii);
    if (time) met.emplace(*time, between - velocity * *time);
  }
  if (!met) return std::nullopt;
  const auto& [time, way] = *met;
  if constexpr (proves) {
    if (!(time > T(0)) || !is_furthest<Tier>(a, of, way, direction_of(b, to)) ||
        !is_furthest<Tier>(b, to, -way, direction_of(a, of)))
      return std::nullopt;
  }
  const Vec3<T> then = on_a + velocity * time;
  const bool is_on_vertex_of_b = std::popcount(to) == 1;
  return MetCores<T>{time, way * (T(1) / radii), is_on_vertex_of_b ? on_b : then + way};
}

template <class Tier, class A, class B, class T>
std::optional<MetCores<T>> met_between(const A& a, const B& b, const Vec3<T>& velocity, const T& radii,
                                       const CastGuess::Features& features) {
  const int facet = facet_of_features(a, features.of, b, features.to);
  return facet >= 0 ? met_along_facet<Tier>(a, b, velocity, radii, features, facet)
                    : met_along_way<Tier>(a, b, velocity, radii, features);
}

/// Calls f(vertices) for each vertex, edge and face of a core.
template <class T, int most, class F>
void for_each_feature(const Core<T, most>& core, F&& f) {
  for (Vertices some = distinct_vertices(core); some != 0; some &= some - 1) f(some & -some);
  if constexpr (most > 1) {
    for (int i = 0; i < count_of_edges(core); ++i) f(of_edge(core, i));
  }
  if constexpr (most == 3) f(all_vertices<3>);
  if constexpr (most == 8) {
    for (int axis = 0; axis < 3; ++axis) f(on_side(axis, false)), f(on_side(axis, true));
  }
}

/// Of cores that are further apart than their radii: the first of all contacts that features prove.
template <class Tier, class A, class B, class T>
std::optional<MetCores<T>> met_by_search(const A& a, const B& b, const Vec3<T>& velocity, const T& radii) {
  std::optional<MetCores<T>> first;
  for_each_feature(a, [&](Vertices of) {
    for_each_feature(b, [&](Vertices to) {
      const auto met = met_between<Tier>(a, b, velocity, radii, {of, to});
      if (met && (!first || met->time < first->time)) first = met;
    });
  });
  return first;
}

/// Of cores without radii: the directions that part them. The line of motion meets the difference of the cores if no
/// direction at a right angle to it does. Then the time of entry is the last one that a direction allows.
template <class Tier, class A, class B, class T>
class PartingDirections {
 public:
  PartingDirections(const A& a, const B& b, const Vec3<T>& velocity) : a_(a), b_(b), velocity_(velocity) {
    const auto of_edges = [&](const auto& core) {
      for (const Vec3<T>& d : core.directions) {
        include_across(Tier::cross(velocity_, d));
        include(Tier::cross(d, Tier::cross(velocity_, d)));
      }
    };
    of_edges(a), of_edges(b);
    for (const Vec3<T>& v : a.vertices) {
      for (const Vec3<T>& w : b.vertices) include_across(Tier::cross(velocity_, Tier::cross(w - v, velocity_)));
    }
    for_each_facet<Tier>(a, b, [&](const Vec3<T>& facet) { include(facet); });
    include(velocity_);
  }

  /// The line of motion misses.
  bool misses() const { return misses_ || !any_; }
  /// When it enters, and a direction that allows no later time.
  const T& time() const { return time_; }
  const Vec3<T>& last() const { return last_; }
  /// A direction along which cores that touch are not apart, and along which the motion does not lead back.
  std::optional<Vec3<T>> of_touch() const {
    std::optional<Vec3<T>> found;
    for_each_facet<Tier>(a_, b_, [&](const Vec3<T>& facet) {
      for (const Vec3<T>& d : {facet, -facet}) {
        if (!found && !(d == Vec3<T>{}) && gap_along<Tier>(d, a_, b_) == T(0) && Tier::dot(d, velocity_) >= T(0))
          found = d;
      }
    });
    return found;
  }

 private:
  void include_across(const Vec3<T>& d) {
    misses_ = misses_ || gap_along<Tier>(d, a_, b_) > T(0) || gap_along<Tier>(-d, a_, b_) > T(0);
  }
  void include(const Vec3<T>& either) {
    if (misses_) return;
    const T along = Tier::dot(either, velocity_);
    if (along == T(0)) return;
    const Vec3<T> d = along > T(0) ? either : -either;
    const T until = gap_along<Tier>(d, a_, b_) / abs(along);
    if (!any_ || until > time_) time_ = until, last_ = d;
    any_ = true;
  }

  const A& a_;
  const B& b_;
  const Vec3<T>& velocity_;
  bool misses_ = false, any_ = false;
  T time_{};
  Vec3<T> last_{};
};

/// Whether the difference of the cores has no volume: no three of their edges span the space.
template <class Tier, class A, class B>
bool is_difference_flat(const A& a, const B& b) {
  using T = typename A::Number;
  std::array<Vec3<T>, 6> edges{};
  std::size_t count = 0;
  const auto add = [&](const auto& core) {
    for (int i = 0; i < core.most_directions; ++i) {
      if constexpr (requires { core.reach; }) {
        edges[count++] = core.reach[std::size_t(i)];
      } else {
        edges[count++] = core.directions[std::size_t(i)];
      }
    }
  };
  add(a), add(b);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Vec3<T> across = Tier::cross(edges[i], edges[j]);
      for (std::size_t k = 0; k < j; ++k) {
        if (!(Tier::dot(across, edges[k]) == T(0))) return false;
      }
    }
  }
  return true;
}

}  // namespace detail

namespace kernels {

/// A normal of shapes that touch, if there is one that the motion does not lead against: they were apart, or touched,
/// a moment before.
template <class Tier, class A, class B, class T>
std::optional<Vec3<T>> normal_that_stays(const A& a, const Vec3<T>& velocity, const B& b, const T& size) {
  Vec3<T> back = -velocity;
  if (size > T(0)) {
    const int down = detail::ilogb(size) - 10 - detail::ilogb(detail::largest(velocity));
    back = {detail::ldexp(back.x, down), detail::ldexp(back.y, down), detail::ldexp(back.z, down)};
  }
  const SignedDistance<T> before = signed_distance<Tier>(detail::translated(a, back), b);
  if (!(before.distance >= T(0)) || !(Tier::dot(before.normal, velocity) >= T(0))) return std::nullopt;
  return before.normal;
}

/// Of machine numbers. Shapes that start apart by no more than rounding start apart.
template <class Tier, class A, class B, class T>
Impact<T> cast_by_steps(const A& a, const Vec3<T>& velocity, const B& b) {
  SignedDistance<T> now = signed_distance<Tier>(a, b);
  T time(0), closing = Tier::dot(now.normal, velocity);
  if (now.distance < T(0) || (now.distance == T(0) && closing >= T(0))) return detail::contact_of(time, now);
  const T size = larger(detail::largest_length(a), detail::largest_length(b));
  if (now.distance == T(0)) {
    const auto normal = normal_that_stays<Tier>(a, velocity, b, size);
    if (!normal) return Impact<T>::miss();
    now.normal = *normal;
    return detail::contact_of(time, now);
  }
  while (closing > T(0)) {
    const T next = time + now.distance / closing;
    if (!(next > time)) return detail::contact_of(time, now);
    const Vec3<T> before = now.normal;
    time = next;
    const Vec3<T> way = velocity * time;
    now = signed_distance<Tier>(detail::translated(a, way), b);
    closing = Tier::dot(now.normal, velocity);
    const T rounding = T(64) * std::numeric_limits<T>::epsilon() * larger(size, detail::largest(way));
    if (now.distance <= rounding) {
      if (!(closing > T(0))) now.normal = before;
      return detail::contact_of(time, now);
    }
  }
  return Impact<T>::miss();
}

/// What doubles say of a cast, and what was proved of it.
template <class A, class B, class T>
class CastProposal {
 public:
  /// The arguments must live as long.
  CastProposal(const A& a, const Vec3<T>& velocity, const B& b)
      : a_(a), velocity_(velocity), b_(b), guess_(guessed()) {}
  const detail::CastGuess& guess() const { return guess_; }

  std::optional<detail::ProvedCast> proved;
  /// The signed distance at the start, where it is 0 or rounds to 0.
  std::optional<SignedDistance<T>> start;

 private:
  using Guess = detail::CastGuess;

  Guess guessed() const {
    const auto first = detail::in_doubles(a_);
    const auto second = detail::in_doubles(b_);
    const Vec3<double> way = detail::in_doubles(velocity_);
    const double radii = detail::radius_in(first) + detail::radius_in(second);
    Guess guess;
    double time = 0, last_closing = 0;
    Vec3<double> last_normal{};
    constexpr int most_steps = 64;
    for (int step = 0; step < most_steps; ++step) {
      const auto there = guess_between(detail::translated(first, way * time), second);
      const double ahead = there.apart.apart - radii, closing = Plain::dot(there.apart.normal, way);
      if (step == 0) guess.may_start_in_contact = !(ahead > 16 * there.rounding);
      if (step == 0 && ahead <= 0) {
        guess.kind = Guess::Kind::starts;
        return guess;
      }
      if (ahead > 4 * there.rounding || step == 0) {
        guess.count = 0;
        guess.add(detail::distinct_of(there.a, there.apart.of), detail::distinct_of(there.b, there.apart.to));
        if (const auto at_normal = there.way_at_normal()) guess.add(at_normal->from_of, at_normal->to_of);
      }
      if (!(closing > 0)) {
        if (!(ahead > 0)) break;
        guess.kind = Guess::Kind::misses;
        // Of the last two normals, where both lead apart, a sum does that at a right angle to the motion.
        guess.aside = step == 0 ? there.apart.normal : there.apart.normal * last_closing - last_normal * closing;
        const double along = Plain::dot(guess.aside, way), speed2 = Plain::dot(way, way);
        const double back = detail::sqrt(Plain::dot(guess.aside, guess.aside) * speed2) * 0x1p-48;
        if (speed2 > 0 && along > -back) guess.aside = guess.aside - way * ((along + back) / speed2);
        return guess;
      }
      const double next = time + ahead / closing;
      if (!(next > time) || !(ahead > there.rounding)) break;
      time = next, last_closing = closing, last_normal = there.apart.normal;
    }
    return guess;
  }

  const A& a_;
  const Vec3<T>& velocity_;
  const B& b_;
  const Guess guess_;
};

/// Whether exact cores with radii touch. None if they overlap.
template <class Tier, class A, class B, class T>
std::optional<bool> touches(const A& a, const B& b, const T& radii, const detail::WayBetween<T>& nearest) {
  const T length2 = Tier::dot(nearest.way, nearest.way);
  if (radii > T(0)) {
    const T beyond = length2 - radii * radii;
    return beyond < T(0) ? std::nullopt : std::optional(beyond == T(0));
  }
  const auto most = detail::facet_of_most<Tier>(a, b);
  return most.facet >= 0 && most.gap < T(0) ? std::nullopt : std::optional(length2 == T(0));
}

/// Of exact numbers, where nothing that doubles propose has been proved. None of shapes that overlap at the start, which
/// only those do that `may_touch`.
template <class Tier, class T, class A, class B>
[[gnu::noinline]] std::optional<Impact<T>> cast_by_search(const Vec3<T>& origin, const Vec3<T>& velocity, const A& a,
                                                          const B& b, bool may_touch) {
  const T radii = a.radius + b.radius;
  const auto unit = [](const Vec3<T>& d) { return detail::unit_of<Tier>(d); };
  const auto answer = [&](const T& time, const Vec3<T>& on_b, const Vec3<T>& normal) {
    return detail::contact(time, (origin + on_b) - normal * b.radius, -normal);
  };
  const auto nearest = [&](const A& core) { return detail::shortest_of_ways<Tier>(core, b); };
  std::optional<detail::WayBetween<T>> at_touch;
  if (may_touch) {
    at_touch = nearest(a);
    const std::optional<bool> touch = touches<Tier>(a, b, radii, *at_touch);
    if (!touch) return std::nullopt;
    if (!*touch) at_touch.reset();
  }
  if (radii > T(0)) {
    if (at_touch) {
      if (!(Tier::dot(at_touch->way, velocity) >= T(0))) return Impact<T>::miss();
      return answer(T(0), at_touch->from + at_touch->way, unit(at_touch->way));
    }
    const auto met = detail::met_by_search<Tier>(a, b, velocity, radii);
    return met ? answer(met->time, met->on_b, met->normal) : Impact<T>::miss();
  }
  const detail::PartingDirections<Tier, A, B, T> parting(a, b, velocity);
  if (at_touch) {
    std::optional<Vec3<T>> along;
    if (!parting.misses() && parting.time() == T(0)) along = parting.last();
    if (!along) along = parting.of_touch();
    if (!along && detail::is_difference_flat<Tier>(a, b)) {
      along = detail::across_some_edge<Tier>(a, b);
      if (Tier::dot(*along, velocity) < T(0)) along = -*along;
    }
    return along ? answer(T(0), at_touch->from, unit(*along)) : Impact<T>::miss();
  }
  if (parting.misses() || !(parting.time() > T(0))) return Impact<T>::miss();
  return answer(parting.time(), nearest(A(detail::moved_by(velocity * parting.time(), a))).from, unit(parting.last()));
}

/// Of exact numbers, and of those with error bounds, for shapes that do not overlap at the start.
template <class Tier, class A, class B, class T, class Proposal>
Impact<T> exact_cast(const A& a, const Vec3<T>& velocity, const B& b, Proposal& proposal) {
  using Kind = detail::CastGuess::Kind;
  const auto& origin = detail::any_point_of(a);
  const auto first = detail::core_of<Tier>(a, origin);
  const auto second = detail::core_of<Tier>(b, origin);
  const T radii = first.radius + second.radius;
  const auto answer = [&](const detail::MetCores<T>& met) {
    return detail::contact(met.time, (origin + met.on_b) - met.normal * second.radius, -met.normal);
  };
  if constexpr (detail::FollowsDecisions<T>) {
    const detail::ProvedCast& proved = *proposal.proved;
    if (proved.kind == Kind::misses) return Impact<T>::miss();
    return answer(*detail::met_between<Tier>(first, second, velocity, radii, proved.features));
  } else {
    proposal.proved.reset();
    const detail::CastGuess& guess = proposal.guess();
    if (guess.kind == Kind::misses) {
      const Vec3<T> aside{T(guess.aside.x), T(guess.aside.y), T(guess.aside.z)};
      const auto misses = detail::found_without_doubt<T>([&]() -> std::optional<bool> {
        if (!(Tier::dot(aside, velocity) <= T(0))) return std::nullopt;
        const T gap = detail::gap_along<Tier>(aside, first, second);
        if (!(gap > T(0)) || !(gap * gap > radii * radii * Tier::dot(aside, aside))) return std::nullopt;
        return true;
      });
      if (misses) {
        proposal.proved = detail::ProvedCast{Kind::misses, {}};
        return Impact<T>::miss();
      }
    }
    for (int i = 0; i < guess.count && guess.kind == Kind::hits; ++i) {
      const detail::CastGuess::Features& features = guess.features[std::size_t(i)];
      const auto met = detail::found_without_doubt<T>(
          [&] { return detail::met_between<Tier>(first, second, velocity, radii, features); });
      if (!met) continue;
      proposal.proved = detail::ProvedCast{Kind::hits, features};
      return answer(*met);
    }
    if constexpr (requires { T::only_proves; }) {
      T::doubt() = true;
      return {};
    } else {
      const bool may_touch = proposal.start.has_value();
      const auto found = cast_by_search<Tier>(origin, velocity, first, second, may_touch);
      if (found) return *found;
      const auto exact = [](const auto& v) { return Vec3<T>{T(v.x), T(v.y), T(v.z)}; };
      return detail::contact(T(0), exact(proposal.start->point2), exact(-proposal.start->normal));
    }
  }
}

/// The kernel of every cast of this kind, as `Tier` lifts it; in one that proves, `start()` is the signed distance at
/// the start.
template <class Tier, class A, class B, class T, class Start>
Impact<T> lifted_cast(const A& a, const Vec3<T>& velocity, const B& b, const Start& start) {
  if constexpr (uses_filter<Tier, T>) {
    CastProposal<A, B, T> proposal(a, velocity, b);
    if (proposal.guess().may_start_in_contact) {
      const SignedDistance<T> d = start();
      if (d.distance < T(0)) {
        Impact<T> at_start = detail::contact_of(T(0), d);
        reject_nonfinite(at_start, a, velocity, b);
        return at_start;
      }
      if (d.distance == T(0)) proposal.start = d;
    }
    return Tier::lift(
        [&proposal](auto tier, const auto& one, const auto& way, const auto& other) {
          using In = decltype(tier);
          if constexpr (MachineNumber<std::remove_cvref_t<decltype(way.x)>>) {
            return cast_by_steps<In>(one, way, other);
          } else {
            return exact_cast<In>(one, way, other, proposal);
          }
        },
        a, velocity, b);
  } else {
    return Tier::lift([](auto tier, const auto& one, const auto& way,
                         const auto& other) { return cast_by_steps<decltype(tier)>(one, way, other); },
                      a, velocity, b);
  }
}

}  // namespace kernels

namespace contracts {

/// The signed distance at the time of contact has the errors of a signed distance. The shape is translated with an
/// error of 3 eps of the way, which is at most as long as start and contact together, and the quotient adds 2 eps of
/// the distance.
template <class Tier, class T>
constexpr Contract cast(double backward) {
  return Tier::template contract<T>(
      {.backward = backward, .unit = 8, .lowest = lowest_for<T>(3), .highest = highest_for<T>(3)});
}

}  // namespace contracts
}  // namespace collide

// NOLINTBEGIN(bugprone-macro-parentheses): a type and a name that is declared have none

/// Defines the function `name` of a moving and a fixed shape, its kernel and its contract. `distance` is their signed
/// distance.
#define COLLIDE_CAST(backward, name, distance, First, first, Second, second)                                          \
  COLLIDE_COMPILED(name)                                                                                              \
  namespace kernels {                                                                                                 \
  template <class Tier, class T>                                                                                      \
  inline Impact<T> name(const First<T>& first, const Vec3<T>& velocity, const Second<T>& second) {                    \
    if constexpr (Tier::template lifts<T>) {                                                                          \
      using In = TierOfSignedDistance<Tier, First<T>, Second<T>>;                                                     \
      const auto start = [&] { return compiled::distance<SignedDistance<T>, Certified>(first, second); };             \
      return lifted_cast<In>(detail::with_moderate_rotation(first), velocity, detail::with_moderate_rotation(second), \
                             start);                                                                                  \
    } else {                                                                                                          \
      return cast_by_steps<Tier>(first, velocity, second);                                                            \
    }                                                                                                                 \
  }                                                                                                                   \
  }                                                                                                                   \
  namespace contracts {                                                                                               \
  template <class Tier = Fast, class T = double>                                                                      \
  constexpr Contract name() {                                                                                         \
    return cast<Tier, T>(backward);                                                                                   \
  }                                                                                                                   \
  }                                                                                                                   \
  template <class Tier = Fast, class T>                                                                               \
  [[nodiscard]] inline Impact<T> name(const First<T>& first, const Vec3<T>& velocity,                                 \
                                      const Second<T>& second) noexcept(Tier::never_throws) {                         \
    COLLIDE_ANSWER(name, TierOfDecisions<Tier>, first, velocity, second);                                             \
  }

// NOLINTEND(bugprone-macro-parentheses)

#include <collide/detail/strict_end.hpp>
