#include "impl/subject/worker.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <fstream>
#include <optional>
#include <system_error>
#include <utility>

#include "impl/subject/contained.hpp"
#include "impl/subject/floating_point.hpp"

namespace nearmiss {

/// Lives in memory that both processes see. The parent writes it before it wakes the child; while the
/// child works it alone writes `done` and the answers. To move memory from one core to another is what isolation
/// costs most, so an answer takes no more of it than it has numbers, one behind the other.
struct Worker::Shared {
  struct Head {
    Answer::Status status;
    bool yes;
    std::uint8_t count;
    std::uint64_t given;
  };

  std::atomic<std::size_t> done;  ///< cases answered
  std::size_t used;               ///< of `numbers`
  std::size_t count, inputs;
  AnswerFunction answer;
  std::array<double, max_values> values;
  std::array<Head, capacity> heads;
  std::array<double, capacity * Answer::capacity> numbers;
  std::array<decltype(Answer::why), capacity> reasons;  ///< of those without an answer; the others are not written

  /// The answer to case number `done`.
  void add(const Answer& a) {
    const std::size_t i = done.load(std::memory_order_relaxed);
    heads[i] = {a.status, a.yes, a.count, a.given};
    std::copy_n(a.values.begin(), a.count, numbers.begin() + std::ptrdiff_t(used));
    if (a.status != Answer::Status::answered) reasons[i] = a.why;
    used += a.count;
    done.store(i + 1, std::memory_order_release);
  }
  void take(std::vector<Answer>& answers) const {
    answers.resize(std::max(answers.size(), count));
    std::size_t at = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const Head& head = heads[i];
      Answer& a = answers[i];
      a.status = head.status, a.yes = head.yes, a.given = head.given;
      std::copy_n(numbers.begin() + std::ptrdiff_t(at), head.count, a.values.begin());
      if (head.count < a.count) std::fill(a.values.begin() + head.count, a.values.begin() + a.count, 0.0);
      a.count = head.count;
      if (head.status != Answer::Status::answered) a.why = reasons[i];
      else a.why[0] = '\0';
      at += head.count;
    }
  }
};

