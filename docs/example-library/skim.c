/* Skim, with three mistakes. Each is one that has been found in real libraries; -DSKIM_MENDED takes them out. */
#include "skim.h"

#include <math.h>

static double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static void between(const float from[3], const float to[3], double difference[3]) {
  for (int i = 0; i < 3; ++i) difference[i] = (double)to[i] - (double)from[i];
}

int skim_balls_meet(const float center1[3], float radius1, const float center2[3], float radius2) {
  double d[3];
  between(center1, center2, d);
  const double reach = (double)radius1 + (double)radius2;
#ifdef SKIM_MENDED
  return dot(d, d) <= reach * reach;
#else
  return dot(d, d) <= reach * reach + 1e-4; /* a little slack, to be safe: for small balls it is all there is */
#endif
}

int skim_ray_ball(const float origin[3], const float direction[3], const float center[3], float radius, float* t) {
  double d[3], m[3];
  for (int i = 0; i < 3; ++i) d[i] = (double)direction[i];
  between(center, origin, m);
  const double a = dot(d, d), b = dot(m, d), c = dot(m, m) - (double)radius * (double)radius;
  *t = 0;
  if (c <= 0) return 1; /* starts inside */
  if (b >= 0) return 0; /* goes away */
  const double discriminant = b * b - a * c;
#ifdef SKIM_MENDED
  if (discriminant < 0) return 0;
#else
  if (discriminant < 1e-6) return 0;        /* "nearly parallel": also every slow ray and every small ball */
#endif
  *t = (float)(c / (sqrt(discriminant) - b));
  return 1;
}

void skim_nearest_on_segment(const float a[3], const float b[3], const float p[3], float nearest[3]) {
  double along[3], to_point[3];
  between(a, b, along);
  between(a, p, to_point);
  const double length2 = dot(along, along);
  double s = length2 > 0 ? dot(to_point, along) / length2 : 0;
  if (s < 0) s = 0;
#ifdef SKIM_MENDED
  if (s > 1) s = 1; /* without it the segment never ends */
#endif
  for (int i = 0; i < 3; ++i) nearest[i] = (float)((double)a[i] + s * along[i]);
}
