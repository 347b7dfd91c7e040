/// The tools for pairs of boxes give the same answers from a precomputed box_box_info as from the boxes. If every
/// number is a small integer or a small power of two, no operation rounds, so the answers must be equal.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <collide/box_box_conservative.hpp>
#include <collide/box_box_info.hpp>
#include <collide/box_box_parallel_axis.hpp>
#include <collide/box_box_projected_distance.hpp>

namespace nearmiss {
namespace {

template <class T>
class BoxBoxTools : public testing::Test {
 protected:
  using Box = collide::Box<T>;

  /// Calls `look(box1, box2)` for boxes whose axes are the coordinate axes, in some order and sign.
  template <class F>
  static void for_each_pair(F&& look) {
    // x, y, z, w: the identity, a half turn, quarter turns, a third of a turn about the diagonal.
    const std::vector<collide::Quaternion<T>> turns{{0, 0, 0, 1}, {1, 0, 0, 0},  {1, 0, 0, 1},
                                                    {0, 1, 0, 1}, {0, 0, 1, -1}, {1, 1, 1, 1}};
    const std::vector<collide::Vec3<T>> centers{{0, 0, 0}, {3, 0, 0}, {4, 1, 0}, {-2, 5, 1}, {3, 3, -6}, {6, 0, -1}};
    for (const auto& turn1 : turns) {
      for (const auto& turn2 : turns) {
        for (const auto& center : centers) look(Box{{1, 0, -1}, {1, 2, 0}, turn1}, Box{center, {3, 1, 2}, turn2});
      }
    }
  }
};

using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(BoxBoxTools, Scalars);

TYPED_TEST(BoxBoxTools, MeasureTheSameDistanceOnEveryAxisFromTheInfo) {
  int apart = 0, across = 0;
  this->for_each_pair([&](const auto& box1, const auto& box2) {
    const auto info = collide::box_box_info(box1, box2);
    for (int axis = 0; axis < collide::box_box_axes; ++axis) {
      const TypeParam from_boxes = collide::box_box_projected_distance(box1, box2, axis).value;
      EXPECT_EQ(collide::box_box_projected_distance(info, axis).value, from_boxes) << "axis " << axis;
      (from_boxes > 0 ? apart : across)++;
    }
  });
  EXPECT_GT(apart, 100);
  EXPECT_GT(across, 100);
}

TYPED_TEST(BoxBoxTools, FindTheSameParallelAxesFromTheInfo) {
  this->for_each_pair([&](const auto& box1, const auto& box2) {
    const auto info = collide::box_box_info(box1, box2);
    for (const TypeParam epsilon : {TypeParam(0), TypeParam(0.5), TypeParam(1)}) {
      const auto from_boxes = collide::box_box_parallel_axis(box1, box2, epsilon);
      const auto from_info = collide::box_box_parallel_axis(info, epsilon);
      EXPECT_TRUE(from_boxes.yes());
      EXPECT_EQ(from_info.yes(), from_boxes.yes());
      EXPECT_EQ(from_info.axis1, from_boxes.axis1);
      EXPECT_EQ(from_info.axis2, from_boxes.axis2);
    }
  });
}

TYPED_TEST(BoxBoxTools, AreConservativeAlikeFromTheInfo) {
  int near = 0, far = 0;
  this->for_each_pair([&](const auto& box1, const auto& box2) {
    const bool from_boxes = collide::box_box_conservative(box1, box2).yes();
    EXPECT_EQ(collide::box_box_conservative(collide::box_box_info(box1, box2)).yes(), from_boxes);
    (from_boxes ? near : far)++;
  });
  EXPECT_GT(near, 10);
  EXPECT_GT(far, 10);
}

}  // namespace
}  // namespace nearmiss
