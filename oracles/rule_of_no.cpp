#include "oracles/rule_of_no.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include "oracles/declared_oracle.hpp"
#include "oracles/derived_case.hpp"
#include "oracles/exact_decision.hpp"
#include "oracles/requirements.hpp"

namespace nearmiss {

namespace {

using Triangle = std::array<std::size_t, 3>;

std::optional<std::size_t> input_named(const Case& c, std::string_view name) {
  const auto& members = c.operands().members;
  const auto found = std::ranges::find(members, name, &InputMember::name);
  return found == members.end() ? std::nullopt : std::optional(found->begin);
}

/// Looks at one case for each rule.
class Rules {
 public:
  explicit Rules(const Case& question)
      : c_(question), query_(*question.query), parts_(question.operands()), start_(parts_.start) {}

  std::string broken() const {
    if (query_.kind == Kind::decision) return limit_of_time();
    if (query_.kind != Kind::impact || parts_.velocities.empty()) return "";
    if (!start_) return of_touch();
    return query_.traits.one_sided ? of_front() : of_start();
  }

 private:
  const std::string& one() const { return parts_[0].words; }
  const std::string& other() const { return parts_[1].words; }

  std::string limit_of_time() const {
    const auto forever = input_named(c_, "forever");
    if (!forever || c_.values[*forever] != 0) return "";
    Case unlimited = c_;
    unlimited.values[*forever] = 1;
    return exact_decision(unlimited) ? "the contact comes after the limit of time" : "";
  }

  /// Of shapes that can be hit from their front only.
  std::string of_front() const {
    if (exact_decision(turned_around())) {
      return fmt::format("{} moves from the back of {} to its front, and only the front can be hit", one(), other());
    }
    if (start_->radius) return of_start();
    if (start_->obstacle.shape == Shape::plane) return ball_meets_plane() ? moves_along() : "";
    for (const Triangle& t : parts_.triangles) {
      if (ball_meets(t)) return has_area(t) ? moves_along() : fmt::format("{} has no area", other());
    }
    return "";
  }
  std::string moves_along() const { return fmt::format("{} does not move toward the front of {}", one(), other()); }

  /// The plane, the triangle or the rectangle with its front at the other side.
  Case turned_around() const {
    Case turned = c_;
    const auto exchange = [&](std::size_t a, std::size_t b) {
      std::swap_ranges(&turned.values[a], &turned.values[a] + 3, &turned.values[b]);
    };
    const Operand& obstacle = start_->obstacle;
    if (obstacle.shape == Shape::plane) {
      for (std::size_t i = obstacle.begin; i < obstacle.begin + obstacle.count; ++i)
        turned.values[i] = -turned.values[i];
    } else if (!parts_.rectangles.empty()) {
      exchange(parts_.rectangles.front()[1], parts_.rectangles.front()[3]);
    } else {
      exchange(parts_.triangles.front()[1], parts_.triangles.front()[2]);
    }
    return turned;
  }

  /// A moving sphere of radius 0, which also hits where it moves along the shape.
  DerivedCase as_ball(QueryId query) const {
    DerivedCase ball(c_, query);
    ball.set_vector("sphere.center", start_->place);
    ball.set_vector("velocity", parts_.velocities.front());
    return ball;
  }
  bool ball_meets_plane() const {
    DerivedCase ball = as_ball(QueryId::moving_sphere_plane);
    ball.set_vector("plane.normal", parts_.normals.front());
    ball.set("plane.offset", start_->obstacle.offset);
    return exact_decision(ball.question());
  }
  bool ball_meets(const Triangle& t) const {
    DerivedCase ball = as_ball(QueryId::moving_sphere_triangle);
    for (std::size_t k = 0; k < 3; ++k) ball.set_vector(fmt::format("triangle.v{}", k), t[k]);
    return exact_decision(ball.question());
  }
  /// A ball at a corner hits at the start if its motion is not toward the back. Without an area there is no back, and
  /// it hits with every motion: along each axis, in both directions.
  bool has_area(const Triangle& t) const {
    DerivedCase ball = as_ball(QueryId::moving_sphere_triangle);
    for (std::size_t k = 0; k < 3; ++k) ball.set_vector(fmt::format("triangle.v{}", k), t[k]);
    ball.set_vector("sphere.center", t[0]);
    const std::size_t velocity = ball.question().operands().velocities.front();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const double speed : {-1.0, 1.0}) {
        Case moving = ball.question();
        std::fill_n(&moving.values[velocity], 3, 0.0);
        moving.values[velocity + axis] = speed;
        if (!exact_decision(moving)) return true;
      }
    }
    return false;
  }

  std::string of_start() const {
    if (meets(c_, Precondition::starts_outside)) return "";
    if (start_->obstacle.shape == Shape::aabox) return fmt::format("{} starts in {}", one(), other());
    if (const std::string touch = of_touch(); !touch.empty()) return touch;
    if (start_->obstacle.shape == Shape::sphere && input_named(c_, "solid"))
      return fmt::format("{} does not move, and so never leaves {}", one(), other());
    return fmt::format("{} starts inside {}", one(), other());
  }
  std::string of_touch() const {
    return exact_decision(at_rest()) ? fmt::format("{} starts in touch with {} and moves away", one(), other()) : "";
  }
  Case at_rest() const {
    Case still = c_;
    for (const std::size_t v : parts_.velocities) std::fill_n(&still.values[v], 3, 0.0);
    return still;
  }

  const Case& c_;
  const Query& query_;
  const Operands& parts_;
  const std::optional<Operands::Start>& start_;
};

}  // namespace

std::string rule_of_no(const Case& question, Conventions declared) {
  if (declared.has(Convention::start_is_miss) && contact_at_start(question) == true &&
      concerns(Convention::start_is_miss, *question.query))
    return std::string(text_of(Convention::start_is_miss).what);
  const bool is_yes = !declared.empty() && exact_decision(question);
  if (!is_yes) return Rules(question).broken();
  for (const Convention c : {Convention::strict_touch, Convention::ends_at_time_one}) {
    if (!declared.has(c) || !concerns(c, *question.query)) continue;
    const Answer none{};
    if (!DeclaredOracle(question, none, {c}).exact().may_be_yes) return std::string(text_of(c).what);
  }
  return "";
}

}  // namespace nearmiss
