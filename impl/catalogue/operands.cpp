#include "impl/catalogue/operands.hpp"

#include <algorithm>
#include <stdexcept>

namespace nearmiss {

namespace {

std::vector<std::size_t> numbers_from(std::size_t begin, std::size_t count) {
  std::vector<std::size_t> all(count);
  for (std::size_t k = 0; k < count; ++k) all[k] = begin + k;
  return all;
}

/// "the sphere", "box 2", "the fixed sphere".
std::string words_of(std::string_view name, Shape shape) {
  const std::string_view words = traits_of(shape).words;
  if (name.back() == '1' || name.back() == '2') {
    return std::string(name.substr(0, name.size() - 1)) + " " + name.back();
  }
  if (name == name_of(shape)) return "the " + std::string(words);
  if (find_shape(name)) return "the " + std::string(name);
  return "the " + std::string(name) + " " + std::string(words);
}

void add_member(Operand& operand, const ShapeMember& m) {
  const std::size_t at = operand.begin + m.begin;
  switch (m.role) {
    case Role::position: operand.positions.push_back(at); break;
    case Role::rotation: operand.rotation = at; break;
    case Role::direction: operand.direction = at; break;
    case Role::offset: operand.offset = at; break;
    case Role::count: break;
    case Role::size:
      (m.count == 1 ? operand.radius : operand.half) = at;
      for (const std::size_t i : numbers_from(at, m.count)) operand.sizes.push_back(i);
      break;
    default: throw std::logic_error("no shape has a member with that role");
  }
}

/// Collects the inputs in their order.
class Collection {
 public:
  Operands result() && {
    set_start();
    return std::move(all_);
  }

  void add(const ListedInput& input) {
    if (input.shape) {
      add_operand(input);
    } else {
      all_.members.push_back({std::string(input.name), at_, input.count, input.role, std::nullopt});
      add_loose(input);
    }
    at_ += input.count;
  }

 private:
  void add_operand(const ListedInput& input) {
    Operand operand{std::string(input.name), words_of(input.name, *input.shape), *input.shape, at_, input.count};
    operand.members = input.members.empty() ? operand.traits().members : input.members;
    for (const ShapeMember& m : operand.members) {
      const std::string name = m.name.empty() ? operand.name : operand.name + "." + m.name;
      all_.members.push_back({name, at_ + m.begin, m.count, m.role, all_.all.size()});
      add_member(operand, m);
    }
    list(operand);
    all_.all.push_back(std::move(operand));
  }

  void list(const Operand& o) {
    const auto corner = [&](std::size_t k) { return o.positions[k]; };
    if (o.shape == Shape::rectangle) all_.rectangles.push_back({corner(0), corner(1), corner(2), corner(3)});
    if (o.shape == Shape::aabox) all_.aaboxes.push_back(o.begin);
    for (const auto& [a, b, c] : o.traits().faces) all_.triangles.push_back({corner(a), corner(b), corner(c)});
    if (o.traits().faces.empty()) {
      for (const auto& [a, b] : o.traits().edges) all_.segments.push_back({corner(a), corner(b)});
    }
    if (o.rotation) all_.quaternions.push_back(*o.rotation);
    if (o.direction) (o.offset ? all_.normals : all_.directions).push_back(*o.direction);
    all_.sizes.insert(all_.sizes.end(), o.sizes.begin(), o.sizes.end());
  }

  /// The operand before a velocity moves.
  void add_loose(const ListedInput& input) {
    if (input.role == Role::velocity) {
      all_.velocities.push_back(at_);
      all_.all.back().velocity = at_;
    }
    if (input.role == Role::direction) (input.name == "normal" ? all_.normals : all_.directions).push_back(at_);
    if (input.role == Role::size) all_.sizes.push_back(at_);
  }

  static bool is_ball_or_point(const Operand& o) { return o.positions.size() == 1 && !o.half; }
  void set_start() {
    if (all_.all.empty()) return;
    const Operand& mover = all_.all.front();
    if (mover.shape != Shape::ray && !(mover.velocity && is_ball_or_point(mover))) return;
    const auto obstacle = std::find_if(all_.all.begin() + 1, all_.all.end(), [](const Operand& o) {
      return o.shape != Shape::point && o.shape != Shape::segment && o.shape != Shape::line && o.shape != Shape::ray;
    });
    if (obstacle != all_.all.end()) all_.start = Operands::Start{mover.begin, mover.radius, *obstacle};
  }

  Operands all_;
  std::size_t at_ = 0;
};

}  // namespace

std::optional<std::size_t> Operand::member(std::string_view wanted) const {
  const auto found = std::ranges::find(members, wanted, &ShapeMember::name);
  return found == members.end() ? std::nullopt : std::optional(begin + found->begin);
}

const Operand* Operands::find(std::string_view name) const {
  const auto found = std::ranges::find(all, name, &Operand::name);
  return found == all.end() ? nullptr : &*found;
}

const Operand* Operands::find(Shape shape) const {
  const auto found = std::ranges::find(all, shape, &Operand::shape);
  return found == all.end() ? nullptr : &*found;
}

const Operand* Operands::of_number(std::size_t number) const {
  const auto found = std::ranges::find_if(all, [number](const Operand& o) { return o.has(number); });
  return found == all.end() ? nullptr : &*found;
}

const InputMember* Operands::at(Role role) const {
  const auto found = std::ranges::find(members, role, &InputMember::role);
  return found == members.end() ? nullptr : &*found;
}

const InputMember& Operands::member_of(std::size_t number) const {
  const auto found = std::ranges::find_if(
      members, [number](const InputMember& m) { return number >= m.begin && number < m.begin + m.count; });
  if (found == members.end()) throw std::logic_error("the query has no input with that number");
  return *found;
}

Operands operands_of(const std::vector<ListedInput>& inputs) {
  Collection collection;
  for (const ListedInput& input : inputs) collection.add(input);
  return std::move(collection).result();
}

}  // namespace nearmiss
