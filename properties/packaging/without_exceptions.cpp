/// A program that is compiled with -fno-exceptions: it asks every tier, and breaks what a contract requires.
#include <cstring>

#include <collide/batch.hpp>
#include <collide/certified.hpp>
#include <collide/checked.hpp>
#include <collide/collide.hpp>
#include <collide/decisive.hpp>

namespace {

using namespace collide;

/// Spheres that touch: the decision needs exact numbers, since 0.6^2 + 0.8^2 is not 1 in doubles.
template <class Tier>
bool agrees() {
  const Sphere<double> one{.center = {0, 0, 0}, .radius = 0.5}, other{.center = {0.6, 0.8, 0}, .radius = 0.5};
  const Triangle<double> triangle{{0, -1, -1}, {0, 1, -1}, {0, 0, 1}};
  return sphere_sphere_overlap<Tier>(one, {.center = {0.75, 0, 0}, .radius = 0.5}).yes() &&
         sphere_sphere_penetration<Tier>(one, other).depth < 1e-15 &&
         moving_point_triangle<Tier>(Vec3<double>{2, 0.1, 0.2}, {-1, 0, 0}, triangle).yes();
}

bool answers() {
  const bool all = agrees<Fast>() && agrees<Accurate>() && agrees<Decisive>() && agrees<Certified>();
  return all && Certified::counts().filter + Certified::counts().extended + Certified::counts().exact > 0;
}

void batch_of_two_sizes() {
  const Soa<Sphere<float>> two(2), three(3);
  Soa<Decision<float>> hits(2);
  batch::sphere_sphere_overlap(two.view(), three.view(), hits.span());
}

}  // namespace

int main(int count, char** arguments) {
  const char* const what = count == 2 ? arguments[1] : "";
  if (std::strcmp(what, "answers") == 0) return answers() ? 0 : 1;
  if (std::strcmp(what, "batch") == 0) batch_of_two_sizes();
  if (std::strcmp(what, "shape") == 0) static_cast<void>(checked(Sphere<double>{.center = {}, .radius = -1}));
  if (std::strcmp(what, "direction") == 0) static_cast<void>(checked_direction(Vec3<double>{}, "velocity"));
  return 2;
}
