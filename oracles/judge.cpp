#include "oracles/judge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "impl/subject/floating_point.hpp"
#include "oracles/declared_oracle.hpp"
#include "oracles/exact/number_memory.hpp"
#include "oracles/requirements.hpp"
#include "oracles/rule_of_no.hpp"

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

using Magnitudes = std::array<double, 16>;  // indexed by role

Magnitudes magnitudes(const Query& query, std::span<const double> values) {
  Magnitudes largest{};
  const std::vector<Field>& fields = query.fields_of(values);
  for (std::size_t i = 0; i < values.size(); ++i) {
    double& m = largest[std::size_t(fields[i].role)];
    m = std::max(m, std::abs(values[i]));
  }
  return largest;
}

/// The number of the rung.
int rung_of(const Backward& b) { return b.above > 0 ? std::ilogb(b.above) + 1 : 0; }

/// The oracle and the case, so that each step below is one line. Caches the result of each rung.
class Examination {
 public:
  /// The case meets `required`, and means what is declared.
  Examination(const Case& question, const Answer& answer, Preconditions required = {}, Conventions declared = {})
      : question_(question),
        answer_(answer),
        oracle_(question, answer, declared),
        largest_(magnitudes(*question.query, question.values)),
        required_(with_border(*question.query, required)) {}

  Enclosure within(double k) const {
    widen(k);
    return oracle_.interval(widening_);
  }
  void widen(double k) const {
    widening_.resize(question_.values.size());
    // One more part in 2^50 covers the rounding of the products themselves.
    const double relative = k * unit_roundoff(question_.scalar) * (1 + 0x1p-50);
    for (std::size_t i = 0; i < widening_.size(); ++i) {
      const Role role = question_.role(i);
      widening_[i] = moves(role) ? relative * largest_[std::size_t(role)] : 0.0;
      if (k > 0 && moves(role) && widening_[i] < 0x1p-1000) widening_[i] = std::nextafter(widening_[i], 1.0);
    }
  }
  Enclosure exactly(AlternativeList* list = nullptr) const { return oracle_.exact(list); }
  /// The highest rung at which no exact answer matches; empty if even the lowest rung may have a match. `about`: where
  /// the search begins.
  std::optional<Backward> backward(int about) const {
    return proving(highest_rung(about, [](const Rung& r) { return !r.may_match; }));
  }
  /// The same for the given decision, and for one member together with the given decision.
  std::optional<Backward> backward_of_decision(int about) const {
    return proving(highest_rung(about, [&](const Rung& r) { return answer_.yes ? !r.may_be_yes : !r.may_be_no; }));
  }
  std::optional<Backward> backward_of_member(std::size_t member, int about) const {
    return proving(highest_rung(about, [&](const Rung& r) { return (r.may_match_member >> member & 1u) == 0; }));
  }
  /// The highest rung up to which every input has the same decision.
  std::optional<Backward> margin(int about = 0) const {
    return highest_rung(about, [](const Rung& r) { return r.may_be_yes != r.may_be_no; });
  }
  bool in_domain(const collide::Contract& contract) const {
    for (std::size_t role = 0; role < largest_.size(); ++role) {
      if (!moves(Role(role)) || largest_[role] == 0) continue;
      const double m = largest_[role];
      if (m < std::ldexp(1.0, contract.lowest) || m > std::ldexp(1.0, contract.highest)) return false;
    }
    // Directions and rotations have no common length, so each must lie there by itself.
    for (const InputMember& member : question_.operands().members) {
      if (member.role != Role::direction && member.role != Role::rotation) continue;
      double m = 0;
      for (std::size_t k = 0; k < member.count; ++k) m = std::max(m, std::abs(question_.values[member.begin + k]));
      if (m < std::ldexp(1.0, contract.lowest) || m > std::ldexp(1.0, contract.highest)) return false;
    }
    return true;
  }
  /// True if the place that contains output `worst` is proved to lie off the surface of every input within k, by more
  /// than that many ulps.
  bool off_surface(int worst, double k, double ulps) const {
    if (!answer_.yes) return false;
    widen(k);
    return !oracle_.may_be_on_surface(widening_, std::size_t(worst), ulps);
  }
  const NumberVector<double>& last_widening() const { return widening_; }
  /// Those of the required preconditions that have a border and that an input within k epsilon may break.
  Preconditions unmet_within_epsilon(double k) const {
    if (required_.empty() || k == 0) return {};
    widen(k);
    return unmet_within(question_, required_, widening_);
  }
  Preconditions ended_by() const { return ended_by_; }

