/* Records the inputs of a program's collision queries: one JSON line a query, for `nearmiss import jsonl`.
 *
 *   FILE* trace = fopen("trace.jsonl", "a");
 *   const double inputs[] = {x, y, z, radius, vx, vy, vz, ...};  // in the order of `nearmiss list --members QUERY`
 *   nearmiss_record_doubles(trace, "moving_sphere_box", inputs, sizeof inputs / sizeof *inputs);
 *
 * The text reads back as the same numbers. C99 or C++; needs the standard library alone. Copy it into the program. A
 * call writes one line at once, so that lines of several threads do not mix where each is shorter than the buffer. */
#ifndef NEARMISS_RECORD_H
#define NEARMISS_RECORD_H
#include <stdio.h>

static inline void nearmiss_record_doubles(FILE* to, const char* query, const double* inputs, size_t count) {
  char line[4096];
  int at = snprintf(line, sizeof line, "{\"query\": \"%s\", \"scalar\": \"double\", \"values\": [", query);
  for (size_t i = 0; i < count && at < (int)sizeof line - 32; ++i)
    at += snprintf(line + at, 32, "%s%.17g", i == 0 ? "" : ", ", inputs[i]);
  fprintf(to, "%s]}\n", line);
}

static inline void nearmiss_record_floats(FILE* to, const char* query, const float* inputs, size_t count) {
  char line[4096];
  int at = snprintf(line, sizeof line, "{\"query\": \"%s\", \"scalar\": \"float\", \"values\": [", query);
  for (size_t i = 0; i < count && at < (int)sizeof line - 32; ++i)
    at += snprintf(line + at, 32, "%s%.9g", i == 0 ? "" : ", ", (double)inputs[i]);
  fprintf(to, "%s]}\n", line);
}
#endif
