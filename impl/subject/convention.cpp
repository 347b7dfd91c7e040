#include "impl/subject/convention.hpp"

#include <algorithm>

#include "impl/catalogue/query.hpp"

namespace nearmiss {

namespace {

/// A moving body, or a ray, with an obstacle.
bool has_motion(const Query& q) { return q.operands.start && !q.operands.velocities.empty(); }
bool has_plane(const Query& q) { return q.operands.find(Shape::plane) != nullptr; }
bool gives(const Query& q, Role role) { return q.layout.at(role) != nullptr; }
bool has_limit(const Query& q) { return q.operands.at(Role::time) != nullptr; }

/// Every normal of a hit from behind is that of the back: not of a sphere, which meets edges too.
bool has_normal_of_face(const Query& q) {
  return q.traits.one_sided && gives(q, Role::normal) &&
         (!q.operands.start->radius || q.operands.start->obstacle.shape == Shape::plane);
}

}  // namespace

std::optional<Convention> convention_named(std::string_view name) {
  const auto found =
      std::find_if(all_conventions.begin(), all_conventions.end(), [&](Convention c) { return name_of(c) == name; });
  return found == all_conventions.end() ? std::nullopt : std::optional(*found);
}

std::string convention_names() {
  std::string names;
  for (const Convention c : all_conventions) names.append(names.empty() ? "" : ", ").append(name_of(c));
  return names;
}

bool concerns(Convention c, const Query& query) {
  const bool is_impact = query.kind == Kind::impact && has_motion(query);
  const auto& start = query.operands.start;
  switch (c) {
    case Convention::two_sided: return query.traits.one_sided || (query.kind == Kind::depth && has_plane(query));
    case Convention::normal_of_front: return has_normal_of_face(query);
    case Convention::normal_reversed: return gives(query, Role::normal);
    case Convention::start_is_miss:
    case Convention::start_is_hit: return is_impact;
    case Convention::exit_from_start:
      return start && start->obstacle.shape != Shape::halfspace && !query.traits.one_sided &&
             gives(query, Role::position);
    case Convention::ends_at_time_one: return is_impact || (query.kind == Kind::decision && start && has_limit(query));
    case Convention::strict_touch:
      return (query.kind == Kind::impact || query.kind == Kind::decision) && query.operands.size() == 2;
    case Convention::center_for_contact: return is_impact && start->radius && gives(query, Role::position);
    case Convention::unit_directions: return !query.operands.directions.empty();
  }
  return false;
}

std::optional<Convention> contradicted(Convention c, Conventions others) {
  constexpr std::array of_starts{Convention::start_is_miss, Convention::start_is_hit, Convention::exit_from_start};
  if (std::find(of_starts.begin(), of_starts.end(), c) == of_starts.end()) return std::nullopt;
  for (const Convention other : of_starts) {
    if (other != c && others.has(other)) return other;
  }
  return std::nullopt;
}

}  // namespace nearmiss