 private:
  /// What the enclosure of one rung allows.
  struct Rung {
    bool known = false, may_be_yes = false, may_be_no = false, may_match = false;
    std::uint32_t may_match_member = 0;  ///< bit i: member i of the layout
  };
  static_assert(Enclosure::most_members <= 32);

  const Rung& at(int k) const {
    Rung& r = remembered_[std::size_t(k)];
    if (r.known) return r;
    const Enclosure e = within(rung(k));
    r = {true, e.may_be_yes, e.may_be_no, e.may_match, 0};
    for (std::size_t i = 0; i < e.members.size(); ++i) r.may_match_member |= std::uint32_t{e.members[i].may_match} << i;
    return r;
  }
  /// What a rung excludes, every lower one excludes too, though its enclosure may not show this: the computation may
  /// take another branch there. Starts from what earlier searches saw, walks away from `about` in steps that double,
  /// and then halves.
  template <class Passes>
  std::optional<Backward> highest_rung(int about, Passes passes) const {
    int low = -1, high = rungs;  // passes at low, fails at high
    for (int k = 0; k < high; ++k) {
      if (const Rung& r = remembered_[std::size_t(k)]; r.known) (passes(r) ? low : high) = k;
    }
    const int lowest = low, highest = high;
    for (int k = about, step = 1; high - low > 1; step *= 2) {
      k = std::min(std::max(k, low + 1), high - 1);
      const bool up = passes(at(k));
      (up ? low : high) = k;
      k = low > lowest && high < highest ? (low + high) / 2 : up ? k + step : k - step;
    }
    if (low < 0) return std::nullopt;
    return Backward{rung(low)};
  }

  /// The bound, or the highest one below it within which every input meets the preconditions.
  std::optional<Backward> proving(std::optional<Backward> bound) const {
    if (!bound || required_.empty()) return bound;
    const int own = rung_of(*bound);
    while (proving_rung_ < own && breaking_rung_ - proving_rung_ > 1) {
      const int k = breaking_rung_ > own ? own : (proving_rung_ + breaking_rung_) / 2;
      const Preconditions unmet = unmet_within_epsilon(rung(k));
      if (unmet.empty()) {
        proving_rung_ = k;
      } else {
        breaking_rung_ = k, ended_by_ = unmet;
      }
    }
    return Backward{rung(std::min(own, proving_rung_))};
  }

  const Case& question_;
  const Answer& answer_;
  DeclaredOracle oracle_;
  Magnitudes largest_;
  Preconditions required_;  ///< only those with a border that concern the query
  mutable NumberVector<double> widening_;
  mutable std::array<Rung, rungs> remembered_{};
  mutable int proving_rung_ = 0;       ///< every input within it meets the preconditions
  mutable int breaking_rung_ = rungs;  ///< not every input within it is sure to meet them
  mutable Preconditions ended_by_{};
};

Disagreement wrong(Role role, double given) {
  switch (role) {
    case Role::time: return given < 0 ? Disagreement::negative_time : Disagreement::wrong_time;
    case Role::depth: return Disagreement::wrong_depth;
    case Role::distance: return Disagreement::wrong_distance;
    case Role::normal: return Disagreement::wrong_normal;
    case Role::position: return Disagreement::wrong_place;
    case Role::flag: return Disagreement::wrong_flag;
    case Role::index: return Disagreement::wrong_index;
    case Role::size: return Disagreement::wrong_size;
    case Role::weight: return Disagreement::wrong_weight;
    default: return Disagreement::wrong_direction;
  }
}

/// |normal| - 1 in units of epsilon; 0 where the answer has no normal, or not all of it.
double length_error(const Query& query, const Answer& answer, Scalar scalar) {
  long double length2 = 0;
  bool any = false;
  for (std::size_t i = 0; i < query.outputs.size(); ++i) {
    if (query.outputs[i].role != Role::normal) continue;
    if (!answer.gives(i)) return 0;
    length2 += static_cast<long double>(answer.values[i]) * answer.values[i];
    any = true;
  }
  if (!any || !answer.yes || !std::isfinite(length2)) return 0;
  return double((std::sqrt(length2) - 1) / unit_roundoff(scalar));
}

