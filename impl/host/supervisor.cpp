#include "impl/host/supervisor.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <linux/close_range.h>
#include <poll.h>
#include <sched.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string_view>
#include <system_error>
#include <utility>

#include "impl/host/throw_errno.hpp"

namespace nearmiss {

namespace {

/// A host whose sanitizer has shadow memory reserves terabytes. The build of the hosts tells
/// (NEARMISS_SANITIZED_HOSTS), since the judge's side may be without the sanitizer.
#if defined(NEARMISS_SANITIZED_HOSTS) || defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool shadow_memory = true;
#elif defined(__has_feature)
constexpr bool shadow_memory = __has_feature(address_sanitizer) || __has_feature(thread_sanitizer);
#else
constexpr bool shadow_memory = false;
#endif

/// Owns a file descriptor.
class File {
 public:
  explicit File(int number = -1) : number_(number) {}
  ~File() {
    if (number_ >= 0) close(number_);
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  int number() const { return number_; }
  int take() { return std::exchange(number_, -1); }

 private:
  int number_;
};

/// A message of a supervisor or its program, on the status pipe.
struct Message {
  enum What : int { process, could_not_start, ended } what;
  int value;
};

void send_message(int file, Message message) {
  [[maybe_unused]] const ssize_t put = write(file, &message, sizeof message);
}

void limit(int resource, std::size_t value) {
  rlimit r{};
  getrlimit(decltype(RLIMIT_CORE)(resource), &r);
  r.rlim_cur = r.rlim_max = std::min<rlim_t>(value, r.rlim_max);
  setrlimit(decltype(RLIMIT_CORE)(resource), &r);
}

/// The private writable memory of this process, in bytes.
std::size_t own_memory() {
  std::size_t pages[6] = {};
  std::ifstream file("/proc/self/statm");
  for (std::size_t& p : pages) file >> p;
  return pages[5] * std::size_t(sysconf(_SC_PAGESIZE));
}

/// Every process in /proc whose parent is this process.
std::vector<pid_t> children() {
  std::vector<pid_t> all;
  DIR* folder = opendir("/proc");
  if (folder == nullptr) return all;
  const pid_t self = getpid();
  while (const dirent* entry = readdir(folder)) {
    const int number = std::atoi(entry->d_name);
    if (number <= 0) continue;
    char name[64], text[512];
    std::snprintf(name, sizeof name, "/proc/%d/stat", number);
    const int file = open(name, O_RDONLY | O_CLOEXEC);
    if (file < 0) continue;
    const ssize_t got = read(file, text, sizeof text - 1);
    close(file);
    if (got <= 0) continue;
    text[got] = '\0';
    const char* after_name = std::strrchr(text, ')');
    char state;
    int parent = 0;
    if (after_name != nullptr && std::sscanf(after_name + 1, " %c %d", &state, &parent) == 2 && parent == self) {
      all.push_back(number);
    }
  }
  closedir(folder);
  return all;
}

/// The number of processes on the system, an upper bound for the user's: the limit for other users than the superuser
/// counts all processes of the user.
std::size_t processes_of_user() {
  std::size_t count = 0;
  DIR* folder = opendir("/proc");
  if (folder == nullptr) return 0;
  while (const dirent* entry = readdir(folder)) count += std::atoi(entry->d_name) > 0;
  closedir(folder);
  return count;
}

/// The largest process limit of a host: it leaves a reserve for the judge, which must be able to start other hosts.
std::size_t most_processes_of_a_host() {
  constexpr rlim_t reserve = 64;
  rlimit own{};
  getrlimit(RLIMIT_NPROC, &own);
  return own.rlim_cur - std::min(reserve, own.rlim_cur / 4);
}

/// The id of this process in /proc, that is in the namespace of the process that mounted /proc.
int number_in_proc() {
  char text[32] = {};
  return readlink("/proc/self", text, sizeof text - 1) > 0 ? std::atoi(text) : 0;
}

/// The data that the child needs after the fork, prepared before it.
struct Plan {
  const Program& program;
  const Confinement& confinement;
  std::vector<char*> arguments, environment;
  int status, judge, output, nowhere;
  std::size_t memory, processes;
};

[[noreturn]] void cannot_start(int status, int why) {
  send_message(status, {Message::could_not_start, why});
  _exit(127);
}

/// Gives the program its files and closes all others. Returns the descriptor for a message about a failed start, which
/// exec closes. A program that would keep a file of the judge is not started.
int give_files(const Plan& plan) {
  std::vector<Program::File> files = plan.program.files;
  files.push_back({plan.nowhere, STDIN_FILENO});
  files.push_back({plan.output, STDOUT_FILENO});
  files.push_back({plan.output, STDERR_FILENO});
  int next = 0;  // above all descriptors of the program
  for (const Program::File& f : files) next = std::max(next, f.there + 1);
  for (Program::File& f : files) {
    f.here = fcntl(f.here, F_DUPFD_CLOEXEC, next);
    if (f.here < 0) cannot_start(plan.status, errno);
  }
  const int status = fcntl(plan.status, F_DUPFD_CLOEXEC, next);
  if (status < 0) cannot_start(plan.status, errno);
  for (const Program::File& f : files) {
    if (dup2(f.here, f.there) < 0) cannot_start(status, errno);
  }
  if (status != next && dup3(status, next, O_CLOEXEC) < 0) cannot_start(status, errno);
  if (close_range(unsigned(next) + 1, ~0u, 0) != 0) cannot_start(next, errno);
  send_message(next, {Message::process, number_in_proc()});
  return next;
}

/// Turns the child process into the program; never returns.
[[noreturn]] void become(const Plan& plan) {
  for (int s = 1; s < NSIG; ++s) {
    if (s != SIGKILL && s != SIGSTOP) signal(s, SIG_DFL);
  }
  for (const int s : {SIGXFSZ, SIGTTOU}) signal(s, SIG_IGN);  // a write beyond a limit fails with an error code
  setsid();
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // it does not outlive its supervisor, even if it kills it
  const Confinement& c = plan.confinement;
  limit(RLIMIT_CORE, 0);
  if (c.file_bytes != Confinement::unlimited) limit(RLIMIT_FSIZE, c.file_bytes);
  if (c.processes != Confinement::unlimited) {
    limit(RLIMIT_NPROC, std::min(plan.processes + c.processes, most_processes_of_a_host()));
  }
  if (c.files != Confinement::unlimited) limit(RLIMIT_NOFILE, c.files);
  const bool is_program = !plan.program.body;
  if (c.bytes != Confinement::unlimited && !shadow_memory) limit(RLIMIT_DATA, (is_program ? 0 : plan.memory) + c.bytes);
  prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  const int status = give_files(plan);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  if (!is_program) {
    close(status);
    _exit(plan.program.body());
  }
  execvpe(plan.arguments[0], plan.arguments.data(), plan.environment.data());
  cannot_start(status, errno);
}

/// Ends every remaining process. Returns the wait status of `program` if it was among them.
std::optional<int> end_all_that_is_left(bool namespaced, pid_t program) {
  std::optional<int> how;
  for (int round = 0; round < 1000; ++round) {
    if (namespaced) {
      kill(-1, SIGKILL);
    } else {
      for (const pid_t p : children()) kill(p, SIGKILL);
    }
    pid_t reaped = 0;
    for (int status = 0; (reaped = waitpid(-1, &status, WNOHANG)) > 0;) {
      if (reaped == program) how = status;
    }
    if (reaped < 0 && errno == ECHILD) break;
    usleep(1000);
  }
  return how;
}

/// The main function of the supervisor.
[[noreturn]] void supervise(const Plan& plan, bool namespaced) {
  sigset_t awaited;
  sigemptyset(&awaited);
  sigaddset(&awaited, SIGCHLD);
  sigaddset(&awaited, SIGTERM);
  sigprocmask(SIG_SETMASK, &awaited, nullptr);
  for (const int s : {SIGINT, SIGHUP, SIGQUIT, SIGPIPE, SIGTSTP, SIGTTIN, SIGTTOU}) signal(s, SIG_IGN);
  signal(SIGCHLD, SIG_DFL);  // if SIGCHLD were ignored, the end of a child would not be reported
  setsid();
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  prctl(PR_SET_PDEATHSIG, namespaced ? SIGKILL : SIGTERM);
  prctl(PR_SET_NAME, "nearmiss-super");
  close(plan.judge);  // so that the end of the judge closes the pipe
  pollfd judge{plan.status, 0, 0};
  if (poll(&judge, 1, 0) == 1 && (judge.revents & POLLERR) != 0) _exit(0);  // the judge ended before
  const pid_t program = fork();
  if (program < 0) cannot_start(plan.status, errno);
  if (program == 0) become(plan);
  dup2(plan.status, 0);
  close_range(1, ~0u, 0);
  int how = 0;
  for (bool ended = false; !ended;) {
    if (sigwaitinfo(&awaited, nullptr) == SIGTERM) break;
    int status = 0;
    for (pid_t p = 0; (p = waitpid(-1, &status, WNOHANG)) > 0;) {
      if (p == program) ended = true, how = status;
    }
  }
  how = end_all_that_is_left(namespaced, program).value_or(how);
  send_message(0, {Message::ended, how});
  _exit(0);
}

bool write_text(const char* name, const char* text) {
  const int file = open(name, O_WRONLY | O_CLOEXEC);
  if (file < 0) return false;
  const bool put = write(file, text, std::strlen(text)) == ssize_t(std::strlen(text));
  close(file);
  return put;
}

/// Forks, into a new process namespace where `wanted` and allowed; other users than the superuser need a user namespace
/// as well. Returns 0 in the child.
pid_t fork_apart(bool wanted, bool& namespaced) {
  namespaced = false;
  if (wanted) {
    const uid_t user = geteuid();
    const gid_t group = getegid();
    // System V memory and message queues end with the namespace as well.
    const unsigned long flags = CLONE_NEWPID | CLONE_NEWIPC | (user == 0 ? 0ul : CLONE_NEWUSER) | SIGCHLD;
    const pid_t child = pid_t(syscall(SYS_clone, flags, nullptr, nullptr, nullptr, nullptr));
    if (child == 0 && user != 0) {
      std::array<char, 64> map;
      write_text("/proc/self/setgroups", "deny");
      std::snprintf(map.data(), map.size(), "%u %u 1", user, user);
      write_text("/proc/self/uid_map", map.data());
      std::snprintf(map.data(), map.size(), "%u %u 1", group, group);
      write_text("/proc/self/gid_map", map.data());
    }
    namespaced = child >= 0;
    if (namespaced) return child;
  }
  return fork();
}

/// True if `environment` sets the variable of `entry` ("NAME=value"). Of two entries of one name a C program takes the
/// first, and a shell may take the last.
bool names_variable_of(std::string_view entry, const std::vector<std::string>& environment) {
  const std::string_view name = entry.substr(0, entry.find('=') + 1);
  return std::ranges::any_of(environment, [&](const std::string& e) { return e.starts_with(name); });
}

}  // namespace

SupervisedProcess::SupervisedProcess(const Program& program, const Confinement& confinement) {
  int pipe_ends[2];
  if (pipe2(pipe_ends, O_CLOEXEC) != 0) throw_errno("a pipe to a supervisor");
  File hears(pipe_ends[0]), speaks(pipe_ends[1]);
  File output(program.log.empty() ? memfd_create("nearmiss-output", MFD_CLOEXEC)
                                  : open(program.log.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0644));
  if (output.number() < 0) throw_errno(program.log.empty() ? "memory for a host's output" : program.log.c_str());
  fcntl(output.number(), F_SETFL, O_APPEND);
  File nowhere(open("/dev/null", O_RDONLY | O_CLOEXEC));
  if (nowhere.number() < 0) throw_errno("/dev/null");
  fcntl(hears.number(), F_SETFL, O_NONBLOCK);
  Plan plan{program,
            confinement,
            {},
            {},
            speaks.number(),
            hears.number(),
            output.number(),
            nowhere.number(),
            own_memory(),
            geteuid() == 0 ? 0 : processes_of_user()};
  for (const std::string& a : program.arguments) plan.arguments.push_back(const_cast<char*>(a.c_str()));
  plan.arguments.push_back(nullptr);
  for (const std::string& e : program.environment) plan.environment.push_back(const_cast<char*>(e.c_str()));
  for (char** e = environ; *e != nullptr; ++e) {
    if (!names_variable_of(*e, program.environment)) plan.environment.push_back(*e);
  }
  plan.environment.push_back(nullptr);
  std::fflush(nullptr);  // otherwise a body that calls exit would flush the buffers twice
  supervisor_ = fork_apart(confinement.pid_namespace, namespaced_);
  if (supervisor_ < 0) throw_errno("a process for a host");
  if (supervisor_ == 0) supervise(plan, namespaced_);
  status_ = hears.take();
  output_ = output.take();
}

SupervisedProcess::~SupervisedProcess() {
  end();
  close(status_);
  close(output_);
}

void SupervisedProcess::read_messages() {
  constexpr int most = 16;  // messages; a program of the superuser may manage to send more
  Message message{};
  for (int i = 0; i < most && read(status_, &message, sizeof message) == ssize_t(sizeof message); ++i) {
    if (message.what == Message::process) process_ = message.value;
    if (message.what == Message::could_not_start) failed_to_start_ = message.value;
    if (message.what == Message::ended) wait_status_ = message.value;
  }
}

bool SupervisedProcess::has_ended(int milliseconds) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point until = Clock::now() + std::chrono::milliseconds(milliseconds);
  while (!reaped_) {
    read_messages();
    // A supervisor that ended without a message was killed, by its program or from outside.
    const pid_t ended = waitpid(supervisor_, nullptr, WNOHANG);
    if (ended == supervisor_ || (ended < 0 && errno == ECHILD)) {
      read_messages();
      reaped_ = true;
    }
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - Clock::now()).count();
    if (reaped_ || left <= 0) break;
    pollfd p{status_, POLLIN, 0};  // the first message reports the start of the program
    poll(&p, 1, int(left));
  }
  return reaped_;
}

