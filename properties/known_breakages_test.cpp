/// Known bugs of FCL that crash or do not return, run in a worker: each costs one case, and the next case is answered.
#include <fcl/narrowphase/distance.h>
#include <gtest/gtest.h>

#include <vector>

#include "impl/host/worker.hpp"

namespace nearmiss {
namespace {

enum Question { ball_and_half_space, ball_and_plane, box_and_half_space, capsule_and_half_space, two_balls };

template <class A, class B>
Answer distance(const A& a, const fcl::Vector3d& at, const B& b, bool signed_distance) {
  fcl::Transform3d moved = fcl::Transform3d::Identity();
  moved.translation() = at;
  fcl::DistanceRequestd request(false, signed_distance);
  request.gjk_solver_type = fcl::GST_LIBCCD;
  fcl::DistanceResultd result;
  fcl::distance(&a, moved, &b, fcl::Transform3d::Identity(), request, result);
  Answer answer;
  answer.values[0] = result.min_distance;
  return answer;
}

/// The case, and the place of the first shape along x.
Answer ask_fcl(std::span<const double> inputs) {
  const fcl::Vector3d at(inputs[1], 0, 0);
  const fcl::Sphered ball(1);
  const fcl::Halfspaced half_space(fcl::Vector3d::UnitX(), 0);
  switch (Question(int(inputs[0]))) {
    case ball_and_half_space: return distance(ball, at, half_space, false);
    case ball_and_plane: return distance(ball, at, fcl::Planed(fcl::Vector3d::UnitX(), 0), false);
    case box_and_half_space: return distance(fcl::Boxd(4, 4, 4), at, half_space, false);
    case capsule_and_half_space: return distance(fcl::Capsuled(1, 2), at, half_space, false);
    case two_balls: return distance(ball, at, ball, true);
  }
  return Answer::without(Answer::Status::cannot_answer, "no such question");
}

struct Known {
  const char* name;
  Question question;
  double at;
  const char* reason;
};
void PrintTo(const Known& k, std::ostream* out) { *out << k.name; }

class KnownBreakage : public testing::TestWithParam<Known> {};

TEST_P(KnownBreakage, CostsOneCase) {
  const Known& known = GetParam();
  Worker worker({.case_timeout = 0.5});
  const Offering offering{"distance", Offer::answers, "", {}, ask_fcl};
  const std::vector<double> inputs{double(known.question), known.at, two_balls, 3};
  const std::vector<Answer> answers = worker.ask(offering, inputs, 2);
  ASSERT_EQ(answers.size(), 2u);
  EXPECT_EQ(answers[0].status, Answer::Status::broke);
  EXPECT_NE(answers[0].reason().find(known.reason), std::string_view::npos) << answers[0].reason();
  ASSERT_EQ(answers[1].status, Answer::Status::answered) << answers[1].reason();
  EXPECT_NEAR(answers[1].values[0], 1, 1e-6);
}

constexpr const char* hangs = "no answer within 0.5";
// https://github.com/flexible-collision-library/fcl/issues/623
INSTANTIATE_TEST_SUITE_P(Fcl623, KnownBreakage,
                         testing::Values(Known{"ball_and_half_space", ball_and_half_space, 3, "signal 11"},
                                         Known{"ball_and_plane", ball_and_plane, 3, "signal 11"},
                                         Known{"box_and_half_space", box_and_half_space, 0, "signal 11"},
                                         Known{"capsule_and_half_space", capsule_and_half_space, 3, "signal 11"}),
                         testing::PrintToStringParamName());
// https://github.com/danfis/libccd/issues/7
INSTANTIATE_TEST_SUITE_P(FclCoincidentSpheresHang, KnownBreakage,
                         testing::Values(Known{"one_place", two_balls, 0, hangs},
                                         Known{"a_hair_apart", two_balls, 1e-9, hangs},
                                         Known{"a_thousandth_apart", two_balls, 1e-3, hangs}),
                         testing::PrintToStringParamName());

}  // namespace
}  // namespace nearmiss
