/// Operands tell what the numbers of a query mean: their shapes agree with the names and roles that the query lists.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "corpus/generator/generator.hpp"
#include "impl/catalogue/query.hpp"

namespace nearmiss {
namespace {

TEST(Shapes, HaveTheMembersOfTheirStructs) {
  std::set<Shape> seen;
  for (const Query& q : catalogue()) {
    for (const Operand& o : q.operands) {
      seen.insert(o.shape);
      ASSERT_EQ(o.count, o.traits().numbers()) << q.name << " " << o.name;
      for (const ShapeMember& m : o.traits().members) {
        const std::string member = m.name.empty() ? o.name : o.name + "." + std::string(m.name);
        for (std::size_t k = 0; k < m.count; ++k) {
          const Field& f = q.inputs[o.begin + m.begin + k];
          EXPECT_EQ(f.role, m.role) << q.name << " " << f.name;
          EXPECT_EQ(f.name, m.count == 1 ? member : member + "." + "xyzw"[k]) << q.name;
        }
      }
    }
  }
  EXPECT_EQ(seen.size(), all_shapes().size()) << "each shape is an operand of some query";
}

TEST(Shapes, AreFoundByTheirNames) {
  for (const ShapeTraits& t : all_shapes()) {
    EXPECT_EQ(&traits_of(t.shape), &t);
    EXPECT_EQ(find_shape(t.name), t.shape);
    EXPECT_EQ(name_of(t.shape), t.name);
    for (const auto& edge : t.edges) {
      for (const auto k : edge) EXPECT_EQ(t.members[k].role, Role::position) << t.name;
    }
    for (const auto& face : t.faces) {
      for (const auto k : face) EXPECT_EQ(t.members[k].role, Role::position) << t.name;
    }
  }
  EXPECT_EQ(find_shape("cone"), std::nullopt);
}

TEST(Operands, MembersCoverEveryInputOnce) {
  for (const Query& q : catalogue()) {
    std::size_t at = 0;
    for (const InputMember& m : q.operands.members) {
      EXPECT_EQ(m.begin, at) << q.name << " " << m.name;
      at += m.count;
      EXPECT_EQ(&q.operands.member_of(m.begin), &m);
      EXPECT_EQ(q.operands.of_number(m.begin), m.operand ? &q.operands[*m.operand] : nullptr) << m.name;
      EXPECT_TRUE(m.operand || m.role != Role::position) << q.name << " " << m.name;
    }
    EXPECT_EQ(at, q.inputs.size()) << q.name;
  }
}

TEST(Operands, AVelocityBelongsToTheOperandBeforeIt) {
  const Operands& operands = find_query("moving_sphere_box")->operands;
  ASSERT_EQ(operands.size(), 2u);
  EXPECT_EQ(operands[0].velocity, 4u);
  EXPECT_EQ(operands[1].velocity, std::nullopt);
  EXPECT_EQ(operands.velocities, std::vector<std::size_t>{4});
  ASSERT_TRUE(operands.start);
  EXPECT_EQ(operands.start->radius, 3u);
  EXPECT_EQ(operands.start->obstacle.shape, Shape::box);
  EXPECT_EQ(operands.find("box"), &operands[1]);
  EXPECT_EQ(operands.find("sphere.center"), nullptr);
  EXPECT_EQ(operands[1].member("half"), operands[1].half);
}

TEST(Operands, ARayStartsOutsideItsBox) {
  const Operands& operands = find_query("ray_aabox")->operands;
  ASSERT_TRUE(operands.start);
  EXPECT_EQ(operands.start->place, 0u);
  EXPECT_EQ(operands.start->radius, std::nullopt);
  EXPECT_EQ(operands.start->obstacle.name, "aabox");
  EXPECT_FALSE(find_query("closest_points_lines")->operands.start);
  EXPECT_FALSE(find_query("slide_direction")->operands.start) << "a location is no obstacle";
}

TEST(Operands, BecomeTheStructsOfTheLibrary) {
  const Query& q = *find_query("moving_point_capsule");
  const Case c = generate(q, Scalar::float64, 1, 2);
  const Operand& capsule = c.operands()[1];
  with_typed(capsule, c.values.data(), [&]<class S>(const S& shape) {
    if constexpr (std::is_same_v<S, collide::Capsule<double>>) {
      EXPECT_EQ(shape.p1.y, c.values[capsule.positions[1] + 1]);
      EXPECT_EQ(shape.radius, c.values[*capsule.radius]);
    } else {
      ADD_FAILURE() << "another shape";
    }
  });
}

}  // namespace
}  // namespace nearmiss
