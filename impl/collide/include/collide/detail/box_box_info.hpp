/// The kernel of box_box_info (collide/box_box_info.hpp).
#pragma once

#include <collide/answers.hpp>
#include <collide/detail/box_filters.hpp>
#include <collide/detail/box_pair.hpp>
#include <collide/detail/frame.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

namespace detail {

// A function of its own: g++ constructs a named result in place only where its scope is the whole function.
template <class Tier, class T>
inline BoxBoxInfo<T> info_of_boxes(const Box<T>& box1, const Box<T>& box2) {
  using detail::abs;
  const BoxPair<T> pair(box1, box2);
  const Axes<T> axes1 = axes_of(box1.orientation), axes2 = axes_of(box2.orientation);
  BoxBoxInfo<T> info;
  info.half1 = box1.half;
  info.half2 = box2.half;
  info.between = box2.center - box1.center;
  const T scale = pair.norm1 * pair.norm2;
  for (int i = 0; i < 3; ++i) {
    const auto& row = pair.cosine[i];
    info.cosine[i] = at_most_one(Vec3<T>{row[0], row[1], row[2]} / scale);
    info.abs_cosine[i] = {abs(info.cosine[i].x), abs(info.cosine[i].y), abs(info.cosine[i].z)};
  }
  const std::array<T, 3> between1 = into_frame<Tier>(axes1, info.between);
  const std::array<T, 3> between2 = into_frame<Tier>(axes2, info.between);
  info.between1 = {between1[0], between1[1], between1[2]};
  info.between2 = {between2[0], between2[1], between2[2]};
  return info;
}

}  // namespace detail

COLLIDE_COMPILED(box_box_info)

namespace kernels {

template <class Tier, class T>
inline BoxBoxInfo<T> box_box_info(const Box<T>& box1, const Box<T>& box2) {
  if constexpr (Tier::template lifts<T>) {
    if constexpr (uses_filter<Tier, T>) {
      if (const auto answer = detail::filtered_info(box1, box2)) return Tier::decided_by_filter(*answer);
    }
    return COLLIDE_LIFTED(box_box_info, box1, box2);
  } else {
    return detail::info_of_boxes<Tier>(box1, box2);
  }
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
