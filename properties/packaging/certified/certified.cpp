/// Links only with the library collide::certified, GMP and MPFR.
#include <collide/certified.hpp>
#include <collide/decisive.hpp>
#include <collide/sphere_sphere_overlap.hpp>
#include <collide/sphere_sphere_penetration.hpp>

int main() {
  using collide::Certified, collide::Decisive;
  // The centers are sqrt(3) apart. The radii add up to 10^-16 less, so a double cannot decide.
  const collide::Sphere<double> one{.center = {0, 0, 0}, .radius = 0.5};
  const collide::Sphere<double> other{.center = {1, 1, 1}, .radius = 1.2320508075688772};
  const bool apart = !collide::sphere_sphere_overlap<Certified>(one, other).yes();
  const bool decided = !collide::sphere_sphere_penetration<Decisive>(one, other).yes();
  const collide::StageCounts& counts = Certified::counts();
  return apart && decided && counts.filter + counts.extended + counts.exact >= 2 ? 0 : 1;
}
