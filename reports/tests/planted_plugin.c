/* A plugin that answers as balls meet, but for the mistakes that NEARMISS_PLANTED names, by their letters. */
#include <stdlib.h>
#include <string.h>

#include "impl/plugin/nearmiss_plugin.h"

static int is_planted(char mistake) {
  const char* planted = getenv("NEARMISS_PLANTED");
  return planted != NULL && strchr(planted, mistake) != NULL;
}

/* sphere1.center, sphere1.radius, sphere2.center, sphere2.radius. The range of long double holds every square. */
static int ball_ball(const double* q, size_t count, nearmiss_answer* answer) {
  (void)count;
  const long double x = (long double)q[0] - q[4], y = (long double)q[1] - q[5], z = (long double)q[2] - q[6];
  const long double reach = (long double)q[3] + q[7], square = x * x + y * y + z * z;
  answer->yes = square <= reach * reach;
  /* a: an absolute tolerance, larger than small balls */
  if (is_planted('a') && square <= reach * reach + 1e-2) answer->yes = 1;
  /* r, R: balls that are larger by 1 % and by 30 % */
  if (is_planted('r') && square <= reach * reach * 1.0201L) answer->yes = 1;
  if (is_planted('R') && square <= reach * reach * 1.69L) answer->yes = 1;
  /* b: a ball of radius 0 meets nothing */
  if (is_planted('b') && (q[3] == 0 || q[7] == 0)) answer->yes = 0;
  /* c: nor do two balls with the same center, of which none has radius 0 */
  if (is_planted('c') && square == 0 && q[3] > 0 && q[7] > 0) answer->yes = 0;
  /* o: the range of a float: large balls meet nothing */
  if (is_planted('o') && reach * reach > 3e38L) answer->yes = 0;
  /* x, y: half of the directions in which balls meet nothing */
  if (is_planted('x') && x > 0) answer->yes = 0;
  if (is_planted('y') && x < 0) answer->yes = 0;
  /* w: always wrong */
  if (is_planted('w')) answer->yes = !answer->yes;
  return NEARMISS_ANSWERED;
}

static const nearmiss_offer offers[] = {{"sphere_sphere_overlap", 8, 0, NULL, NULL, ball_ball, 0}};
static const nearmiss_plugin plugin = {NEARMISS_PLUGIN_VERSION, "planted", "planted 1.2", NEARMISS_DOUBLE, 1, offers};

const nearmiss_plugin* nearmiss_plugin_entry(void) { return &plugin; }
