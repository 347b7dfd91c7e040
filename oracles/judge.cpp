#include "oracles/judge.hpp"

#include <fmt/format.h>

#include <array>
#include <cfenv>
#include <cmath>

namespace nearmiss {

namespace {

bool moves(Role role) {
  switch (role) {
    case Role::position:
    case Role::velocity:
    case Role::size:
    case Role::direction:
    case Role::rotation:
    case Role::time:
    case Role::offset: return true;
    default: return false;
  }
}

using Magnitudes = std::array<double, 16>;  // by role

/// "box1.orientation" of "box1.orientation.x".
std::string_view vector_of(std::string_view field) { return field.substr(0, field.find_last_of('.')); }

Magnitudes magnitudes(const Query& query, std::span<const double> values) {
  Magnitudes largest{};
  for (std::size_t i = 0; i < values.size(); ++i) {
    double& m = largest[std::size_t(query.inputs[i].role)];
    m = std::max(m, std::abs(values[i]));
  }
  return largest;
}

/// Rounds to nearest for its lifetime, whatever the caller's mode.
class RoundToNearest {
 public:
  RoundToNearest() : before_(std::fegetround()) {
    if (before_ != FE_TONEAREST) std::fesetround(FE_TONEAREST);
  }
  ~RoundToNearest() {
    if (before_ != FE_TONEAREST) std::fesetround(before_);
  }
  RoundToNearest(const RoundToNearest&) = delete;
  RoundToNearest& operator=(const RoundToNearest&) = delete;

 private:
  int before_;
};

/// The oracle and the question, so that each step below is one line.
class Examination {
 public:
  Examination(const Case& question, const Answer& answer)
      : question_(question), answer_(answer), largest_(magnitudes(*question.query, question.values)) {}

  Enclosure within(double k) const {
    widen(k);
    return question_.query->oracle.interval(question_.values, widening_, answer_, question_.scalar);
  }
  void widen(double k) const {
    widening_.resize(question_.values.size());
    // One part in 2^50 more covers the rounding of the products themselves.
    const double relative = k * unit_roundoff(question_.scalar) * (1 + 0x1p-50);
    for (std::size_t i = 0; i < widening_.size(); ++i) {
      const Role role = question_.query->inputs[i].role;
      widening_[i] = moves(role) ? relative * largest_[std::size_t(role)] : 0.0;
      if (k > 0 && moves(role) && widening_[i] < 0x1p-1000) widening_[i] = std::nextafter(widening_[i], 1.0);
    }
  }
  Enclosure exactly(std::vector<Alternative>* list = nullptr) const {
    return question_.query->oracle.exact(question_.values, answer_, question_.scalar, list);
  }
  /// The highest rung at which no exact answer matches; empty when the lowest cannot exclude it.
  std::optional<Backward> backward() const {
    return highest_rung([](const Enclosure& e) { return !e.may_match; });
  }
  /// The highest rung up to which the decision is the same for every input.
  std::optional<Backward> margin() const {
    return highest_rung([](const Enclosure& e) { return e.decided(); });
  }
  bool in_domain(const collide::Contract& contract) const {
    for (std::size_t role = 0; role < largest_.size(); ++role) {
      if (!moves(Role(role)) || largest_[role] == 0) continue;
      const double m = largest_[role];
      if (m < std::ldexp(1.0, contract.lowest) || m > std::ldexp(1.0, contract.highest)) return false;
    }
    // Directions and rotations have no length in common: each must lie there by itself.
    const std::vector<Field>& fields = question_.query->inputs;
    for (std::size_t i = 0; i < fields.size();) {
      const std::string_view vector = vector_of(fields[i].name);
      double m = 0;
      std::size_t end = i;
      for (; end < fields.size() && fields[end].role == fields[i].role && vector_of(fields[end].name) == vector; ++end) {
        m = std::max(m, std::abs(question_.values[end]));
      }
      const bool by_itself = fields[i].role == Role::direction || fields[i].role == Role::rotation;
      if (by_itself && (m < std::ldexp(1.0, contract.lowest) || m > std::ldexp(1.0, contract.highest))) return false;
      i = end;
    }
    return true;
  }
  /// True where the place that number `worst` belongs to is proved to be off the surface of every input within k, by
  /// more than that many ulps.
  bool off_surface(int worst, double k, double ulps) const {
    const Oracle& oracle = question_.query->oracle;
    if (oracle.may_be_on_surface == nullptr || !answer_.yes) return false;
    widen(k);
    return !oracle.may_be_on_surface(question_.values, widening_, answer_, std::size_t(worst), ulps, question_.scalar);
  }
  const std::vector<double>& last_widening() const { return widening_; }

