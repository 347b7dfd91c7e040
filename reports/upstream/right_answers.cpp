#include "reports/upstream/right_answers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "impl/subject/subject.hpp"
#include "oracles/declared_oracle.hpp"

namespace nearmiss {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double middle(const Bounds& b) { return b.low / 2 + b.high / 2; }

double to_scalar(double x, Scalar scalar) { return scalar == Scalar::float32 ? double(float(x)) : x; }

/// Finds the distances from a right answer at which the judge still takes a member for right.
class Tolerances {
 public:
  Tolerances(const Case& question, double allowed, Conventions declared)
      : question_(question),
        declared_(declared),
        moves_(widening(*question.query, question.values, question.scalar, allowed)) {}

  Enclosure about(const Answer& answer) const { return DeclaredOracle(question_, answer, declared_).interval(moves_); }
  /// The largest distance, in the maximum norm, along each axis and towards the given values.
  double of(const Answer& right, std::size_t member, const Answer& given) const {
    const Layout::Part part = question_.query->layout.parts[member];
    double most = 0;
    for (std::size_t i = part.begin; i < part.end; ++i) {
      for (const double side : {-1.0, 1.0}) {
        std::vector<double> by(part.end - part.begin);
        by[i - part.begin] = side;
        most = std::max(most, along(right, member, by));
      }
    }
    const double distance = distance_to(right, part, given);
    if (!(distance > 0) || !std::isfinite(distance)) return most;
    std::vector<double> towards;
    for (std::size_t i = part.begin; i < part.end; ++i) {
      towards.push_back((given.values[i] - right.values[i]) / distance);
    }
    const double reach = along(right, member, towards);
    return std::max(most, reach);
  }
  static double distance_to(const Answer& right, const Layout::Part& part, const Answer& given) {
    double distance = 0;
    for (std::size_t i = part.begin; i < part.end; ++i) {
      const double d = std::abs(given.values[i] - right.values[i]);
      if (!(d <= distance)) distance = d;  // a NaN stays
    }
    return distance;
  }

 private:
  /// By doubling and bisection: the distance along a direction up to which the judge takes the member for right.
  double along(const Answer& right, std::size_t member, const std::vector<double>& direction) const {
    double accepted = 0, refused = least_step(right, member);
    while (matches(right, member, direction, refused)) {
      accepted = refused, refused *= 2;
      if (refused > largest_finite(question_.scalar) / 4) return infinity;
    }
    constexpr int bisections = 8;  // a 256th of the tolerance is enough
    for (int i = 0; i < bisections; ++i) {
      const double half = accepted + (refused - accepted) / 2;
      (matches(right, member, direction, half) ? accepted : refused) = half;
    }
    return accepted;
  }
  double least_step(const Answer& right, std::size_t member) const {
    const Layout::Part part = question_.query->layout.parts[member];
    double largest = 0;
    for (std::size_t i = part.begin; i < part.end; ++i) largest = std::max(largest, std::abs(right.values[i]));
    return std::max(ulp(largest, question_.scalar), 0x1p-1000);
  }
  bool matches(const Answer& right, std::size_t member, const std::vector<double>& direction, double distance) const {
    const Layout::Part part = question_.query->layout.parts[member];
    Answer moved = right;
    for (std::size_t i = part.begin; i < part.end; ++i) {
      moved.values[i] = to_scalar(right.values[i] + distance * direction[i - part.begin], question_.scalar);
    }
    if (part.role == Role::normal) {
      // A right normal keeps its length; one that turned around is another answer.
      const double length =
          std::hypot(moved.values[part.begin], moved.values[part.begin + 1], moved.values[part.begin + 2]);
      if (!(length > 0) || distance > 1) return false;
      for (std::size_t i = part.begin; i < part.end; ++i)
        moved.values[i] = to_scalar(moved.values[i] / length, question_.scalar);
    }
    return about(moved).members[member].may_match;
  }

