/* What a subject may try against the judge, its neighbours and the system: each attack returns 1 where it succeeded.
 * None of them does harm where it succeeds: a signal is the signal 0, a limit or a priority is set to what it was, a
 * file is opened and not written. */
#ifndef NEARMISS_TESTS_ATTACKS_H
#define NEARMISS_TESTS_ATTACKS_H

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <linux/capability.h>
#include <linux/kcmp.h>
#include <sched.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/mount.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/sysmacros.h>
#include <sys/uio.h>
#include <sys/wait.h>
#include <unistd.h>

/* The processes around this one, by their ids in /proc. 0: not found. */
static pid_t judge, supervisor, neighbour;

/* Reads the name and the parent of a process. */
static int look_at_process(pid_t process, char name[64], pid_t* parent) {
  char file[64], text[512];
  snprintf(file, sizeof file, "/proc/%d/stat", process);
  FILE* stat_file = fopen(file, "r");
  if (stat_file == NULL) return 0;
  const size_t got = fread(text, 1, sizeof text - 1, stat_file);
  fclose(stat_file);
  text[got] = '\0';
  char *begin = strchr(text, '('), *end = strrchr(text, ')'), state;
  if (begin == NULL || end == NULL || end - begin > 60) return 0;
  snprintf(name, 64, "%.*s", (int)(end - begin - 1), begin + 1);
  return sscanf(end + 1, " %c %d", &state, parent) == 2;
}

static int is_below(pid_t process, pid_t ancestor) {
  char name[64];
  for (int depth = 0; process > 1 && depth < 32; ++depth) {
    if (process == ancestor) return 1;
    if (!look_at_process(process, name, &process)) return 0;
  }
  return 0;
}

static void look_around(void) {
  char text[32] = "", name[64];
  if (readlink("/proc/self", text, sizeof text - 1) < 0) return;
  const pid_t self = atoi(text);
  pid_t parent = 0, own_supervisor = 0;
  for (pid_t p = self; p > 1 && look_at_process(p, name, &parent); p = parent) {
    if (p == self) continue;
    if (strcmp(name, "nearmiss-super") == 0) own_supervisor = p;
    if (strcmp(name, "nearmiss-super") == 0 && supervisor == 0) supervisor = p;
    if (strcmp(name, "nearmiss-super") != 0 && own_supervisor != 0) {
      judge = p;
      break;
    }
  }
  DIR* folder = opendir("/proc");
  for (const struct dirent* e; folder != NULL && (e = readdir(folder)) != NULL;) {
    const pid_t p = atoi(e->d_name);
    if (p <= 0 || judge == 0 || !look_at_process(p, name, &parent)) continue;
    if (strncmp(name, "collide-fast", 12) == 0 && is_below(p, judge) && !is_below(p, own_supervisor)) neighbour = p;
  }
  if (folder != NULL) closedir(folder);
}

