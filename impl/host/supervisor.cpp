#include "impl/host/supervisor.hpp"

#include <fcntl.h>
#include <linux/close_range.h>
#include <poll.h>
#include <sched.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
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
#include <filesystem>
#include <fstream>
#include <numeric>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>

#include "impl/host/exposure.hpp"
#include "impl/host/processes.hpp"
#include "impl/host/separation.hpp"
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
  enum What : int { second_supervisor, process, could_not_start, ended } what;
  int value;
};

void send_message(int file, Message message) {
  [[maybe_unused]] const ssize_t put = write(file, &message, sizeof message);
}

constexpr uid_t nobody = 65534;

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
  std::string executable;  ///< the file, where PATH was searched for it
  int status, judge, output, nowhere;
  std::size_t memory, processes;
  std::optional<uid_t> user;                  ///< a user of its own
  std::vector<std::filesystem::path> hidden;  ///< what this user could not reach
  pid_t judge_process, judge_group;
};

/// What a supervisor and its program have of their own.
struct Namespaces {
  bool processes = false, users = false, mounts = false;
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
  for (const Program::NamedFile& f : plan.program.named_files) next = std::max(next, f.there + 1);
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

/// Opens the files that the program itself could not open as its user.
void open_named_files(const Plan& plan) {
  for (const Program::NamedFile& f : plan.program.named_files) {
    struct stat about {};
    const bool is_folder = stat(f.path.c_str(), &about) == 0 && S_ISDIR(about.st_mode);
    const int file = is_folder ? open(f.path.c_str(), O_PATH | O_CLOEXEC) : open_for_other_users(f.path.c_str());
    if (file < 0) continue;
    dup2(file, f.there);
    close(file);
  }
}

/// Takes from this process what would let it reach the judge or another host.
void separate(Plan& plan, Namespaces own, const std::array<pid_t, 4>& others, int status) {
  static char undumpable[] = "NEARMISS_UNDUMPABLE=1";  // for a host of this project: docs/explanation/threat-model.md
  if (const int why = become_unprivileged(plan.user); why != 0) cannot_start(status, why);
  if (plan.user || own.users) return;
  plan.environment.insert(plan.environment.begin(), undumpable);
  shield(own.processes ? std::span<const pid_t>{} : others);
}

/// Starts the program; returns where it cannot. `executable` is its open file where this process cannot reach its path.
void start_program(const Plan& plan, int executable) {
  char* const* const arguments = plan.arguments.data();
  char* const* const environment = plan.environment.data();
  execvpe(plan.executable.c_str(), arguments, environment);
  if (errno != EACCES || executable < 0) return;
  const auto start = [&] { syscall(SYS_execveat, executable, "", arguments, environment, AT_EMPTY_PATH); };
  start();
  if (errno != ENOENT) return;
  fcntl(executable, F_SETFD, 0);  // a script, which its interpreter opens through the descriptor
  start();
}

/// Turns the child process into the program; never returns.
[[noreturn]] void become(Plan& plan, Namespaces own, pid_t supervisor, pid_t first_supervisor) {
  for (int s = 1; s < NSIG; ++s) {
    if (s != SIGKILL && s != SIGSTOP) signal(s, SIG_DFL);
  }
  for (const int s : {SIGXFSZ, SIGTTOU}) signal(s, SIG_IGN);  // a write beyond a limit fails with an error code
  setsid();
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
  if (plan.user) open_named_files(plan);
  const int executable = plan.user && is_program ? open_for_other_users(plan.executable.c_str()) : -1;
  if (!c.trusted) separate(plan, own, {plan.judge_process, plan.judge_group, first_supervisor, supervisor}, status);
  // It does not outlive its supervisor, even if it kills it. A change of user cancels this.
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != supervisor) _exit(127);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  if (!is_program) {
    close(status);
    _exit(plan.program.body());
  }
  start_program(plan, executable);
  cannot_start(status, errno);
}

/// Ends every process of the user at once, so that none can start others meanwhile.
void end_all_of(uid_t user) {
  if (fork() != 0) return;
  if (become_unprivileged(user) == 0) kill(-1, SIGKILL);
  _exit(0);
}