void SupervisedProcess::send(int signal) {
  if (!reaped_ && process() > 0) kill(process(), signal);
}

void SupervisedProcess::end() {
  if (reaped_) return;
  // The system ends all processes of a namespace with its init. A supervisor without a namespace searches for the
  // remaining processes, which may be thousands.
  constexpr int end_timeout = 5000;  // milliseconds
  if (!namespaced_) {
    kill(supervisor_, SIGCONT);
    kill(supervisor_, SIGTERM);
    if (has_ended(end_timeout)) return;
  }
  kill(supervisor_, SIGKILL);
  has_ended(end_timeout);  // a process that cannot be killed now (a disk that does not respond) is left to the system
  reaped_ = true;
}

std::string SupervisedProcess::exit_text() const {
  if (failed_to_start_ != 0) return std::string("cannot be started: ") + std::strerror(failed_to_start_);
  if (!wait_status_) return "ended with the process that keeps it";
  const int status = *wait_status_;
  const std::string prefix(reason_prefix(break_cause()));
  if (!WIFSIGNALED(status)) return prefix + std::to_string(WEXITSTATUS(status));
  return prefix + std::to_string(WTERMSIG(status)) + " (" + strsignal(WTERMSIG(status)) + ")";
}

BreakCause SupervisedProcess::break_cause() const {
  if (failed_to_start_ != 0 || !wait_status_) return BreakCause::other;
  return WIFSIGNALED(*wait_status_) ? BreakCause::signal : BreakCause::exit_code;
}

