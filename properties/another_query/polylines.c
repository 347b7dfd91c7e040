/* A plugin that answers the query of this test whose cases have lists. */
#include <math.h>

#include "nearmiss_plugin.h"

#ifndef VERSION
#define VERSION NEARMISS_PLUGIN_VERSION
#endif

/* sphere.center, sphere.radius, polyline.vertices: their count, and so many points */
static int contains(const double* q, size_t count, nearmiss_answer* answer) {
  if (count != 5 + 3 * (size_t)q[4]) return 7;
  answer->yes = 1;
  for (size_t i = 5; i < count; i += 3) {
    const long double x = (long double)q[i] - q[0], y = (long double)q[i + 1] - q[1], z = (long double)q[i + 2] - q[2];
    if (sqrtl(x * x + y * y + z * z) > q[3]) answer->yes = 0;
  }
  return NEARMISS_ANSWERED;
}

static const nearmiss_offer offers[] = {{"sphere_contains_polyline", 8, 0, NULL, NULL, contains, 0}};
static const nearmiss_plugin plugin = {VERSION, "polylines-c", "1", NEARMISS_DOUBLE, 1, offers};

const nearmiss_plugin* nearmiss_plugin_entry(void) { return &plugin; }