/// Builds a finding, member by member.
class Judgement {
 public:
  Judgement(const Case& question, const Answer& answer, const Standard& standard, Detail detail,
            const SceneLimits* scene)
      : question_(question),
        query_(*question.query),
        answer_(answer),
        contract_(standard.contract),
        promised_(standard.promised),
        scene_(standard.promised ? nullptr : scene),
        length_of_epsilon_(unit_roundoff(question.scalar) * largest_length(question)),
        detail_(detail),
        x_(question, answer, standard.required, standard.declared) {}

  Finding finding() {
    if (answer_.status != Answer::Status::answered) {
      f_.verdict = answer_.status == Answer::Status::broke ? Verdict::broke : Verdict::cannot_answer;
      f_.clause = answer_.reason();
      f_.cause = answer_.cause;
      return std::move(f_);
    }
    f_.unit_error = length_error(query_, answer_, question_.scalar);
    if (!x_.in_domain(contract_)) {
      f_.verdict = Verdict::out_of_domain;
      return std::move(f_);
    }
    decide();
    judge_whole();
    judge_decision();
    judge_members();
    judge_length();
    conclude();
    f_.ended_by = x_.ended_by();
    f_.forward_at_most = largest_forward();
    f_.settled = is_settled();
    return std::move(f_);
  }

