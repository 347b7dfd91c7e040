/* The misdeeds of a subject, by name. The environment variable NEARMISS_ZOO selects one, or, where many are run at
 * once, the name of the plugin's file or the program's argument (choose()). Shared by the plugin and the program.
 *
 * Words before a name say when it is done: "ask-" in every 40th case of a process, "seldom-" in every 190th, "once-" in
 * the 40th case of the first process alone. */
#ifndef NEARMISS_TESTS_MISDEEDS_H
#define NEARMISS_TESTS_MISDEEDS_H

#define _GNU_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <fenv.h>
#include <pthread.h>
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/shm.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "reports/tests/zoo/attacks.h"
static char chosen_name[64], subject_name[80] = "zoo";

/* Selects a misdeed; the subject is then named after it. */
static void choose(const char* misdeed) {
  snprintf(chosen_name, sizeof chosen_name, "%s", misdeed);
  snprintf(subject_name, sizeof subject_name, "zoo-%s", chosen_name);
}
static const char* the_chosen(void) { return chosen_name[0] != '\0' ? chosen_name : getenv("NEARMISS_ZOO"); }

static int is_chosen(const char* what) {
  const char* chosen = the_chosen();
  return chosen != NULL && strcmp(chosen, what) == 0;
}

static void spin(void) {
  for (volatile int forever = 1; forever;) {
  }
}
/* More processor time than the tests let a case take. */
static void work_for_a_while(void) {
  while (clock() < CLOCKS_PER_SEC / 5) {
  }
}
static void sleep_for_ever(void) {
  for (;;) pause();
}

/* Marks that this was done before, in the file that NEARMISS_ZOO_MARK names, or in one for each subject. */
static int is_first_time(void) {
  const char* mark = getenv("NEARMISS_ZOO_MARK");
  char name[512];
  snprintf(name, sizeof name, "%s%s", mark == NULL ? "" : mark, chosen_name);
  const int file = mark == NULL ? -1 : open(name, O_WRONLY | O_CREAT | O_EXCL, 0600);
  if (file >= 0) close(file);
  return file >= 0;
}

/* A process that would live for a minute. */
static void leave_behind(int sessions) {
  if (fork() != 0) return;
  for (int i = 0; i < sessions; ++i) {
    setsid();
    if (fork() != 0) _exit(0);
  }
  signal(SIGTERM, SIG_IGN);
  signal(SIGHUP, SIG_IGN);
  sleep(60);
  _exit(0);
}

static int overflow_the_stack(volatile int depth) {
  volatile char room[4096];
  room[0] = (char)depth;
  return overflow_the_stack(depth + 1) + room[0];
}

static void eat_memory(void) {
  for (size_t size = (size_t)1 << 24;;) {
    char* volatile more = malloc(size); /* a compiler may remove unused memory */
    if (more == NULL) abort();
    more[0] = 1;
  }
}

static void close_all(int from) {
  for (int file = from; file < 1024; ++file) close(file);
}

static void write_all_to(int file, size_t bytes) {
  char block[4096];
  memset(block, 'x', sizeof block);
  for (size_t put = 0; put < bytes; put += sizeof block) {
    if (write(file, block, sizeof block) < 0) return;
  }
}

/* Writes noise over every shared mapping that can be written: the answers, where a host has them there. */
static void scribble_over_shared_memory(unsigned char with) {
  FILE* maps = fopen("/proc/self/maps", "r");
  char line[512];
  while (maps != NULL && fgets(line, sizeof line, maps) != NULL) {
    unsigned long begin, end;
    char rights[5];
    if (sscanf(line, "%lx-%lx %4s", &begin, &end, rights) != 3 || strncmp(rights, "rw-s", 4) != 0) continue;
    memset((void*)begin, with, end - begin);
  }
  if (maps != NULL) fclose(maps);
}

/* The first shared mapping that can be written. */
static void* shared_memory(size_t* size) {
  FILE* maps = fopen("/proc/self/maps", "r");
  char line[512];
  void* found = NULL;
  while (maps != NULL && found == NULL && fgets(line, sizeof line, maps) != NULL) {
    unsigned long begin, end;
    char rights[5];
    if (sscanf(line, "%lx-%lx %4s", &begin, &end, rights) != 3 || strncmp(rights, "rw-s", 4) != 0) continue;
    found = (void*)begin;
    *size = end - begin;
  }
  if (maps != NULL) fclose(maps);
  return found;
}

