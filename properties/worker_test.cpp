/// In a worker, any misbehaviour of a subject costs one case, and the finding gives the reason.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
#include <memory>
#include <numeric>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "impl/host/processes.hpp"
#include "impl/host/reasons.hpp"
#include "impl/host/separation.hpp"
#include "impl/host/serve.hpp"
#include "impl/host/worker.hpp"

namespace nearmiss {
namespace {

enum Misdeed {
  none,
  aborts,
  crashes,
  throws,
  throws_an_int,
  hangs,
  sleeps,
  eats_memory,
  exits,
  keeps_memory,
  scribbles,
  scribbles_far,
  speaks
};

/// The memory of the answers in a host, which finds it as a wild pointer would.
unsigned char* memory_of_answers() {
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    if (line.find("nearmiss-answered") != std::string::npos)
      return reinterpret_cast<unsigned char*>(std::stoul(line, nullptr, 16));  // NOLINT(performance-no-int-to-ptr)
  }
  throw std::runtime_error("no memory of answers");
}

char* volatile kept_memory = nullptr;

/// Misbehaves as the first input says; otherwise answers with the second.
Answer misbehave(std::span<const double> inputs) {
  switch (Misdeed(int(inputs[0]))) {
    case aborts: std::fputs("subject: assertion depth > 0 failed\n", stderr); std::abort();
    case crashes: std::raise(SIGSEGV); break;
    case throws: throw std::runtime_error("no contact found");
    case throws_an_int: throw 42;
    case hangs:
      for (volatile bool forever = true; forever;) {
      }
      break;
    case sleeps:
      for (;;) pause();
    case eats_memory:
      for (std::vector<std::vector<char>> kept;;) kept.emplace_back(std::size_t{1} << 24, 'x');
    case exits: std::_Exit(3);
    case keeps_memory: kept_memory = new char[std::size_t{64} << 20]; break;
    case scribbles:
      std::memset(memory_of_answers() + offsetof(wire::SharedAnswers, heads), 0x5a, sizeof(wire::SharedAnswers::heads));
      break;
    case scribbles_far: std::memset(memory_of_answers() + offsetof(wire::SharedAnswers, numbers), 0x5a, 64); break;
    case speaks:
      if (write(wire::to_judge, "noise", 5) != 5) throw std::runtime_error("the judge does not listen");
      break;
    case none: break;
  }
  Answer a;
  a.values[0] = inputs[1];
  return a;
}

Offering offering() { return {"misbehave", Offer::answers, "", {}, misbehave}; }

WorkerLimits limits() { return {.case_timeout = 0.5, .bytes = std::size_t{256} << 20}; }

class WorkerSurvives : public testing::TestWithParam<std::tuple<const char*, Misdeed, const char*>> {};

TEST_P(WorkerSurvives, AndOnlyTheCaseBreaks) {
  const auto [name, misdeed, reason] = GetParam();
#if defined(__SANITIZE_ADDRESS__)
  if (misdeed == eats_memory) GTEST_SKIP() << "AddressSanitizer leaves no address space to limit";
#endif
  WorkerLimits limits = nearmiss::limits();
  if (misdeed == eats_memory) limits.case_timeout = 30;  // a sanitizer is slow at allocating memory
  Worker worker(limits);
  const std::vector<double> inputs{none, 1, double(misdeed), 2, none, 3};
  const std::vector<Answer> answers = worker.ask(offering(), inputs, 2);
  ASSERT_EQ(answers.size(), 3u);
  EXPECT_EQ(answers[0].status, Answer::Status::answered);
  EXPECT_EQ(answers[0].values[0], 1);
  EXPECT_EQ(answers[1].status, Answer::Status::broke);
  EXPECT_NE(answers[1].reason().find(reason), std::string_view::npos) << answers[1].reason();
  EXPECT_EQ(answers[2].status, Answer::Status::answered);
  EXPECT_EQ(answers[2].values[0], 3);
}

INSTANTIATE_TEST_SUITE_P(Misdeeds, WorkerSurvives,
                         testing::Values(std::tuple{"abort", aborts, "assertion depth > 0 failed"},
                                         std::tuple{"crash", crashes, "signal 11"},
                                         std::tuple{"exception", throws, "no contact found"},
                                         std::tuple{"foreign_exception", throws_an_int, "no std::exception"},
                                         std::tuple{"hang", hangs, "no answer within 0.500 s of processor time"},
                                         std::tuple{"sleep", sleeps, "no answer within 2.500 s"},
                                         std::tuple{"memory", eats_memory, "memory limit"},
                                         std::tuple{"exit", exits, "exit code 3"}),
                         [](const auto& test) { return std::string(std::get<0>(test.param)); });

TEST(Worker, AnswersMoreCasesThanOneBatchHoldsInOrder) {
  Worker worker(limits());
  std::vector<double> inputs;
  for (std::size_t i = 0; i < 3 * Worker::capacity + 5; ++i) inputs.insert(inputs.end(), {none, double(i)});
  const std::vector<Answer> answers = worker.ask(offering(), inputs, 2);
  ASSERT_EQ(answers.size(), inputs.size() / 2);
  for (std::size_t i = 0; i < answers.size(); ++i) ASSERT_EQ(answers[i].values[0], double(i));
}

TEST(Worker, SurvivesWhenEveryCaseBreaks) {
  Worker worker(limits());
  std::vector<double> inputs;
  for (int i = 0; i < 20; ++i) inputs.insert(inputs.end(), {double(aborts), 0.0});
  for (const Answer& a : worker.ask(offering(), inputs, 2)) EXPECT_EQ(a.status, Answer::Status::broke);
}

/// The positions of the cases that broke among `cases`, of which those in `misdeeds` misbehave. Every other case must
/// have its own answer.
std::vector<std::size_t> broken_of(std::size_t cases, Misdeed misdeed, const std::set<std::size_t>& misdeeds) {
  Worker worker(limits());
  std::vector<double> inputs;
  for (std::size_t i = 0; i < cases; ++i)
    inputs.insert(inputs.end(), {double(misdeeds.contains(i) ? misdeed : none), double(i)});
  const std::vector<Answer> answers = worker.ask(offering(), inputs, 2);
  EXPECT_EQ(answers.size(), cases);
  std::vector<std::size_t> broken;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    if (answers[i].status == Answer::Status::broke) {
      broken.push_back(i);
      EXPECT_EQ(answers[i].reason().find(not_again_suffix), std::string_view::npos) << i << ": " << answers[i].reason();
    } else {
      EXPECT_EQ(answers[i].values[0], double(i));
    }
  }
  return broken;
}

