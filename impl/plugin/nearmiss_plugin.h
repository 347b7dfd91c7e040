/* A collision library as a plugin of Nearmiss: a shared library that is loaded at run time, written in any language
 * that can speak C's calling convention. `nearmiss list --members QUERY` shows a query's numbers, in their order;
 * docs/semantics.md says what they mean, docs/bring-your-own.md how to go on.
 *
 *   cc -shared -fPIC -o libmine.so mine.c   &&   nearmiss run --plugin ./libmine.so --subject mine
 */
#ifndef NEARMISS_PLUGIN_H
#define NEARMISS_PLUGIN_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Of this header. It changes with every change of the structs below; a plugin of another version is refused. */
#define NEARMISS_PLUGIN_VERSION 2

/* The number in which the library computes. It is asked nothing that is not exactly such a number. */
enum { NEARMISS_FLOAT = 1, NEARMISS_DOUBLE = 2 };

/* What nearmiss_answer_function returns. Anything else breaks that case. */
enum { NEARMISS_ANSWERED = 0, NEARMISS_CANNOT_ANSWER = 1 };

#define NEARMISS_MAX_VALUES 40

typedef struct nearmiss_answer {
  int yes;        /* hit, overlap, inside; for depths: touching or overlapping. Ignored where
                   * the query has no yes or no */
  uint64_t given; /* bit i: values[i] is part of the answer; all bits are set at the call */
  double
      values[NEARMISS_MAX_VALUES]; /* in the order of the query's outputs; zero at the call. A miss: time is INFINITY */
  char why[200];                   /* of NEARMISS_CANNOT_ANSWER: the reason, for people */
} nearmiss_answer;

/* Answers one case. `inputs` has the query's inputs in their order; flags are 0 or 1, indices small integers. It may
 * do what it likes: it runs in a process of its own, and a crash or an endless loop costs this one case. */
typedef int (*nearmiss_answer_function)(const double* inputs, nearmiss_answer* answer);

/* What the library promises for a query, as collide/contract.hpp has it; INFINITY promises nothing. */
typedef struct nearmiss_contract {
  double backward;     /* in units of the number's epsilon, 2^-24 or 2^-53 */
  double forward;      /* in units in the last place */
  double unit;         /* of the length of normals, in units of epsilon */
  int exact_decisions; /* 1: every yes or no is the exact one */
  int lowest, highest; /* the largest number of each group lies in [2^lowest, 2^highest] */
} nearmiss_contract;

/* What the library requires of its callers. A case that is not surely inside is not asked. */
enum {
  NEARMISS_TRUE_RECTANGLE = 1 << 0,  /* corners within 4 epsilon of those of a rectangle with sides that are not zero */
  NEARMISS_UNIT_NORMAL = 1 << 1,     /* given normals of length 1 within 4 epsilon */
  NEARMISS_UNIT_DIRECTION = 1 << 2,  /* directions of lines and rays, likewise */
  NEARMISS_UNIT_QUATERNION = 1 << 3, /* orientations, likewise */
  NEARMISS_STARTS_OUTSIDE = 1 << 4,  /* no touch and no overlap at the start; in front of a plane */
  NEARMISS_MOVES = 1 << 5,           /* a velocity that is not zero */
  NEARMISS_NO_ZERO_SIZES = 1 << 6    /* no radius, half extent, box side, segment, axis or triangle's area of zero */
};

typedef struct nearmiss_offer {
  const char* query;                 /* its name in the catalogue */
  int inputs, outputs;               /* how many numbers it has: checked, so that an older plugin is told so */
  const char* equivalence;           /* by which other operation it is answered; NULL: by this very one */
  const nearmiss_contract* contract; /* NULL: no promise */
  nearmiss_answer_function answer;
  uint32_t needs; /* what it requires: some of the bits above; 0: nothing */
} nearmiss_offer;

typedef struct nearmiss_plugin {
  int version;                 /* NEARMISS_PLUGIN_VERSION */
  const char* name;            /* as the command line knows it */
  const char* library_version; /* for reports */
  int scalar;                  /* NEARMISS_FLOAT or NEARMISS_DOUBLE */
  size_t offer_count;
  const nearmiss_offer* offers; /* queries that are not among them are not offered */
} nearmiss_plugin;

/* The one symbol that a plugin must export. What it returns lives as long as the process. */
const nearmiss_plugin* nearmiss_plugin_entry(void);

#ifdef __cplusplus
}
#endif
#endif