static unsigned long backtracks(unsigned depth) {
  return depth == 0 ? 1 : backtracks(depth - 1) + backtracks(depth - 1);
}

static void* sleep_in_a_thread(void* unused) {
  (void)unused;
  sleep_for_ever();
  return NULL;
}

static void* answer_for_ever(void* unused) {
  (void)unused;
  for (;;) scribble_over_shared_memory(0xff);
  return NULL;
}

static void trap_floating_point(void) {
  feclearexcept(FE_ALL_EXCEPT);
  feenableexcept(FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW);
  volatile double zero = 0;
  volatile double nothing = 1 / zero;
  (void)nothing;
}

/* Makes the system send SIGKILL to the process when a pipe becomes readable. */
static void signal_by_a_file(pid_t process) {
  int ends[2];
  if (pipe(ends) != 0) return;
  if (fcntl(ends[0], F_SETOWN, process) != 0 || fcntl(ends[0], F_SETSIG, SIGKILL) != 0) return;
  fcntl(ends[0], F_SETFL, O_ASYNC);
  if (write(ends[1], "x", 1) == 1) usleep(10000);
}

/* Does to the judge and to its supervisor what would end or cripple them. */
static void assault(void) {
  look_around();
  if (judge == 0) return;
  const struct rlimit none = {0, 0};
  kill(judge, SIGKILL);
  syscall(SYS_tgkill, judge, judge, SIGKILL);
  signal_by_a_file(judge);
  for (int limit = 0; limit < RLIM_NLIMITS; ++limit) syscall(SYS_prlimit64, judge, limit, &none, NULL);
  kill(supervisor, SIGSTOP);
  kill(supervisor, SIGKILL);
  if (mount("zoo", target(""), "tmpfs", 0, "size=4k") == 0) fputs("mounted\n", stderr);
  usleep(50000);
  fputs("did its worst\n", stderr);
}

/* What a subject does to the memory that it shares with the judge; a program has none. */
static void spoil_shared_memory(const char* name) {
  size_t size = 0;
  unsigned char* shared = (unsigned char*)shared_memory(&size);
  if (shared == NULL) return;
#define IF(what) if (strcmp(name, what) == 0)
  IF("counts-more") * (volatile uint32_t*)shared += 1;
  IF("counts-from-the-start") * (volatile uint32_t*)shared = 0;
  IF("scribbles-behind-the-count") memset(shared + 8, 0x5a, size - 8);
  IF("clears-behind-the-count") memset(shared + 8, 0, size - 8);
  IF("copies-answers") memmove(shared + 8 + 240, shared + 8, 2048);
  IF("unmaps-answers") munmap(shared, size);
  IF("protects-answers") mprotect(shared, size, PROT_READ);
  IF("replaces-answers") mmap(shared, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED, -1, 0);
#undef IF
}

