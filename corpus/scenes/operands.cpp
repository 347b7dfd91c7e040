#include "corpus/scenes/operands.hpp"

#include <utility>

namespace nearmiss::scenes {

namespace {

bool is_filled_in(Role role) { return role == Role::time || role == Role::flag || role == Role::index; }

/// Adds an input that is no shape; false where a scene cannot fill it in.
bool add_loose(QueryPlan& plan, const InputMember& m) {
  if (m.role == Role::velocity) {
    plan.velocity = m.begin;
  } else {
    plan.lone.push_back(m.begin);
  }
  return m.role == Role::velocity || is_filled_in(m.role);
}

}  // namespace

std::optional<QueryPlan> query_plan(const Query& query) {
  QueryPlan plan;
  if (query.kind == Kind::direction) return std::nullopt;  // asked after a contact, about its place
  if (!query.lists.empty()) return std::nullopt;           // a scene has no shape of any number of vertices
  for (const InputMember& m : query.operands.members) {
    if (!m.operand && !add_loose(plan, m)) return std::nullopt;
  }
  for (const Operand& o : query.operands) {
    if (o.shape == Shape::line) return std::nullopt;
    plan.operands.push_back(o);
    if (o.shape != Shape::ray) continue;
    plan.direction = o.direction;
    plan.operands.back().shape = Shape::point;
  }
  if (plan.operands.size() != 2) return std::nullopt;
  const bool plane_first = has_one_plane(plan.operands[0].shape);
  if (plane_first) std::swap(plan.operands[0], plan.operands[1]);
  return plan;
}

}  // namespace nearmiss::scenes