/// A process that runs; one that could not be started is never one, for its number would be -1, and to end that is to end
/// every process there is.
struct Worker::Child {
  pid_t pid = -1;
  int to_child = -1, from_child = -1, standard_error = -1;
  Child() = default;
  ~Child() {
    for (const int file : {to_child, from_child, standard_error}) {
      if (file >= 0) close(file);
    }
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
};

namespace {

[[noreturn]] void fail(const char* what) { throw std::system_error(errno, std::generic_category(), what); }

#if defined(__SANITIZE_ADDRESS__)
constexpr bool address_sanitizer = true;
#elif defined(__has_feature)
constexpr bool address_sanitizer = __has_feature(address_sanitizer);
#else
constexpr bool address_sanitizer = false;
#endif

/// Closes at its end what was not taken.
struct Pipe {
  int ends[2] = {-1, -1};
  Pipe() {
    if (pipe2(ends, O_CLOEXEC) != 0) fail("pipes to a worker process");
  }
  ~Pipe() {
    for (const int end : ends) {
      if (end >= 0) close(end);
    }
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  int take(std::size_t end) { return std::exchange(ends[end], -1); }
};

std::size_t address_space_in_use() {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * std::size_t(sysconf(_SC_PAGESIZE));
}

void limit(int resource, std::size_t value) {
  const rlimit r{value, value};
  setrlimit(resource, &r);
}

/// The processes that the subject starts are of the child's group, so that they end with it, by this as well: the
/// kernel sends it to the child when the parent ends, whatever ended that.
void end_with_parent(pid_t parent) {
  const int parent_ended = SIGRTMAX;  // one that libraries leave alone
  signal(parent_ended, [](int) { kill(0, SIGKILL); });
  prctl(PR_SET_PDEATHSIG, parent_ended);
  if (getppid() != parent) _exit(0);  // it ended before
}

/// The child's own limits and signals. AddressSanitizer reserves terabytes, so it cannot be limited so.
void confine(std::size_t bytes, int standard_error) {
  for (const int s : {SIGABRT, SIGSEGV, SIGFPE, SIGILL, SIGBUS, SIGTERM}) signal(s, SIG_DFL);
  // A terminal's interrupt is the parent's to handle, and writing to the terminal is no reason to stop.
  for (const int s : {SIGINT, SIGXFSZ, SIGTTOU}) signal(s, SIG_IGN);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_FSIZE, std::size_t{16} << 20);
  if (!address_sanitizer) limit(RLIMIT_AS, address_space_in_use() + bytes);
  dup2(standard_error, STDERR_FILENO);
}

/// For how long in all a process has been ready to run while others ran; 0 where the system does not tell.
double seconds_in_line(pid_t process) {
  double running = 0, in_line = 0;  // nanoseconds
  std::ifstream("/proc/" + std::to_string(process) + "/schedstat") >> running >> in_line;
  return 1e-9 * in_line;
}

/// How long a process takes for a case, without the time for which a busy machine lets it wait.
class Patience {
 public:
  void begin_again() { since_ = Clock::now(), in_line_before_.reset(); }
  /// To be asked often: what it waited before it was first asked does not count.
  double seconds(pid_t process) {
    const double in_line = seconds_in_line(process);
    if (!in_line_before_) in_line_before_ = in_line;
    return std::chrono::duration<double>(Clock::now() - since_).count() - (in_line - in_line_before_.value_or(in_line));
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point since_ = Clock::now();
  std::optional<double> in_line_before_;
};

std::string last_line_of(int file) {
  const off_t size = lseek(file, 0, SEEK_END);
  std::string text(std::size_t(std::clamp<off_t>(size, 0, 4096)), '\0');
  const ssize_t got = pread(file, text.data(), text.size(), std::max<off_t>(0, size - off_t(text.size())));
  text.resize(std::size_t(std::max<ssize_t>(0, got)));
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text.substr(text.find_last_of('\n') + 1);
}

}  // namespace

Worker::Worker(WorkerLimits limits) : limits_(limits) {
  void* memory = mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) fail("shared memory for a worker process");
  shared_ = new (memory) Shared;
}

Worker::~Worker() {
  end();
  munmap(shared_, sizeof(Shared));
}

void Worker::start() {
  auto child = std::make_unique<Child>();
  Pipe down, up;
  child->standard_error = memfd_create("worker-stderr", MFD_CLOEXEC);
  if (child->standard_error < 0) fail("memory for a worker's messages");
  const pid_t parent = getpid();
  child->pid = fork();
  if (child->pid < 0) fail("a worker process");
  if (child->pid == 0) {
    setpgid(0, 0);
    end_with_parent(parent);
    close(down.ends[1]);
    close(up.ends[0]);
    confine(limits_.bytes, child->standard_error);
    FloatingPointModes::standard().set();
    char byte = 0;
    while (read(down.ends[0], &byte, 1) == 1) {
      for (std::size_t i = shared_->done; i < shared_->count; ++i) {
        const std::span<const double> inputs{shared_->values.data() + i * shared_->inputs, shared_->inputs};
        shared_->add(answer_or_broke([&] { return shared_->answer(inputs); }));
      }
      if (write(up.ends[1], &byte, 1) != 1) break;
    }
    _exit(0);
  }
  setpgid(child->pid, child->pid);  // whichever of the two is first
  child->to_child = down.take(1);
  child->from_child = up.take(0);
  child_ = std::move(child);
}

void Worker::release() { child_.reset(); }

void Worker::end() {
  if (!child_) return;
  kill(-child_->pid, SIGKILL);
  waitpid(child_->pid, nullptr, 0);
  release();
}

bool Worker::has_ended() const {
  siginfo_t info{};
  return waitid(P_PID, id_t(child_->pid), &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid == child_->pid;
}

/// Reaps the child, ends what it started, and says in one line what became of it.
std::string Worker::how_it_ended(bool timed_out) {
  siginfo_t info{};
  if (!timed_out) waitid(P_PID, id_t(child_->pid), &info, WEXITED | WNOWAIT);  // not reaped: its group is its own still
  kill(-child_->pid, SIGKILL);
  int status = 0;
  waitpid(child_->pid, &status, 0);
  const std::string last_words = last_line_of(child_->standard_error);
  release();
  if (timed_out) return "no answer within " + std::to_string(limits_.seconds_per_case).substr(0, 5) + " s";
  std::string how = WIFSIGNALED(status) ? "killed by signal " + std::to_string(WTERMSIG(status)) + " (" +
                                              strsignal(WTERMSIG(status)) + ")"
                                        : "left with exit code " + std::to_string(WEXITSTATUS(status));
  return last_words.empty() ? how : how + ": " + last_words;
}

void Worker::send(const Offering& offering, std::span<const double> values, std::size_t inputs_per_case) {
  shared_->count = values.size() / inputs_per_case;
  shared_->inputs = inputs_per_case;
  shared_->answer = offering.answer;
  shared_->done = 0;
  shared_->used = 0;
  std::copy(values.begin(), values.end(), shared_->values.begin());
  if (!child_) start();
  [[maybe_unused]] const ssize_t woken = write(child_->to_child, "g", 1);  // a dead child is seen in receive
}

std::span<const Answer> Worker::receive() {
  std::size_t seen = 0;
  Patience patience;
  while (true) {
    pollfd p{child_->from_child, POLLIN, 0};
    const int ready = poll(&p, 1, 50);
    char byte = 0;
    if (ready > 0 && read(child_->from_child, &byte, 1) == 1) break;
    if (const std::size_t done = shared_->done.load(std::memory_order_acquire); done != seen) {
      seen = done;
      patience.begin_again();
    }
    const bool timed_out = patience.seconds(child_->pid) > limits_.seconds_per_case;
    // What the subject started may hold the pipe open after the child itself has ended.
    if (ready <= 0 && !timed_out && !has_ended()) continue;
    const std::string how = how_it_ended(timed_out);
    if (shared_->done < shared_->count) shared_->add(Answer::without(Answer::Status::broke, how));
    if (shared_->done >= shared_->count) break;
    start();
    [[maybe_unused]] const ssize_t woken = write(child_->to_child, "g", 1);
    seen = shared_->done;
    patience.begin_again();
  }
  shared_->take(answers_);
  return {answers_.data(), shared_->count};
}

std::vector<Answer> Worker::ask(const Offering& offering, std::span<const double> values, std::size_t inputs_per_case) {
  std::vector<Answer> answers;
  const std::size_t most = std::min(capacity, max_values / inputs_per_case) * inputs_per_case;
  for (std::size_t at = 0; at < values.size(); at += most) {
    send(offering, values.subspan(at, std::min(most, values.size() - at)), inputs_per_case);
    const auto batch = receive();
    answers.insert(answers.end(), batch.begin(), batch.end());
  }
  return answers;
}

}  // namespace nearmiss
