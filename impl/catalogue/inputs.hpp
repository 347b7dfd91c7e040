/// The building blocks of a query's inputs: the shapes of `collide`, listed members and their roles.
///
/// Each file of `queries/` defines one query: a struct of its inputs that has the query's name, lists its members,
/// names the type of its answer and states its traits. Where members depend on each other, `broken()` returns the rule
/// that they break.
#pragma once

#include <optional>
#include <tuple>

#include <collide/answers.hpp>
#include <collide/members.hpp>
#include <collide/shapes.hpp>

#include "impl/catalogue/traits.hpp"

namespace nearmiss::inputs {

using collide::AABox;
using collide::Box;
using collide::Broken;
using collide::Capsule;
using collide::Line;
using collide::member;
using collide::Plane;
using collide::Ray;
using collide::Rectangle;
using collide::Role;
using collide::Segment;
using collide::Sphere;
using collide::Triangle;
using collide::Vec3;

/// The number of axes of two boxes: three of each box, and the cross products of the nine pairs.
inline constexpr int box_box_axes = 15;

}  // namespace nearmiss::inputs