static int opens(const char* name, int how) {
  const int file = open(name, how | O_CLOEXEC, 0600);
  if (file >= 0) close(file);
  return file >= 0;
}
static int opens_of(pid_t process, const char* what, int how) {
  char name[128];
  snprintf(name, sizeof name, "/proc/%d/%s", process, what);
  return opens(name, how);
}
/* Opens one of the files of a process. Their numbers may be listed, as they tell nothing. */
static int opens_file_of(pid_t process) {
  for (int file = 0; file < 16; ++file) {
    char name[32];
    snprintf(name, sizeof name, "fd/%d", file);
    if (opens_of(process, name, O_RDONLY) || opens_of(process, name, O_WRONLY)) return 1;
  }
  return 0;
}
static int lists_mappings_of(pid_t process) {
  char name[128];
  int count = 0;
  snprintf(name, sizeof name, "/proc/%d/map_files", process);
  DIR* folder = opendir(name);
  while (folder != NULL && readdir(folder) != NULL) ++count;
  if (folder != NULL) closedir(folder);
  return count > 2; /* itself and the folder above it */
}
static int traces(pid_t process) {
  if (ptrace(PTRACE_SEIZE, process, NULL, NULL) != 0) return 0;
  ptrace(PTRACE_INTERRUPT, process, NULL, NULL);
  waitpid(process, NULL, __WALL);
  ptrace(PTRACE_DETACH, process, NULL, NULL);
  return 1;
}
static int reads_memory_of(pid_t process) {
  static long own = 1;
  long other = 0;
  const struct iovec here = {&other, sizeof other}, there = {&own, sizeof own};
  return syscall(SYS_process_vm_readv, process, &here, 1UL, &there, 1UL, 0UL) > 0 || errno == EFAULT;
}
static int limits(pid_t process) {
  struct rlimit was;
  return syscall(SYS_prlimit64, process, RLIMIT_CPU, NULL, &was) == 0;
}
static int moves(pid_t process) {
  cpu_set_t set;
  return sched_getaffinity(process, sizeof set, &set) == 0 && sched_setaffinity(process, sizeof set, &set) == 0;
}
static int slows(pid_t process) {
  errno = 0;
  const int was = getpriority(PRIO_PROCESS, (id_t)process);
  return errno == 0 && setpriority(PRIO_PROCESS, (id_t)process, was) == 0;
}
static int schedules(pid_t process) {
  struct sched_param p;
  const int policy = sched_getscheduler(process);
  return policy >= 0 && sched_getparam(process, &p) == 0 && sched_setscheduler(process, policy, &p) == 0;
}
static int signals_by_pidfd(pid_t process) {
  char name[64];
  snprintf(name, sizeof name, "/proc/%d", process);
  const int by_folder = open(name, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  const int by_number = (int)syscall(SYS_pidfd_open, process, 0);
  const int sent = syscall(SYS_pidfd_send_signal, by_folder, 0, NULL, 0) == 0 ||
                   syscall(SYS_pidfd_send_signal, by_number, 0, NULL, 0) == 0;
  close(by_folder), close(by_number);
  return sent;
}
static int signals_thread(pid_t process) {
  return syscall(SYS_tgkill, process, process, 0) == 0 || syscall(SYS_tkill, process, 0) == 0;
}
static int queues_signal(pid_t process) {
  siginfo_t info;
  memset(&info, 0, sizeof info);
  info.si_code = SI_QUEUE;
  return syscall(SYS_rt_sigqueueinfo, process, 0, &info) == 0;
}
static const char* target(const char* name) {
  static char file[4096];
  const char* folder = getenv("NEARMISS_ZOO_TARGET");
  snprintf(file, sizeof file, "%s%s", folder == NULL ? "/nowhere" : folder, name);
  return file;
}

static int judge_fd(void) { return opens_file_of(judge); }
static int judge_mem(void) { return opens_of(judge, "mem", O_RDWR); }
static int judge_environ(void) { return opens_of(judge, "environ", O_RDONLY); }
static int judge_maps(void) { return opens_of(judge, "maps", O_RDONLY); }
static int judge_root(void) { return opens_of(judge, "root", O_RDONLY) || opens_of(judge, "cwd", O_RDONLY); }
static int judge_oom(void) { return opens_of(judge, "oom_score_adj", O_WRONLY); }
static int judge_autogroup(void) { return opens_of(judge, "autogroup", O_WRONLY); }
static int judge_traced(void) { return traces(judge); }
static int judge_read(void) { return reads_memory_of(judge); }
static int judge_killed(void) { return kill(judge, 0) == 0; }
static int judge_group_killed(void) {
  const pid_t group = getpgid(judge);
  return group > 1 && kill(-group, 0) == 0;
}
static int judge_thread_killed(void) { return signals_thread(judge); }
static int judge_signalled(void) { return queues_signal(judge); }
static int judge_pidfd(void) { return signals_by_pidfd(judge); }
static int judge_limited(void) { return limits(judge); }
static int judge_moved(void) { return moves(judge); }
static int judge_slowed(void) { return slows(judge); }
static int judge_scheduled(void) { return schedules(judge); }
static int judge_compared(void) { return syscall(SYS_kcmp, judge, getpid(), KCMP_FILE, 0, 0) >= 0; }
static int supervisor_fd(void) { return opens_file_of(supervisor); }
static int supervisor_mem(void) { return opens_of(supervisor, "mem", O_RDWR); }
static int supervisor_traced(void) { return traces(supervisor); }
static int supervisor_killed(void) { return kill(supervisor, 0) == 0; }
static int supervisor_limited(void) { return limits(supervisor); }
static int neighbour_fd(void) { return opens_file_of(neighbour); }
static int neighbour_answers(void) { return opens_of(neighbour, "fd/6", O_RDWR); }
static int neighbour_mapping(void) { return lists_mappings_of(neighbour); }
static int neighbour_mem(void) { return opens_of(neighbour, "mem", O_RDWR); }
static int neighbour_traced(void) { return traces(neighbour); }
static int neighbour_killed(void) { return kill(neighbour, 0) == 0; }
static int neighbour_pidfd(void) { return signals_by_pidfd(neighbour); }
static int all_killed(void) {
  const uid_t first_of_hosts = 0x70000000; /* to such a user, who may signal nobody, the system answers 0 as well */
  return getuid() < first_of_hosts && kill(-1, 0) == 0;
}
static int init_root(void) { return opens_of(1, "root/.", O_RDONLY) || opens_of(1, "mem", O_RDWR); }
static int becomes_superuser(void) { return setresuid(0, 0, 0) == 0 || setresgid(0, 0, 0) == 0 || setuid(0) == 0; }
static int has_capabilities(void) {
  struct __user_cap_header_struct header = {_LINUX_CAPABILITY_VERSION_3, 0};
  struct __user_cap_data_struct own[2];
  return syscall(SYS_capget, &header, own) == 0 && (own[0].permitted | own[1].permitted) != 0;
}
static int mounts(void) {
  if (mount("zoo", target(""), "tmpfs", 0, "size=4k") != 0) return 0;
  umount(target(""));
  return 1;
}
static int binds(void) {
  if (mount("/", target(""), NULL, MS_BIND, NULL) != 0) return 0;
  umount(target(""));
  return 1;
}
static int leaves_root(void) { return chroot("/tmp") == 0; }
static int leaves_mounts(void) { return unshare(CLONE_NEWNS) == 0; }
static int joins_judge(void) {
  char name[64];
  snprintf(name, sizeof name, "/proc/%d/ns/mnt", judge);
  const int file = open(name, O_RDONLY);
  const int joined = file >= 0 && setns(file, 0) == 0;
  if (file >= 0) close(file);
  return joined;
}
static int makes_device(void) {
  char name[] = "/tmp/nearmiss-zoo-XXXXXX";
  if (mkdtemp(name) == NULL) return 0;
  char device[64];
  snprintf(device, sizeof device, "%s/null", name);
  const int made = mknod(device, S_IFCHR | 0600, makedev(1, 3)) == 0;
  unlink(device);
  rmdir(name);
  return made;
}
static int makes_in_dev(void) {
  const int made = opens("/dev/nearmiss-zoo", O_WRONLY | O_CREAT);
  if (made) unlink("/dev/nearmiss-zoo");
  return made;
}
static int opens_memory(void) { return opens("/dev/mem", O_RDONLY) || opens("/dev/port", O_RDONLY); }
static int opens_disk(void) { return opens("/dev/vda", O_RDONLY) || opens("/dev/sda", O_RDONLY); }
static int opens_terminal(void) { return opens("/dev/tty", O_RDWR); }
static int opens_secrets(void) { return opens("/etc/shadow", O_RDONLY); }
static int sets_kernel(void) { return opens("/proc/sys/kernel/core_pattern", O_WRONLY); }
static int raises_limit(void) {
  struct rlimit r;
  getrlimit(RLIMIT_NPROC, &r);
  if (r.rlim_max == RLIM_INFINITY) return 1;
  r.rlim_max += 1000;
  return setrlimit(RLIMIT_NPROC, &r) == 0;
}
static int hurries(void) { return setpriority(PRIO_PROCESS, 0, -5) == 0; }
static int names_host(void) {
  char name[256];
  return gethostname(name, sizeof name) == 0 && sethostname(name, strnlen(name, sizeof name)) == 0;
}
static int seals_answers(void) { return fcntl(6, F_ADD_SEALS, F_SEAL_FUTURE_WRITE) == 0; }
static int writes_cases(void) {
  const int again = open("/proc/self/fd/5", O_RDWR | O_CLOEXEC);
  const int file = again >= 0 ? again : 5;
  void* const cases = mmap(NULL, 4096, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  const int can = cases != MAP_FAILED;
  if (cases != MAP_FAILED) munmap(cases, 4096);
  if (again >= 0) close(again);
  return can;
}
static int forks_for_ever(void) {
  enum { many = 3000 };
  static pid_t started[many];
  int count = 0;
  while (count < many && (started[count] = fork()) > 0) ++count;
  if (count < many && started[count] == 0) {
    for (;;) pause();
  }
  for (int i = 0; i < count; ++i) kill(started[i], SIGKILL);
  for (int i = 0; i < count; ++i) waitpid(started[i], NULL, 0);
  return count == many;
}
/* These are allowed to a subject of an ordinary user, which has the files of this user. */
static int writes_run_folder(void) { return opens(target("/zoo"), O_WRONLY | O_CREAT); }
static int writes_itself(void) { return opens(getenv("NEARMISS_ZOO_FILE"), O_WRONLY); }

static const struct {
  const char* name;
  int (*succeeds)(void);
} attacks[] = {
#define ATTACK(name) \
  { #name, name }
    ATTACK(judge_fd),
    ATTACK(judge_mem),
    ATTACK(judge_environ),
    ATTACK(judge_maps),
    ATTACK(judge_root),
    ATTACK(judge_oom),
    ATTACK(judge_autogroup),
    ATTACK(judge_traced),
    ATTACK(judge_read),
    ATTACK(judge_killed),
    ATTACK(judge_group_killed),
    ATTACK(judge_thread_killed),
    ATTACK(judge_signalled),
    ATTACK(judge_pidfd),
    ATTACK(judge_limited),
    ATTACK(judge_moved),
    ATTACK(judge_slowed),
    ATTACK(judge_scheduled),
    ATTACK(judge_compared),
    ATTACK(supervisor_fd),
    ATTACK(supervisor_mem),
    ATTACK(supervisor_traced),
    ATTACK(supervisor_killed),
    ATTACK(supervisor_limited),
    ATTACK(neighbour_fd),
    ATTACK(neighbour_answers),
    ATTACK(neighbour_mapping),
    ATTACK(neighbour_mem),
    ATTACK(neighbour_traced),
    ATTACK(neighbour_killed),
    ATTACK(neighbour_pidfd),
    ATTACK(all_killed),
    ATTACK(init_root),
    ATTACK(becomes_superuser),
    ATTACK(has_capabilities),
    ATTACK(mounts),
    ATTACK(binds),
    ATTACK(leaves_root),
    ATTACK(leaves_mounts),
    ATTACK(joins_judge),
    ATTACK(makes_device),
    ATTACK(makes_in_dev),
    ATTACK(opens_memory),
    ATTACK(opens_disk),
    ATTACK(opens_terminal),
    ATTACK(opens_secrets),
    ATTACK(sets_kernel),
    ATTACK(raises_limit),
    ATTACK(hurries),
    ATTACK(names_host),
    ATTACK(seals_answers),
    ATTACK(writes_cases),
    ATTACK(forks_for_ever),
    ATTACK(writes_run_folder),
    ATTACK(writes_itself),
#undef ATTACK
};

/* Tries all of them, and says on standard error which succeeded. */
static void attack(void) {
  look_around();
  char said[4096] = "";
  for (size_t i = 0; i < sizeof attacks / sizeof *attacks; ++i) {
    if (!attacks[i].succeeds()) continue;
    strcat(said, " ");
    strcat(said, attacks[i].name);
  }
  fprintf(stderr, "found%s%s%s; succeeded:%s.\n", judge == 0 ? "" : " judge", supervisor == 0 ? "" : " supervisor",
          neighbour == 0 ? "" : " neighbour", said);
}

#endif
