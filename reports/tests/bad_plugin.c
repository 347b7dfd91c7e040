/* A plugin with one fault, which a definition of the build selects. */
#include <math.h>
#include <stdlib.h>

#include "impl/plugin/nearmiss_plugin.h"

#ifdef SETS_MODES
#include <fenv.h>
#ifdef __SSE2__
#include <xmmintrin.h>
#endif
/* Like a library that is linked with -ffast-math, or one for interval arithmetic. */
__attribute__((constructor)) static void set_modes(void) {
  fesetround(FE_UPWARD);
#ifdef __SSE2__
  _mm_setcsr(_mm_getcsr() | 0x8040u); /* flush to zero, denormals are zero */
#endif
}
#endif

/* The first input decides: an abort, an endless loop (for what is far away, too), an unknown return value, an answer.
 */
static int misbehave(const double* inputs, size_t count, nearmiss_answer* answer) {
  (void)count;
  const double x = inputs[0];
  if (x == 1) abort();
  for (volatile int forever = x == 2 || x > 1e9; forever;) {
  }
  if (x == 3) return 7;
  answer->yes = 0;
#ifdef SETS_MODES
  answer->yes = fegetround() == FE_UPWARD;
#endif
  return NEARMISS_ANSWERED;
}

#ifdef MISCOUNTS
#define INPUTS 7
#else
#define INPUTS 8
#endif
#ifdef UNKNOWN_QUERY
#define QUERY "sphere_sphere_overlaps"
#else
#define QUERY "sphere_sphere_overlap"
#endif
#ifdef OTHER_VERSION
#define VERSION (NEARMISS_PLUGIN_VERSION + 1)
#elif defined(FIRST_VERSION)
#define VERSION 1
#elif defined(SECOND_VERSION)
#define VERSION 2
#else
#define VERSION NEARMISS_PLUGIN_VERSION
#endif
#ifdef TAKEN_NAME
#define NAME "collide-fast-double"
#else
#define NAME "misbehaves"
#endif

#ifdef CONTRACT_BELOW_ZERO
static const nearmiss_contract contract = {-1, 0, 0, 0, 0, 0};
#define CONTRACT &contract
#elif defined(CONTRACT_UPSIDE_DOWN)
static const nearmiss_contract contract = {1, 1, 1, 0, 20, -20};
#define CONTRACT &contract
#elif defined(CONTRACT_OF_NOTHING)
static const nearmiss_contract contract = {INFINITY, INFINITY, INFINITY, 0, -20, 20};
#define CONTRACT &contract
#else
#define CONTRACT NULL
#endif

#ifdef UNKNOWN_NEED
#define NEEDS (NEARMISS_NO_ZERO_SIZES | 1u << 31)
#elif defined(NEEDS_SIZES)
#define NEEDS NEARMISS_NO_ZERO_SIZES
#else
#define NEEDS 0
#endif

#ifdef SECOND_VERSION
/* Two balls meet; the range of long double holds every square. The functions of that version have no count. */
static int meet(const double* q, nearmiss_answer* answer) {
  const long double x = (long double)q[0] - q[4], y = (long double)q[1] - q[5], z = (long double)q[2] - q[6];
  const long double reach = (long double)q[3] + q[7];
  answer->yes = x * x + y * y + z * z <= reach * reach;
  return NEARMISS_ANSWERED;
}
#define ANSWER (nearmiss_answer_function)(void (*)(void)) meet
#else
#define ANSWER misbehave
#endif

static const nearmiss_offer offers[] = {{QUERY, INPUTS, 0, NULL, CONTRACT, ANSWER, NEEDS}};
static const nearmiss_plugin plugin = {VERSION, NAME, "1", NEARMISS_DOUBLE, 1, offers};

#ifdef NO_ENTRY
const nearmiss_plugin* another_entry(void) { return &plugin; }
#else
const nearmiss_plugin* nearmiss_plugin_entry(void) {
#ifdef CRASHES
  abort();
#endif
  return &plugin;
}
#endif