/* Returns where the misdeed lets it. The same names as of a load begin with "load-". */
static void do_misdeed(const char* when) {
  char name[64];
  const char* chosen = the_chosen();
  if (chosen == NULL || strncmp(chosen, when, strlen(when)) != 0) return;
  snprintf(name, sizeof name, "%s", chosen + strlen(when));
#define IF(what) if (strcmp(name, what) == 0)
  IF("exit-0") exit(0);
  IF("exit-1") exit(1);
  IF("quick-exit") _exit(7);
  IF("abort") abort();
  IF("assertion") {
    fputs("balls.c:42: balls_meet: Assertion `radius > 0' failed.\n", stderr);
    abort();
  }
  IF("segfault") * (volatile int*)8 = 1;
  IF("bus-error") raise(SIGBUS);
  IF("illegal") raise(SIGILL);
  IF("floating-trap") trap_floating_point();
  IF("terminates-itself") raise(SIGTERM);
  IF("kills-itself") raise(SIGKILL);
  IF("stack") overflow_the_stack(0);
  IF("memory") eat_memory();
  IF("spins") spin();
  IF("takes-a-while") work_for_a_while();
  IF("sleeps") sleep_for_ever();
  IF("stops-itself") raise(SIGSTOP);
  IF("blocks-signals-and-spins") {
    sigset_t all;
    sigfillset(&all);
    sigprocmask(SIG_SETMASK, &all, NULL);
    spin();
  }
  IF("ignores-signals-and-sleeps") {
    for (int s = 1; s < 64; ++s) signal(s, SIG_IGN);
    sleep_for_ever();
  }
  IF("alarm") {
    alarm(1);
    sleep_for_ever();
  }
  IF("closes-files") close_all(0);
  IF("closes-files-and-sleeps") {
    close_all(0);
    sleep_for_ever();
  }
  IF("closes-pipes-and-spins") {
    close_all(3);
    spin();
  }
  IF("execs-sleep") execl("/bin/sleep", "sleep", "60", (char*)NULL);
  IF("execs-true") execl("/bin/true", "true", (char*)NULL);
  IF("leaves-a-child") leave_behind(0), abort();
  IF("leaves-a-session") leave_behind(1), abort();
  IF("leaves-an-orphan") leave_behind(2), abort();
  IF("leaves-an-orphan-and-exits") leave_behind(2), _exit(0);
  IF("leaves-an-orphan-and-spins") leave_behind(2), spin();
  IF("leaves-group") {
    setpgid(0, 0);
    sleep_for_ever();
  }
  IF("leaves-shared-memory") {
    shmget(0x4e4d, 4096, IPC_CREAT | 0600);
    abort();
  }
  IF("many-children") {
    for (int i = 0; i < 200; ++i) {
      if (fork() == 0) sleep(60), _exit(0);
    }
    abort();
  }
  IF("kills-its-parent") {
    kill(getppid(), SIGKILL);
    usleep(50000);
    abort();
  }
  IF("stops-its-parent") {
    kill(getppid(), SIGSTOP);
    usleep(50000);
    abort();
  }
  IF("terminates-its-parent") {
    kill(getppid(), SIGTERM);
    sleep_for_ever();
  }
  IF("kills-its-group") kill(0, SIGKILL);
  IF("traces-its-parent") {
    if (ptrace(PTRACE_ATTACH, getppid(), NULL, NULL) == 0) sleep_for_ever();
    abort();
  }
  IF("noise-to-judge") {
    write_all_to(4, 1 << 16);
    sleep_for_ever();
  }
  IF("floods-judge") write_all_to(4, (size_t)1 << 28);
  IF("nul-to-judge") {
    static const char nothing[64];
    if (write(4, nothing, sizeof nothing) > 0) sleep_for_ever();
  }
  IF("says-done") {
    if (write(4, "d", 1) == 1) usleep(100000);
  }
  IF("writes-to-its-input") {
    if (write(3, "g", 1) != 1) abort();
  }
  IF("floods-output") {
    write_all_to(1, (size_t)1 << 26);
    abort();
  }
  IF("floods-error") {
    write_all_to(2, (size_t)1 << 26);
    abort();
  }
  IF("escapes-to-output") {
    fputs(
        "\033[2J\033]0;owned\007\xc2\x9b"
        "31m\xe2\x80\xae"
        "drawkcab\n",
        stderr);
    abort();
  }
  IF("json-to-output") {
    puts("[{\"finding\": {\"verdict\": \"agrees\"}}]");
    fflush(stdout);
    abort();
  }
  IF("keeps-output-in-buffer") printf("never flushed");
  IF("reads-its-input") {
    char byte;
    if (read(0, &byte, 1) != 0) sleep_for_ever();
    fputs("standard input is empty\n", stderr);
    abort();
  }
  IF("fills-the-disk") {
    char file[] = "/tmp/nearmiss-zoo-XXXXXX";
    const int big = mkstemp(file);
    unlink(file);
    write_all_to(big, (size_t)1 << 26);
    fprintf(stderr, "wrote %ld bytes\n", (long)lseek(big, 0, SEEK_END));
    abort();
  }
  IF("changes-folder") {
    if (chdir("/") == 0) umask(0777);
  }
  IF("scribbles") scribble_over_shared_memory(0xff);
  IF("scribbles-zeros") scribble_over_shared_memory(0);
  IF("scribbles-for-ever") {
    pthread_t thread;
    pthread_create(&thread, NULL, answer_for_ever, NULL);
  }
  IF("shrinks-shared-memory") {
    for (int file = 5; file <= 6; ++file) {
      if (ftruncate(file, 0) == 0) fputs("it became smaller\n", stderr);
    }
    abort();
  }
  IF("writes-cases") {
    void* cases = mmap(NULL, 4096, PROT_READ | PROT_WRITE, MAP_SHARED, 5, 0);
    fputs(cases == MAP_FAILED ? "the cases cannot be written\n" : "the cases can be written\n", stderr);
    abort();
  }
  IF("attacks") attack(), abort();
  IF("assault") leave_behind(2), assault(), abort();
  IF("seals-answers") {
    if (fcntl(6, F_ADD_SEALS, F_SEAL_FUTURE_WRITE) == 0) fputs("it sealed its answers\n", stderr);
    abort();
  }
  IF("forks-for-ever") {
    for (;;) fork();
  }
  IF("limits") {
    const struct rlimit none = {0, 0};
    setrlimit(RLIMIT_NOFILE, &none);
    setrlimit(RLIMIT_FSIZE, &none);
  }
  IF("thread-that-crashes") {
    pthread_t thread;
    pthread_create(&thread, NULL, (void* (*)(void*))(uintptr_t)16, NULL);
    usleep(50000);
  }
  IF("closes-its-pipe-and-lives-on") close(4);
  IF("child-holds-the-pipe") {
    if (fork() == 0) sleep_for_ever();
    abort();
  }
  IF("child-lives-on") {
    if (fork() == 0) sleep_for_ever();
  }
  IF("exits-in-a-child") {
    const pid_t child = fork();
    if (child == 0) exit(0); /* writes what is in the buffers of its parent */
    waitpid(child, NULL, 0);
  }
  IF("speaks-on-stdout") {
    puts("{\"case\": 0, \"yes\": true}");
    fflush(stdout);
  }
  IF("frees-twice") {
    char* volatile twice = malloc(100);
    free(twice);
    free(twice);
  }
  IF("leaks") {
    if (malloc((size_t)512 << 20) == NULL) abort();
  }
  IF("profiles-itself") {
    const struct itimerval soon = {{0, 1000}, {0, 1000}};
    setitimer(ITIMER_PROF, &soon, NULL);
    spin();
  }
  IF("divides-by-zero") {
    volatile int seven = 7, zero = 0;
    zero = seven / zero;
  }
  IF("runs-data") {
    static const unsigned char data[16] = {0xc3};
    ((void (*)(void))(uintptr_t)data)();
  }
  IF("breaks-a-pipe") {
    int ends[2];
    if (pipe(ends) == 0 && close(ends[0]) == 0 && write(ends[1], "x", 1) != 1) abort();
  }
  IF("lowers-its-priority") setpriority(PRIO_PROCESS, 0, 19);
  IF("many-threads") {
    for (int i = 0; i < 20; ++i) {
      pthread_t thread;
      pthread_create(&thread, NULL, sleep_in_a_thread, NULL);
    }
  }
  IF("opens-every-file") {
    while (open("/dev/null", O_RDONLY) >= 0) {
    }
  }
  IF("points-the-pipe-elsewhere") dup2(open("/dev/null", O_WRONLY), 4);
  IF("waits-for-a-request") {
    char byte;
    while (read(3, &byte, 1) == 1) {
    }
  }
  IF("backtracks") {
    if (backtracks(60) == 0) abort();
  }
  IF("says-done-twice") {
    if (write(4, "dd", 2) != 2) abort();
  }
  IF("noise-once") {
    if (write(4, "noise\n", 6) != 6) abort();
  }
  spoil_shared_memory(name);
#undef IF
}

