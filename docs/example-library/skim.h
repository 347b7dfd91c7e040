/* Skim, a small collision library in C: an example of a library that somebody else wrote. All numbers are floats,
 * a vector is an array of three. */
#ifndef SKIM_H
#define SKIM_H

#ifdef __cplusplus
extern "C" {
#endif

/* 1 where two balls have a point in common, touching included; else 0. */
int skim_balls_meet(const float center1[3], float radius1, const float center2[3], float radius2);

/* 1 where the ray origin + t * direction, t >= 0, meets a solid ball; its least t goes to *t. Else 0. */
int skim_ray_ball(const float origin[3], const float direction[3], const float center[3], float radius, float* t);

/* The point of the segment from a to b nearest to p goes to nearest. */
void skim_nearest_on_segment(const float a[3], const float b[3], const float p[3], float nearest[3]);

#ifdef __cplusplus
}
#endif
#endif
