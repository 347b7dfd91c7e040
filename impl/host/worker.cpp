#include "impl/host/worker.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <system_error>
#include <thread>
#include <utility>

#include "impl/host/replies.hpp"
#include "impl/host/serve.hpp"
#include "impl/host/throw_errno.hpp"
#include "impl/subject/floating_point.hpp"
#include "impl/subject/printable.hpp"

namespace nearmiss {

namespace {

constexpr int poll_interval = 50;  ///< milliseconds
constexpr std::size_t max_output = 4096;

/// Raises the limit of file sizes to its maximum for its lifetime. Shared memory is a file here, and a limit that is
/// meant for files on disk must not apply to it.
class UnlimitedFileSize {
 public:
  UnlimitedFileSize() {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit any{before_.rlim_max, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &any);
  }
  ~UnlimitedFileSize() { setrlimit(RLIMIT_FSIZE, &before_); }
  UnlimitedFileSize(const UnlimitedFileSize&) = delete;
  UnlimitedFileSize& operator=(const UnlimitedFileSize&) = delete;

 private:
  rlimit before_{};
};

/// Shared memory that neither side can shrink: reading beyond its end would kill the reader. Nor can either side forbid
/// the other more (F_SEAL_SEAL). `seals` are further ones.
template <class T>
T* new_shared(const char* name, int& file, int seals = 0) {
  const UnlimitedFileSize any;
  file = memfd_create(name, MFD_CLOEXEC | MFD_ALLOW_SEALING);
  if (file < 0 || ftruncate(file, sizeof(T)) != 0) throw_errno("shared memory for a host");
  void* memory = mmap(nullptr, sizeof(T), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  if (memory == MAP_FAILED) throw_errno("shared memory for a host");
  const int all = F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL | seals;
  if (fcntl(file, F_ADD_SEALS, all) != 0) throw_errno("shared memory for a host");
  return static_cast<T*>(memory);  // a T of zero bytes is valid
}

/// True for a temporary shortage of processes, memory or files.
bool is_resource_shortage(int error) {
  return error == EAGAIN || error == ENOMEM || error == EMFILE || error == ENFILE;
}

std::string last_line_of(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.pop_back();
  return text.substr(text.find_last_of('\n') + 1);
}

/// Reasons of a subject go to terminals and into reports.
void make_printable(Answer& a) {
  if (a.status != Answer::Status::answered) a.explain(printable(a.reason()));
}

/// What a host may report as the time of a call, in nanoseconds.
bool is_duration(double nanoseconds) { return nanoseconds >= 0 && std::isfinite(nanoseconds); }

/// Whether a host's number is that of a stage.
bool is_stage(double number) {
  return number >= 0 && number <= double(AnswerStage::plain) && std::floor(number) == number;
}

std::string seconds_text(double s) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3f s", s);
  return text;
}

struct Pipe {
  int ends[2] = {-1, -1};
  Pipe() {
    if (pipe2(ends, O_CLOEXEC) != 0) throw_errno("pipes to a host");
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

}  // namespace

struct Worker::Child {
  int to_host = -1, from_host = -1;
  std::unique_ptr<SupervisedProcess> process;
  std::string out;          ///< bytes to write
  std::size_t written = 0;  ///< written bytes of `out`
  std::string in;           ///< bytes read
  std::size_t understood = 0;
  std::uint32_t asked = 0;     ///< cases sent over the pipe
  std::uint32_t answered = 0;  ///< answered cases of `asked`

  Child() = default;
  ~Child() {
    process.reset();
    for (const int file : {to_host, from_host}) {
      if (file >= 0) close(file);
    }
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  bool has_more_to_write() const { return written < out.size(); }
  std::string_view unread() const { return std::string_view(in).substr(understood); }
  /// Reads the available bytes. False where the host closed the pipe.
  bool read_some() {
    if (understood > 0) in.erase(0, std::exchange(understood, 0));
    std::array<char, 1 << 16> some;
    const ssize_t got = read(from_host, some.data(), some.size());
    const int why = errno;
    if (got > 0) in.append(some.data(), std::size_t(got));
    return got > 0 || (got < 0 && (why == EAGAIN || why == EINTR));
  }
};

/// Measures a host against the time limits of a case: processor time, and wall time without the time that the host
/// waits for a processor on a busy machine. A host that keeps the machine busy itself profits from this grace too, so
/// the grace is bounded.
class Worker::CaseTimeout {
 public:
  static constexpr double most_in_run_queue = 5;  ///< bound of the grace, in multiples of WorkerLimits::wall
  void restart() { since_ = Clock::now(), before_.reset(); }
  /// The reason once a limit is exceeded; empty before. Call it often: time before the first call does not count.
  std::optional<std::string> expired(SupervisedProcess& host, const WorkerLimits& limits) {
    const Used now{host.processor_seconds(), host.run_queue_seconds()};
    if (!before_) before_ = now;
    if (now.processor - before_->processor > limits.case_timeout) {
      return "no answer within " + seconds_text(limits.case_timeout) + " of processor time";
    }
    const double passed = std::chrono::duration<double>(Clock::now() - since_).count();
    const double in_run_queue = std::min(now.in_run_queue - before_->in_run_queue, most_in_run_queue * limits.wall());
    if (passed - in_run_queue > limits.wall()) return "no answer within " + seconds_text(limits.wall());
    return std::nullopt;
  }

