/* Skim as a plugin: the same library and the same three queries as adapter.hpp has, without a line of C++. */
#include <math.h>
#include <string.h>

#include "nearmiss_plugin.h"
#include "skim.h"

static void to_floats(const double* from, size_t count, float* to) {
  for (size_t i = 0; i < count; ++i) to[i] = (float)from[i]; /* exact: Skim is asked nothing but floats */
}

/* sphere1.center, sphere1.radius, sphere2.center, sphere2.radius */
static int sphere_sphere_overlap(const double* inputs, size_t count, nearmiss_answer* answer) {
  float in[8];
  to_floats(inputs, count, in);
  answer->yes = skim_balls_meet(in, in[3], in + 4, in[7]);
  return NEARMISS_ANSWERED;
}

/* point, velocity, sphere.center, sphere.radius, solid; time, location, normal */
static int moving_point_sphere(const double* inputs, size_t count, nearmiss_answer* answer) {
  float in[11], t;
  if (inputs[10] == 0) {
    strcpy(answer->why, "Skim's balls are solid");
    return NEARMISS_CANNOT_ANSWER;
  }
  to_floats(inputs, count, in);
  answer->yes = skim_ray_ball(in, in + 3, in + 6, in[9], &t);
  answer->values[0] = answer->yes ? t : INFINITY;
  answer->given = 1u << 0; /* the time, and no more */
  return NEARMISS_ANSWERED;
}

/* segment.v0, segment.v1, point; point */
static int closest_point_segment(const double* inputs, size_t count, nearmiss_answer* answer) {
  float in[9], nearest[3];
  to_floats(inputs, count, in);
  skim_nearest_on_segment(in, in + 3, in + 6, nearest);
  answer->yes = 1;
  for (int i = 0; i < 3; ++i) answer->values[i] = nearest[i];
  return NEARMISS_ANSWERED;
}

static const nearmiss_contract eight_roundings = {
    .backward = 8, .forward = INFINITY, .unit = INFINITY, .lowest = -20, .highest = 20};

static const nearmiss_offer offers[] = {
    {"sphere_sphere_overlap", 8, 0, NULL, &eight_roundings, sphere_sphere_overlap, 0},
    {"moving_point_sphere", 11, 7, NULL, &eight_roundings, moving_point_sphere, 0},
    {"closest_point_segment", 9, 3, NULL, &eight_roundings, closest_point_segment, 0},
};

static const nearmiss_plugin skim = {NEARMISS_PLUGIN_VERSION,        "skim", "skim 1.0", NEARMISS_FLOAT,
                                     sizeof offers / sizeof *offers, offers};

const nearmiss_plugin* nearmiss_plugin_entry(void) { return &skim; }