  const Case& question_;
  Conventions declared_;
  std::vector<double> moves_;
};

bool is_exact(Role role) { return role == Role::flag || role == Role::index; }

class Builder {
 public:
  Builder(const Case& question, const Answer& given, const Finding& finding, const Truth& truth, double allowed,
          Conventions declared)
      : question_(question),
        given_(given),
        finding_(finding),
        truth_(truth),
        allowed_(allowed),
        tolerances_(question, allowed, declared),
        found_(question.query->layout.parts.size(), -1) {}

  RightAnswer right_answer(const Alternative& a, const std::vector<std::size_t>& members) {
    RightAnswer right;
    right.yes = a.yes;
    Answer values;
    values.yes = a.yes;
    for (std::size_t i = 0; i < a.count; ++i) values.values[i] = a.nearest[i];
    for (const std::size_t m : members) {
      if (question_.query->layout.parts[m].end > a.count) continue;
      MemberCondition c = condition(a, values, m);
      if (std::isfinite(c.tolerance)) right.members.push_back(std::move(c));
    }
    return right;
  }

 private:
  MemberCondition condition(const Alternative& a, const Answer& right, std::size_t member) {
    const Layout::Part part = question_.query->layout.parts[member];
    MemberCondition c;
    c.member = member;
    for (std::size_t i = part.begin; i < part.end; ++i) c.values.push_back(right.values[i] + 0.0);
    if (is_exact(part.role)) return c;
    if (a.many_normals && part.role == Role::normal) {
      for (const Alternative::Face& f : a.facing) c.faces.push_back(face(f));
      c.any_unit_vector = true;
      c.tolerance = slack();
      return c;
    }
    if (found_[member] < 0) found_[member] = tolerance(member);
    c.tolerance = found_[member];
    return c;
  }
  static MemberCondition::Face face(const Alternative::Face& f) {
    return {{middle(f.direction[0]), middle(f.direction[1]), middle(f.direction[2])}, f.range.low, f.range.high};
  }
  /// For directions: the allowed error, with room for a few roundings.
  double slack() const { return (4 * allowed_ + 16) * unit_roundoff(question_.scalar); }

  /// The same for all right answers: that at the one nearest to the given answer.
  double tolerance(std::size_t member) const {
    const Layout::Part part = question_.query->layout.parts[member];
    Answer nearest;
    double least = infinity;
    bool any = false;
    for (const Alternative& a : truth_.alternatives) {
      if (a.yes != truth_.yes || a.count < part.end || (a.many_normals && part.role == Role::normal)) continue;
      Answer right;
      right.yes = a.yes;
      for (std::size_t i = 0; i < a.count; ++i) right.values[i] = a.nearest[i];
      const double d = Tolerances::distance_to(right, part, given_);
      if (!any || d < least) nearest = right, least = d, any = true;
    }
    const double t = for_readers(tolerances_.of(nearest, member, given_));
    const bool compared =
        given_.status == Answer::Status::answered && given_.yes == truth_.yes && given_.gives(part.begin);
    if (!compared) return t;
    if (is_wrong(member)) return std::min(t, for_readers(least * 0.7));
    // What the judge takes for right lies on a line to another right answer.
    return finding_.is_proved() ? t : std::max(t, for_readers(least));
  }
  /// Rounded up to three digits.
  static double for_readers(double tolerance) {
    if (!(tolerance > 0) || !std::isfinite(tolerance)) return tolerance;
    const double unit = std::pow(10.0, std::floor(std::log10(tolerance)) - 2);
    const double rounded = std::stod(fmt::format("{:.2e}", tolerance));
    return rounded >= tolerance ? rounded : std::stod(fmt::format("{:.2e}", tolerance + unit));
  }
  bool is_wrong(std::size_t member) const {
    return std::any_of(finding_.members.begin(), finding_.members.end(), [&](const MemberFinding& m) {
      return m.member == int(member) && m.breaks() && m.disagreement != Disagreement::not_unit;
    });
  }

