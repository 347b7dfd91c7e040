/* A program that speaks the protocol, with every fault, one at a time: NEARMISS_ZOO selects it (misdeeds.h). */
#include "reports/tests/zoo/misdeeds.h"

static const char usual_hello[] =
    "{\"nearmiss\": 1, \"name\": \"%s\", \"version\": \"%s\", \"scalar\": \"double\", \"batches\": \"json\", "
    "\"offers\": [{\"query\": \"sphere_sphere_overlap\"}, {\"query\": \"moving_point_triangle\"}]}\n";
static const char reordered_hello[] =
    "{\"offers\": [{\"query\": \"sphere_sphere_overlap\"}, {\"query\": \"moving_point_triangle\"}], \"nearmiss\": 1, "
    "\"batches\": \"json\", \"scalar\": \"double\", \"version\": \"1\", \"name\": \"%s\"}\n";

/* Lines that replace the usual hello, by name. */
static const struct {
  const char *name, *text;
} hellos[] = {
    {"hello-nothing", "\n"},
    {"hello-noise", "\x80\x81\xfe\xff\n"},
    {"hello-list", "[1, 2]\n"},
    {"hello-deep-requirement", NULL},
    {"hello-deep", NULL},
    {"hello-endless", NULL},
    {"hello-version", "{\"nearmiss\": 4}\n"},
    {"hello-no-version", "{\"name\": \"zoo\"}\n"},
    {"hello-refused", "{\"nearmiss\": 1, \"refused\": \"no license \\u001b[31m found\"}\n"},
    {"hello-typo", "{\"nearmiss\": 1, \"nmae\": \"zoo\"}\n"},
    {"hello-name", "{\"nearmiss\": 1, \"name\": \"../zoo\", \"scalar\": \"double\", \"batches\": \"json\"}\n"},
    {"hello-scalar", "{\"nearmiss\": 1, \"name\": \"zoo\", \"scalar\": \"half\", \"batches\": \"json\"}\n"},
    {"hello-shared", "{\"nearmiss\": 1, \"name\": \"zoo\", \"scalar\": \"double\", \"batches\": \"shared\"}\n"},
    {"hello-name-dash", "{\"nearmiss\": 1, \"name\": \"-\", \"scalar\": \"double\", \"batches\": \"json\"}\n"},
    {"hello-name-option", "{\"nearmiss\": 1, \"name\": \"--help\", \"scalar\": \"double\", \"batches\": \"json\"}\n"},
    {"hello-name-word", "{\"nearmiss\": 1, \"name\": \"added\", \"scalar\": \"double\", \"batches\": \"json\"}\n"},
    {"hello-name-twice",
     "{\"nearmiss\": 1, \"name\": \"zoo\", \"name\": \"zoo2\", \"scalar\": \"double\", \"batches\": \"json\"}\n"},
    {"hello-offer-twice",
     "{\"nearmiss\": 1, \"name\": \"zoo\", \"scalar\": \"double\", \"batches\": \"json\", "
     "\"offers\": [{\"query\": \"sphere_sphere_overlap\", \"query\": \"moving_point_triangle\"}]}\n"},
    {"hello-gives",
     "{\"nearmiss\": 1, \"name\": \"zoo\", \"scalar\": \"double\", \"batches\": \"json\", "
     "\"offers\": [{\"query\": \"moving_point_triangle\", \"gives\": [\"time\", \"nomral\"]}]}\n"},
    {"hello-gives-number",
     "{\"nearmiss\": 1, \"name\": \"zoo\", \"scalar\": \"double\", \"batches\": \"json\", "
     "\"offers\": [{\"query\": \"moving_point_triangle\", \"gives\": [3]}]}\n"},
    {"hello-offers",
     "{\"nearmiss\": 1, \"name\": \"zoo\", \"scalar\": \"double\", \"batches\": \"json\", \"offers\": 3}\n"},
    {"hello-inputs",
     "{\"nearmiss\": 1, \"name\": \"zoo\", \"scalar\": \"double\", \"batches\": \"json\", "
     "\"offers\": [{\"query\": \"sphere_sphere_overlap\", \"inputs\": 1e300}]}\n"},
    {"hello-contract",
     "{\"nearmiss\": 1, \"name\": \"zoo\", \"scalar\": \"double\", \"batches\": \"json\", "
     "\"offers\": [{\"query\": \"sphere_sphere_overlap\", \"contract\": {\"backward\": -1}}]}\n"},
    {"hello-requires",
     "{\"nearmiss\": 1, \"name\": \"zoo\", \"scalar\": \"double\", \"batches\": \"json\", "
     "\"offers\": [{\"query\": \"sphere_sphere_overlap\", \"requires\": [\"luck\"]}]}\n"},
};