/// Ends every remaining process. Returns the wait status of `program` if it was among them.
std::optional<int> end_all_that_is_left(const Plan& plan, Namespaces own, pid_t program) {
  std::optional<int> how;
  for (int round = 0; round < 1000; ++round) {
    if (own.processes) {
      kill(-1, SIGKILL);
    } else {
      const std::vector<pid_t> left = children_of(getpid());
      if (plan.user && !left.empty() && round % 16 == 0) end_all_of(*plan.user);
      for (const pid_t p : left) kill(p, SIGKILL);
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

/// Exposes what the program is started with to its user. Where that fails, it starts from open files.
void show_hidden(const Plan& plan) {
  if (const int why = expose(plan.hidden); why != 0) cannot_start(plan.status, why);
  std::error_code gone;
  const std::filesystem::path here = std::filesystem::current_path(gone);
  if (!gone) std::filesystem::current_path(here, gone);  // the folder in its new place
}

/// The main function of a supervisor. Without a namespace there are two: the first starts the second, which starts the
/// program, and ends everything where the second was killed. `first` is 0 in the only or first supervisor.
[[noreturn]] void supervise(Plan& plan, Namespaces own, pid_t first = 0) {
  sigset_t awaited;
  sigemptyset(&awaited);
  sigaddset(&awaited, SIGCHLD);
  sigaddset(&awaited, SIGTERM);
  sigprocmask(SIG_SETMASK, &awaited, nullptr);
  for (const int s : {SIGINT, SIGHUP, SIGQUIT, SIGPIPE, SIGTSTP, SIGTTIN, SIGTTOU}) signal(s, SIG_IGN);
  signal(SIGCHLD, SIG_DFL);  // if SIGCHLD were ignored, the end of a child would not be reported
  setsid();
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  prctl(PR_SET_PDEATHSIG, own.processes ? SIGKILL : SIGTERM);
  if (first != 0 && getppid() != first) _exit(0);
  prctl(PR_SET_NAME, "nearmiss-super");
  prctl(PR_SET_DUMPABLE, 0);
  close(plan.judge);  // so that the end of the judge closes the pipe
  pollfd judge{plan.status, 0, 0};
  if (poll(&judge, 1, 0) == 1 && (judge.revents & POLLERR) != 0) _exit(0);  // the judge ended before
  const bool starts_the_second = !own.processes && first == 0;
  if (first != 0) send_message(plan.status, {Message::second_supervisor, number_in_proc()});
  if (own.mounts) show_hidden(plan);
  const pid_t self = getpid();
  const pid_t program = fork();
  if (program < 0) cannot_start(plan.status, errno);
  if (program == 0 && starts_the_second) supervise(plan, own, self);
  if (program == 0) become(plan, own, self, first);
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
  how = end_all_that_is_left(plan, own, program).value_or(how);
  if (!starts_the_second) send_message(0, {Message::ended, how});
  _exit(0);
}

bool write_text(const char* name, const char* text) {
  const int file = open(name, O_WRONLY | O_CLOEXEC);
  if (file < 0) return false;
  const bool put = write(file, text, std::strlen(text)) == ssize_t(std::strlen(text));
  close(file);
  return put;
}

/// Makes `inside` the name of the user `outside` in this process's new user namespace, and the same for the groups.
void map_ids(uid_t user_inside, uid_t user_outside, gid_t group_inside, gid_t group_outside) {
  std::array<char, 64> map;
  prctl(PR_SET_DUMPABLE, 1);  // otherwise these files belong to the superuser
  write_text("/proc/self/setgroups", "deny");
  std::snprintf(map.data(), map.size(), "%u %u 1", user_inside, user_outside);
  write_text("/proc/self/uid_map", map.data());
  std::snprintf(map.data(), map.size(), "%u %u 1", group_inside, group_outside);
  write_text("/proc/self/gid_map", map.data());
}

pid_t clone_into(unsigned long namespaces) {
  return pid_t(syscall(SYS_clone, namespaces | SIGCHLD, nullptr, nullptr, nullptr, nullptr));
}

/// Forks, into new namespaces where allowed. Returns 0 in the child. Other users than the superuser need a user
/// namespace for the others, and a superuser without another user for the program needs it to separate the program from
/// the judge: the program has the same files, and is no superuser.
pid_t fork_apart(const Plan& plan, Namespaces& own) {
  const bool is_superuser = geteuid() == 0;
  const bool needs_users = !is_superuser || (!plan.user && !plan.confinement.trusted);
  const uid_t user = geteuid();
  const gid_t group = getegid();
  // System V memory and message queues end with the namespace as well.
  constexpr unsigned long apart = CLONE_NEWPID | CLONE_NEWIPC;
  const bool needs_mounts = !plan.hidden.empty();
  pid_t child = clone_into(apart | (needs_users ? CLONE_NEWUSER : 0) | (needs_mounts ? CLONE_NEWNS : 0));
  own = {child >= 0, child >= 0 && needs_users, child >= 0 && needs_mounts};
  if (child < 0 && is_superuser && needs_users) {
    child = clone_into(apart);
    own.processes = child >= 0;
  }
  if (child < 0) return fork();
  if (child == 0 && own.users) {
    const bool renamed = is_superuser;
    map_ids(renamed ? nobody : user, user, renamed ? nobody : group, group);
  }
  return child;
}

/// The file that a program is started from: PATH is searched with the rights of this process.
std::string executable_of(const Program& program) {
  if (program.arguments.empty()) return {};
  const std::string& name = program.arguments.front();
  const char* path = std::getenv("PATH");
  if (name.find('/') != std::string::npos || path == nullptr) return name;
  std::istringstream folders(path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    std::string file = (folder.empty() ? "." : folder) + "/" + name;
    struct stat about {};
    if (stat(file.c_str(), &about) == 0 && S_ISREG(about.st_mode) && access(file.c_str(), X_OK) == 0) return file;
  }
  return name;
}

/// Adds the parts of the text between separators.
void add_parts(const std::string& text, const char* separators, std::vector<std::string>& parts) {
  for (std::size_t begin = 0; (begin = text.find_first_not_of(separators, begin)) != std::string::npos;) {
    const std::size_t end = std::min(text.find_first_of(separators, begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end;
  }
}

/// What may be names of files and folders that the program opens. A program behind pipes, which has no shared memory,
/// may be a command of a shell, and may start what is in PATH.
std::vector<std::string> names_in(const Program& program, const std::string& executable) {
  std::vector<std::string> names{executable};
  names.insert(names.end(), program.arguments.begin(), program.arguments.end());
  for (const Program::NamedFile& f : program.named_files) names.push_back(f.path);
  if (program.files.size() > 2) return names;
  for (const std::string& a : program.arguments) add_parts(a, " \t\n'\"", names);
  if (const char* path = std::getenv("PATH"); path != nullptr) add_parts(path, ":", names);
  return names;
}

/// Where the superuser has no other user id and no user namespace for its hosts.
void tell_once_of_the_superuser() {
  static const int told = std::fputs(
      "nearmiss: what is asked runs as the superuser here, because this system has no other user id for it; "
      "docs/explanation/threat-model.md says what that means\n",
      stderr);
  static_cast<void>(told);
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
  if (!confinement.trusted) prctl(PR_SET_DUMPABLE, 0);
  Plan plan{program,
            confinement,
            {},
            {},
            {},
            speaks.number(),
            hears.number(),
            output.number(),
            nowhere.number(),
            own_memory(),
            geteuid() == 0 ? 0 : count_processes(),  // for other users the limit counts all processes of the user
            confinement.trusted ? std::nullopt : user_for_a_host(),
            {},
            getpid(),
            getpgrp()};
  plan.executable = plan.user ? executable_of(program) : program.arguments.empty() ? "" : program.arguments.front();
  if (plan.user) plan.hidden = hidden_paths(names_in(program, plan.executable));
  for (const Program::File& f : program.files) {
    // Only a program that opens /dev/fd/3 once more needs this; a superuser without CAP_CHOWN may not do it.
    if (plan.user && fchown(f.here, *plan.user, *plan.user) != 0 && errno != EPERM) throw_errno("a file of a host");
  }
  for (const std::string& a : program.arguments) plan.arguments.push_back(const_cast<char*>(a.c_str()));
  plan.arguments.push_back(nullptr);
  for (const std::string& e : program.environment) plan.environment.push_back(const_cast<char*>(e.c_str()));
  for (char** e = environ; *e != nullptr; ++e) {
    if (!names_variable_of(*e, program.environment)) plan.environment.push_back(*e);
  }
  plan.environment.push_back(nullptr);
  std::fflush(nullptr);  // otherwise a body that calls exit would flush the buffers twice
  Namespaces own;
  supervisor_ = confinement.pid_namespace ? fork_apart(plan, own) : fork();
  namespaced_ = own.processes;
  if (supervisor_ < 0) throw_errno("a process for a host");
  if (supervisor_ == 0) supervise(plan, own);
  if (geteuid() == 0 && !confinement.trusted && !plan.user && !own.users) tell_once_of_the_superuser();
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
    if (message.what == Message::second_supervisor) second_supervisor_ = message.value;
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

/// The program and every process that it started.
std::vector<pid_t> SupervisedProcess::processes() {
  read_messages();
  std::vector<pid_t> all = descendants_of(supervisor_);
  std::erase(all, second_supervisor_);
  return all;
}

bool SupervisedProcess::uses_more_memory_than(std::size_t bytes) {
  if (process() > 0 && resident_bytes_of(process()) > bytes) return true;
  const std::vector<pid_t> all = processes();
  const auto sum = [&](std::size_t (*of)(pid_t)) {
    return std::transform_reduce(all.begin(), all.end(), std::size_t{0}, std::plus<>(), of);
  };
  return sum(resident_bytes_of) > bytes && sum(proportional_bytes_of) > bytes;
}

std::string SupervisedProcess::output(std::size_t most) const {
  const off_t size = lseek(output_, 0, SEEK_END);
  std::string text(std::size_t(std::clamp<off_t>(size, 0, off_t(most))), '\0');
  const ssize_t got = pread(output_, text.data(), text.size(), std::max<off_t>(0, size - off_t(text.size())));
  text.resize(std::size_t(std::max<ssize_t>(0, got)));
  return text;
}

}  // namespace nearmiss