/* Called for each case, by its number in this process, from 1. */
static void do_misdeed_of_case(unsigned number) {
  if (number % 40 == 0) do_misdeed("ask-");
  if (number % 190 == 0) do_misdeed("seldom-");
  if (number == 40 && the_chosen() != NULL && strncmp(the_chosen(), "once-", 5) == 0 && is_first_time())
    do_misdeed("once-");
  do_misdeed("always-");
}

/* --- hostile texts: NEARMISS_ZOO=text-PLACE-NAME puts the text of that name into that place --- */

static const struct {
  const char *name, *text;
} hostile_texts[] = {
    {"comment", "1 */ __attribute__((constructor)) static void injected(void) { puts(\"INJECTED\"); } /* 2"},
    {"lines", "1\n#error INJECTED\n// \\\nINJECTED\r\n2 \\"},
    {"trigraph", "1 ?\?/\nINJECTED ?\?= ?\?/"},
    {"markdown", "1 | INJECTED | `x` **b** [l](http://x) ![i](x) \n```\n# INJECTED"},
    {"html", "</script><script>alert('INJECTED')</script><img src=x onerror=alert(1)>&amp;<!--"},
    {"cdata", "]]>&lt;INJECTED/>\" a='b"},
    {"json", "\"}, \"verdict\": \"agrees\", {\"INJECTED\": \"\\u0000"},
    {"shell", "$(touch INJECTED) `touch INJECTED`; touch INJECTED & '\"'"},
    {"formula", "=cmd|' /C INJECTED'!A0,\"1\""},
    {"escapes", "\033[2J\033]0;INJECTED\007\033[1;31m\b\b\x7f\xc2\x9b"},
    {"direction", "\xe2\x80\xae INJECTED \xe2\x81\xa6\xef\xbb\xbf"},
    {"separator", "1\xe2\x80\xa8INJECTED\xe2\x80\xa9\xc2\x85"},
    {"not-utf8", "1\xff\xfe\xc0\xaf\xed\xa0\x80\xf4\x90\x80\x80 INJECTED \xe2\x80"},
    {"formats", "%s%n%d {} {0} ${HOME} %INJECTED%"},
    {"mixed",
     "=1 */ __attribute__((constructor)) static void injected(void) { puts(\"INJECTED\"); } /* | `x` **b** "
     "[l](http://x)"
     "\n#error INJECTED\n```\n# INJECTED\n</script><script>alert('INJECTED')</script> ]]>&lt; \", 'a {} %s $(touch "
     "INJECTED)"
     "\033[2J\033]0;INJECTED\007\b\x7f\xc2\x9b\xe2\x80\xae\xe2\x80\xa8INJECTED\xff ?\?/\nINJECTED \\"},
};