std::optional<int> SupervisedProcess::exit_code() const {
  if (!wait_status_ || !WIFEXITED(*wait_status_)) return std::nullopt;
  return WEXITSTATUS(*wait_status_);
}

pid_t SupervisedProcess::process() {
  if (!process_) read_messages();
  return process_.value_or(0);
}

double SupervisedProcess::processor_seconds() {
  clockid_t clock{};
  timespec t{};
  if (process() <= 0 || clock_getcpuclockid(process(), &clock) != 0 || clock_gettime(clock, &t) != 0) return 0;
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

double SupervisedProcess::run_queue_seconds() {
  double running = 0, waited = 0;  // nanoseconds
  if (process() > 0) std::ifstream("/proc/" + std::to_string(process()) + "/schedstat") >> running >> waited;
  return 1e-9 * waited;
}

std::size_t SupervisedProcess::resident_bytes() {
  std::size_t all = 0, resident = 0;
  if (process() > 0) std::ifstream("/proc/" + std::to_string(process()) + "/statm") >> all >> resident;
  return resident * std::size_t(sysconf(_SC_PAGESIZE));
}

std::string SupervisedProcess::output(std::size_t most) const {
  const off_t size = lseek(output_, 0, SEEK_END);
  std::string text(std::size_t(std::clamp<off_t>(size, 0, off_t(most))), '\0');
  const ssize_t got = pread(output_, text.data(), text.size(), std::max<off_t>(0, size - off_t(text.size())));
  text.resize(std::size_t(std::max<ssize_t>(0, got)));
  return text;
}

}  // namespace nearmiss
