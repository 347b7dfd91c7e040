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
#include <cstring>
#include <system_error>
#include <thread>
#include <utility>

#include "impl/catalogue/query.hpp"
#include "impl/host/error_line.hpp"
#include "impl/host/reasons.hpp"
#include "impl/host/replies.hpp"
#include "impl/host/serve.hpp"
#include "impl/host/throw_errno.hpp"
#include "impl/subject/floating_point.hpp"
#include "impl/subject/printable.hpp"

namespace nearmiss {

namespace {

constexpr int poll_interval = 50;             ///< milliseconds
constexpr std::size_t most_one_by_one = 512;  ///< cases that are asked again one by one
constexpr unsigned char poison_byte = 0xa5;
constexpr const char* overwritten = "wrote over the memory that holds its answers";
constexpr std::size_t max_output = 4096;
constexpr std::size_t max_searched_output = 16384;  ///< in which the line with the error is looked for

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

/// ": what happened" of a host's output; empty where it wrote nothing.
std::string error_in(const SupervisedProcess& host) {
  const std::string error = error_line_of(host.output(max_searched_output));
  return error.empty() ? "" : ": " + error;
}

/// Bits of the outputs that are also part of a miss, as the judge sees it.
std::uint64_t parts_of_misses(std::string_view query) {
  std::uint64_t parts = 0;
  const Query* q = find_query(query);
  for (std::size_t i = 0; q != nullptr && i < q->outputs.size(); ++i) {
    const Role role = q->outputs[i].role;
    if (role == Role::depth || role == Role::flag || role == Role::index) parts |= std::uint64_t{1} << i;
  }
  return parts;
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
    if (const auto other = wire::difference_between(program_->hello, first_line()))
      throw HostFailed("its hello differs from that of its first start: " + *other, HostFailed::another_hello);
    pollfd more{child_->from_host, POLLIN, 0};
    if (poll(&more, 1, 0) > 0) child_->read_some();
    if (!child_->unread().empty()) throw HostFailed("it says more than its hello before it is asked");
    refused_since_.reset();
    failed_starts_ = 0;
    lost_.clear();
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
      const bool is_done = child_->process->exit_code() == 0;
      throw HostFailed(child_->process->exit_text() + error_in(*child_->process),
                       is_done ? HostFailed::done : HostFailed::ended);
    }
    if (const auto late = timeout.expired(*child_->process, limits_.of_start())) {
      throw HostFailed(std::string("no hello").append(*late, std::string_view("no answer").size()), HostFailed::late);
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

void Worker::send(const Offering& offering, std::span<const double> values, const CaseLengths& lengths,
                  Rounding rounding) {
  const FloatingPointScope standard;
  put_request(offering, values, lengths);
  asked_->rounding = rounding;
  request(0, end_of_next_request());
}

std::optional<Worker::Times> Worker::time(const Offering& offering, std::span<const double> values,
                                          const CaseLengths& lengths) {
  if (!is_shared()) return std::nullopt;
  const FloatingPointScope standard;
  put_request(offering, values, lengths);
  outputs_ = 2;
  asked_->timed = true;
  request(0, end_of_next_request());
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
void Worker::put_request(const Offering& offering, std::span<const double> values, const CaseLengths& lengths) {
  count_ = lengths.cases(values.size());
  got_ = late_ = 0;
  outputs_ = offering.outputs;
  if (!is_shared()) due_ = {0, offering.outputs, gives().at(offering.position), parts_of_misses(offering.query)};
  decides_ = offering.decides;
  suspicions_.clear();
  broken_.clear();
  answers_.resize(std::max(answers_.size(), count_));
  asked_->offer = offering.position;
  asked_->rounding = Rounding::its_own;
  asked_->timed = false;
  raised_.assign(count_, 0);
  asked_->answer = program_ == nullptr ? offering.answer : AnswerFunction{};
  query_ = offering.query;
  std::copy(values.begin(), values.end(), asked_->values.begin());
  asked_->begins[0] = 0;
  for (std::size_t i = 0; i < count_; ++i) asked_->begins[i + 1] = asked_->begins[i] + std::uint32_t(lengths[i]);
}

/// The end of the next request, which begins at the next case without an answer. Cases that are asked again: the first
/// alone, then one by one, or about the square root of their number at once where they are many. So the case that
/// breaks the host is found with two or three starts and few requests.
std::size_t Worker::end_of_next_request() {
  std::size_t most = is_shared() ? capacity : piped_at_once();
  if (is_searching()) most = searches_one_by_one() ? 1 : again_at_once_;
  return std::min(count_, got_ + most);
}

bool Worker::searches_one_by_one() const {
  return std::any_of(suspicions_.begin(), suspicions_.end(),
                     [](const Suspicion& s) { return s.event.what == Event::late; });
}

/// What the host did since its last answer, where it did anything.
std::optional<Worker::Event> Worker::event_between_requests() {
  constexpr const char* when = ", between two requests";
  pollfd said{child_->from_host, POLLIN, 0};
  if (poll(&said, 1, 0) > 0) child_->read_some();
  if (!child_->unread().empty()) return end_as(Event::broke, std::string("wrote to file 4 without being asked") + when);
  if (!child_->process->has_ended()) return std::nullopt;
  Event event = event_of_end();
  event.reason += when;
  return event;
}

/// Sends the cases [first, end) to the host; starts a host where none runs.
void Worker::request(std::size_t first, std::size_t end_of_request) {
  cannot_start_.reset();
  if (child_) {
    if (auto event = event_between_requests()) {
      suspicions_.push_back({std::move(*event), first, first + 1, true});
      again_at_once_ = 1;
      end_of_request = first + 1;
    }
  }
  first_requested_ = first, requested_ = end_of_request;
  is_unreadable_ = false;
  if (!child_) {
    try {
      start();
    } catch (const HostFailed& e) {
      cannot_start_ = e;
      return;
    }
  }
  requested_since_ = Clock::now();
  if (is_searching()) {
    processor_before_ = child_->process->processor_seconds();
    run_queue_before_ = child_->process->run_queue_seconds();
  }
  timeout_->restart();
  if (is_shared()) {
    numbers_begin_ = numbers_got_ = 0;
    if (is_searching()) {
      poison();
      // Elsewhere at each try: a wild write that hits the place of its own answer would show nothing.
      numbers_begin_ = numbers_got_ = std::size_t{97} * requests_ % wire::most_shift;
    }
    asked_->numbers_at = std::uint32_t(numbers_begin_);
    asked_->first = std::uint32_t(first);
    asked_->count = std::uint32_t(end_of_request);
    asked_->batch = ++requests_;
    answered_->done.store(std::uint32_t(first), std::memory_order_relaxed);
    [[maybe_unused]] const ssize_t woken = write(child_->to_host, "g", 1);  // receive notices a dead host
    return;
  }
  const CaseNumbers cases = asked_->numbers(first, end_of_request);
  child_->out = program_->batches == HostProgram::Batches::binary
                    ? wire::binary_request(asked_->offer, child_->asked, cases, program_->version)
                    : wire::json_request(query_, child_->asked, cases);
  if (program_->asks_for_names && child_->asked == 0) child_->out.insert(0, wire::names_of_offers(program_->hello));
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

Worker::Event Worker::end_as(Event::What what, std::string reason, bool is_of_next_case) {
  Event event{what,
              std::move(reason),
              is_of_next_case,
              false,
              what == Event::late ? BreakCause::time_limit : BreakCause::other,
              child_->process->output(max_output)};
  end();
  return event;
}

Worker::Event Worker::end_as_of_any(std::string reason) {
  Event event = end_as(Event::broke, std::move(reason));
  event.is_of_any_case = true;
  return event;
}

/// The event for a host that has ended or closed its pipe.
Worker::Event Worker::event_of_end() {
  constexpr int moment = 200;  // milliseconds from the last output of a process to its end
  if (!child_->process->has_ended(moment)) return end_as(Event::broke, "hung up without ending");
  const BreakCause cause = child_->process->break_cause();
  const bool is_counted = is_shared() && !is_unreadable_;
  Event event = end_as(Event::broke, child_->process->exit_text() + error_in(*child_->process), is_counted);
  event.cause = cause;
  return event;
}

/// Reads the new answers in shared memory. An event where the host lacks memory: it would break every later case.
std::optional<Worker::Event> Worker::read_shared_answers() {
  const std::size_t done = answered_->done.load(std::memory_order_acquire);
  const std::size_t before = got_;
  is_unreadable_ = done > requested_ || !wire::take(*answered_, requests_, got_, std::max(done, got_), numbers_got_,
                                                    outputs_, answers_.data());
  for (std::size_t i = before; i < got_; ++i) {
    if (!decides_) answers_[i].yes = true;
    raised_[i] = answered_->heads[i].raised;
    make_printable(answers_[i]);
    if (answers_[i].status == Answer::Status::broke && answers_[i].reason() == memory_limit_reason) {
      got_ = i;
      return end_as(Event::broke, std::string(memory_limit_reason), true);
    }
  }
  has_answered_ = has_answered_ || got_ > before;
  if (got_ > before) timeout_->restart();
  return std::nullopt;
}

/// The event where a host that shares memory has said something: that all is done. Until then the host may still mend
/// what the subject wrote over its answers.
std::optional<Worker::Event> Worker::event_of_shared_end() {
  const std::string said(child_->unread());
  if (said.empty()) return std::nullopt;
  if (is_unreadable_) return end_as(Event::broke, "answered with what is no answer");
  const char* wrong = said == wire::all_done_and_overwritten ? overwritten
                      : said != wire::all_done               ? "wrote to file 4 more than its host does"
                      : got_ < requested_                    ? "says that all is done, and did not answer"
                                                             : nullptr;
  if (wrong != nullptr) return end_as_of_any(wrong);
  child_->understood = child_->in.size();
  return Event{Event::all_answered};
}

std::optional<Worker::Event> Worker::read_piped_answers() {
  while (got_ < requested_) {
    due_.number = child_->answered;
    const wire::Taken taken = program_->batches == HostProgram::Batches::binary
                                  ? wire::take_binary(child_->unread(), due_)
                                  : wire::take_json(child_->unread(), due_);
    if (!taken.error.empty()) return end_as(Event::broke, "answered with " + taken.error, taken.names_its_case);
    if (taken.bytes == 0) return std::nullopt;
    child_->understood += taken.bytes;
    ++child_->answered;
    answers_[got_] = taken.answer;
    if (!decides_) answers_[got_].yes = true;
    make_printable(answers_[got_++]);
    has_answered_ = true;
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
    if (!is_shared() && ready > 0 && files[2].revents != 0 && child_->has_more_to_write()) open = flush() && open;
    const bool is_gone = !open || child_->process->has_ended();  // what it answered before its end is read below
    if (auto event = is_shared() ? read_shared_answers() : read_piped_answers()) return *event;
    if (is_shared()) {
      if (auto event = event_of_shared_end()) return *event;
    }
    if (!is_gone && ready > 0 && Clock::now() < looked_ + std::chrono::milliseconds(poll_interval)) continue;
    looked_ = Clock::now();
    const auto late = is_gone ? std::nullopt : timeout_->expired(*child_->process, limits_);
    const bool is_too_large =
        limits_.bytes > 0 && child_->process->uses_more_memory_than(limits_.bytes + (std::size_t{1} << 28));
    if (!is_gone && !late && !is_too_large) continue;
    if (is_gone) {
      child_->process->has_ended(200);
      if (const int lack = child_->process->failed_to_start(); is_resource_shortage(lack)) {
        wait_for_resources(lack);
        end();
        return {Event::not_asked};
      }
      if (is_shared()) {  // a host that has only closed its pipe goes on to answer
        if (auto event = read_shared_answers()) return *event;
      }
      return event_of_end();
    }
    if (late) {
      const bool is_counted = is_shared() && !is_unreadable_;
      const bool is_silent = !is_shared() && !heard_;
      return end_as(Event::late, *late + (is_silent ? ": it wrote nothing to file 4, or did not flush it" : ""),
                    is_counted);
    }
    return end_as(Event::broke, std::string(memory_limit_reason), is_shared() && !is_unreadable_);
  }
}

void Worker::mark_broken(std::size_t i, const Event& event, std::string_view suffix) {
  answers_[i] = Answer::without(Answer::Status::broke, printable(event.reason), event.cause);
  if (!suffix.empty()) {
    const std::string whole(answers_[i].reason());
    std::size_t most = std::min(whole.size(), sizeof(Answer::why) - 1 - suffix.size());
    while (most < whole.size() && most > 0 && (whole[most] & 0xC0) == 0x80) --most;
    answers_[i].explain(whole.substr(0, most) + std::string(suffix));
  }
  late_ += event.cause == BreakCause::time_limit;
  std::erase_if(broken_, [i](const Output& o) { return o.of == i; });
  if (!event.output.empty()) broken_.push_back({i, event.output});
}

/// For each offer of the hello the outputs that it gives.
const std::vector<std::uint64_t>& Worker::gives() {
  if (gives_.empty()) gives_ = wire::given_by_offers(program_->hello);
  return gives_;
}

std::size_t& Worker::piped_at_once() {
  if (piped_at_once_.size() <= asked_->offer) piped_at_once_.resize(asked_->offer + 1, 1);
  return piped_at_once_[asked_->offer];
}

/// Adapts the size of requests: small for a host that sends its answers only at the end of a request, large for a fast
/// one. A request takes much less than the time limit of one case, so that no sum of usual times is late.
void Worker::adapt(Clock::duration took) {
  using Seconds = std::chrono::duration<double>;
  std::size_t& most = piped_at_once();
  if (took < Seconds(std::min(0.05, limits_.case_timeout / 8))) most = std::min(2 * most, capacity);
  if (took > Seconds(std::min(0.2, limits_.case_timeout / 2))) most = std::max<std::size_t>(1, most / 2);
}

/// What the request has taken.
Worker::Took Worker::took() const {
  const double wall = std::chrono::duration<double>(Clock::now() - requested_since_).count();
  return {child_->process->processor_seconds() - processor_before_,
          wall - (child_->process->run_queue_seconds() - run_queue_before_)};
}

/// True where the cases, asked again, explain the time that the request took.
bool Worker::was_only_slow(const Suspicion& s) const {
  return s.event.what == Event::late &&
         (2 * s.again.processor >= limits_.case_timeout || 2 * s.again.wall >= limits_.wall());
}

/// Counts what broke the host in a request and did not so again, for each request whose cases end at or before `end`.
void Worker::settle(std::size_t end) {
  for (const Suspicion& s : suspicions_) {
    if (s.end > end || was_only_slow(s)) continue;
    got_ = std::max(got_, s.at + 1);
    mark_broken(s.at, s.event, s.is_earlier ? std::string_view{} : not_again_suffix);
  }
  std::erase_if(suspicions_, [end](const Suspicion& s) { return s.end <= end; });
}

/// Marks the next case as broken, for no host can be started. False where the host is lost.
bool Worker::take_failed_start() {
  const HostFailed why = *std::exchange(cannot_start_, std::nullopt);
  if (why.why == HostFailed::another_hello && !has_answered_) throw why;
  Event event{Event::broke, std::string("it cannot be started again: ") + why.what()};
  if (why.why == HostFailed::late) event.cause = BreakCause::time_limit;
  mark_broken(got_++, event);
  if (++failed_starts_ == most_failed_starts || why.why == HostFailed::another_hello) lost_ = why.what();
  return lost_.empty();
}

/// Fills the answers with bytes that no answer to the next request changes.
void Worker::poison() { std::memset(static_cast<void*>(answered_), poison_byte, sizeof *answered_); }

/// True where nothing but the answers to the request has changed the memory that holds them.
bool Worker::is_poison_intact() const {
  const auto is_poison = [](const auto* begin, const auto* end) {
    return std::all_of(reinterpret_cast<const unsigned char*>(begin), reinterpret_cast<const unsigned char*>(end),
                       [](unsigned char byte) { return byte == poison_byte; });
  };
  const auto but_the_requested = [&](const auto& all) {
    return is_poison(all.data(), all.data() + first_requested_) &&
           is_poison(all.data() + requested_, all.data() + all.size());
  };
  return but_the_requested(answered_->heads) && but_the_requested(answered_->reasons) &&
         is_poison(answered_->numbers.data(), answered_->numbers.data() + numbers_begin_) &&
         is_poison(answered_->numbers.data() + numbers_got_, answered_->numbers.data() + answered_->numbers.size());
}

/// Every requested case is answered.
void Worker::take_answered() {
  if (!is_searching()) {
    if (!is_shared()) adapt(Clock::now() - requested_since_);
    return;
  }
  if (searches_one_by_one()) {
    const Took now = took();
    for (Suspicion& s : suspicions_) s.again.processor += now.processor, s.again.wall += now.wall;
  }
  // After the first case alone: a start of a program costs as much as many requests of one case.
  const std::size_t suspects = suspicions_.back().end - suspicions_.back().at;
  again_at_once_ = suspects <= most_one_by_one ? 1 : std::size_t(std::sqrt(double(suspects)));
  if (!is_shared() || asked_->timed || is_poison_intact()) return;
  take(end_as_of_any(overwritten));
}

void Worker::take(Event event) {
  refused_since_.reset();
  if (event.what == Event::all_answered) return take_answered();
  if (got_ == requested_ && !event.is_of_any_case) {
    event.reason += ", after its last answer";  // which are all good: none is asked again
    return mark_broken(got_ - 1, event);
  }
  if (event.is_of_any_case) got_ = first_requested_;
  if (!event.is_of_next_case && requested_ - got_ > 1) {
    suspicions_.push_back({std::move(event), got_, requested_});
    again_at_once_ = 1;
    if (!is_shared()) piped_at_once() = std::max<std::size_t>(1, piped_at_once() / 2);
    return;
  }
  std::erase_if(suspicions_, [](const Suspicion& s) { return !s.is_earlier; });  // this case was the one
  mark_broken(got_++, event);
}

bool Worker::broke_from_the_start(std::size_t most) const {
  return got_ >= most && std::all_of(answers_.begin(), answers_.begin() + std::ptrdiff_t(got_),
                                     [](const Answer& a) { return a.status == Answer::Status::broke; });
}

std::span<const Answer> Worker::receive(std::size_t most_broken) {
  const FloatingPointScope standard;
  // No request is under way when this function returns: its end would be counted at a case of the next batch.
  const auto is_over = [&] { return got_ == count_ || late_ >= most_late || broke_from_the_start(most_broken); };
  while (!is_over()) {
    if (cannot_start_) {
      if (!keeps_waiting() || !take_failed_start()) break;
    } else {
      Event event = await();
      if (event.what == Event::gave_up) {
        // Whether its cases are only slow stays open.
        std::erase_if(suspicions_, [](const Suspicion& s) { return s.event.what == Event::late; });
        break;
      }
      if (event.what == Event::not_asked) {
        request(got_, requested_);
        continue;
      }
      take(std::move(event));
    }
    settle(got_);
    if (!is_over()) request(got_, end_of_next_request());
  }
  settle(count_);
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

std::vector<Answer> Worker::ask(const Offering& offering, std::span<const double> values, const CaseLengths& lengths) {
  std::vector<Answer> answers;
  const std::size_t count = lengths.cases(values.size());
  while (answers.size() < count) {
    const std::size_t first = answers.size();
    std::size_t end = first, numbers = 0;
    while (end < count && end - first < capacity && numbers + lengths[end] <= max_values) numbers += lengths[end++];
    send(offering, values.first(numbers), lengths.part(first, end));
    values = values.subspan(numbers);
    const auto batch = receive();
    answers.insert(answers.end(), batch.begin(), batch.end());
    if (batch.size() < end - first) break;
  }
  return answers;
}

}  // namespace nearmiss