 private:
  using Part = Layout::Part;
  /// The decision: by intervals first, by exact numbers where the intervals cannot tell.
  void decide() {
    constexpr double vague_ulps = 0.1;
    here_ = x_.within(0);
    ulps_of_intervals_ = here_.ulps;
    const bool vague = !(here_.ulps_at_most_of_any - here_.ulps <= vague_ulps);
    if (!here_.decided() || detail_ == Detail::full || (detail_ == Detail::forward && vague) || scene_is_open()) {
      if (!here_.decided()) f_.decided_by = Stage::exact;
      here_ = x_.exactly();
    }
    f_.truth_yes = here_.may_be_yes;
    f_.branches = here_.branches;
    f_.right_answers = here_.answers;
    decision_differs_ = f_.truth_yes != answer_.yes;
  }
  void judge_whole() {
    if (!decision_differs_) {
      f_.forward_ulps = here_.ulps;
      f_.worst = here_.worst;
      f_.forward_absolute = here_.absolute;
    }
    // The exact stage excludes a match at the input itself where the lowest rung cannot.
    if (!here_.may_match) f_.backward = x_.backward(likely_rung()).value_or(Backward{0});
  }
  /// A guess at the backward bound. Where a wider enclosure excludes what a narrower one cannot, the result of the
  /// search depends on the guess: it is the same for every detail.
  int likely_rung() const {
    const int wrong_by_as_much_as_the_inputs = -std::ilogb(unit_roundoff(question_.scalar));
    if (decision_differs_ || !(ulps_of_intervals_ < HUGE_VAL)) return wrong_by_as_much_as_the_inputs;
    return std::clamp(std::ilogb(std::max(ulps_of_intervals_, 1.0)) - 1, 0, wrong_by_as_much_as_the_inputs);
  }
  /// The rung of the bound of the whole answer: no member has a higher one.
  int rung_of_whole() const { return f_.backward ? rung_of(*f_.backward) : 0; }
  void judge_decision() {
    if (!decision_differs_) return;
    MemberFinding m;
    m.disagreement = answer_.yes ? Disagreement::false_hit : Disagreement::false_miss;
    m.backward = x_.backward_of_decision(rung_of_whole()).value_or(Backward{0});
    if (scene_ != nullptr) {
      judge_gap(m);
    } else if (m.backward->above >= contract_.backward) {
      breaks(m, Clause::backward);
    } else if (contract_.exact_decisions) {
      breaks(m, Clause::exact_decisions);
    }
    f_.members.push_back(std::move(m));
  }
  /// After a decision that breaks the contract, the numbers mean nothing.
  void judge_members() {
    const bool broken_decision = !f_.members.empty() && f_.members.front().breaks();
    for (std::size_t i = 0; i < query_.layout.parts.size(); ++i) {
      const Part& part = query_.layout.parts[i];
      if (is_unasked_time_of_miss(part)) {
        judge_miss(i, part);
      } else if (const int bad = not_finite(part); bad >= 0) {
        add_not_finite(i, bad);
      } else if (!broken_decision) {
        judge_member(i, part);
      }
    }
  }
  bool is_unasked_time_of_miss(const Part& part) const {
    return query_.kind == Kind::impact && !answer_.yes && part.role == Role::time;
  }
  /// A miss has an infinite time; a negative time or NaN is invalid.
  void judge_miss(std::size_t member, const Part& part) {
    const double time = answer_.values[part.begin];
    if (std::isnan(time)) {
      add_not_finite(member, int(part.begin));
    } else if (time < 0) {
      MemberFinding m = member_finding(member, Disagreement::negative_time, int(part.begin));
      breaks(m, Clause::no_negative_time);
      f_.members.push_back(std::move(m));
    }
  }
  static MemberFinding member_finding(std::size_t member, Disagreement d, int worst) {
    MemberFinding m;
    m.member = int(member);
    m.disagreement = d;
    m.worst = worst;
    return m;
  }
  /// Members that describe a hit mean nothing in a miss.
  bool is_given(std::size_t i) const { return answer_.gives(i) && (answer_.yes || query_.kind != Kind::impact); }
  /// The first number that is NaN, or infinite without proof that infinity is right.
  int not_finite(const Part& part) {
    for (std::size_t i = part.begin; i < part.end; ++i) {
      if (!is_given(i)) continue;
      if (std::isnan(answer_.values[i])) return int(i);
      if (std::isinf(answer_.values[i]) && !may_be_infinite(i)) return int(i);
    }
    return -1;
  }
  /// An infinite number is invalid if an exact one is at most half the largest finite number, for the input and for
  /// every other input within the promised backward error. Beyond that, or beside a wrong decision (which has no exact
  /// number to compare with), it is judged by its distance like any other number.
  bool may_be_infinite(std::size_t i) const {
    const auto is_beyond = [&](const Enclosure& e) {
      return e.error[i].nearest_to_zero() <= largest_finite(question_.scalar) / 2;
    };
    const Enclosure exact = x_.exactly();
    if (exact.may_be_yes != answer_.yes || is_beyond(exact)) return true;
    return std::isfinite(contract_.backward) && is_beyond(x_.within(contract_.backward));
  }
  void add_not_finite(std::size_t member, int bad) {
    MemberFinding m = member_finding(member, Disagreement::not_finite, bad);
    breaks(m, Clause::finite_numbers);
    f_.members.push_back(std::move(m));
  }
  /// Beside a wrong decision, a member counts only if it is wrong for every input that has the given decision too.
  void judge_member(std::size_t member, const Part& part) {
    if (!answer_.gives(part.begin) || here_.members[member].may_match) return;
    std::optional<Backward> backward = x_.backward_of_member(member, rung_of_whole());
    if (decision_differs_ && !(backward && backward->above > f_.members.front().backward->above)) return;
    const Enclosure::Member& seen = here_.members[member];
    const int worst = seen.number < 0 ? int(part.begin) : seen.number;
    MemberFinding m = member_finding(member, wrong(part.role, answer_.values[std::size_t(worst)]), worst);
    m.backward = backward.value_or(Backward{0});
    if (!decision_differs_) m.forward_ulps = seen.ulps, m.forward_absolute = seen.absolute;
    if (scene_ != nullptr && is_of_scene(part.role)) {
      judge_by_scene(m, part.role);
    } else if (m.backward->above >= contract_.backward) {
      breaks(m, Clause::backward);
      name_place(m, contract_.backward, 1);
    } else if (m.forward_ulps > contract_.forward) {
      breaks(m, Clause::forward);
      name_place(m, 0, contract_.forward);
    }
    f_.members.push_back(std::move(m));
  }

  // What a scene requires. It states lengths and times; they judge the decision, places, depths, times and flags.

