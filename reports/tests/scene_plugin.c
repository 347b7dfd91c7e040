/* A plugin that promises nothing and knows the depth of two balls, but for the mistake that NEARMISS_PLANTED names:
 *   d  depths are too large by 0.3
 *   n  depths are too large by 0.004
 *   m  contacts less than 0.05 deep are missed
 *   p  balls less than 0.05 apart touch
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "impl/plugin/nearmiss_plugin.h"

static int is_planted(char mistake) {
  const char* planted = getenv("NEARMISS_PLANTED");
  return planted != NULL && strchr(planted, mistake) != NULL;
}

/* sphere1.center, sphere1.radius, sphere2.center, sphere2.radius */
static int depth(const double* q, size_t count, nearmiss_answer* answer) {
  (void)count;
  const long double x = (long double)q[0] - q[4], y = (long double)q[1] - q[5], z = (long double)q[2] - q[6];
  double deep = (double)((long double)q[3] + q[7] - sqrtl(x * x + y * y + z * z));
  answer->yes = deep >= 0;
  if (is_planted('d') && deep > 0) deep += 0.3;
  if (is_planted('n')) deep += deep > 0 ? 0.004 : 0;
  if (is_planted('m') && deep < 0.05) answer->yes = 0;
  if (is_planted('p') && deep > -0.05) answer->yes = 1;
  answer->given = 1;
  answer->values[0] = deep;
  return NEARMISS_ANSWERED;
}

static const nearmiss_offer offers[] = {{"sphere_sphere_penetration", 8, 7, NULL, NULL, depth, 0}};
static const nearmiss_plugin plugin = {NEARMISS_PLUGIN_VERSION, "scenic", "scenic 1", NEARMISS_DOUBLE, 1, offers};

const nearmiss_plugin* nearmiss_plugin_entry(void) { return &plugin; }
