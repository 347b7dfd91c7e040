/// A ball flies at a crate, bounces off it, and a guard looks for the nearest point of his rail.
#include <cstdio>

#include <collide/bounce_direction.hpp>
#include <collide/closest_point_segment.hpp>
#include <collide/moving_sphere_box.hpp>

namespace {

void print(const char* what, const collide::Vec3<double>& v) { std::printf("%s (%g, %g, %g)\n", what, v.x, v.y, v.z); }

}  // namespace

int main() {
  const collide::Sphere<double> ball{.center = {-4, 1, 0.5}, .radius = 0.5};
  const collide::Vec3<double> velocity{3, -0.5, 0};
  const collide::Box<double> crate{.center = {2, 0, 0}, .half = {1.5, 1, 2}};
  const collide::Segment<double> rail{{0, -2, 0}, {0, 2, 0}};

  const collide::Impact<double> impact = collide::moving_sphere_box(ball, velocity, crate);
  if (!impact.yes()) {
    std::puts("the ball misses the crate");
    return 1;
  }
  std::printf("the ball meets the crate at time %g\n", impact.time);
  print("  at    ", impact.location);
  print("  normal", impact.normal);

  // The same question where rounding must not matter: the tier is an argument, the answer has the same type.
  const auto bounce =
      collide::bounce_direction<collide::Accurate>(ball, velocity, impact.time, impact.location, impact.normal);
  print("it flies on along     ", bounce.direction);

  print("the guard waits at    ", collide::closest_point_segment(rail, impact.location).point);
}
