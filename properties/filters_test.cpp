/// The filters of Certified alone: what a filter decides is right, with every number within one unit in the last place,
/// and filters decide most plain scenes. In the tier itself a filter that never decided would only be slow.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "corpus/generator/case_builder.hpp"
#include "corpus/generator/generator.hpp"
#include "corpus/storage/codec.hpp"
#include "nearmiss/collide_functions.hpp"
#include "oracles/confirmed.hpp"
#include "oracles/requirements.hpp"
#include "properties/judge/raw_numbers.hpp"
#include "properties/support.hpp"
#include "properties/unlikely_cases.hpp"

namespace nearmiss {
namespace {

/// A tier that has the filters of Certified and nothing else: `decided` tells whether the filter gave the last answer.
struct FiltersAlone : collide::Plain {
  template <class T>
  static constexpr bool lifts = collide::MachineNumber<T>;
  template <class T>
  static constexpr bool computes_in = false;
  static inline bool decided = false;

  template <class A>
  static A decided_by_filter(const A& answer) {
    decided = true;
    return answer;
  }
  template <class Kernel, class... Arguments>
  static auto lift(Kernel&&, const Arguments&... arguments) {
    return decltype(std::declval<Kernel>()(collide::Plain{}, arguments...)){};
  }
};

using FilterOf = Answer (*)(std::span<const double> inputs);
template <template <class> class Inputs, class T>
Answer answer_of_filter(std::span<const double> inputs) {
  FiltersAlone::decided = false;
  return erase(adapters::ask_collide<FiltersAlone>(inputs_from<Inputs<T>>(inputs.data())));
}

struct Filters {
  const char* query;
  FilterOf in_float, in_double;
};
#define NEARMISS_QUERY(name) \
  Filters{#name, answer_of_filter<inputs::name, float>, answer_of_filter<inputs::name, double>},
constexpr Filters filters[] = {
#include "impl/catalogue/catalogue.def"
};
#undef NEARMISS_QUERY
std::ostream& operator<<(std::ostream& out, const Filters& f) { return out << f.query; }

class FilterOfCertified : public testing::TestWithParam<Filters> {
 protected:
  /// Whether the filter decided the case. What it decided must be right. In double, only exact numbers tell whether a
  /// number is within one unit: Detail::full computes them.
  bool decides_rightly(const Case& c, Detail detail = Detail::verdict) {
    const Answer answer = (c.scalar == Scalar::float32 ? GetParam().in_float : GetParam().in_double)(c.values);
    if (!FiltersAlone::decided) return false;
    const Finding f = confirmed(c, answer, promise, detail);
    EXPECT_FALSE(is_violation(f)) << name_of(f.disagreement) << ", " << f.clause << "\n" << case_to_json(c).dump(2);
    return true;
  }

 private:
  /// Half a unit before the last rounding, and half a unit by it.
  static constexpr collide::Contract promise{.forward = 1, .exact_decisions = true, .unit = 4};
};

TEST_P(FilterOfCertified, IsRightWhereItDecides) {
  const Query& query = *find_query(GetParam().query);
  for (const Scalar scalar : scalars) {
    for (std::uint64_t i = 0; i < 2000 && !HasFailure(); ++i) {
      const Detail detail = i % 4 == 0 ? Detail::full : Detail::verdict;
      decides_rightly(generate(query, scalar, stream(21), i), detail);
      decides_rightly(raw_case(query, scalar, i), detail);
      decides_rightly(raw_case_with_zeros(query, scalar, i), detail);
      decides_rightly(flattened_case(query, scalar, i), detail);
      decides_rightly(far_scaled_case(query, scalar, stream(21), i), detail);
    }
  }
}

/// The queries whose filters give the numbers of a yes too, and so decide nearly all plain scenes.
constexpr std::string_view with_numbers[] = {
    "ray_aabox",
    "moving_point_aabox",
    "moving_point_plane",
    "moving_point_triangle",
    "moving_point_triangle_prepared",
    "closest_point_segment",
    "closest_point_segment_unit",
    "closest_point_triangle_perimeter",
    "closest_point_triangle_perimeter_edges",
    "bounce_direction",
    "slide_direction",
    "moving_point_rectangle",
    "moving_sphere_plane",
    "moving_sphere_triangle",
    "sphere_sphere_penetration",
    "sphere_plane_penetration",
    "sphere_box_penetration",
    "box_plane_penetration",
    "box_box_penetration",
    "box_box_info",
    "box_box_projected_distance",
    "box_box_separating_axis",
    "box_box_conservative",
    "closest_point_rectangle",
    "closest_point_rectangle_perimeter",
    "point_in_triangle",
    "point_in_rectangle",
    "segment_triangle_overlap",
    "capsule_triangle_overlap",
    "triangle_triangle_overlap",
    "triangle_box_overlap",
    "segment_box_overlap",
    "capsule_box_overlap",
};

/// The same for those that start outside: a start in contact is left to the kernel.
constexpr std::string_view with_numbers_from_outside[] = {
    "moving_point_sphere",
    "moving_sphere_sphere",
};

template <std::size_t n>
bool is_among(const std::string_view (&queries)[n], std::string_view name) {
  return std::find(std::begin(queries), std::end(queries), name) != std::end(queries);
}

TEST_P(FilterOfCertified, DecidesMostPlainScenes) {
  const Query& query = *find_query(GetParam().query);
  const bool from_outside = is_among(with_numbers_from_outside, query.name);
  if (!from_outside && !is_among(with_numbers, query.name)) return;
  for (const Scalar scalar : scalars) {
    int plain = 0, decided = 0;
    for (std::uint64_t i = 0; i < 1000; ++i) {
      const Case c = generate(query, scalar, stream(22), i);
      if (!c.moves.empty() || (from_outside && !meets(c, Precondition::starts_outside))) continue;
      ++plain;
      decided += decides_rightly(c);
    }
    EXPECT_GE(4 * decided, 3 * plain) << decided << " of " << plain;
  }
}

/// Queries whose filters lose digits as the decision comes close to its change.
constexpr std::string_view with_cancellation[] = {
    "point_in_rectangle",        "box_box_conservative",      "moving_point_sphere",      "moving_sphere_sphere",
    "moving_sphere_triangle",    "sphere_box_penetration",    "box_box_penetration",      "box_plane_penetration",
    "sphere_plane_penetration",  "sphere_sphere_penetration", "segment_triangle_overlap", "capsule_triangle_overlap",
    "triangle_triangle_overlap", "segment_box_overlap",       "capsule_box_overlap",
};

TEST_P(FilterOfCertified, IsRightAsTheDecisionChanges) {
  const Query& query = *find_query(GetParam().query);
  if (!is_among(with_cancellation, query.name)) return;
  for (const Scalar scalar : scalars) {
    check_as_the_decision_changes(query, scalar, stream(23), 40, [&](const Case& middle) {
      decides_rightly(middle, Detail::full);
      return !HasFailure();
    });
  }
}

/// Corners of a parallelogram that is thin by a random power of two, and a point above a place in it. The normal of so
/// thin a shape has few digits.
Case above_thin_rectangle(const Query& query, Scalar scalar, std::uint64_t index) {
  Random random(index);
  const auto vector = [&] { return std::array{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}; };
  const auto v0 = vector(), a = vector(), across = vector();
  const double thinness = random.power_of_two(-24, 0), height = random.power_of_two(-8, 8),
               skew = random.uniform(-1, 1);
  const double share = random.uniform(0, 1), other_share = random.uniform(0, 1);
  Case c{&query, scalar, {}, "a thin rectangle", index, 0, {}};
  std::array<double, 3> b, place;
  for (std::size_t k = 0; k < 3; ++k) b[k] = skew * a[k] + thinness * across[k];
  for (std::size_t k = 0; k < 3; ++k) place[k] = v0[k] + share * a[k] + other_share * b[k];
  std::array<double, 3> normal;
  for (std::size_t k = 0; k < 3; ++k)
    normal[k] = a[(k + 1) % 3] * across[(k + 2) % 3] - a[(k + 2) % 3] * across[(k + 1) % 3];
  for (const auto& [of_a, of_b] : {std::pair(0.0, 0.0), {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}) {
    for (std::size_t k = 0; k < 3; ++k) c.values.push_back(rounded_to(scalar, v0[k] + of_a * a[k] + of_b * b[k]));
  }
  for (std::size_t k = 0; k < 3; ++k) c.values.push_back(rounded_to(scalar, place[k] + height * normal[k]));
  return c;
}

TEST_P(FilterOfCertified, IsRightAboveThinRectangles) {
  const Query& query = *find_query(GetParam().query);
  if (query.name != std::string_view("closest_point_rectangle")) return;
  int decided = 0;
  for (const Scalar scalar : scalars) {
    for (std::uint64_t i = 0; i < 1000 && !HasFailure(); ++i)
      decided += decides_rightly(above_thin_rectangle(query, scalar, i), Detail::full);
  }
  EXPECT_GE(decided, 100);
}

INSTANTIATE_FOR_EVERY_QUERY(Queries, FilterOfCertified, testing::ValuesIn(filters), testing::PrintToStringParamName());

}  // namespace
}  // namespace nearmiss
