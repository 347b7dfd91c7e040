/* A collision library in C as a subject of Nearmiss, over pipes in binary; docs/reference/protocol.md explains each
 * line.
 *
 *   cc -O2 -o balls docs/example-program/balls.c   &&   ./nearmiss run --command ./balls --subject balls-c
 */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

enum { INPUTS = 8, MOST = 2048 };

struct request {
  uint32_t offer, count, first, numbers;
};
struct reply {
  uint8_t status, yes;
  uint16_t reason;
  uint32_t number;
  uint64_t given;
};

static int balls_meet(const double* q) {
  const double x = q[0] - q[4], y = q[1] - q[5], z = q[2] - q[6], reach = q[3] + q[7];
  return x * x + y * y + z * z <= reach * reach;
}

int main(void) {
  FILE *cases = fdopen(3, "rb"), *answers = fdopen(4, "wb");
  static uint32_t lengths[MOST]; /* INPUTS, each: no input of the query is a list */
  static double numbers[MOST][INPUTS];
  static struct reply replies[MOST];
  struct request batch;
  if (!cases || !answers) return 2;
  fputs(
      "{\"nearmiss\": 3, \"name\": \"balls-c\", \"version\": \"1.0\", \"scalar\": \"double\", \"batches\": \"binary\", "
      "\"offers\": [{\"query\": \"sphere_sphere_overlap\"}]}\n",
      answers);
  fflush(answers);
  while (fread(&batch, sizeof batch, 1, cases) == 1 && batch.count <= MOST) {
    if (fread(lengths, sizeof lengths[0], batch.count, cases) != batch.count) return 1;
    if (batch.numbers != INPUTS * batch.count) return 1;
    if (fread(numbers, sizeof numbers[0], batch.count, cases) != batch.count) return 1;
    for (uint32_t i = 0; i < batch.count; ++i)
      replies[i] = (struct reply){.yes = (uint8_t)balls_meet(numbers[i]), .number = batch.first + i};
    if (fwrite(replies, sizeof replies[0], batch.count, answers) != batch.count) return 1;
    fflush(answers);
  }
  return 0;
}