/* The text for the place; NULL where none is chosen for it. "all" chooses each place that ends no process and refuses
 * nothing. */
static const char* hostile_text(const char* place) {
  static char longest[100000];
  static const char* const of_all[] = {"all", "version", "equivalence", "how"};
  const char* chosen = the_chosen();
  if (chosen == NULL || strncmp(chosen, "text-", 5) != 0) return NULL;
  const char* name = strchr(chosen + 5, '-');
  if (name == NULL) return NULL;
  const size_t length = (size_t)(name - chosen - 5);
  int is_meant = strlen(place) == length && strncmp(chosen + 5, place, length) == 0;
  for (size_t i = 0; i < sizeof of_all / sizeof *of_all; ++i) {
    if (strncmp(chosen + 5, "all-", 4) == 0 && strcmp(of_all[i], place) == 0) is_meant = 1;
  }
  if (!is_meant) return NULL;
  if (strcmp(name + 1, "long") == 0) return memset(longest, 'x', sizeof longest - 1);
  for (size_t i = 0; i < sizeof hostile_texts / sizeof *hostile_texts; ++i) {
    if (strcmp(hostile_texts[i].name, name + 1) == 0) return hostile_texts[i].text;
  }
  return NULL;
}

/* Ends with the text on standard error, where it is chosen. */
static void end_with_hostile_text(void) {
  if (is_chosen("text-error-nul")) {
    static const char text[] = "1\0\0INJECTED\0";
    fwrite(text, 1, sizeof text, stderr);
    abort();
  }
  const char* text = hostile_text("error");
  if (text == NULL) return;
  fputs(text, stderr);
  abort();
}

#endif