  static bool is_of_scene(Role role) {
    return is_length(role) || role == Role::time || role == Role::flag || role == Role::index;
  }
  /// The distance of the number from a right one that the scene tolerates; empty where it states none.
  std::optional<double> tolerated(Role role) const {
    return role == Role::time ? scene_->time : is_length(role) ? std::optional(scene_->error) : std::nullopt;
  }
  /// The enclosure leaves open whether some number is good enough for the scene.
  bool scene_is_open() const {
    if (scene_ == nullptr || !here_.decided() || here_.may_be_yes != answer_.yes) return false;
    for (std::size_t member = 0; member < query_.layout.parts.size(); ++member) {
      const Part& part = query_.layout.parts[member];
      const std::optional<double> most = tolerated(part.role);
      if (!most || here_.members[member].absolute > *most) continue;
      for (std::size_t i = part.begin; i < part.end; ++i) {
        if (is_given(i) && std::isfinite(answer_.values[i]) && !here_.error[i].empty() &&
            here_.error[i].furthest_from_zero() > *most) {
          return true;
        }
      }
    }
    return false;
  }
  void exceeds_scene(MemberFinding& m, double error, double most, std::string_view what) const {
    if (!(error > most)) return;
    m.broken = Clause::scene;
    m.times_tolerated = most > 0 ? error / most : HUGE_VAL;
    m.clause = fmt::format("the scene {} requires {}", scene_->scene, what);
  }
  /// The depth of a missed contact, or the gap of a phantom one. Where the limit lies above the proved rung and below
  /// the next one, the bound is refined to a sixteenth.
  void judge_gap(MemberFinding& m) const {
    const double most = answer_.yes ? scene_->error : scene_->missed_depth;
    const auto beyond = [&](double above) { return above * length_of_epsilon_ > most; };
    double above = m.backward->above, step = std::max(above, 1.0);
    for (int halvings = 4; halvings > 0 && !beyond(above) && beyond(above + step); --halvings) {
      step /= 2;
      const Enclosure e = x_.within(above + step);
      const bool excluded = answer_.yes ? !e.may_be_yes : !e.may_be_no;
      if (excluded && x_.unmet_within_epsilon(above + step).empty()) above += step;
    }
    exceeds_scene(m, above * length_of_epsilon_, most,
                  answer_.yes ? fmt::format("phantom contacts to be at most {} {} apart", most, scene_->unit)
                              : fmt::format("missed contacts to be at most {} {} deep", most, scene_->unit));
  }
  /// A flag, what stands beside a wrong flag, and a member beside a wrong decision have no distance to a right one: the
  /// distance of the nearest input that they are right for counts.
  void judge_by_scene(MemberFinding& m, Role role) const {
    const std::optional<double> most = tolerated(role);
    if (decision_differs_ || role == Role::flag || role == Role::index || follows_wrong_flag(m.member)) {
      exceeds_scene(m, m.backward->above * length_of_epsilon_, scene_->error,
                    fmt::format("{} to be right for inputs within {} {}",
                                query_.layout.parts[std::size_t(m.member)].name, scene_->error, scene_->unit));
    } else if (most) {
      exceeds_scene(m, m.forward_absolute, *most,
                    role == Role::time ? fmt::format("times of impact within {} s", *most)
                                       : fmt::format("places and depths within {} {}", *most, scene_->unit));
    }
    if (m.breaks()) name_place(m, scene_->error / length_of_epsilon_, 1);
  }
  bool follows_wrong_flag(int member) const {
    return member > 0 && query_.layout.parts[std::size_t(member - 1)].role == Role::flag && !f_.members.empty() &&
           f_.members.back().member == member - 1;
  }
  /// The least backward error, in epsilon, of a combination of members that is told.
  double bound_of_combination() const {
    if (scene_ == nullptr || !(length_of_epsilon_ > 0)) return contract_.backward;
    return std::max(contract_.backward, scene_->error / length_of_epsilon_);
  }