class WildWrite : public testing::TestWithParam<Misdeed> {};

TEST_P(WildWrite, CostsItsOwnCaseAlone) {
  EXPECT_EQ(broken_of(400, GetParam(), {57, 130, 399}), (std::vector<std::size_t>{57, 130, 399}));
  EXPECT_EQ(broken_of(6000, GetParam(), {1499, 2999, 4499, 5999}), (std::vector<std::size_t>{1499, 2999, 4499, 5999}));
}

INSTANTIATE_TEST_SUITE_P(Of, WildWrite, testing::Values(scribbles, scribbles_far, speaks));

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool is_sanitized = true;
#elif defined(__has_feature)
constexpr bool is_sanitized = __has_feature(address_sanitizer) || __has_feature(thread_sanitizer);
#else
constexpr bool is_sanitized = false;
#endif

TEST(Worker, StartsAnewWhereMemoryHasRunOut) {
  if (is_sanitized) GTEST_SKIP() << "a sanitizer leaves no address space to limit";
  Worker worker(limits());  // room for three or so
  std::vector<double> inputs;
  for (int i = 0; i < 30; ++i) inputs.insert(inputs.end(), {double(keeps_memory), double(i)});
  const std::vector<Answer> answers = worker.ask(offering(), inputs, 2);
  ASSERT_EQ(answers.size(), 30u);
  std::size_t broke = 0;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    if (answers[i].status != Answer::Status::broke) continue;
    ++broke;
    EXPECT_EQ(answers[i].reason(), "memory limit reached");
    EXPECT_TRUE(i == 0 || answers[i - 1].status == Answer::Status::answered) << "a breakage erases the next answer";
  }
  EXPECT_GE(broke, 5u);
  EXPECT_LE(broke, 15u);
}

