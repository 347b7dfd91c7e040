/* A collision library as a plugin of Nearmiss: a shared library that is loaded at run time, written in any language
 * that can speak C's calling convention. `nearmiss list --members QUERY` shows a query's numbers, in their order;
 * docs/reference/semantics.md defines their meaning, docs/bring-your-own.md describes the steps.
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

/* The version of this header. It changes with every change of the structs below. A plugin of version 2, whose functions
 * have no argument `count`, is loaded too; one of any other version is refused. */
#define NEARMISS_PLUGIN_VERSION 3

/* The scalar in which the library computes. Every input is exactly such a number. */
enum { NEARMISS_FLOAT = 1, NEARMISS_DOUBLE = 2 };

/* The results of nearmiss_answer_function. Any other result makes the case count as broken. */
enum { NEARMISS_ANSWERED = 0, NEARMISS_CANNOT_ANSWER = 1 };

#define NEARMISS_MAX_VALUES 40

typedef struct nearmiss_answer {
  int yes;        /* hit, overlap, inside; for depths: touching or overlapping. Ignored where
                   * the query has no yes or no */
  uint64_t given; /* bit i: values[i] is part of the answer; all bits are set at the call */
  double
      values[NEARMISS_MAX_VALUES]; /* in the order of the query's outputs; zero at the call. A miss: time is INFINITY */
  char why[200];                   /* for NEARMISS_CANNOT_ANSWER: the reason, shown in reports */
} nearmiss_answer;

/* Answers one case. `inputs` has the query's inputs in their order, `count` numbers; flags are 0 or 1, indices small
 * integers. A list, such as the vertices of a shape, is the count of its entries and then the numbers of each entry, so
 * that the cases of its query differ in `count`. The function runs in a process of its own: a crash or an endless loop
 * costs only this case. */
typedef int (*nearmiss_answer_function)(const double* inputs, size_t count, nearmiss_answer* answer);

/* The library's promise for a query, with the meaning of collide/contract.hpp; INFINITY promises nothing. */
typedef struct nearmiss_contract {
  double backward;     /* in units of the number's epsilon, 2^-24 or 2^-53 */
  double forward;      /* in units in the last place */
  double unit;         /* of the length of normals, in units of epsilon */
  int exact_decisions; /* 1: every yes or no is the exact one */
  int lowest, highest; /* the largest number of each group lies in [2^lowest, 2^highest] */
} nearmiss_contract;

/* The preconditions of the library. A case that is not proved to meet them is not asked. */
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
  int inputs, outputs;               /* the numbers of its inputs and outputs, checked against the catalogue. Each list
                                      * counts with the fewest entries that it can have */
  const char* equivalence;           /* the other operation that answers the query; NULL: this very operation */
  const nearmiss_contract* contract; /* NULL: no promise */
  nearmiss_answer_function answer;
  uint32_t needs; /* its preconditions: some of the bits above; 0: none */
} nearmiss_offer;

typedef struct nearmiss_plugin {
  int version;                 /* NEARMISS_PLUGIN_VERSION */
  const char* name;            /* its name on the command line */
  const char* library_version; /* shown in reports */
  int scalar;                  /* NEARMISS_FLOAT or NEARMISS_DOUBLE */
  size_t offer_count;
  const nearmiss_offer* offers; /* other queries are not offered */
} nearmiss_plugin;

/* The one symbol that a plugin must export. Its result must stay valid until the process ends. */
const nearmiss_plugin* nearmiss_plugin_entry(void);

/* What the documentation of the library defines otherwise than the catalogue does: the name of a convention, from the
 * list of docs/bring-your-own.md, such as "two-sided". */
typedef struct nearmiss_declaration {
  const char* query;      /* of one of its offers; NULL: each one where the convention has an effect */
  const char* convention; /* its name */
  const char* sentence;   /* of the library's documentation; NULL: none */
} nearmiss_declaration;

/* A symbol that a plugin of any version may export: its conventions, which end with one whose `convention` is NULL. The
 * result must stay valid until the process ends. */
const nearmiss_declaration* nearmiss_plugin_declarations(void);

#ifdef __cplusplus
}
#endif
#endif
