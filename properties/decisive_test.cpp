/// The tier Decisive: its decisions are exact, and it takes most answers from Fast.
#include <gtest/gtest.h>
#include <collide/decisive.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "corpus/generator/case_builder.hpp"
#include "corpus/generator/generator.hpp"
#include "corpus/storage/codec.hpp"
#include "impl/adapters/decisive_kernels.hpp"
#include "nearmiss/collide_functions.hpp"
#include "properties/judge/raw_numbers.hpp"
#include "properties/support.hpp"
#include "properties/unlikely_cases.hpp"

namespace nearmiss {
namespace {

const Subject& tier(std::string_view name, Scalar scalar) {
  return *find_subject("collide-" + std::string(name) + (scalar == Scalar::float32 ? "-float" : "-double"));
}

std::uint64_t bits_of(double x) { return std::bit_cast<std::uint64_t>(x); }

class DecisiveTier : public testing::TestWithParam<NamedQuery> {};

/// Also outside of the domain of the contract, which is that of Fast.
TEST_P(DecisiveTier, DecidesNumbersOfAnyMagnitude) {
  const Query& query = *GetParam().query;
  if (!decides(query.kind)) return;
  for (const Scalar scalar : scalars) {
    const Subject& subject = tier("decisive", scalar);
    for (std::uint64_t i = 0; i < 400; ++i) {
      for (const Case& c :
           {generate(query, scalar, stream(31), i), raw_case(query, scalar, i), raw_case_with_zeros(query, scalar, i),
            flattened_case(query, scalar, i), far_scaled_case(query, scalar, stream(31), i)}) {
        ASSERT_EQ(ask_here(subject, c).yes, truth_is_yes(c)) << case_to_json(c).dump(2);
      }
    }
  }
}

/// Fuzz targets leave Decisive out where it has no kernel.
TEST_P(DecisiveTier, IsAnotherTierWhereItHasNoKernel) {
  const Query& query = *GetParam().query;
  if (adapters::has_decisive_kernel(query.name)) return;
  for (const Scalar scalar : scalars) {
    const Subject& other = tier(decides(query.kind) ? "certified" : "fast", scalar);
    for (std::uint64_t i = 0; i < 200; ++i) {
      const Case c = generate(query, scalar, stream(32), i);
      const Answer decisive = ask_here(tier("decisive", scalar), c), same = ask_here(other, c);
      EXPECT_EQ(decisive.yes, same.yes) << case_to_json(c).dump(2);
      EXPECT_TRUE(std::ranges::equal(decisive.values, same.values, {}, bits_of, bits_of)) << case_to_json(c).dump(2);
    }
  }
}

/// Numbers whose squares, or whose differences, overflow while the computed depth or time is an ordinary number.
template <class T>
void decide_beside_an_overflow() {
  using collide::Certified, collide::Decisive;
  constexpr int top = std::numeric_limits<T>::max_exponent, low = sizeof(T) == sizeof(float) ? -60 : -600;
  const T long_quaternion = std::ldexp(T(1), top / 2), large = std::ldexp(T(0.75), top);
  const collide::Box<T> turned{{0, 0, 0}, {2, T(0.125), T(0.125)}, {0, 0, long_quaternion, long_quaternion}};
  const collide::Plane<T> below{{0, 1, 0}, 1};
  EXPECT_TRUE(collide::box_plane_penetration<Certified>(turned, below).yes());
  EXPECT_TRUE(collide::box_plane_penetration<Decisive>(turned, below).yes());
  const collide::Box<T> plate{{0, 0, 0}, {0, 1, 1}, {0, long_quaternion, 0, long_quaternion}};
  const collide::Sphere<T> ball{{T(0.5), 0, std::ldexp(T(1), low)}, T(0.25)};
  EXPECT_TRUE(collide::sphere_box_penetration<Certified>(ball, plate).yes());
  EXPECT_TRUE(collide::sphere_box_penetration<Decisive>(ball, plate).yes());
  for (const int speed : {1, top / 4, top / 2, top - top / 4, top - 24}) {
    const collide::Ray<T> ray{{-large, 0, 0}, {std::ldexp(T(1), speed), 1, 0}};
    const T far_up = std::ldexp(T(1), top - 80);
    for (const collide::AABox<T>& box :
         {collide::AABox<T>{{large, 0, 0}, {large, far_up, 1}}, {{-large, far_up, 0}, {large, 2 * far_up, 0}}}) {
      const auto hits = [&](auto tier) {
        using Tier = decltype(tier);
        return collide::ray_aabox<Tier>(collide::prepare_ray<Tier>(ray), collide::prepare_aabox<Tier>(box)).yes();
      };
      EXPECT_EQ(hits(Decisive{}), hits(Certified{})) << speed << " " << box.min.x;
    }
  }
}

TEST(DecisiveAlone, DecidesBesideAnOverflow) {
  decide_beside_an_overflow<float>();
  decide_beside_an_overflow<double>();
}

INSTANTIATE_FOR_EVERY_QUERY(Every, DecisiveTier, testing::ValuesIn(every_query()), testing::PrintToStringParamName());

/// In place of the tier that decides where no bound is enough: `asked` tells whether it was asked.
struct Undecided : collide::Plain {
  template <class T>
  static constexpr bool lifts = collide::MachineNumber<T>;
  template <class T>
  static constexpr bool computes_in = false;
  static inline bool asked = false;