TEST(Worker, StopsABatchThatBreaksFromItsStart) {
  Worker worker(limits());
  worker.send(offering(), std::vector<double>{aborts, 0, aborts, 1, aborts, 2, none, 3}, 2);
  EXPECT_EQ(worker.receive(2).size(), 2u);
  worker.send(offering(), std::vector<double>{none, 0, aborts, 1, aborts, 2, aborts, 3}, 2);
  EXPECT_EQ(worker.receive(2).size(), 4u);
}

/// The first case of the batch behind a batch that ends early has its own answer.
void expect_no_blame_for_the_batch_before(Misdeed misdeed, double case_timeout, std::size_t most_broken) {
  Worker worker({.case_timeout = case_timeout, .bytes = std::size_t{256} << 20});
  worker.send(offering(), std::vector<double>(128, double(misdeed)), 2);
  ASSERT_LT(worker.receive(most_broken).size(), 64u);
  // A case that was asked in vain has ended by now.
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  worker.send(offering(), std::vector<double>{none, 7}, 2);
  const std::span<const Answer> answers = worker.receive();
  ASSERT_EQ(answers.size(), 1u);
  EXPECT_EQ(answers[0].status, Answer::Status::answered) << answers[0].reason();
  EXPECT_EQ(answers[0].values[0], 7);
}

TEST(Worker, BlamesNoCaseForABatchThatBrokeFromItsStart) { expect_no_blame_for_the_batch_before(aborts, 0.5, 4); }

TEST(Worker, BlamesNoCaseForABatchOfWhichManyWereLate) {
  expect_no_blame_for_the_batch_before(hangs, 0.02, Worker::capacity);
}

/// Uses a tenth of a second of processor time.
Answer work(std::span<const double>) {
  const auto worked = [] {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
  };
  for (const double begin = worked(); worked() < begin + 0.1;) {
  }
  return {};
}

/// This process and its children share one processor with `others` busy processes.
class Crowd {
 public:
  explicit Crowd(int others) {
    sched_getaffinity(0, sizeof before_, &before_);
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(sched_getcpu(), &one);
    sched_setaffinity(0, sizeof one, &one);
    for (int i = 0; i < others; ++i) {
      others_.push_back(fork());
      if (others_.back() == 0) {
        setsid();   // as a host does: a system may share its processors between sessions
        alarm(60);  // a safeguard if the test fails
        for (volatile bool forever = true; forever;) {
        }
      }
    }
  }
  ~Crowd() {
    for (const pid_t p : others_) kill(p, SIGKILL), waitpid(p, nullptr, 0);
    sched_setaffinity(0, sizeof before_, &before_);
  }

 private:
  cpu_set_t before_;
  std::vector<pid_t> others_;
};

TEST(Worker, HasPatienceWithASubjectThatWaitsForItsTurn) {
  using Clock = std::chrono::steady_clock;
  const Crowd crowd(24);
  Worker worker(limits());
  const Clock::time_point begin = Clock::now();
  const auto answers = worker.ask({"work", Offer::answers, "", {}, work}, std::vector<double>{0}, 1);
  EXPECT_EQ(answers[0].status, Answer::Status::answered) << answers[0].reason();
  EXPECT_GT(Clock::now() - begin, std::chrono::seconds(1)) << "the machine was not busy: this shows nothing";
}