  const Case& question_;
  const Answer& given_;
  const Finding& finding_;
  const Truth& truth_;
  double allowed_;
  Tolerances tolerances_;
  std::vector<double> found_;  ///< the tolerance of each member; negative: not yet known
};

double length_of(const Layout::Part& part, const Answer& answer) {
  return std::hypot(answer.values[part.begin], answer.values[part.begin + 1], answer.values[part.begin + 2]);
}

bool holds(const MemberCondition& c, const Layout::Part& part, const Answer& answer) {
  for (const MemberCondition::Face& f : c.faces) {
    double along = 0;
    for (std::size_t i = 0; i < 3; ++i) along += f.direction[i] * answer.values[part.begin + i];
    if (!(along >= f.low - c.tolerance && along <= f.high + c.tolerance)) return false;
  }
  if (c.any_unit_vector) return std::abs(length_of(part, answer) - 1) <= c.tolerance;
  for (std::size_t i = part.begin; i < part.end; ++i) {
    if (!(std::abs(answer.values[i] - c.values[i - part.begin]) <= c.tolerance)) return false;
  }
  return true;
}

bool is_unit(const RightAnswers& right, const Query& query, const Answer& answer) {
  for (const Layout::Part& part : query.layout.parts) {
    if (part.role != Role::normal || !answer.yes || !answer.gives(part.begin) || right.unit_error == 0) continue;
    if (!(std::abs(length_of(part, answer) - 1) <= right.unit_error)) return false;
  }
  return true;
}

/// Halves the tolerances until the answer is no longer accepted; as before where that does not help.
void narrow(RightAnswers& right, const Query& query, const Answer& given) {
  RightAnswers narrower = right;
  constexpr int most_halvings = 40;
  for (int i = 0; i < most_halvings; ++i) {
    if (!accepts(narrower, query, given)) {
      right = narrower;
      return;
    }
    narrower.narrowed = true;
    for (RightAnswer& r : narrower.any) {
      for (MemberCondition& c : r.members) c.tolerance /= 2;
    }
  }
}

}  // namespace

double allowed_backward_error(const Standard& standard, Scalar scalar) {
  const double promised = standard.contract.backward;
  return promised < collide::Contract::none ? promised : measure().error / unit_roundoff(scalar);
}

RightAnswers right_answers(const Case& question, const Answer& given, const Finding& finding, const Standard& standard,
                           const Truth& truth, const std::vector<std::size_t>& members) {
  RightAnswers right;
  right.allowed = allowed_backward_error(standard, question.scalar);
  const SceneLimits* scene = standard.promised ? nullptr : scene_limits();
  if (const double length = largest_length(question); scene != nullptr && length > 0)
    right.allowed = std::min(right.allowed, scene->error / length / unit_roundoff(question.scalar));
  if (standard.contract.unit < collide::Contract::none) {
    right.unit_error = standard.contract.unit * unit_roundoff(question.scalar);
  }
  Builder builder(question, given, finding, truth, right.allowed, standard.declared);
  for (const Alternative& a : truth.alternatives) right.any.push_back(builder.right_answer(a, members));
  const bool exact = standard.contract.exact_decisions || !decides(question.query->kind);
  const Enclosure all = Tolerances(question, right.allowed, standard.declared).about(Answer{});
  const bool flips = truth.yes ? all.may_be_no : all.may_be_yes;
  if (flips && !exact && !(finding.is_proved() && given.yes != truth.yes)) right.any.push_back({!truth.yes, {}});
  if (finding.is_proved()) narrow(right, *question.query, given);
  return right;
}

bool accepts(const RightAnswers& right, const Query& query, const Answer& answer) {
  if (answer.status != Answer::Status::answered || !is_unit(right, query, answer)) return false;
  return std::any_of(right.any.begin(), right.any.end(), [&](const RightAnswer& r) {
    if (decides(query.kind) && r.yes != answer.yes) return false;
    return std::all_of(r.members.begin(), r.members.end(),
                       [&](const MemberCondition& c) { return holds(c, query.layout.parts[c.member], answer); });
  });
}

}  // namespace nearmiss
