/* A library whose triangles have two sides: a ray meets each from its front and from its back. A definition of the
 * build selects what it declares, and a mistake. */
#include <math.h>

#include "impl/plugin/nearmiss_plugin.h"

typedef long double number; /* the squares of squares of doubles neither overflow nor vanish */
typedef struct vector {
  number x, y, z;
} vector;

static vector from(const double* v) {
  vector a = {v[0], v[1], v[2]};
  return a;
}
static vector minus(vector a, vector b) {
  vector d = {a.x - b.x, a.y - b.y, a.z - b.z};
  return d;
}
static number dot(vector a, vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static vector cross(vector a, vector b) {
  vector c = {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  return c;
}

static int ray_triangle(const double* in, nearmiss_answer* answer) {
  const vector p = from(in), v = from(in + 3), a = from(in + 6), b = from(in + 9), c = from(in + 12);
  const vector n = cross(minus(b, a), minus(c, a));
  const number speed = dot(n, v), time = dot(n, minus(a, p)) / speed;
  answer->yes = 0;
  answer->values[0] = INFINITY;
  if (speed == 0 || !(time >= 0 && time <= 1.7e308L)) return NEARMISS_ANSWERED;
  const vector x = {p.x + v.x * time, p.y + v.y * time, p.z + v.z * time};
  const vector* corners[4] = {&a, &b, &c, &a};
  for (int i = 0; i < 3; ++i) {
    if (dot(n, cross(minus(*corners[i + 1], *corners[i]), minus(x, *corners[i]))) < 0) return NEARMISS_ANSWERED;
  }
  const number length = sqrtl(dot(n, n)) * (speed > 0 ? -1 : 1);
  const number values[7] = {time, x.x, x.y, x.z, n.x / length, n.y / length, n.z / length};
  answer->yes = 1;
  for (int i = 0; i < 7; ++i) answer->values[i] = (double)values[i];
#ifdef PLANTED
  if (speed > 0 && v.x > 0) answer->values[0] *= 1.5; /* of hits from behind */
#endif
  return NEARMISS_ANSWERED;
}
#ifdef OF_VERSION_2
#define VERSION 2
#define ANSWER (nearmiss_answer_function)(void (*)(void)) ray_triangle
#else
static int with_count(const double* in, size_t count, nearmiss_answer* answer) {
  (void)count;
  return ray_triangle(in, answer);
}
#define VERSION NEARMISS_PLUGIN_VERSION
#define ANSWER with_count
#endif

static const nearmiss_offer offers[] = {{"moving_point_triangle", 15, 7, NULL, NULL, ANSWER, 0}};
static const nearmiss_plugin plugin = {VERSION, "rays", "1", NEARMISS_DOUBLE, 1, offers};
const nearmiss_plugin* nearmiss_plugin_entry(void) { return &plugin; }

#ifdef DECLARES
static const nearmiss_declaration declared[] = {
    {NULL, DECLARES, "A triangle has two sides."},
#ifdef DECLARES_TOO
    {"moving_point_triangle", DECLARES_TOO, NULL},
#endif
    {NULL, NULL, NULL},
};
const nearmiss_declaration* nearmiss_plugin_declarations(void) { return declared; }
#endif