/// A named pipe whose end of file is seen when every process that has opened it has ended.
class Lifeline {
 public:
  Lifeline() {
    if (mkdtemp(folder_.data()) == nullptr || mkfifo(name().c_str(), 0600) != 0)
      throw std::runtime_error("a named pipe");
    // A subject may have a user of its own.
    if (chmod(folder_.c_str(), 0711) != 0 || chmod(name().c_str(), 0622) != 0) throw std::runtime_error("its rights");
    file_ = open(name().c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    current = name();
  }
  ~Lifeline() {
    close(file_);
    unlink(name().c_str());
    rmdir(folder_.c_str());
  }
  Lifeline(const Lifeline&) = delete;
  Lifeline& operator=(const Lifeline&) = delete;

  bool says_something_within(int seconds) {
    char said = 0;
    return ready_within(seconds) && read(file_, &said, 1) == 1;
  }
  bool ends_within(int seconds) {
    char said = 0;
    while (ready_within(seconds)) {
      if (read(file_, &said, 1) == 0) return true;
    }
    return false;
  }
  /// The name of the current pipe. A subject, which is a copy of this process, has no other access to it.
  static inline std::string current;

 private:
  std::string name() const { return folder_ + "/pipe"; }
  bool ready_within(int seconds) {
    pollfd p{file_, POLLIN, 0};
    return poll(&p, 1, 1000 * seconds) == 1;
  }
  std::string folder_ = "/tmp/nearmiss-lifeline-XXXXXX";
  int file_ = -1;
};

enum Leaving { in_its_group, in_its_own_session, twice_removed };

/// Starts a process that would live for a minute and holds the pipe, reports that, then misbehaves as the first input
/// says.
Answer leave_something_behind(std::span<const double> inputs) {
  const auto leaving = Leaving(int(inputs[1]));
  const int lifeline = open(Lifeline::current.c_str(), O_WRONLY);
  if (fork() == 0) {
    if (leaving != in_its_group) setsid();
    if (leaving == twice_removed && fork() != 0) _exit(0);
    for (unsigned left = 60; left > 0;) left = sleep(left);
    _exit(0);
  }
  if (write(lifeline, "x", 1) != 1) throw std::runtime_error("the lifeline is broken");
  close(lifeline);
  return misbehave(inputs);
}

Offering leaving() { return {"leaving", Offer::answers, "", {}, leave_something_behind}; }

/// A process that a subject starts, in its group or hidden elsewhere. In a process namespace, and without one.
class WhatASubjectStarted : public testing::TestWithParam<std::tuple<Leaving, bool>> {
 protected:
  double how() const { return double(std::get<0>(GetParam())); }
  WorkerLimits patient(double seconds) const {
    return {.case_timeout = seconds, .pid_namespace = std::get<1>(GetParam())};
  }
};

TEST_P(WhatASubjectStarted, EndsWhenTheSubjectHangs) {
  Lifeline lifeline;
  Worker worker(patient(0.5));
  const auto answers = worker.ask(leaving(), std::vector<double>{hangs, how()}, 2);
  EXPECT_EQ(answers[0].reason(), "no answer within 0.500 s of processor time");
  EXPECT_TRUE(answers[0].late());
  EXPECT_TRUE(lifeline.says_something_within(0));
  EXPECT_TRUE(lifeline.ends_within(5));
}

TEST_P(WhatASubjectStarted, EndsWhenTheSubjectCrashesAndTheCrashIsTold) {
  Lifeline lifeline;
  Worker worker(patient(60));
  const auto answers = worker.ask(leaving(), std::vector<double>{aborts, how()}, 2);
  EXPECT_NE(answers[0].reason().find("signal 6"), std::string_view::npos) << answers[0].reason();
  EXPECT_FALSE(answers[0].late());
  EXPECT_EQ(worker.output(0), "subject: assertion depth > 0 failed\n");
  EXPECT_TRUE(lifeline.ends_within(5));
}

TEST_P(WhatASubjectStarted, EndsWithTheWorker) {
  Lifeline lifeline;
  {
    Worker worker(patient(60));
    const auto answers = worker.ask(leaving(), std::vector<double>{none, how()}, 2);
    EXPECT_EQ(answers[0].status, Answer::Status::answered);
    EXPECT_TRUE(lifeline.says_something_within(5));
  }
  EXPECT_TRUE(lifeline.ends_within(5));
}

TEST_P(WhatASubjectStarted, EndsWhenTheJudgeIsKilled) {
  Lifeline lifeline;
  const pid_t judge = fork();
  if (judge == 0) {
    Worker worker(patient(3600));
    worker.ask(leaving(), std::vector<double>{hangs, how()}, 2);
    _exit(0);
  }
  EXPECT_TRUE(lifeline.says_something_within(10));
  kill(judge, SIGKILL);
  waitpid(judge, nullptr, 0);
  EXPECT_TRUE(lifeline.ends_within(5));
}

TEST_P(WhatASubjectStarted, EndsWhenASupervisorIsKilled) {
  Lifeline lifeline;
  const pid_t judge = fork();
  if (judge == 0) {
    Worker worker(patient(3600));
    worker.ask(leaving(), std::vector<double>{hangs, how()}, 2);
    _exit(0);
  }
  EXPECT_TRUE(lifeline.says_something_within(10));
  const std::vector<pid_t> first = children_of(judge);
  ASSERT_EQ(first.size(), 1u);
  const bool namespaced = std::get<1>(GetParam());
  const std::vector<pid_t> above_the_host = namespaced ? first : children_of(first.front());
  ASSERT_EQ(above_the_host.size(), 1u);
  kill(judge, SIGSTOP);  // it does not help
  kill(above_the_host.front(), SIGKILL);
  EXPECT_TRUE(lifeline.ends_within(5));
  kill(judge, SIGKILL);
  waitpid(judge, nullptr, 0);
}

std::string how_it_left(const testing::TestParamInfo<std::tuple<Leaving, bool>>& test) {
  constexpr const char* names[] = {"in_its_group", "in_its_own_session", "twice_removed"};
  return std::string(names[std::get<0>(test.param)]) + (std::get<1>(test.param) ? "_of_a_namespace" : "");
}
INSTANTIATE_TEST_SUITE_P(Anywhere, WhatASubjectStarted,
                         testing::Combine(testing::Values(in_its_group, in_its_own_session, twice_removed),
                                          testing::Bool()),
                         how_it_left);

/// The open files of this process as a bit set, without the file used for counting.
Answer count_files(std::span<const double>) {
  Answer a;
  for (int file = 0; file < 1000; ++file) {
    if (fcntl(file, F_GETFD) != -1) a.values[std::size_t(std::min(file, 39))] = 1;
  }
  return a;
}

TEST(Worker, HasNoFilesButItsOwn) {
  const int secret = open("/dev/null", O_RDONLY);  // not to be closed by exec
  const int far = fcntl(secret, F_DUPFD, 700);
  Worker worker(limits()), other(limits());
  const Offering counting{"counting", Offer::answers, "", {}, count_files};
  for (Worker* w : {&worker, &other}) {
    const Answer a = w->ask(counting, std::vector<double>{0}, 1).front();
    for (int file = 0; file < 40; ++file) EXPECT_EQ(a.values[std::size_t(file)], file < 5 ? 1 : 0) << file;
  }
  close(secret), close(far);
}

TEST(Worker, HasItsOwnSessionAndAnEmptyInput) {
  Worker worker(limits());
  const AnswerFunction look = [](std::span<const double>) {
    Answer a;
    char byte = 0;
    a.values[0] = getsid(0) == getpid();
    a.values[1] = double(read(STDIN_FILENO, &byte, 1));
    a.values[2] = getppid() > 1 ? 0 : double(getppid());
    return a;
  };
  const Answer a = worker.ask({"look", Offer::answers, "", {}, look}, std::vector<double>{0}, 1).front();
  EXPECT_EQ(a.values[0], 1);
  EXPECT_EQ(a.values[1], 0);
}

/// The user, the number of groups, no_new_privs, the capabilities of this process and those of its bounding set.
Answer look_at_rights(std::span<const double>) {
  Answer a;
  a.values[0] = getuid();
  a.values[1] = getgroups(0, nullptr);
  a.values[2] = prctl(PR_GET_NO_NEW_PRIVS, 0, 0, 0, 0);
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    if (word == "CapInh:" || word == "CapPrm:" || word == "CapEff:" || word == "CapBnd:" || word == "CapAmb:") {
      unsigned long long capabilities = 0;
      status >> std::hex >> capabilities >> std::dec;
      a.values[word == "CapBnd:" ? 4 : 3] += double(capabilities);
    }
  }
  return a;
}