  template <class Kernel, class... Arguments>
  static auto lift(Kernel&&, const Arguments&... arguments) {
    asked = true;
    return decltype(std::declval<Kernel>()(collide::Plain{}, arguments...)){};
  }
};

/// The bounds of Decisive and nothing else.
struct BoundsAlone : collide::Plain {
  using Decisions = Undecided;
  using Numbers = collide::Fast;
};

template <template <class> class Inputs, class T>
Answer answer_by_bounds(std::span<const double> inputs) {
  Undecided::asked = false;
  return erase(adapters::ask_collide<BoundsAlone>(inputs_from<Inputs<T>>(inputs.data())));
}

struct BoundOf {
  const char* query;
  Answer (*in_float)(std::span<const double>);
  Answer (*in_double)(std::span<const double>);

  /// The answer of Fast, if a bound proves its decision.
  std::optional<Answer> decided(const Case& c) const {
    const Answer answer = (c.scalar == Scalar::float32 ? in_float : in_double)(c.values);
    return Undecided::asked ? std::nullopt : std::optional(answer);
  }
};
#define NEARMISS_BOUNDS(name) \
  BoundOf { #name, answer_by_bounds<inputs::name, float>, answer_by_bounds<inputs::name, double> }
constexpr BoundOf bounds[] = {
    NEARMISS_BOUNDS(moving_point_plane),
    NEARMISS_BOUNDS(moving_point_triangle),
    NEARMISS_BOUNDS(moving_point_triangle_prepared),
    NEARMISS_BOUNDS(moving_point_aabox),
    NEARMISS_BOUNDS(ray_aabox),
    NEARMISS_BOUNDS(moving_sphere_plane),
    NEARMISS_BOUNDS(sphere_sphere_penetration),
    NEARMISS_BOUNDS(sphere_plane_penetration),
    NEARMISS_BOUNDS(box_plane_penetration),
    NEARMISS_BOUNDS(sphere_box_penetration),
    NEARMISS_BOUNDS(box_box_penetration),
};
#undef NEARMISS_BOUNDS
std::ostream& operator<<(std::ostream& out, const BoundOf& b) { return out << b.query; }

class BoundsOfDecisive : public testing::TestWithParam<BoundOf> {
 protected:
  /// Whether a bound decided the case. What it decided must be right.
  bool decides_rightly(const Case& c) {
    const std::optional<Answer> answer = GetParam().decided(c);
    if (answer) {
      EXPECT_EQ(answer->yes, truth_is_yes(c)) << case_to_json(c).dump(2);
    }
    return answer.has_value();
  }
};

TEST_P(BoundsOfDecisive, AreEnoughForMostPlainScenes) {
  const Query& query = *find_query(GetParam().query);
  for (const Scalar scalar : scalars) {
    int plain = 0, decided = 0;
    for (std::uint64_t i = 0; i < 1000; ++i) {
      const Case c = generate(query, scalar, stream(33), i);
      if (!c.moves.empty()) continue;
      ++plain;
      decided += decides_rightly(c);
    }
    EXPECT_GE(10 * decided, 9 * plain) << decided << " of " << plain;
  }
}

TEST_P(BoundsOfDecisive, AreRightAsTheDecisionChanges) {
  const Query& query = *find_query(GetParam().query);
  for (const Scalar scalar : scalars) {
    check_as_the_decision_changes(query, scalar, stream(34), 500, [&](const Case& middle) {
      decides_rightly(middle);
      return !HasFailure();
    });
  }
}

/// A point that starts on a triangle up to rounding, and moves through it from its front.
Case start_on_triangle(const Query& query, Scalar scalar, std::uint64_t index) {
  Random random(index);
  const auto vector = [&] { return std::array{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}; };
  const auto v0 = vector(), a = vector(), b = vector();
  const double share = random.uniform(0.1, 0.4), other_share = random.uniform(0.1, 0.4);
  std::array<double, 3> point, velocity;
  for (std::size_t k = 0; k < 3; ++k) {
    point[k] = v0[k] + share * a[k] + other_share * b[k];
    velocity[k] = a[(k + 2) % 3] * b[(k + 1) % 3] - a[(k + 1) % 3] * b[(k + 2) % 3];
  }
  Case c{&query, scalar, {}, "a start on a triangle", index, 0, {}};
  const auto put = [&](const auto& number) {
    for (std::size_t k = 0; k < 3; ++k) c.values.push_back(rounded_to(scalar, number(k)));
  };
  put([&](std::size_t k) { return point[k]; });
  put([&](std::size_t k) { return velocity[k]; });
  put([&](std::size_t k) { return v0[k]; });
  put([&](std::size_t k) { return v0[k] + a[k]; });
  put([&](std::size_t k) { return v0[k] + b[k]; });
  return c;
}

TEST_P(BoundsOfDecisive, AreRightWhereAPointStartsOnATriangle) {
  const Query& query = *find_query(GetParam().query);
  if (query.name != std::string_view("moving_point_triangle")) return;
  for (const Scalar scalar : scalars) {
    int hits = 0;
    for (std::uint64_t i = 0; i < 2000 && !HasFailure(); ++i) {
      const Case c = start_on_triangle(query, scalar, i);
      decides_rightly(c);
      hits += truth_is_yes(c);
    }
    EXPECT_GE(hits, 500);
    EXPECT_LE(hits, 1500);
  }
}

TEST(DecisiveAlone, HasABoundInEachKernel) {
  std::set<std::string_view> with_bounds;
  for (const BoundOf& b : bounds) with_bounds.insert(b.query);
  EXPECT_TRUE(std::ranges::equal(with_bounds, adapters::decisive_kernels));
}

INSTANTIATE_TEST_SUITE_P(Queries, BoundsOfDecisive, testing::ValuesIn(bounds), testing::PrintToStringParamName());

}  // namespace
}  // namespace nearmiss