  /// The clause in words; for the clauses without a contract, the number that breaks it.
  std::string words_of(Clause c, int number) const {
    switch (c) {
      case Clause::none: return {};
      case Clause::exact_decisions: return "exact decisions";
      case Clause::backward: return fmt::format("backward error at most {} epsilon", contract_.backward);
      case Clause::forward: return fmt::format("forward error at most {} ulp", contract_.forward);
      case Clause::unit: return fmt::format("normals of length 1 within {} epsilon", contract_.unit);
      case Clause::scene:
      case Clause::finite_numbers:
      case Clause::no_negative_time: break;
    }
    const double given = answer_.values[std::size_t(number)];
    const std::string& name = query_.outputs[std::size_t(number)].name;
    return std::isnan(given) ? name + " is NaN" : fmt::format("{} is {}", name, given);  // whatever the sign of a NaN
  }
  void breaks(MemberFinding& m, Clause c) const { m.broken = c, m.clause = words_of(c, m.worst); }
  /// A wrong place that breaks the contract may break more: does it lie on the surface of any input that the contract
  /// allows?
  void name_place(MemberFinding& m, double k, double ulps) const {
    if (m.disagreement == Disagreement::wrong_place && x_.off_surface(m.worst, k, ulps)) {
      m.disagreement = Disagreement::off_surface;
    }
  }
  void judge_length() {
    if (!(std::abs(f_.unit_error) > contract_.unit)) return;
    for (std::size_t i = 0; i < query_.layout.parts.size(); ++i) {
      if (query_.layout.parts[i].role != Role::normal) continue;
      MemberFinding m = member_finding(i, Disagreement::not_unit, int(query_.layout.parts[i].begin));
      breaks(m, Clause::unit);
      f_.members.push_back(std::move(m));
    }
  }

  /// How many times the promised bound is exceeded; orders the headline. A number that is not finite comes first.
  double excess(const MemberFinding& m) const { return excess(m, m.forward_ulps); }
  /// The same with another forward error.
  double excess(const MemberFinding& m, double forward_ulps) const {
    const auto times = [](double amount, double promised) {
      return std::isfinite(promised) ? amount / std::max(promised, 1.0) : 0.0;
    };
    if (m.disagreement == Disagreement::not_finite) return HUGE_VAL;
    if (m.disagreement == Disagreement::not_unit) return times(std::abs(f_.unit_error), contract_.unit);
    if (m.broken == Clause::scene) return m.times_tolerated;
    const double backward = m.backward ? m.backward->above : 0.0;
    if (!m.breaks()) return backward;
    return std::max({times(backward, contract_.backward), times(forward_ulps, contract_.forward),
                     contract_.exact_decisions && m.member == MemberFinding::decision ? 1.0 : 0.0});
  }
  /// Members that break the contract come before those that differ; within each group the worst comes first.
  void choose_headline() {
    const auto rank = [&](int i) {
      const MemberFinding& m = f_.members[std::size_t(i)];
      return std::tuple(m.breaks(), excess(m), m.forward_ulps);
    };
    for (int i = 0; i < int(f_.members.size()); ++i) {
      if (f_.headline < 0 || rank(i) > rank(f_.headline)) f_.headline = i;
    }
  }
  void conclude() {
    choose_headline();
    const MemberFinding* head = f_.headline_member();
    if (head != nullptr && head->breaks()) return violated(head->disagreement, head->broken, head->clause);
    // No member differs alone; together they may.
    const bool is_combination = scene_ == nullptr || head == nullptr;  // a scene may tolerate the member that differs
    if (is_combination && f_.backward && f_.backward->above >= bound_of_combination())
      return combination(Clause::backward);
    if (!decision_differs_ && f_.forward_ulps > contract_.forward) return combination(Clause::forward);
    if (here_.may_match && head == nullptr) return;  // agrees
    f_.verdict = Verdict::not_proved;
    f_.disagreement = head != nullptr ? head->disagreement : Disagreement::wrong_combination;
  }
  /// At most this far, in ulps, is a part of the answer from that of any exact answer with the given decision. A NaN
  /// has no distance.
  double forward_at_most(const Part& part) const {
    double largest = 0, furthest = 0;
    for (std::size_t i = part.begin; i < part.end; ++i) {
      if (!answer_.gives(i) || std::isnan(answer_.values[i])) continue;
      largest = std::max(largest, std::abs(answer_.values[i]));
      furthest = std::max(furthest, here_.error[i].furthest_from_zero());
    }
    const double unit = ulp(std::min(largest, largest_finite(question_.scalar)), question_.scalar);
    return std::isfinite(largest) ? furthest / unit : HUGE_VAL;
  }
  double largest_forward() const {
    double largest = 0;
    if (decision_differs_) return largest;
    for (const Part& part : query_.layout.parts) largest = std::max(largest, forward_at_most(part));
    return largest;
  }
  /// The finding about the value of a member; nullptr where the member may match, or has no number.
  const MemberFinding* about_value_of(std::size_t member) const {
    const auto found = std::find_if(f_.members.begin(), f_.members.end(), [&](const MemberFinding& m) {
      return m.member == int(member) && m.disagreement != Disagreement::not_unit;
    });
    return found == f_.members.end() ? nullptr : &*found;
  }
  /// A member that does not break the contract here may break it in full only by a forward error within the enclosure.
  bool breaks_as_in_full(std::size_t member, const Part& part) const {
    const MemberFinding* m = about_value_of(member);
    if ((m != nullptr && m->breaks()) || !is_given(part.begin)) return true;
    return contract_.backward > 0 && forward_at_most(part) <= contract_.forward;
  }
  /// No other member can come before the headline, wherever the forward errors lie in their enclosures. The exact stage
  /// resolves the distance from a set to one part in 128 (nearest_member.cpp), and may state less than the intervals.
  bool has_headline_of_full() const {
    const MemberFinding* head = f_.headline_member();
    if (head == nullptr) return true;
    const double least_forward = head->forward_ulps * (1 - 0x1p-6);
    const std::tuple least(head->breaks(), excess(*head, least_forward), least_forward);
    return std::all_of(f_.members.begin(), f_.members.end(), [&](const MemberFinding& m) {
      if (&m == head) return true;
      const double most = m.backward ? forward_at_most(query_.layout.parts[std::size_t(m.member)]) : m.forward_ulps;
      const std::tuple greatest(m.breaks(), excess(m, most), most);
      return greatest < least || (greatest == least && &m > head);  // of equals the first one is the headline
    });
  }
  bool is_settled() const {
    if (detail_ == Detail::full || f_.decided_by == Stage::exact) return true;
    if (scene_ != nullptr) return false;
    if (decision_differs_) return f_.members.front().breaks();
    for (std::size_t i = 0; i < query_.layout.parts.size(); ++i) {
      if (!breaks_as_in_full(i, query_.layout.parts[i])) return false;
    }
    return has_headline_of_full();
  }
  void combination(Clause c) {
    f_.headline = -1;
    violated(Disagreement::wrong_combination, c, words_of(c, -1));
  }
  void violated(Disagreement d, Clause c, std::string words) {
    f_.verdict = promised_ ? Verdict::violates_contract : Verdict::exceeds_measure;
    f_.disagreement = d;
    f_.broken = c;
    f_.clause = std::move(words);
  }

