/// A subject may do anything in a worker: it costs one case, and the reason is told.
#include <gtest/gtest.h>
#include <poll.h>
#include <sched.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <numeric>
#include <stdexcept>
#include <utility>
#include <vector>

#include "impl/subject/worker.hpp"

namespace nearmiss {
namespace {

enum Misdeed { none, aborts, crashes, throws, throws_an_int, hangs, sleeps, eats_memory, exits };

/// Does what the first input says; otherwise answers with the second.
Answer misbehave(std::span<const double> inputs) {
  switch (Misdeed(int(inputs[0]))) {
    case aborts: std::fputs("subject: assertion depth > 0 failed\n", stderr); std::abort();
    case crashes: std::raise(SIGSEGV); break;
    case throws: throw std::runtime_error("no contact found");
    case throws_an_int: throw 42;
    case hangs: for (volatile bool forever = true; forever;) {} break;
    case sleeps: for (;;) pause();
    case eats_memory:
      for (std::vector<std::vector<char>> kept;;) kept.emplace_back(std::size_t{1} << 24, 'x');
    case exits: std::_Exit(3);
    case none: break;
  }
  Answer a;
  a.values[0] = inputs[1];
  return a;
}

Offering offering() { return {"misbehave", Offer::answers, "", {}, misbehave}; }

WorkerLimits limits() { return {.seconds_per_case = 0.5, .bytes = std::size_t{256} << 20}; }

class WorkerSurvives : public testing::TestWithParam<std::tuple<const char*, Misdeed, const char*>> {};

TEST_P(WorkerSurvives, AndOnlyTheCaseBreaks) {
  const auto [name, misdeed, reason] = GetParam();
#if defined(__SANITIZE_ADDRESS__)
  if (misdeed == eats_memory) GTEST_SKIP() << "AddressSanitizer leaves no address space to limit";
#endif
  Worker worker(limits());
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
                                         std::tuple{"hang", hangs, "no answer within 0.5"},
                                         std::tuple{"sleep", sleeps, "no answer within 0.5"},
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

/// Works for a tenth of a second of processor time.
Answer work(std::span<const double>) {
  const auto worked = [] {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
  };
  for (const double begin = worked(); worked() < begin + 0.1;) {}
  return {};
}

/// This process and those that it starts have one processor to share with `others` that never rest.
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
        alarm(60);  // whatever becomes of the test
        for (volatile bool forever = true; forever;) {}
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

/// A pipe whose end is seen when every process that has it has ended.
class Lifeline {
 public:
  Lifeline() {
    if (pipe(ends_) != 0) throw std::runtime_error("pipe");
  }
  ~Lifeline() {
    close(ends_[0]);
    if (ends_[1] >= 0) close(ends_[1]);
  }
  int writing_end() const { return ends_[1]; }
  void let_go() { close(std::exchange(ends_[1], -1)); }
  bool says_something_within(int seconds) {
    char said = 0;
    return ready_within(seconds) && read(ends_[0], &said, 1) == 1;
  }
  bool ends_within(int seconds) {
    char said = 0;
    while (ready_within(seconds)) {
      if (read(ends_[0], &said, 1) == 0) return true;
    }
    return false;
  }

 private:
  bool ready_within(int seconds) {
    pollfd p{ends_[0], POLLIN, 0};
    return poll(&p, 1, 1000 * seconds) == 1;
  }
  int ends_[2];
};

/// Starts a process that would live for a minute, says so on the lifeline, then does what the first input says.
Answer leave_something_behind(std::span<const double> inputs) {
  if (fork() == 0) {
    for (unsigned left = 60; left > 0;) left = sleep(left);
    _exit(0);
  }
  if (write(int(inputs[1]), "x", 1) != 1) throw std::runtime_error("the lifeline is broken");
  return misbehave(inputs);
}

Offering leaving() { return {"leaving", Offer::answers, "", {}, leave_something_behind}; }

TEST(Worker, EndsWhatASubjectThatHangsHadStarted) {
  Lifeline lifeline;
  Worker worker(limits());
  const auto answers = worker.ask(leaving(), std::vector<double>{hangs, double(lifeline.writing_end())}, 2);
  EXPECT_EQ(answers[0].reason(), "no answer within 0.500 s");
  lifeline.let_go();
  EXPECT_TRUE(lifeline.says_something_within(0));
  EXPECT_TRUE(lifeline.ends_within(5));
}

TEST(Worker, EndsWhatASubjectThatCrashesHadStartedAndTellsOfTheCrash) {
  Lifeline lifeline;
  Worker worker({.seconds_per_case = 60});
  const auto answers = worker.ask(leaving(), std::vector<double>{aborts, double(lifeline.writing_end())}, 2);
  EXPECT_NE(answers[0].reason().find("signal 6"), std::string_view::npos) << answers[0].reason();
  lifeline.let_go();
  EXPECT_TRUE(lifeline.ends_within(5));
}

TEST(Worker, EndsWithAllThatTheSubjectHadStarted) {
  Lifeline lifeline;
  {
    Worker worker(limits());
    const auto answers = worker.ask(leaving(), std::vector<double>{none, double(lifeline.writing_end())}, 2);
    EXPECT_EQ(answers[0].status, Answer::Status::answered);
    lifeline.let_go();
    EXPECT_TRUE(lifeline.says_something_within(5));
  }
  EXPECT_TRUE(lifeline.ends_within(5));
}

TEST(Worker, EndsWithAllThatTheSubjectHadStartedWhenItsParentIsKilled) {
  Lifeline lifeline;
  const pid_t parent = fork();
  if (parent == 0) {
    Worker worker({.seconds_per_case = 3600});
    worker.ask(leaving(), std::vector<double>{hangs, double(lifeline.writing_end())}, 2);
    _exit(0);
  }
  lifeline.let_go();
  EXPECT_TRUE(lifeline.says_something_within(10));
  kill(parent, SIGKILL);
  waitpid(parent, nullptr, 0);
  EXPECT_TRUE(lifeline.ends_within(5));
}

}  // namespace
}  // namespace nearmiss
