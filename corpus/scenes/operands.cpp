#include "corpus/scenes/operands.hpp"

#include <algorithm>
#include <string_view>

namespace nearmiss::scenes {

namespace {

/// The fields of a shape behind its name.
struct Form {
  std::string_view fields;
  ShapeType type;
};
constexpr Form forms[] = {
    {"x y z", ShapeType::point},
    {"origin.x origin.y origin.z direction.x direction.y direction.z", ShapeType::point},
    {"center.x center.y center.z radius", ShapeType::sphere},
    {"p0.x p0.y p0.z p1.x p1.y p1.z radius", ShapeType::capsule},
    {"v0.x v0.y v0.z v1.x v1.y v1.z", ShapeType::segment},
    {"center.x center.y center.z half.x half.y half.z orientation.x orientation.y orientation.z orientation.w",
     ShapeType::box},
    {"min.x min.y min.z max.x max.y max.z", ShapeType::aabox},
    {"v0.x v0.y v0.z v1.x v1.y v1.z v2.x v2.y v2.z", ShapeType::triangle},
    {"v0.x v0.y v0.z v1.x v1.y v1.z v2.x v2.y v2.z v3.x v3.y v3.z", ShapeType::rectangle},
    {"normal.x normal.y normal.z offset", ShapeType::plane},
};

std::string_view before_point(std::string_view name) { return name.substr(0, name.find('.')); }

/// The fields of an input that follow each other, and where they end.
struct FieldsOfInput {
  std::string name, fields;
  std::size_t end;
};
FieldsOfInput group_at(const std::vector<Field>& inputs, std::size_t begin) {
  FieldsOfInput g{std::string(before_point(inputs[begin].name)), "", begin};
  for (; g.end < inputs.size() && before_point(inputs[g.end].name) == g.name; ++g.end) {
    const std::string& name = inputs[g.end].name;
    if (name.size() == g.name.size()) return {g.name, "", begin + 1};
    if (!g.fields.empty()) g.fields += ' ';
    g.fields.append(name, g.name.size() + 1);
  }
  return g;
}

bool is_filled_in(Role role) { return role == Role::time || role == Role::flag || role == Role::index; }

/// Adds a group of inputs; false where a scene cannot fill it in.
bool add(QueryPlan& plan, const Query& query, std::size_t begin, const FieldsOfInput& g) {
  const Role role = query.inputs[begin].role;
  if (g.fields.empty()) {
    plan.lone.push_back(begin);
    return is_filled_in(role);
  }
  if (g.fields == "x y z" && role == Role::velocity) {
    plan.velocity = begin;
    return true;
  }
  const auto form =
      std::find_if(std::begin(forms), std::end(forms), [&](const Form& f) { return f.fields == g.fields; });
  if (form == std::end(forms) || (form->type == ShapeType::point && role != Role::position)) return false;
  if (g.fields.find("direction") != std::string::npos) plan.direction = begin + 3;
  plan.operands.push_back({g.name, form->type, begin});
  return true;
}

}  // namespace

std::optional<QueryPlan> query_plan(const Query& query) {
  QueryPlan plan;
  if (query.kind == Kind::direction) return std::nullopt;  // asked after a contact, about its place
  for (std::size_t i = 0; i < query.inputs.size();) {
    const FieldsOfInput g = group_at(query.inputs, i);
    if (!add(plan, query, i, g)) return std::nullopt;
    i = g.end;
  }
  if (plan.operands.size() != 2) return std::nullopt;
  const bool plane_first = plan.operands[0].type == ShapeType::plane;
  if (plane_first) std::swap(plan.operands[0], plan.operands[1]);
  return plan;
}

}  // namespace nearmiss::scenes