  const Case& question_;
  const Query& query_;
  const Answer& answer_;
  const collide::Contract& contract_;
  const bool promised_;
  const SceneLimits* const scene_;  ///< nullptr: no scene
  const double length_of_epsilon_;  ///< how far a coordinate moves for a backward error of one epsilon
  const Detail detail_;
  const Examination x_;
  Enclosure here_;
  double ulps_of_intervals_ = 0;  ///< of the answer, from the enclosure of the input itself by intervals
  bool decision_differs_ = false;
  Finding f_;
};

}  // namespace

double largest_length(const Case& question) {
  double largest = 0;
  for (std::size_t i = 0; i < question.values.size(); ++i) {
    const Role role = question.role(i);
    if (role == Role::position || role == Role::size) largest = std::max(largest, std::abs(question.values[i]));
  }
  return largest;
}

double rung(int k) { return k == 0 ? 0.0 : std::ldexp(1.0, k - 1); }

std::vector<double> widening(const Query& query, std::span<const double> values, Scalar scalar, double k) {
  const FloatingPointScope standard_modes;
  const Case question{&query, scalar, {values.begin(), values.end()}, {}, 0, 0, {}};
  const Answer none{};
  const Examination x(question, none);
  x.widen(k);
  return {x.last_widening().begin(), x.last_widening().end()};
}

bool Finding::has(Disagreement d) const {
  if (disagreement == d) return true;
  return std::any_of(members.begin(), members.end(),
                     [&](const MemberFinding& m) { return m.disagreement == d && (m.breaks() || !is_proved()); });
}

namespace {

Finding not_asked(Preconditions unmet) {
  Finding f;
  f.verdict = Verdict::not_asked;
  f.clause = requires_text(unmet);
  return f;
}

}  // namespace

Finding judge(const Case& question, const Answer& answer, const Standard& standard, Detail detail,
              const SceneLimits* scene) {
  if (const Preconditions unmet = unmet_by(question, standard.required); !unmet.empty()) return not_asked(unmet);
  const FloatingPointScope standard_modes;
  return Judgement(question, answer, standard, detail, scene).finding();
}

