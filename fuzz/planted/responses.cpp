/// Mistakes: responses.
#include "fuzz/planted/planting.hpp"

namespace nearmiss::planted {
namespace {

MISREPORT(1, bounce_direction, degenerate, "a speed below 1e-9 is taken for 0", "absolute tolerance 1e-9 speed") {
  if (length(q.velocity) < 1e-9) a = {};
}
MISTAKE(2, bounce_direction, ordinary, "the direction has the other sign", "logic") { return {-right(q).direction}; }
MISREAD(5, bounce_direction, degenerate,
        "a vector from location to center shorter than an absolute 1e-6 is taken for zero",
        "absolute tolerance 1e-6 length") {
  const Vector u = q.sphere.center + q.velocity * q.time - q.location;
  if (length(u) < 1e-6) q.location = q.sphere.center, q.time = 0;  // exactly zero
}
MISTAKE(8, bounce_direction, ordinary, "the velocity is reflected instead of its direction",
        "convention or unsupported") {
  return {right(q).direction * length(q.velocity)};
}
MISREPORT(9, bounce_direction, ordinary, "the vector from location to center is a float", "rounding") {
  const Vector u = q.sphere.center + q.velocity * q.time - q.location, rounded = in_float(u);
  const double size = length(rounded), speed = length(q.velocity);
  if (!std::isfinite(size) || !(size > 1e-30) || !(speed > 0)) return;
  const Vector normal = rounded / size, direction = q.velocity / speed;
  a = {direction - normal * (2 * dot(direction, normal))};
}
MISTAKE(10, bounce_direction, ordinary, "the unit velocity is kept in float", "rounding") {
  const double speed = length(q.velocity);
  auto a = right(q);
  if (!(speed > 0)) return a;
  const Vector u = q.sphere.center + q.velocity * q.time - q.location;
  const double l = length(u);
  const Vector n = l > 0 ? u / l : q.normal / length(q.normal);
  const Vector v = in_float(q.velocity / speed);
  a.direction = v - n * (2 * dot(v, n));
  return a;
}
MISREPORT(11, bounce_direction, degenerate, "a velocity with a length up to 1e-5 gives the direction zero",
          "absolute tolerance 1e-5 .* or absolute tolerance 1e-10 .*") {
  if (length(q.velocity) <= 1e-5) a = {};
}
MISREPORT(12, bounce_direction, degenerate,
          "a vector to the center shorter than 1e-5 is normalised to zero, so that nothing is reflected",
          "absolute tolerance (1e-0?5|0\\.00001) length") {
  const Vector out = q.sphere.center + q.velocity * q.time - q.location;
  const double size = length(out), speed = length(q.velocity);
  if (size > 0 && size < 1e-5 && speed > 0) a = {q.velocity / speed};
}
MISREAD(13, bounce_direction, degenerate, "a contact earlier than 1e-3 counts as a contact at the start",
        "absolute tolerance (1e-0?3|0\\.001(0\\d*)?|0\\.00099\\d*|9\\.9\\d*e-0?4|1\\.0\\d*e-0?3) time") {
  if (std::abs(q.time) < 1e-3) q.time = 0;
}
MISREPORT(14, bounce_direction, ordinary, "does not reflect a velocity that already leads away from the contact",
          "logic or convention") {
  const Vector way = q.velocity * q.time;
  const Vector u = q.sphere.center + way - q.location;
  const double size = length(q.sphere.center) + length(way) + length(q.location), speed = length(q.velocity);
  if (speed == 0 || !(length(u) > 1e-9 * size)) return;
  if (dot(q.velocity / speed, u) > 0) a = {q.velocity / speed};
}
MISTAKE(15, bounce_direction, ordinary,
        "a bounce threshold: slower than 0.2 along the normal, the sphere slides instead",
        "absolute tolerance 0\\.2 speed") {
  if (q.sphere.center + q.velocity * q.time == q.location) q.location = q.location - q.normal;
  const Vector u = q.sphere.center + q.velocity * q.time - q.location;
  const double speed = dot(q.velocity, u / length(u));
  if (!(std::abs(speed) < 0.2)) return right(q);
  const Vector slide = right(inputs::slide_direction<double>{q.sphere, q.velocity, q.time, q.location}).direction;
  const double size = length(slide);
  if (size == 0) return {};
  return {slide / size};
}

MISREPORT(1, slide_direction, degenerate,
          "a vector from location to center shorter than 1e-9 of the radius is taken for 0",
          "relative tolerance 1e-9") {
  const double speed = length(q.velocity);
  if (speed > 0 && length(q.sphere.center + q.velocity * q.time - q.location) < 1e-9 * q.sphere.radius)
    a = {q.velocity / speed};
}
MISREPORT(2, slide_direction, degenerate, "a speed below an absolute 1e-8 is taken for 0",
          "absolute tolerance 1e-8 speed") {
  if (length(q.velocity) < 1e-8) a = {};
}
MISREPORT(6, slide_direction, ordinary, "a velocity away from the contact does not lose its part along u", "logic") {
  const Vector u = q.sphere.center + q.velocity * q.time - q.location;
  const double speed = length(q.velocity);
  if (speed > 0 && dot(q.velocity, u) > 0) a = {q.velocity / speed};
}
MISREPORT(7, slide_direction, degenerate,
          "a squared vector from location to center below an absolute 1e-8 is taken for zero",
          "absolute tolerance 1e-4 length or absolute tolerance 1e-8 length\\^2") {
  const Vector u = q.sphere.center + q.velocity * q.time - q.location;
  const double speed = length(q.velocity);
  if (speed > 0 && dot(u, u) < 1e-8) a = {q.velocity / speed};
}
MISREPORT(9, slide_direction, ordinary, "the direction is divided by its length", "convention") {
  const double size = length(a.direction);
  if (size > 0) a.direction = a.direction / size;
}
MISREPORT(10, slide_direction, ordinary, "the direction is normalised", "convention") {
  const double l = length(a.direction);
  if (l > 0) a.direction = a.direction * (1 / l);
}
MISREPORT(11, slide_direction, degenerate, "a speed below 1e-4 is no motion", "absolute tolerance 1e-4 .*") {
  if (dot(q.velocity, q.velocity) < 1e-4 * 1e-4) a = {};
}
MISREPORT(12, slide_direction, degenerate,
          "no component is removed where the squared distance of center and location is below 1e-8",
          "absolute tolerance 1e-0?8 length\\^2 or absolute tolerance (1e-0?4|0\\.0001) length") {
  const Wide velocity = widened(q.velocity);
  const Wide u = widened(q.sphere.center) + velocity * Real(q.time) - widened(q.location);
  const Real speed = length(velocity);
  if (!(speed > 0) || !(dot(u, u) < 1e-8L)) return;
  a = {narrowed(velocity / speed)};
}
MISREPORT(13, slide_direction, degenerate, "a squared distance of center and location below 1e-12 counts as zero",
          "absolute tolerance 1e-12 length\\^2 or absolute tolerance 1e-6 length") {
  const Vector u = q.sphere.center + q.velocity * q.time - q.location;
  const double speed = length(q.velocity);
  if (squared(u) < 1e-12 && speed > 0) a = {q.velocity / speed};
}
MISREPORT(14, slide_direction, degenerate,
          "the product of the squared lengths of velocity and contact vector, tested before dividing, leaves the range "
          "of float",
          "overflow or underflow") {
  const Wide v = widened(q.velocity);
  const Wide u = widened(q.sphere.center) + v * static_cast<long double>(q.time) - widened(q.location);
  const long double uu = dot(u, u), vv = dot(v, v);
  if (uu == 0 || vv == 0 || std::isnormal(float(uu * vv))) return;
  a = {};
}
MISREPORT(15, slide_direction, degenerate, "gives zero, stuck, where the squared length of the slide is below 1e-3",
          "relative tolerance 1e-3 or relative tolerance 0\\.03(1\\d*|2)") {
  if (dot(a.direction, a.direction) < 1e-3) a = {};
}

}  // namespace
}  // namespace nearmiss::planted
