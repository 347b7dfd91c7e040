/* A program that records its collision queries: balls bounce in a room with boxes. `record_example FILE [STEPS]` */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "nearmiss_record.h"

enum { balls = 4, boxes = 3 };
static const float step = 1.0f / 64, room = 4;
static float place[balls][3], velocity[balls][3];
static const float radius[balls] = {0.25f, 0.1f, 0.4f, 0.05f};
/* center, half extents, and the rotation x, y, z, w */
static const float box[boxes][10] = {{1, 1, 0.5f, 0.5f, 0.5f, 0.5f, 0, 0, 0, 1},
                                     {-2, 0.5f, 1, 0.25f, 1, 1, 0, 0, 0.6f, 0.8f},
                                     {0.5f, -2, 0.25f, 1.5f, 0.1f, 0.25f, 0, 0.28f, 0, 0.96f}};

static float between(float low, float high) { return low + (high - low) * (float)rand() / (float)RAND_MAX; }

/* What the program asks a collision library in one step. */
static void ask(FILE* trace, int i) {
  const float* p = place[i];
  const float* v = velocity[i];
  for (int k = 0; k < boxes; ++k) {
    float inputs[17] = {p[0], p[1], p[2], radius[i], v[0], v[1], v[2]};
    for (int j = 0; j < 10; ++j) inputs[7 + j] = box[k][j];
    nearmiss_record_floats(trace, "moving_sphere_box", inputs, 17);
  }
  for (int k = i + 1; k < balls; ++k) {
    const float inputs[] = {p[0], p[1], p[2], radius[i], place[k][0], place[k][1], place[k][2], radius[k]};
    nearmiss_record_floats(trace, "sphere_sphere_overlap", inputs, 8);
  }
  const float floor_below[] = {p[0], p[1], p[2], radius[i], v[0], v[1], v[2], 0, 0, 1, 0};
  nearmiss_record_floats(trace, "moving_sphere_plane", floor_below, 11);
}

static void move(int i) {
  velocity[i][2] -= 9.81f * step;
  for (int k = 0; k < 3; ++k) {
    const float low = k == 2 ? radius[i] : -room, high = room;
    place[i][k] += velocity[i][k] * step;
    if (place[i][k] < low || place[i][k] > high) velocity[i][k] *= -0.9f;
    place[i][k] = fminf(fmaxf(place[i][k], low), high);
  }
}

int main(int count, char** arguments) {
  const int steps = count > 2 ? atoi(arguments[2]) : 8;
  FILE* trace = count > 1 ? fopen(arguments[1], "w") : NULL;
  if (trace == NULL) return fprintf(stderr, "usage: record_example FILE [STEPS]\n"), 2;
  for (int i = 0; i < balls; ++i) {
    for (int k = 0; k < 3; ++k) place[i][k] = between(-2, 2), velocity[i][k] = between(-3, 3);
    place[i][2] = between(1, 3);
  }
  for (int s = 0; s < steps; ++s) {
    for (int i = 0; i < balls; ++i) ask(trace, i), move(i);
  }
  return fclose(trace) == 0 ? 0 : 2;
}
