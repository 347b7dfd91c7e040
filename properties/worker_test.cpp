/// A subject may do anything in a worker: it costs one case, and the reason is told.
#include <gtest/gtest.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "impl/subject/worker.hpp"

namespace nearmiss {
namespace {

enum Misdeed { none, aborts, crashes, throws, throws_an_int, hangs, eats_memory, exits };

/// Does what the first input says; otherwise answers with the second.
Answer misbehave(std::span<const double> inputs) {
  switch (Misdeed(int(inputs[0]))) {
    case aborts: std::fputs("subject: assertion depth > 0 failed\n", stderr); std::abort();
    case crashes: std::raise(SIGSEGV); break;
    case throws: throw std::runtime_error("no contact found");
    case throws_an_int: throw 42;
    case hangs: for (volatile bool forever = true; forever;) {} break;
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

}  // namespace
}  // namespace nearmiss