TEST(Worker, HasAUserOfItsOwnForEachSubjectOfTheSuperuser) {
  if (!user_for_a_host()) GTEST_SKIP() << "this test does not run as the superuser, or has no other user id";
  Worker worker(limits()), other(limits());
  const Offering rights{"rights", Offer::answers, "", {}, look_at_rights};
  const Answer first = worker.ask(rights, std::vector<double>{0}, 1).front();
  const Answer second = other.ask(rights, std::vector<double>{0}, 1).front();
  EXPECT_NE(first.values[0], second.values[0]);
  for (const Answer& a : {first, second}) {
    EXPECT_GE(a.values[0], 61184);
    EXPECT_EQ(a.values[1], 0) << "it is in a group";
    EXPECT_EQ(a.values[2], 1);
    EXPECT_EQ(a.values[3], 0) << "it has capabilities";
    EXPECT_EQ(a.values[4], 0) << "it could get capabilities";
  }
}

TEST(Worker, HasNoCapabilitiesWithAnyUser) {
  for (const bool namespaced : {true, false}) {
    Worker worker({.pid_namespace = namespaced});
    const Offering rights{"rights", Offer::answers, "", {}, look_at_rights};
    const Answer a = worker.ask(rights, std::vector<double>{0}, 1).front();
    EXPECT_EQ(a.values[2], 1);
    EXPECT_EQ(a.values[3], 0);
  }
}