/* Lines that replace an answer, by name. */
static const struct {
  const char *name, *text;
} replies[] = {
    {"reply-nothing", "\n"},
    {"reply-noise", "\x80\xff{\n"},
    {"reply-list", "[]\n"},
    {"reply-empty", "{\"case\": %u}\n"},
    {"reply-yes", "{\"case\": %u, \"yes\": 1}\n"},
    {"reply-values", "{\"case\": %u, \"yes\": true, \"values\": [1, 2, 3]}\n"},
    {"reply-cannot", "{\"case\": %u, \"cannot\": 7}\n"},
    {"reply-cannot-and-yes", "{\"case\": %u, \"cannot\": \"x\", \"yes\": false}\n"},
    {"reply-unknown", "{\"case\": %u, \"yes\": true, \"time\": 1}\n"},
    {"reply-without-case", "{\"yes\": true}\n"},
    {"reply-other-case", "{\"case\": 7, \"yes\": true}\n"},
    {"reply-none", ""},
    {"reply-key-twice", "{\"case\": %u, \"yes\": true, \"yes\": false}\n"},
    {"reply-case-twice", "{\"case\": 7, \"case\": %u, \"yes\": true}\n"},
    {"reply-key-in-escapes-twice", "{\"case\": %u, \"yes\": true, \"y\\u0065s\": false}\n"},
    {"reply-case-negative", "{\"case\": -1, \"yes\": true}\n"},
    {"reply-case-fraction", "{\"case\": %u.5, \"yes\": true}\n"},
    {"reply-case-text", "{\"case\": \"%u\", \"yes\": true}\n"},
    {"reply-case-huge", "{\"case\": 99999999999999999999999, \"yes\": true}\n"},
    {"reply-mark", "\xef\xbb\xbf{\"case\": %u, \"yes\": true}x\n"},
    {"reply-two-on-a-line", "{\"case\": %u, \"yes\": true}{\"case\": %u, \"yes\": true}\n"},
    {"reply-two-of-one-line", "{\"case\": %u,\n\"yes\": true}\n"},
    {"reply-beside-noise", "a line of a log\n{\"case\": %u, \"yes\": true}\n"},
    {"reply-twice", "{\"case\": %u, \"yes\": true}\n{\"case\": %u, \"yes\": true}\n"},
};

/* A string of JSON. */
static void put_text(FILE* judge, const char* text) {
  fputc('"', judge);
  for (; *text != 0; ++text) {
    const unsigned char c = (unsigned char)*text;
    if (c < 0x20 || c == '"' || c == '\\') {
      fprintf(judge, "\\u%04x", c);
    } else {
      fputc(c, judge);
    }
  }
  fputc('"', judge);
}

/* The usual hello with a hostile text; 0 where none is chosen. */
static int say_hostile_hello(FILE* judge) {
  const char *version = hostile_text("version"), *how = hostile_text("how"), *refused = hostile_text("refused");
  if (version == NULL && how == NULL && refused == NULL) return 0;
  fputs("{\"nearmiss\": 1, ", judge);
  if (refused != NULL) {
    fputs("\"refused\": ", judge);
    put_text(judge, refused);
  } else {
    fputs("\"name\": \"zoo\", \"scalar\": \"double\", \"batches\": \"json\", \"version\": ", judge);
    put_text(judge, version != NULL ? version : "1");
    fputs(", \"offers\": [{\"query\": \"sphere_sphere_overlap\", \"how\": ", judge);
    put_text(judge, how != NULL ? how : "as it is");
    fputs("}]", judge);
  }
  fputs("}\n", judge);
  fflush(judge);
  return 1;
}

static void say(FILE* judge, const char* text) {
  fputs(text, judge);
  fflush(judge);
}

static void say_hello(FILE* judge) {
  if (say_hostile_hello(judge)) return;
  if (is_chosen("hello-deep")) {
    for (int i = 0; i < 500000; ++i) fputc('[', judge);
    say(judge, "\n");
    return;
  }
  if (is_chosen("hello-endless")) {
    for (;;) {
      if (fputc('x', judge) == EOF) exit(1);
    }
  }
  if (is_chosen("hello-deep-requirement")) {
    fputs(
        "{\"nearmiss\": 1, \"name\": \"zoo\", \"scalar\": \"double\", \"batches\": \"json\", "
        "\"offers\": [{\"query\": \"sphere_sphere_overlap\", \"requires\": ",
        judge);
    for (int i = 0; i < 200000; ++i) fputc('[', judge);
    for (int i = 0; i < 200000; ++i) fputc(']', judge);
    say(judge, "}]}\n");
    return;
  }
  for (size_t i = 0; i < sizeof hellos / sizeof *hellos; ++i) {
    if (is_chosen(hellos[i].name)) {
      say(judge, hellos[i].text);
      return;
    }
  }
  if (is_chosen("hello-binary")) {
    say(judge,
        "{\"nearmiss\": 1, \"name\": \"zoo\", \"scalar\": \"double\", \"batches\": \"binary\", "
        "\"offers\": [{\"query\": \"sphere_sphere_overlap\"}]}\n");
    write_all_to(4, 4096);
    sleep_for_ever();
  }
  if (is_chosen("hello-drips-without-end")) {
    for (;; usleep(1000)) say(judge, " ");
  }
  char hello[1024];
  const int is_second = (is_chosen("hello-otherwise") || is_chosen("hello-reordered")) && !is_first_time();
  if (is_chosen("hello-reordered") && is_second) {
    snprintf(hello, sizeof hello, reordered_hello, subject_name);
  } else {
    snprintf(hello, sizeof hello, usual_hello, subject_name, is_second ? "2" : "1");
  }
  if (is_chosen("hello-drips")) {
    for (const char* c = hello; *c != '\0'; ++c) {
      fputc(*c, judge);
      fflush(judge);
    }
    return;
  }
  fputs(hello, judge);
  if (is_chosen("hello-and-noise")) fputs("and more\n", judge);
  if (is_chosen("hello-and-answer")) fputs("{\"case\": 0, \"yes\": true}\n", judge);
  if (is_chosen("hello-twice")) fputs(hello, judge);
  fflush(judge);
}