namespace {

std::vector<Alternative> each_once(std::vector<Alternative> all) {
  std::vector<Alternative> once;
  for (Alternative& a : all) {
    if (std::find(once.begin(), once.end(), a) == once.end()) once.push_back(std::move(a));
  }
  return once;
}

}  // namespace

Enclosure enclosure_of(const Case& question, const Answer& answer) {
  const FloatingPointScope standard_modes;
  return Examination(question, answer).within(0);
}

double finer_backward(const Case& question, const Answer& answer, const Backward& proved, Preconditions required,
                      Conventions declared) {
  constexpr int halvings = 4;  // to 1/16
  const FloatingPointScope standard_modes;
  const Examination x(question, answer, required, declared);
  double above = proved.above, step = std::max(proved.above, 1.0);
  for (int i = 0; i < halvings; ++i) {
    step /= 2;
    if (!x.within(above + step).may_match && x.unmet_within_epsilon(above + step).empty()) above += step;
  }
  return above;
}

double estimated_backward(const Case& question, const Answer& answer, double forward_ulps) {
  constexpr double widened = 1024;  // epsilon: far above the roundings of the intervals themselves
  const FloatingPointScope standard_modes;
  const Examination x(question, answer);
  const double slope = (x.within(widened).ulps_at_most - x.within(0).ulps_at_most) / widened;
  return slope > 0 && std::isfinite(slope) ? forward_ulps / slope : 0;
}

double decision_margin(const Case& question, double guess) {
  const FloatingPointScope standard_modes;
  const Answer none{};
  return Examination(question, none).margin(rung_of({guess})).value_or(Backward{-1}).above;
}

namespace {

Truth truth(const Case& question, Conventions declared, int digits) {
  const FloatingPointScope standard_modes;
  const Answer none{};
  const Examination x(question, none, {}, declared);
  AlternativeList list{.digits = digits};
  const Enclosure exact = x.exactly(&list);
  Truth t;
  t.alternatives = each_once(std::move(list.all));
  t.yes = exact.may_be_yes;
  t.decided_by = x.within(0).decided() ? Stage::interval : Stage::exact;
  if (const auto margin = x.margin()) t.margin_at_least = margin->above;
  if (!t.yes) {
    const bool late = std::any_of(t.alternatives.begin(), t.alternatives.end(), [](const auto& a) { return a.late; });
    t.because = late ? "the contact comes at a time beyond the largest number" : rule_of_no(question, declared);
  }
  return t;
}

}  // namespace

Truth truth_of(const Case& question, Conventions declared) { return truth(question, declared, 0); }

Truth truth_in_digits(const Case& question, int digits) { return truth(question, {}, digits); }

std::string_view name_of(Verdict v) {
  switch (v) {
    case Verdict::agrees: return "agrees";
    case Verdict::not_proved: return "not proved to differ by more";
    case Verdict::violates_contract: return "violates contract";
    case Verdict::exceeds_measure: return "differs by more than the measure";
    case Verdict::out_of_domain: return "out of domain";
    case Verdict::cannot_answer: return "cannot answer";
    case Verdict::broke: return "broke";
    case Verdict::not_asked: return "not asked";
  }
  return "?";
}

std::string_view name_of(Disagreement d) {
  switch (d) {
    case Disagreement::none: return "none";
    case Disagreement::false_hit: return "false hit";
    case Disagreement::false_miss: return "false miss";
    case Disagreement::wrong_time: return "wrong time";
    case Disagreement::negative_time: return "negative time";
    case Disagreement::wrong_place: return "wrong place";
    case Disagreement::wrong_normal: return "wrong normal";
    case Disagreement::wrong_depth: return "wrong depth";
    case Disagreement::wrong_distance: return "wrong distance";
    case Disagreement::wrong_size: return "wrong size";
    case Disagreement::wrong_direction: return "wrong direction";
    case Disagreement::wrong_weight: return "wrong weight";
    case Disagreement::wrong_flag: return "wrong flag";
    case Disagreement::wrong_index: return "wrong index";
    case Disagreement::wrong_combination: return "wrong combination";
    case Disagreement::off_surface: return "off the surface";
    case Disagreement::not_finite: return "not finite";
    case Disagreement::not_unit: return "not unit";
  }
  return "?";
}

}  // namespace nearmiss