 private:
  struct Used {
    double processor, in_run_queue;
  };
  Clock::time_point since_ = Clock::now();
  std::optional<Used> before_;
};

namespace {
WorkerLimits the_limits;
}

const WorkerLimits& worker_limits() { return the_limits; }
void set_worker_limits(const WorkerLimits& limits) { the_limits = limits; }

Worker::Worker(WorkerLimits limits, std::shared_ptr<const HostProgram> program, WaitCallback on_wait)
    : limits_(limits),
      program_(std::move(program)),
      on_wait_(std::move(on_wait)),
      // From now on no new writable mapping of the cases is possible; this one stays.
      asked_(new_shared<wire::SharedRequest>("nearmiss-asked", asked_file_, F_SEAL_FUTURE_WRITE)),
      answered_(new_shared<wire::SharedAnswers>("nearmiss-answered", answered_file_)),
      timeout_(std::make_unique<CaseTimeout>()) {}

Worker::~Worker() {
  end();
  munmap(asked_, sizeof *asked_);
  munmap(answered_, sizeof *answered_);
  close(asked_file_);
  close(answered_file_);
}

void Worker::end() { child_.reset(); }

void Worker::spawn() {
  while (true) {
    try {
      spawn_once();
      return;
    } catch (const std::system_error& e) {
      if (!is_resource_shortage(e.code().value())) throw;
      wait_for_resources(e.code().value());
    }
  }
}

/// Call it each time the system refuses a process or memory. Waits; throws std::system_error after some seconds.
void Worker::wait_for_resources(int error) {
  using namespace std::chrono_literals;
  const Clock::time_point now = Clock::now();
  if (!refused_since_) refused_since_ = now;
  const bool may_pass = error != EMFILE;  // that limit concerns only this process
  if (!may_pass || now - *refused_since_ > 3s || !keeps_waiting()) {
    throw std::system_error(error, std::generic_category(), "a process for a host");
  }
  std::this_thread::sleep_for(50ms);
}

void Worker::spawn_once() {
  Pipe down, up;
  auto child = std::make_unique<Child>();
  Program run;
  if (program_ != nullptr) {
    run.arguments = program_->arguments;
    run.files = {{down.ends[0], wire::from_judge}, {up.ends[1], wire::to_judge}};
    if (is_shared()) {
      run.files.push_back({asked_file_, wire::shared_request});
      run.files.push_back({answered_file_, wire::shared_answers});
    }
    if (is_shared() && run.arguments.size() == 2) {  // a host of this project is told of a plugin alone
      const std::string& plugin = run.arguments.back();
      run.named_files = {{plugin.substr(0, plugin.rfind('/') + 1), wire::plugin_folder}, {plugin, wire::plugin_file}};
    }
  } else {
    run.files = {{down.ends[0], wire::from_judge}, {up.ends[1], wire::to_judge}};
    run.body = [this] {
      FloatingPointModes::standard().set();
      serve(wire::from_judge, wire::to_judge, *asked_, *answered_, {});
      return 0;
    };
  }
  child->process = std::make_unique<SupervisedProcess>(
      run, Confinement{.bytes = limits_.bytes, .pid_namespace = limits_.pid_namespace});
  child->to_host = down.take(1);
  child->from_host = up.take(0);
  for (const int file : {child->to_host, child->from_host}) fcntl(file, F_SETFL, O_NONBLOCK);
  child_ = std::move(child);
}

/// Starts a host and checks its hello. Throws HostFailed.
void Worker::start() {
  spawn();
  if (program_ == nullptr) return;
  try {
    if (first_line() != program_->hello)
      throw HostFailed("it says something else of itself than when it was first started");
    refused_since_.reset();
  } catch (const HostFailed&) {
    end();
    throw;
  }
}

/// The first line of the host, with its end of line.
std::string Worker::first_line() {
  CaseTimeout timeout;
  while (keeps_waiting()) {
    pollfd files[2] = {{child_->from_host, POLLIN, 0}, {child_->process->status_file(), POLLIN, 0}};
    poll(files, 2, poll_interval);
    const bool ended = (files[0].revents & (POLLIN | POLLHUP)) != 0 && !child_->read_some();
    if (const std::size_t at = child_->unread().find('\n'); at != std::string_view::npos) {
      std::string line(child_->unread().substr(0, at + 1));
      child_->understood += line.size();
      return line;
    }
    if (child_->unread().size() > wire::max_hello) throw HostFailed("its hello has more than 1,048,576 bytes");
    if (ended || child_->process->has_ended()) {
      if (!child_->process->has_ended(200)) throw HostFailed("it closed the pipe before it said hello");
      if (const int lack = child_->process->failed_to_start(); is_resource_shortage(lack)) {
        wait_for_resources(lack);
        spawn();
        timeout.restart();
        continue;
      }
      const std::string last = last_line_of(child_->process->output(max_output));
      throw HostFailed(child_->process->exit_text() + (last.empty() ? "" : ": " + last));
    }
    if (const auto late = timeout.expired(*child_->process, limits_)) {
      throw HostFailed(std::string("no hello").append(*late, std::string_view("no answer").size()), true);
    }
  }
  throw HostFailed("interrupted");
}

void Worker::begin() {
  end();
  spawn();
}

std::string Worker::hello() {
  const FloatingPointScope standard;
  if (!child_) spawn();
  const std::string line = first_line();
  end();
  return line;
}

void Worker::send(const Offering& offering, std::span<const double> values, std::size_t inputs_per_case,
                  Rounding rounding) {
  const FloatingPointScope standard;
  put_request(offering, values, inputs_per_case);
  asked_->rounding = rounding;
  request(0, count_);
}

std::optional<Worker::Times> Worker::time(const Offering& offering, std::span<const double> values,
                                          std::size_t inputs_per_case) {
  if (!is_shared()) return std::nullopt;
  const FloatingPointScope standard;
  put_request(offering, values, inputs_per_case);
  outputs_ = 2;
  asked_->timed = true;
  request(0, count_);
  const std::span<const Answer> answers = receive();
  if (answers.size() < count_) return std::nullopt;
  Times times{{}, answered_->timed};
  for (const Answer& a : answers) {
    if (a.status != Answer::Status::answered || a.count != 2 || !is_duration(a.values[0]) || !is_stage(a.values[1]))
      return std::nullopt;
    times.nanoseconds.push_back(a.values[0]);
    times.stages.push_back(AnswerStage(int(a.values[1])));
  }
  if (!is_duration(times.how.processor_nanoseconds)) return std::nullopt;
  return times;
}

/// Writes a batch, to be answered in the host's own rounding, into the shared memory.
void Worker::put_request(const Offering& offering, std::span<const double> values, std::size_t inputs_per_case) {
  count_ = values.size() / inputs_per_case;
  got_ = 0;
  outputs_ = offering.outputs;
  decides_ = offering.decides;
  one_by_one_ = false;
  suspected_.reset();
  broken_.clear();
  answers_.resize(std::max(answers_.size(), count_));
  asked_->offer = offering.position;
  asked_->inputs = std::uint32_t(inputs_per_case);
  asked_->rounding = Rounding::its_own;
  asked_->timed = false;
  raised_.assign(count_, 0);
  asked_->answer = program_ == nullptr ? offering.answer : AnswerFunction{};
  query_ = offering.query;
  std::copy(values.begin(), values.end(), asked_->values.begin());
}

/// Sends the cases [first, end) to the host; starts a host where none runs.
void Worker::request(std::size_t first, std::size_t end_of_request) {
  cannot_start_.reset();
  if (!is_shared()) end_of_request = std::min(end_of_request, first + piped_at_once_);
  requested_ = end_of_request;
  requested_since_ = Clock::now();
  numbers_got_ = 0;
  if (child_ && !child_->unread().empty()) {
    this->end();  // the host wrote without a request
  }
  if (!child_) {
    try {
      start();
    } catch (const HostFailed& e) {
      cannot_start_ = e;
      return;
    }
  }
  timeout_->restart();
  if (is_shared()) {
    asked_->first = std::uint32_t(first);
    asked_->count = std::uint32_t(end_of_request);
    answered_->done.store(std::uint32_t(first), std::memory_order_relaxed);
    [[maybe_unused]] const ssize_t woken = write(child_->to_host, "g", 1);  // receive notices a dead host
    return;
  }
  const std::span<const double> values{asked_->values.data() + first * asked_->inputs,
                                       (end_of_request - first) * asked_->inputs};
  child_->out = program_->batches == HostProgram::Batches::binary
                    ? wire::binary_request(asked_->offer, child_->asked, values, asked_->inputs)
                    : wire::json_request(query_, child_->asked, values, asked_->inputs);
  child_->asked += std::uint32_t(end_of_request - first);
  heard_ = false;
  child_->written = 0;
  flush();
}

/// Writes as many bytes as the pipe takes. False where the reader is gone.
bool Worker::flush() {
  while (child_->has_more_to_write()) {
    const ssize_t put =
        write(child_->to_host, child_->out.data() + child_->written, child_->out.size() - child_->written);
    if (put < 0 && errno == EINTR) continue;
    if (put < 0) return errno == EAGAIN;
    child_->written += std::size_t(put);
  }
  return true;
}

Worker::Event Worker::end_as(Event::What what, std::string reason, bool is_of_one_case) {
  suspected_output_ = child_->process->output(max_output);
  end();
  return {what, std::move(reason), is_of_one_case, what == Event::late ? BreakCause::time_limit : BreakCause::other};
}

/// The event for a host that has ended or closed its pipe.
Worker::Event Worker::event_of_end() {
  constexpr int moment = 200;  // milliseconds from the last output of a process to its end
  if (!child_->process->has_ended(moment)) return end_as(Event::broke, "hung up without ending");
  const std::string last = last_line_of(child_->process->output(max_output));
  const BreakCause cause = child_->process->break_cause();
  Event event = end_as(Event::broke, child_->process->exit_text() + (last.empty() ? "" : ": " + last));
  event.cause = cause;
  return event;
}

/// Reads the new answers in shared memory.
std::optional<Worker::Event> Worker::read_shared_answers() {
  const std::size_t done = answered_->done.load(std::memory_order_acquire);
  if (done > requested_) return end_as(Event::broke, "counts more answers than it was asked for", true);
  const std::size_t before = got_;
  const bool all = wire::take(*answered_, got_, std::max(done, got_), numbers_got_, outputs_, answers_.data());
  for (std::size_t i = before; i < got_; ++i) {
    if (!decides_) answers_[i].yes = true;
    raised_[i] = answered_->heads[i].raised;
    make_printable(answers_[i]);
  }
  if (got_ > before) timeout_->restart();
  if (!all) return end_as(Event::broke, "answered with what is no answer", true);
  return std::nullopt;
}

std::optional<Worker::Event> Worker::read_piped_answers() {
  while (got_ < requested_) {
    const wire::Taken taken = program_->batches == HostProgram::Batches::binary
                                  ? wire::take_binary(child_->unread(), child_->answered, outputs_)
                                  : wire::take_json(child_->unread(), child_->answered, outputs_);
    if (!taken.error.empty()) return end_as(Event::broke, "answered with " + taken.error, true);
    if (taken.bytes == 0) return std::nullopt;
    child_->understood += taken.bytes;
    ++child_->answered;
    answers_[got_] = taken.answer;
    if (!decides_) answers_[got_].yes = true;
    make_printable(answers_[got_++]);
    timeout_->restart();
  }
  if (!child_->unread().empty()) {
    --got_;
    return end_as(Event::broke, "answered more often than it was asked", true);
  }
  return Event{Event::all_answered};
}

/// Waits until every requested case is answered, or until another event ends the waiting.
Worker::Event Worker::await() {
  while (true) {
    if (!keeps_waiting()) return end_as(Event::gave_up, "");
    pollfd files[3] = {{child_->from_host, POLLIN, 0},
                       {child_->process->status_file(), POLLIN, 0},
                       {child_->to_host, short(child_->has_more_to_write() ? POLLOUT : 0), 0}};
    const int ready = poll(files, child_->has_more_to_write() ? 3 : 2, poll_interval);
    bool open = true;
    if (ready > 0 && files[0].revents != 0) {
      open = child_->read_some();
      heard_ = true;
    }
    if (is_shared()) {
      const bool woken = !child_->unread().empty();
      if (auto event = read_shared_answers()) return *event;
      if (woken) {
        child_->understood = child_->in.size();
        if (got_ < requested_) return end_as(Event::broke, "says that all is done, and did not answer", true);
        return {Event::all_answered};
      }
    } else {
      if (ready > 0 && files[2].revents != 0 && child_->has_more_to_write()) open = flush() && open;
      if (auto event = read_piped_answers()) return *event;
    }
    const bool is_gone = !open || child_->process->has_ended();
    if (!is_gone && ready > 0 && Clock::now() < looked_ + std::chrono::milliseconds(poll_interval)) continue;
    looked_ = Clock::now();
    const auto late = is_gone ? std::nullopt : timeout_->expired(*child_->process, limits_);
    const bool is_too_large =
        limits_.bytes > 0 && child_->process->uses_more_memory_than(limits_.bytes + (std::size_t{1} << 28));
    if (!is_gone && !late && !is_too_large) continue;
    if (got_ == requested_) {  // an event after the last answer concerns no case
      end();
      return {Event::all_answered};
    }
    if (is_gone) {
      child_->process->has_ended(200);
      if (const int lack = child_->process->failed_to_start(); is_resource_shortage(lack)) {
        wait_for_resources(lack);
        end();
        return {Event::not_asked};
      }
      return event_of_end();
    }
    if (late)
      return end_as(Event::late,
                    is_shared() || heard_ ? *late : *late + ": it wrote nothing to file 4, or did not flush it");
    return end_as(Event::broke, "memory limit reached");
  }
}

void Worker::mark_broken(std::size_t i, std::string_view reason, std::string output, BreakCause cause) {
  answers_[i] = Answer::without(Answer::Status::broke, printable(reason), cause);
  if (!output.empty()) broken_.push_back({i, std::move(output)});
}

/// Adapts the size of requests: small for a host that sends its answers only at the end of a request, large for a fast
/// one.
void Worker::adapt(Clock::duration took) {
  using namespace std::chrono_literals;
  if (took < 50ms) piped_at_once_ = std::min(2 * piped_at_once_, capacity);
  if (took > 200ms) piped_at_once_ = std::max<std::size_t>(1, piped_at_once_ / 2);
}

std::span<const Answer> Worker::receive() {
  const FloatingPointScope standard;
  for (std::size_t late = 0; got_ < count_ && late < most_late;) {
    if (cannot_start_) {
      const std::string why = std::string("it cannot be started again: ") + cannot_start_->what();
      while (got_ < count_)
        mark_broken(got_++, why, {}, cannot_start_->late ? BreakCause::time_limit : BreakCause::other);
      break;
    }
    Event event = await();
    if (event.what == Event::gave_up) break;
    if (event.what == Event::not_asked) {
      request(got_, requested_);
      continue;
    }
    refused_since_.reset();
    if (event.what == Event::all_answered) {
      if (!is_shared() && !one_by_one_) adapt(Clock::now() - requested_since_);
      if (got_ < count_) request(got_, one_by_one_ ? got_ + 1 : count_);
      continue;
    }
    // A host behind a pipe may hold back answers to earlier cases, so the next case need not be the one that broke.
    const bool is_surely_next = is_shared() || event.is_of_one_case || requested_ - got_ == 1;
    if (is_surely_next) {
      mark_broken(got_++, event.reason, std::move(suspected_output_), event.cause);
      one_by_one_ = false;
      suspected_.reset();
      late += event.what == Event::late;
      if (late == most_late) break;
    } else {
      one_by_one_ = true;
      suspected_ = std::move(event);
      suspected_at_ = got_;
      suspected_with_ = std::move(suspected_output_);
    }
    if (got_ < count_) request(got_, one_by_one_ ? got_ + 1 : count_);
  }
  // The host broke in the batch but not case by case. A mere time limit in a batch does not count.
  if (got_ == count_ && suspected_ && suspected_->what == Event::broke) {
    mark_broken(suspected_at_, suspected_->reason + "; not again when the cases of its batch were asked one by one",
                std::move(suspected_with_), suspected_->cause);
  }
  return {answers_.data(), got_};
}

std::string_view Worker::output(std::size_t case_of_batch) const {
  for (const Output& o : broken_) {
    if (o.of == case_of_batch) return o.text;
  }
  return {};
}

double Worker::processor_seconds() const {
  const FloatingPointScope standard;
  return child_ ? child_->process->processor_seconds() : 0;
}

std::vector<Answer> Worker::ask(const Offering& offering, std::span<const double> values, std::size_t inputs_per_case) {
  std::vector<Answer> answers;
  const std::size_t most = std::min(capacity, max_values / inputs_per_case) * inputs_per_case;
  for (std::size_t at = 0; at < values.size(); at += most) {
    const std::span<const double> some = values.subspan(at, std::min(most, values.size() - at));
    send(offering, some, inputs_per_case);
    const auto batch = receive();
    answers.insert(answers.end(), batch.begin(), batch.end());
    if (batch.size() < some.size() / inputs_per_case) break;
  }
  return answers;
}

}  // namespace nearmiss