TEST(Worker, MakesTheJudgeNotDumpable) {
  Worker worker(limits());
  worker.ask(offering(), std::vector<double>{none, 1}, 2);
  EXPECT_EQ(prctl(PR_GET_DUMPABLE, 0, 0, 0, 0), 0);
}

/// Starts as many processes as the first input says, each of which uses 60 MB, and waits for them.
Answer feed_children(std::span<const double> inputs) {
  for (int i = 0; i < int(inputs[0]); ++i) {
    if (fork() == 0) {
      std::vector<char> kept(std::size_t{60} << 20, 'x');
      for (;;) kept[std::size_t(pause() + 2)] = 'y';  // NOLINT(bugprone-misplaced-widening-cast)
    }
  }
  if (inputs[0] > 0) sleep(60);
  return {};
}

TEST(Worker, LimitsTheMemoryOfAllProcessesOfASubjectTogether) {
  for (const bool namespaced : {true, false}) {
    Worker worker({.case_timeout = 30, .bytes = std::size_t{64} << 20, .pid_namespace = namespaced});
    const Offering feeding{"feeding", Offer::answers, "", {}, feed_children};
    const std::vector<Answer> answers = worker.ask(feeding, std::vector<double>{0, 7, 0}, 1);
    EXPECT_EQ(answers[0].status, Answer::Status::answered);
    EXPECT_EQ(answers[1].reason(), "memory limit reached");
    EXPECT_EQ(answers[2].status, Answer::Status::answered);
  }
}

TEST(Worker, KeepsWhatASubjectWroteBeforeItBroke) {
  Worker worker(limits());
  const AnswerFunction talk = [](std::span<const double>) -> Answer {
    std::puts("to standard output");
    std::fflush(stdout);
    std::fputs("and to standard error\n", stderr);
    std::abort();
  };
  const auto answers = worker.ask({"talk", Offer::answers, "", {}, talk}, std::vector<double>{0}, 1);
  EXPECT_EQ(answers[0].reason(), "killed by signal 6 (Aborted): and to standard error");
  EXPECT_EQ(worker.output(0), "to standard output\nand to standard error\n");
}

TEST(Worker, GivesUpABatchOfWhichManyAreLate) {
  Worker worker({.case_timeout = 0.02});
  const std::vector<double> inputs(64, double(hangs));
  const auto answers = worker.ask(offering(), inputs, 2);
  EXPECT_EQ(answers.size(), Worker::most_late);
  for (const Answer& a : answers) EXPECT_TRUE(a.late());
}

TEST(Worker, StopsWaitingWhenItIsTold) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  Worker worker({.case_timeout = 3600}, nullptr, [&] { return Clock::now() < begin + std::chrono::milliseconds(300); });
  const auto answers = worker.ask(offering(), std::vector<double>{none, 1, sleeps, 2, none, 3}, 2);
  EXPECT_LT(Clock::now() - begin, std::chrono::minutes(1)) << "it waits for the case";
  ASSERT_EQ(answers.size(), 1u);
  EXPECT_EQ(answers[0].values[0], 1);
}

TEST(Worker, TimesTheCallOfEachCaseAndThenAnswersAsBefore) {
  Worker worker(limits());
  std::vector<double> inputs;
  for (int i = 0; i < 50; ++i) inputs.insert(inputs.end(), {double(none), double(i)});
  const auto times = worker.time(offering(), inputs, 2);
  ASSERT_TRUE(times);
  ASSERT_EQ(times->nanoseconds.size(), 50u);
  for (const double t : times->nanoseconds) EXPECT_GT(t, 0);
  EXPECT_GT(times->how.processor_nanoseconds, 0);
  EXPECT_GE(times->how.rounds, 1u);
  EXPECT_FALSE(times->how.typed);
  EXPECT_EQ(times->stages, std::vector(50, AnswerStage::unknown));
  const std::vector<Answer> answers = worker.ask(offering(), inputs, 2);
  ASSERT_EQ(answers.size(), 50u);
  for (std::size_t i = 0; i < answers.size(); ++i) EXPECT_EQ(answers[i].values[0], double(i));
}

