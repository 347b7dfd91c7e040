/* A plugin with every fault, one at a time: NEARMISS_ZOO selects it (misdeeds.h). */
#include "reports/tests/zoo/misdeeds.h"

#include <dlfcn.h>
#include <math.h>

#include "impl/plugin/nearmiss_plugin.h"

/* The misdeed in the name of this library's file, "zoo-ask-abort.so"; none in "libzoo.so". */
static void choose_by_file(void) {
  Dl_info here;
  if (dladdr((void*)(uintptr_t)choose_by_file, &here) == 0) return;
  const char* slash = strrchr(here.dli_fname, '/');
  char name[64];
  if (sscanf(slash == NULL ? here.dli_fname : slash + 1, "zoo-%63[a-z0-9-].so", name) == 1) choose(name);
}

__attribute__((constructor)) static void load(void) {
  choose_by_file();
  do_misdeed("load-");
  if (is_chosen("load-rounds-upward")) fesetround(FE_UPWARD);
}

/* Every 40th case of a process does the deed: the others are answered as balls meet. */
static int ball_ball(const double* q, size_t count, nearmiss_answer* answer) {
  (void)count;
  static unsigned asked;
  const double x = q[0] - q[4], y = q[1] - q[5], z = q[2] - q[6], reach = q[3] + q[7];
  answer->yes = x * x + y * y + z * z <= reach * reach;
  if (hostile_text("all") != NULL) answer->yes = !answer->yes; /* a finding, whose report has the texts */
  do_misdeed_of_case(++asked);
  if (asked % 40 != 0) return NEARMISS_ANSWERED;
  end_with_hostile_text();
  if (hostile_text("why") != NULL) {
    strncpy(answer->why, hostile_text("why"), sizeof answer->why);
    return NEARMISS_CANNOT_ANSWER;
  }
  if (is_chosen("answer-status")) return 7;
  if (is_chosen("answer-yes")) answer->yes = 99;
  if (is_chosen("answer-reason-without-end")) {
    memset(answer->why, 'x', sizeof answer->why);
    return NEARMISS_CANNOT_ANSWER;
  }
  if (is_chosen("answer-nan")) {
    for (int i = 0; i < NEARMISS_MAX_VALUES; ++i) answer->values[i] = NAN;
  }
  if (is_chosen("answer-too-much")) memset(answer, 0x7f, 4 * sizeof *answer);
  return NEARMISS_ANSWERED;
}

static nearmiss_contract contract = {8, INFINITY, INFINITY, 0, -20, 20};
static nearmiss_offer offers[] = {{"sphere_sphere_overlap", 8, 0, NULL, NULL, ball_ball, 0},
                                  {"sphere_sphere_overlap", 8, 0, NULL, NULL, ball_ball, 0}};
static nearmiss_plugin plugin = {NEARMISS_PLUGIN_VERSION, "zoo", "1", NEARMISS_DOUBLE, 1, offers};

/* Text that ends at a page that cannot be read. */
static const char* text_without_end(void) {
  char* pages = mmap(NULL, 1 << 16, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  memset(pages, 'a', 1 << 16);
  mprotect(pages + (1 << 15), 1 << 15, PROT_NONE);
  return pages + (1 << 15) - 100;
}

const nearmiss_plugin* nearmiss_plugin_entry(void) {
  do_misdeed("entry-");
  plugin.name = subject_name;
  if (is_chosen("told-nothing")) return NULL;
  if (is_chosen("told-wild")) return (const nearmiss_plugin*)(uintptr_t)0xdeadbeef00;
  if (is_chosen("told-version")) plugin.version = 99;
  if (is_chosen("told-scalar")) plugin.scalar = 9;
  if (is_chosen("told-no-name")) plugin.name = NULL;
  if (is_chosen("told-bad-name")) plugin.name = "Zoo \033[31m";
  if (is_chosen("told-long-name"))
    plugin.name = "aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa";
  if (is_chosen("told-name-without-end")) plugin.name = text_without_end();
  if (is_chosen("told-taken-name")) plugin.name = "collide-fast-double";
  if (is_chosen("told-count")) plugin.offer_count = (size_t)-1;
  if (is_chosen("told-count-beyond")) plugin.offer_count = 4000;
  if (is_chosen("told-no-offers")) plugin.offers = NULL;
  if (is_chosen("told-wild-offers")) plugin.offers = (const nearmiss_offer*)(uintptr_t)0xdeadbeef00;
  if (is_chosen("told-twice")) plugin.offer_count = 2;
  if (is_chosen("told-no-query")) offers[0].query = NULL;
  if (is_chosen("told-wild-query")) offers[0].query = (const char*)(uintptr_t)16;
  if (is_chosen("told-unknown-query")) offers[0].query = "sphere_sphere_overlaps";
  if (is_chosen("told-no-function")) offers[0].answer = NULL;
  if (is_chosen("told-wild-function")) offers[0].answer = (nearmiss_answer_function)(uintptr_t)16;
  if (is_chosen("told-inputs")) offers[0].inputs = -8;
  if (is_chosen("told-outputs")) offers[0].outputs = 1 << 30;
  if (is_chosen("told-needs")) offers[0].needs = 1u << 30;
  if (is_chosen("told-contract")) contract.backward = NAN, offers[0].contract = &contract;
  if (is_chosen("told-wild-contract")) offers[0].contract = (const nearmiss_contract*)(uintptr_t)16;
  if (is_chosen("told-otherwise") && !is_first_time()) plugin.library_version = "2";
  if (is_chosen("told-crash-later") && !is_first_time()) abort();
  if (is_chosen("told-hang-later") && !is_first_time()) sleep_for_ever();
  if (hostile_text("version") != NULL) plugin.library_version = hostile_text("version");
  if (hostile_text("equivalence") != NULL) offers[0].equivalence = hostile_text("equivalence");
  if (hostile_text("name") != NULL) plugin.name = hostile_text("name");
  return &plugin;
}