 private:
  /// Widening an input never shrinks its enclosure, so the rungs that pass come first.
  template <class Passes>
  std::optional<Backward> highest_rung(Passes passes) const {
    int low = -1, high = rungs;  // passes at low, fails at high
    while (high - low > 1) {
      const int middle = low < 0 ? 0 : high == rungs && low < 8 ? std::min(2 * low + 1, rungs - 1) : (low + high) / 2;
      (passes(within(rung(middle))) ? low : high) = middle;
    }
    if (low < 0) return std::nullopt;
    return Backward{rung(low)};
  }

  const Case& question_;
  const Answer& answer_;
  Magnitudes largest_;
  mutable std::vector<double> widening_;
};

Disagreement disagreement_of(const Query& query, const Answer& answer, bool decision_differs, int worst) {
  if (decision_differs) return answer.yes ? Disagreement::false_hit : Disagreement::false_miss;
  if (worst < 0) return Disagreement::none;
  switch (query.outputs[std::size_t(worst)].role) {
    case Role::time: return Disagreement::wrong_time;
    case Role::depth: return Disagreement::wrong_depth;
    case Role::normal: return Disagreement::wrong_normal;
    case Role::position: return Disagreement::wrong_place;
    case Role::flag: return Disagreement::wrong_flag;
    case Role::index: return Disagreement::wrong_index;
    case Role::weight: return query.kind == Kind::direction ? Disagreement::wrong_direction : Disagreement::wrong_weight;
    default: return Disagreement::wrong_direction;
  }
}

/// The first given number that is NaN, if any; a miss has an infinite time by definition.
int not_a_number(const Query& query, const Answer& answer) {
  const bool miss = query.kind == Kind::impact && !answer.yes;
  for (std::size_t i = 0; i < query.outputs.size(); ++i) {
    if (miss && query.outputs[i].role == Role::time) {  // what follows the time belongs to a hit
      return std::isnan(answer.values[i]) || answer.values[i] < 0 ? int(i) : -1;
    }
    if (answer.gives(i) && std::isnan(answer.values[i])) return int(i);
  }
  return -1;
}

/// The first given number that is infinite, which is right only for a number beyond the largest finite one.
int infinite(const Query& query, const Answer& answer) {
  if (query.kind == Kind::impact && !answer.yes) return -1;
  for (std::size_t i = 0; i < query.outputs.size(); ++i) {
    if (answer.gives(i) && std::isinf(answer.values[i])) return int(i);
  }
  return -1;
}

/// |normal| - 1 in units of epsilon; 0 where the answer has no normal.
double length_error(const Query& query, const Answer& answer, Scalar scalar) {
  long double length2 = 0;
  bool any = false;
  for (std::size_t i = 0; i < query.outputs.size(); ++i) {
    if (query.outputs[i].role != Role::normal || !answer.gives(i)) continue;
    length2 += static_cast<long double>(answer.values[i]) * answer.values[i];
    any = true;
  }
  if (!any || !answer.yes) return 0;
  return double((std::sqrt(length2) - 1) / unit_roundoff(scalar));
}

/// The answer with its normals divided by their length: normals are compared as directions, and their
/// length on its own. Normals that are nowhere near unit stay as they are.
Answer with_unit_normals(const Query& query, Answer answer, double error, Scalar scalar) {
  if (!(std::abs(error) * unit_roundoff(scalar) < 0.5)) return answer;
  const long double length = 1 + static_cast<long double>(error) * unit_roundoff(scalar);
  for (std::size_t i = 0; i < query.outputs.size(); ++i) {
    if (query.outputs[i].role == Role::normal) answer.values[i] = double(answer.values[i] / length);
  }
  return answer;
}

void take_forward(const Enclosure& e, Finding& f) {
  f.forward_ulps = e.ulps;
  f.worst = e.worst;
  f.forward_absolute = e.absolute;
}

Finding violation(Finding f, Disagreement d, std::string clause) {
  f.verdict = Verdict::violates_contract;
  if (f.disagreement == Disagreement::none || d == Disagreement::not_unit) f.disagreement = d;
  f.clause = std::move(clause);
  return f;
}

}  // namespace

double rung(int k) { return k == 0 ? 0.0 : std::ldexp(1.0, k - 1); }

std::vector<double> widening(const Query& query, std::span<const double> values, Scalar scalar, double k) {
  const Case question{&query, scalar, {values.begin(), values.end()}, {}, 0, 0, {}};
  const Answer none{};
  const Examination x(question, none);
  x.widen(k);
  return x.last_widening();
}

Finding judge(const Case& question, const Answer& answer, const collide::Contract& contract, Detail detail) {
  const RoundToNearest to_nearest;
  const Query& query = *question.query;
  Finding f;
  if (answer.status != Answer::Status::answered) {
    f.verdict = answer.status == Answer::Status::broke ? Verdict::broke : Verdict::cannot_answer;
    f.clause = answer.reason();
    return f;
  }
  f.unit_error = length_error(query, answer, question.scalar);
  const Answer compared = with_unit_normals(query, answer, f.unit_error, question.scalar);
  const Examination x(question, compared);
  if (!x.in_domain(contract)) {
    f.verdict = Verdict::out_of_domain;
    return f;
  }
  const auto not_finite = [&](int bad) {
    f.worst = bad;
    return violation(f, Disagreement::not_finite,
                     fmt::format("{} is {}", query.outputs[std::size_t(bad)].name, answer.values[std::size_t(bad)]));
  };
  if (const int bad = not_a_number(query, answer); bad >= 0) {
    f.truth_yes = x.exactly().may_be_yes;
    return not_finite(bad);
  }

  // The decision: interval first, exact where it cannot tell.
  Enclosure here = x.within(0);
  const bool vague = !(here.ulps_at_most_of_any - here.ulps <= 0.1);
  if (!here.decided() || detail == Detail::full || (detail == Detail::forward && vague)) {
    if (!here.decided()) f.decided_by = Stage::exact;
    here = x.exactly();
  }
  f.truth_yes = here.may_be_yes;
  const bool decision_differs = f.truth_yes != answer.yes;
  // An infinite number is held to the same bound as any other: on a knife's edge it may be right next door.
  const auto right_next_door = [&] { return std::isfinite(contract.backward) && x.within(contract.backward).may_match; };
  if (const int bad = infinite(query, answer); bad >= 0 && !x.exactly().may_match && !right_next_door()) {
    return not_finite(bad);
  }
  if (!decision_differs) take_forward(here, f);
  if (here.may_match) {
    f.verdict = Verdict::agrees;
  } else {
    f.verdict = Verdict::within_contract;
    f.disagreement = disagreement_of(query, answer, decision_differs, here.worst);
    f.backward = x.backward();
    if (!f.backward) f.backward = Backward{0};  // the exact stage excludes a match at the input itself
  }

  // A wrong place that breaks the contract may break more: is it on the surface of anything that the contract allows?
  const auto name_place = [&](double k, double ulps) {
    if (f.disagreement == Disagreement::wrong_place && x.off_surface(f.worst, k, ulps)) {
      f.disagreement = Disagreement::off_surface;
    }
  };
  if (f.backward && f.backward->above >= contract.backward) {
    name_place(contract.backward, 1);
    return violation(f, f.disagreement,
                     fmt::format("backward error at most {} epsilon", contract.backward));
  }
  if (contract.exact_decisions && decision_differs) return violation(f, f.disagreement, "exact decisions");
  if (!decision_differs && f.forward_ulps > contract.forward) {
    name_place(0, contract.forward);
    return violation(f, f.disagreement, fmt::format("forward error at most {} ulp", contract.forward));
  }
  if (std::abs(f.unit_error) > contract.unit) {
    return violation(f, Disagreement::not_unit, fmt::format("normals of length 1 within {} epsilon", contract.unit));
  }
  return f;
}

Truth truth_of(const Case& question) {
  const RoundToNearest to_nearest;
  const Answer none{};
  const Examination x(question, none);
  Truth t;
  const Enclosure exact = x.exactly(&t.alternatives);
  t.yes = exact.may_be_yes;
  t.decided_by = x.within(0).decided() ? Stage::interval : Stage::exact;
  if (const auto margin = x.margin()) t.margin_at_least = margin->above;
  return t;
}

std::string_view name_of(Verdict v) {
  switch (v) {
    case Verdict::agrees: return "agrees";
    case Verdict::within_contract: return "within contract";
    case Verdict::violates_contract: return "violates contract";
    case Verdict::out_of_domain: return "out of domain";
    case Verdict::cannot_answer: return "cannot answer";
    case Verdict::broke: return "broke";
  }
  return "?";
}

std::string_view name_of(Disagreement d) {
  switch (d) {
    case Disagreement::none: return "none";
    case Disagreement::false_hit: return "false hit";
    case Disagreement::false_miss: return "false miss";
    case Disagreement::wrong_time: return "wrong time";
    case Disagreement::wrong_place: return "wrong place";
    case Disagreement::wrong_normal: return "wrong normal";
    case Disagreement::wrong_depth: return "wrong depth";
    case Disagreement::wrong_direction: return "wrong direction";
    case Disagreement::wrong_weight: return "wrong weight";
    case Disagreement::wrong_flag: return "wrong flag";
    case Disagreement::wrong_index: return "wrong index";
    case Disagreement::off_surface: return "off the surface";
    case Disagreement::not_finite: return "not finite";
    case Disagreement::not_unit: return "not unit";
  }
  return "?";
}

}  // namespace nearmiss