TEST(Worker, TimesNothingWhereACallBreaks) {
  Worker worker(limits());
  for (const Misdeed misdeed : {throws, aborts}) {
    EXPECT_FALSE(worker.time(offering(), std::vector<double>{none, 1, double(misdeed), 2}, 2));
    EXPECT_EQ(worker.ask(offering(), std::vector<double>{none, 3}, 2).front().values[0], 3);
  }
}

/// Works for a tenth of a second of processor time where the input says so.
Answer work_or_not(std::span<const double> inputs) { return inputs[0] > 0 ? work(inputs) : Answer{}; }

TEST(Worker, TimesAtLeastTheWorkOfACall) {
  Worker worker({.case_timeout = 30});
  const Offering o{"work", Offer::answers, "", {}, work_or_not};
  const auto times = worker.time(o, std::vector<double>{0, 1, 0}, 1);
  ASSERT_TRUE(times);
  // The clock of a call runs also while others have the processor. A tick is measured during two milliseconds, each end
  // to a microsecond: to a thousandth.
  EXPECT_GE(times->nanoseconds[1], 0.999e8);
  EXPECT_GE(times->how.processor_nanoseconds, 5e7 / 3);
}

/// Runs the host's side in a thread instead of a process, so that a sanitizer sees both: answers are taken while others
/// are being written, each one complete.
TEST(Wire, CarriesAnswersWholeWhileOthersAreWritten) {
  constexpr int rounds = 20;
  const auto asked = std::make_unique<wire::SharedRequest>();
  const auto answered = std::make_unique<wire::SharedAnswers>();
  int to_host[2], to_judge[2];
  ASSERT_EQ(pipe(to_host) | pipe(to_judge), 0);
  const AnswerFunction halves = [](std::span<const double> inputs) {
    if (std::fmod(inputs[0], 7) == 3) return Answer::without(Answer::Status::cannot_answer, "the third of seven");
    Answer a;
    a.count = std::uint8_t(1 + int(inputs[0]) % 3);
    for (std::size_t i = 0; i < a.count; ++i) a.values[i] = inputs[0] / 2;
    return a;
  };
  std::thread host([&] { serve(to_host[0], to_judge[1], *asked, *answered, {}); });
  std::vector<Answer> answers(wire::capacity);
  for (int round = 0; round < rounds; ++round) {
    asked->answer = halves;
    asked->first = 0, asked->numbers_at = 0, asked->count = wire::capacity, asked->batch = std::uint32_t(round);
    for (std::size_t i = 0; i < wire::capacity; ++i) asked->values[i] = double(round) * 10'000 + double(i);
    std::iota(asked->begins.begin(), asked->begins.end(), 0u);
    answered->done.store(0, std::memory_order_relaxed);
    ASSERT_EQ(write(to_host[1], "g", 1), 1);
    std::size_t got = 0, numbers = 0;
    while (got < wire::capacity) {
      const std::size_t done = answered->done.load(std::memory_order_acquire);
      ASSERT_TRUE(wire::take(*answered, asked->batch, got, done, numbers, 0, answers.data()));
    }
    char byte = 0;
    ASSERT_EQ(read(to_judge[0], &byte, 1), 1);
    for (std::size_t i = 0; i < wire::capacity; ++i) {
      const double x = asked->values[i];
      if (std::fmod(x, 7) == 3) {
        ASSERT_EQ(answers[i].reason(), "the third of seven");
      } else {
        ASSERT_EQ(answers[i].count, 1 + int(x) % 3);
        ASSERT_EQ(answers[i].values[answers[i].count - 1u], x / 2);
        ASSERT_EQ(answers[i].reason(), "");
      }
    }
  }
  close(to_host[1]);
  host.join();
  for (const int file : {to_host[0], to_judge[0], to_judge[1]}) close(file);
}

}  // namespace
}  // namespace nearmiss