/* Writes a reply in a broken or unusual way. Returns 0 where none is chosen. */
static int reply_otherwise(FILE* judge, const char* reply, unsigned number) {
  char text[256];
  const int length = snprintf(text, sizeof text, reply, number, number);
  if (is_chosen("reply-cut")) {
    fwrite(text, 1, (size_t)length / 2, judge);
    exit(0);
  }
  if (is_chosen("reply-cut-and-killed")) {
    fwrite(text, 1, (size_t)length / 2, judge);
    fflush(judge);
    raise(SIGKILL);
  }
  if (is_chosen("reply-in-pieces")) {
    for (int i = 0; i < length; ++i) {
      fputc(text[i], judge);
      fflush(judge);
    }
    return 1;
  }
  if (is_chosen("reply-with-returns")) {
    fprintf(judge, "\t%.*s \r\n", length - 1, text);
    return 1;
  }
  if (is_chosen("reply-of-next")) {
    fprintf(judge, reply, number + 1, number + 1);
    fputs(text, judge);
    return 1;
  }
  if (is_chosen("reply-and-next")) {
    fputs(text, judge);
    fprintf(judge, reply, number + 1, number + 1);
    return 1;
  }
  if (is_chosen("reply-thousand-times")) {
    for (int i = 0; i < 1000; ++i) fputs(text, judge);
    return 1;
  }
  return 0;
}

int main(int argc, char** argv) {
  FILE *cases = fdopen(3, "r"), *judge = fdopen(4, "w");
  static char line[1 << 22];
  unsigned asked = 0;
  if (argc > 1) choose(argv[1]);
  do_misdeed("load-");
  if (cases == NULL || judge == NULL) return 2;
  say_hello(judge);
  while (fgets(line, sizeof line, cases) != NULL) {
    const unsigned before = asked;
    for (const char* at = strchr(strchr(line, '[') + 1, '['); at != NULL; at = strchr(at + 1, '[')) {
      double q[8];
      char* end = (char*)at + 1;
      for (int i = 0; i < 8; ++i, ++end) q[i] = strtod(end, &end);
      const double x = q[0] - q[4], y = q[1] - q[5], z = q[2] - q[6], reach = q[3] + q[7];
      const char* reply = x * x + y * y + z * z <= reach * reach ? "{\"case\": %u, \"yes\": true}\n"
                                                                 : "{\"case\": %u, \"yes\": false}\n";
      const unsigned number = asked;
      do_misdeed_of_case(++asked);
      if (asked % 40 == 0) {
        end_with_hostile_text();
        if (hostile_text("why") != NULL) {
          fprintf(judge, "{\"case\": %u, \"cannot\": ", number);
          put_text(judge, hostile_text("why"));
          fputs("}\n", judge);
          continue;
        }
        for (size_t i = 0; i < sizeof replies / sizeof *replies; ++i) {
          if (is_chosen(replies[i].name)) reply = replies[i].text;
        }
        if (is_chosen("reply-long")) write_all_to(4, 1 << 20);
        if (is_chosen("reply-drips")) {
          for (;;) {
            fputs(" ", judge);
            fflush(judge);
            usleep(10000);
          }
        }
        if (is_chosen("reply-without-end")) {
          fputs("{\"yes\": tr", judge);
          fflush(judge);
          sleep_for_ever();
        }
        if (reply_otherwise(judge, reply, number)) continue;
      }
      fprintf(judge, reply, number, number);
      if (is_chosen("seldom-sleeps")) fflush(judge);
    }
    if (!is_chosen("reply-unflushed")) fflush(judge);
    if (asked / 40 == before / 40) continue; /* the 40th case is not in this batch */
    if (is_chosen("reply-and-exit")) return 0;
    if (is_chosen("reply-and-noise")) say(judge, "and more\n");
  }
  return 0;
}
