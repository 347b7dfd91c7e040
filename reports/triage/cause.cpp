#include "reports/triage/cause.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "corpus/fit.hpp"
#include "corpus/generator.hpp"
#include "corpus/relations/exact_sums.hpp"
#include "oracles/requirements.hpp"
#include "reports/findings/text.hpp"
#include "reports/triage/border.hpp"
#include "reports/triage/readings.hpp"
#include "reports/triage/regions.hpp"
#include "reports/triage/scales.hpp"
#include "reports/triage/tested.hpp"
#include "reports/triage/tolerance.hpp"
#include "reports/triage/trials.hpp"

namespace nearmiss {

namespace {

constexpr std::size_t most_variants = 16;
constexpr std::size_t sample_size = 256;  ///< generated cases on which a reading must hold too
constexpr std::size_t of_each_side = 64;  ///< generated cases inside and outside of a region
constexpr std::size_t neighbours = 64;    ///< cases an ulp away

/// "Some, and not nearly all": 1 to 9 of 10.
bool is_mixed(std::size_t part, std::size_t all) { return 10 * part >= all && 10 * part <= 9 * all && part > 0; }

std::string of_text(std::size_t part, std::size_t all) { return fmt::format("{} of {}", part, all); }

/// The tests of one finding, in the order of the hypotheses. Each test adds what was seen to the evidence.
class Investigation {
 public:
  Investigation(const Report& report, const Subject& subject, const CauseLimits& limits, Workers& workers)
      : trials_(report.question, subject, limits, workers), seed_(seed_of(report.question)) {}

  Cause result() {
    Cause cause;
    if (const auto named = first_named()) cause.kind = named->kind, cause.key = named->key, cause.text = named->text;
    if (cause.text.empty()) cause.text = "No hypothesis passed its test.";
    cause.evidence = std::move(evidence_);
    cause.questions = trials_.questions();
    return cause;
  }

 private:
  using Test = std::optional<Named> (Investigation::*)();

  std::optional<Named> first_named() {
    if (!is_bad(trials_.base().finding)) {
      saw("The subject was asked again.", "The finding is gone.");
      return std::nullopt;
    }
    ask_in_all_roundings();
    for (const ScaleGroup& group : scale_groups()) scans_.push_back(scan(trials_, group));
    static constexpr Test tests[] = {&Investigation::range_of_numbers, &Investigation::convention,
                                     &Investigation::unsupported,      &Investigation::constant_error,
                                     &Investigation::tolerance,        &Investigation::certified,
                                     &Investigation::rounding,         &Investigation::times_of_steps,
                                     &Investigation::starts_of_motion, &Investigation::logic};
    for (const Test test : tests) {
      if (trials_.is_over()) {
        saw("The search has a limit of questions and of time.", "The limit was reached before every test was made.");
        return std::nullopt;
      }
      if (auto named = (this->*test)()) return named;
    }
    return std::nullopt;
  }

  void saw(std::string test, std::string result) { evidence_.push_back({std::move(test), std::move(result)}); }
  const Case& question() const { return trials_.base().question; }

  /// Other cases with the finding, found once.
  const std::vector<Trial>& similar() {
    if (!variants_) variants_ = variants(trials_, most_variants, seed_);
    return *variants_;
  }

  // Roundings

  void ask_in_all_roundings() {
    if (!trials_.sets_rounding()) return;
    for (const Rounding r : {Rounding::to_nearest, Rounding::downward, Rounding::upward, Rounding::toward_zero})
      roundings_.push_back(trials_.ask({&question(), 1}, r).front());
  }
  bool same_in_all_roundings() const {
    return !roundings_.empty() && count(roundings_, Outcome::same) == roundings_.size();
  }
  /// The subject's arithmetic on the case was exact: no exception, not even an inexact result.
  bool is_exact() const {
    return std::any_of(roundings_.begin(), roundings_.end(), [](const Trial& t) {
      return t.outcome == Outcome::same && t.answer.status == Answer::Status::answered && t.raised == 0;
    });
  }
  /// How far the worst number of the answer moves between the roundings, as a share of its error.
  double moved_by_rounding() const {
    const Trial& base = trials_.base();
    const Finding full = trials_.in_full(base);
    const MemberFinding* worst = full.headline_member();
    if (worst == nullptr || worst->worst < 0 || !(worst->forward_absolute > 0)) return 0;
    double furthest = 0;
    for (const Trial& t : roundings_) {
      const bool comparable = t.answer.status == Answer::Status::answered && t.answer.yes == base.answer.yes;
      const double by = t.answer.values[std::size_t(worst->worst)] - base.answer.values[std::size_t(worst->worst)];
      if (comparable && std::isfinite(by)) furthest = std::max(furthest, std::abs(by));
    }
    return furthest / worst->forward_absolute;
  }

  // Overflow and underflow

  std::optional<Named> range_of_numbers() {
    for (const ScaleScan& s : scans_) {
      if (s.explained_by(raised_overflow)) return out_of_range(s, CauseKind::overflow);
      if (s.explained_by(raised_underflow)) return out_of_range(s, CauseKind::underflow);
      if (auto named = out_of_range_without_flags(s)) return named;
    }
    return std::nullopt;
  }
  std::optional<Named> out_of_range(const ScaleScan& s, CauseKind kind) {
    saw(fmt::format("All {} were multiplied by powers of two.", s.group->name),
        fmt::format("With 2^{} the answer is right and no {} is raised. From 1 to 2^{} the finding stays, and every "
                    "answer raises the exception.",
                    s.flip->right, name_of(kind), s.flip->wrong));
    return Named{kind, std::string(s.group->name),
                 fmt::format("A number that the subject computes leaves the range of the scalar: {}.", name_of(kind))};
  }

  /// A subject that broke, or that answers behind pipes, leaves no flags. The range is exceeded if the fourth power of
  /// the largest number exceeds it wherever the finding is there, and the answer is right nearer to scale 1.
  std::optional<Named> out_of_range_without_flags(const ScaleScan& s) {
    const bool has_flags = trials_.sets_rounding() && trials_.base().finding.verdict != Verdict::broke;
    if (has_flags || !s.flip) return std::nullopt;
    constexpr int powers = 4;
    const int highest = (trials_.subject().scalar == Scalar::float32 ? 128 : 1024) / powers;
    const int at_flip = largest_exponent(question()) + s.flip->wrong;
    const int base = largest_exponent(question());
    const bool toward_one = at_flip < 0 ? base <= at_flip : base >= at_flip;
    if (!toward_one || (at_flip < highest && at_flip > -highest)) return std::nullopt;
    saw(fmt::format("All {} were multiplied by powers of two.", s.group->name),
        fmt::format(
            "With 2^{} the answer is right. The finding stays from 1 to 2^{}, where the largest number is about "
            "2^{}: its fourth power leaves the range of the scalar.",
            s.flip->right, s.flip->wrong, at_flip));
    return Named{at_flip > 0 ? CauseKind::overflow : CauseKind::underflow, std::string(s.group->name),
                 "The finding is there where products of the inputs leave the range of the scalar, and only there."};
  }
  /// Of the positions and sizes.
  static int largest_exponent(const Case& c) {
    double largest = 0;
    for (std::size_t i = 0; i < c.values.size(); ++i) {
      const Role role = c.query->inputs[i].role;
      if (role == Role::position || role == Role::size) largest = std::max(largest, std::abs(c.values[i]));
    }
    return largest > 0 ? std::ilogb(largest) : 0;
  }

  // Conventions

  /// Generated cases with the subject's answers, asked once.
  const std::vector<Trial>& sample() {
    if (!sample_.empty()) return sample_;
    const Preconditions required = trials_.subject().offering(trials_.query().name).required;
    std::vector<Case> cases(sample_size);
    std::uint64_t index = 0;
    for (Case& c : cases) {
      do {
        generate_inside(c, trials_.query(), trials_.subject().scalar, seed_, index++, required);
      } while (has_extreme_mutator(c));
    }
    return sample_ = trials_.ask(cases);
  }

  /// How the subject's answers fit a reading.
  struct Support {
    std::size_t with_finding = 0, explained = 0;  ///< cases with the finding, and those that the reading explains
    std::size_t for_it = 0;      ///< generated cases with a wrong answer that is right under the reading
    std::size_t against_it = 0;  ///< generated cases with a right answer that is wrong under the reading

    /// A convention holds in every case. A reading that explains wrong answers by chance makes right ones wrong.
    bool holds() const {
      constexpr std::size_t least = 4, least_generated = 2;
      return explained >= least && nearly_all(explained, with_finding) && for_it >= least_generated &&
             nearly_all(for_it, for_it + against_it);
    }
  };
  /// The answer would be wrong under the reading if the reading made a difference.
  static bool contradicts(const Reading& reading, const Trial& t) {
    if (t.outcome == Outcome::right) return true;
    return reading.decides && t.answer.status == Answer::Status::answered && t.answer.yes == t.finding.truth_yes;
  }
  /// A reading of the decision alone says nothing about the cases in which it makes no difference.
  static void count_finding(const Reading& reading, std::optional<bool> fits, Support& s) {
    s.with_finding += fits || !reading.decides;
    s.explained += fits.value_or(false);
  }
  Support support_of(const Reading& reading) {
    Support s;
    for (const Trial& t : similar()) count_finding(reading, reading.right(t.question, t.answer, is_right_), s);
    for (const Trial& t : sample()) {
      if (t.outcome == Outcome::none) continue;
      const std::optional<bool> fits = reading.right(t.question, t.answer, is_right_);
      s.against_it += contradicts(reading, t) && !fits.value_or(true);
      s.for_it += t.outcome != Outcome::right && fits.value_or(false);
      if (t.outcome == Outcome::same) count_finding(reading, fits, s);
    }
    return s;
  }

  std::optional<Named> convention() {
    if (trials_.base().answer.status != Answer::Status::answered) return std::nullopt;
    std::vector<std::string> by_chance;
    for (const Reading& reading : readings()) {
      if (reading.decides && !is_wrong_decision()) continue;
      if (!reading.right(question(), trials_.base().answer, is_right_).value_or(false)) continue;
      const Support s = support_of(reading);
      if (s.holds()) return named_reading(reading, s);
      by_chance.emplace_back(reading.name);
    }
    const std::string which =
        by_chance.empty() ? "" : fmt::format(" Right for this case, but not for others: {}.", list_text(by_chance));
    saw(fmt::format("{} other meanings of the inputs and of the answer were tried.", readings().size()),
        "None explains the answers." + which);
    return std::nullopt;
  }
  bool is_wrong_decision() const {
    const Disagreement d = trials_.base().finding.disagreement;
    return d == Disagreement::false_hit || d == Disagreement::false_miss;
  }
  Named named_reading(const Reading& reading, const Support& s) {
    saw(fmt::format("The answers were judged as if {}.", reading.what),
        fmt::format("The answer to the case is right then, and so are those to {} other cases with the finding. Of the "
                    "generated cases, {} wrong answers become right, and {} right ones become wrong.",
                    of_text(s.explained, s.with_finding), s.for_it, s.against_it));
    return {reading.kind, std::string(reading.name), fmt::format("The answer is right if {}.", reading.what)};
  }

  // Unsupported features

  std::optional<Named> unsupported() {
    for (const Region& region : regions_of(trials_.query())) {
      if (!region.has(question())) continue;
      if (auto named = tested(region)) return named;
    }
    return std::nullopt;
  }
  /// Generated cases inside or outside of the region.
  std::vector<Trial> cases_of(const Region& region, bool inside) {
    constexpr std::uint64_t most_tries = 4000;
    const Preconditions required = trials_.subject().offering(trials_.query().name).required;
    std::vector<Case> cases;
    Case c;
    for (std::uint64_t i = 0; i < most_tries && cases.size() < of_each_side; ++i) {
      generate_inside(c, trials_.query(), trials_.subject().scalar, seed_ + 1, i, required);
      if (!has_extreme_mutator(c) && region.has(c) == inside) cases.push_back(c);
    }
    return trials_.ask(cases);
  }
  std::optional<Named> tested(const Region& region) {
    constexpr std::size_t least = 6;
    const std::vector<Trial> in = cases_of(region, true), out = cases_of(region, false);
    const std::size_t in_right = count(in, Outcome::right), out_right = count(out, Outcome::right);
    const std::size_t in_all = in.size() - count(in, Outcome::none), out_all = out.size() - count(out, Outcome::none);
    saw(fmt::format("Generated cases with and without {} were asked.", region.name),
        fmt::format("Wrong are {} with it, and {} without it.", of_text(in_all - in_right, in_all),
                    of_text(out_all - out_right, out_all)));
    if (in_all < least || out_all < least) return std::nullopt;
    if (nearly_all(in_all - in_right, in_all) && nearly_all(out_right, out_all))
      return Named{CauseKind::unsupported, region.name,
                   fmt::format("The subject does not support {}: nearly every such answer is wrong.", region.name)};
    constexpr std::size_t least_outside = of_each_side / 2;
    const bool only_here = out_all >= least_outside && region.is_special && out_right == out_all &&
                           in_all - in_right >= least && !nearly_all(in_right, in_all);
    if (!only_here) return std::nullopt;
    return Named{CauseKind::unsupported, region.name,
                 fmt::format("The subject does not support {}: only such answers are wrong.", region.name)};
  }

  // Absolute tolerances

  std::optional<Named> constant_error() { return taken(constant_error_of(trials_, scans_)); }
  std::optional<Named> tolerance() { return taken(tolerance_of(trials_, scans_, similar())); }
  std::optional<Named> taken(Tested tested) {
    std::move(tested.evidence.begin(), tested.evidence.end(), std::back_inserter(evidence_));
    return std::move(tested.named);
  }

  // Rounding

  /// The kernels of `collide` in exact real numbers are its tier Certified.
  std::optional<Named> certified() {
    const Subject& s = trials_.subject();
    if (!s.own || !s.name.starts_with("collide-")) return std::nullopt;
    const Subject* exact =
        find_subject(s.scalar == Scalar::float32 ? "collide-certified-float" : "collide-certified-double");
    if (exact == nullptr) return std::nullopt;
    const Answer answer = trials_.workers().ask(*exact, question());
    const bool is_right = trials_.is_right(question(), answer);
    saw("The same kernel was run in exact real numbers (" + exact->name + ").",
        is_right ? "It is right." : "It has no right answer either.");
    if (is_right)
      return Named{CauseKind::rounding, "", "The kernel is right over the real numbers: its rounding is not."};
    return Named{CauseKind::logic, "", "The kernel is wrong over the real numbers too: the mistake is in its logic."};
  }

  std::optional<Named> rounding() {
    constexpr int ulps = 8;
    const std::vector<Trial> near = trials_.ask(ulp_neighbours(question(), neighbours, ulps, seed_));
    near_same_ = count(near, Outcome::same), near_right_ = count(near, Outcome::right);
    near_all_ = near.size() - count(near, Outcome::none);
    if (auto named = by_roundings()) return named;
    saw(fmt::format("{} cases were asked whose numbers are a few ulps away.", near_all_),
        fmt::format("{} have the finding, and {} are right.", near_same_, near_right_));
    if (is_exact()) {
      saw("The flags of floating-point exceptions were read.", "The subject's arithmetic on the case was exact.");
      return std::nullopt;
    }
    if (is_mixed(near_right_, near_all_)) {
      if (!are_on_two_sides(question(), near))
        return Named{CauseKind::rounding, "",
                     "The answer is unstable: it is right or wrong by the last bits of the inputs."};
      saw("A plane was sought that separates these cases with the finding from those without.",
          "There is one: the case lies on a border, and the answer is not right or wrong by chance.");
    }
    return far_from_the_origin();
  }
  std::optional<Named> by_roundings() {
    if (roundings_.empty()) {
      saw("The subject answers behind pipes.", "It cannot be asked in other rounding modes.");
      return std::nullopt;
    }
    const std::size_t right = count(roundings_, Outcome::right), same = count(roundings_, Outcome::same);
    const double moved = moved_by_rounding();
    saw("The case was asked in the four rounding modes.",
        fmt::format(
            "The finding is there in {}, and the answer is right in {}. The worst number moves by {:.2g} % of its "
            "error.",
            same, right, 100 * moved));
    constexpr double least_moved = 0.25;
    if (right > 0) return Named{CauseKind::rounding, "", "The answer is right in another rounding mode."};
    if (moved >= least_moved)
      return Named{CauseKind::rounding, "",
                   "The error changes with the rounding mode: it consists of rounding errors."};
    return std::nullopt;
  }

  /// Exactly moved toward the origin, in steps that halve the distance.
  std::optional<Named> far_from_the_origin() {
    const std::vector<Case> cases = moved_to_the_origin();
    if (cases.empty()) return std::nullopt;
    const std::vector<Trial> moved = trials_.ask(cases);
    const std::size_t first = std::size_t(
        std::find_if(moved.begin(), moved.end(), [](const Trial& t) { return t.outcome != Outcome::same; }) -
        moved.begin());
    const std::size_t right = std::size_t(std::count_if(moved.begin() + std::ptrdiff_t(first), moved.end(),
                                                        [](const Trial& t) { return t.outcome == Outcome::right; }));
    saw("The scene was moved exactly toward the origin, by halves of its distance.",
        fmt::format("The finding stays in {} of {} steps, and then {} are right.", first, moved.size(), right));
    constexpr std::size_t least = 3;
    if (right < least || right != moved.size() - first) return std::nullopt;
    return Named{
        CauseKind::rounding, "far from the origin",
        "The answer is wrong far from the origin and right near it: coordinates lose the bits of the distances."};
  }
  std::vector<Case> moved_to_the_origin() const {
    const Query& q = trials_.query();
    std::vector<Case> cases;
    if (std::any_of(q.inputs.begin(), q.inputs.end(), [](const Field& f) { return f.role == Role::offset; }))
      return cases;
    const auto first =
        std::find_if(q.inputs.begin(), q.inputs.end(), [](const Field& f) { return f.role == Role::position; });
    if (first == q.inputs.end()) return cases;
    const std::size_t at = std::size_t(first - q.inputs.begin());
    const double* place = &question().values[at];
    for (int m = 1; m <= 24; ++m) {
      Case c = question();
      for (std::size_t i = 0; i < c.values.size(); ++i) {
        if (q.inputs[i].role != Role::position) continue;
        const std::size_t k = std::size_t(q.inputs[i].name.back() - 'x');
        const auto kept = metamorphic::exact_product(place[k], std::ldexp(1.0, -m), c.scalar);
        const auto shift = kept ? metamorphic::exact_sum(*kept, -place[k], c.scalar) : std::nullopt;
        const auto moved = shift ? metamorphic::exact_sum(c.values[i], *shift, c.scalar) : std::nullopt;
        if (!moved) return cases;
        c.values[i] = *moved;
      }
      if (c.values != question().values) cases.push_back(std::move(c));
    }
    return cases;
  }

  // A limit of steps

  /// The start moves a little, so that the exact times differ, and the given times are few.
  std::optional<Named> times_of_steps() {
    if (trials_.query().kind != Kind::impact || !trials_.base().answer.yes) return std::nullopt;
    const std::vector<Trial> moved = trials_.ask(with_moved_starts());
    std::vector<double> times;
    for (const Trial& t : moved) {
      if (t.answer.status == Answer::Status::answered && t.answer.yes && t.answer.values[0] > 0)
        times.push_back(t.answer.values[0]);
    }
    const std::size_t all = times.size();
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    saw("The start was moved by different small distances.",
        fmt::format("{} different times of contact were given in {} answers.", times.size(), all));
    constexpr std::size_t least = 16, shared = 4;
    if (all < least || shared * times.size() > all) return std::nullopt;
    return Named{CauseKind::iteration_limit, "steps along the motion",
                 "The time is one of a few: the subject looks at few steps along the motion."};
  }
  std::vector<Case> with_moved_starts() const {
    std::vector<Case> cases;
    const auto& start = parts_of(trials_.query()).start;
    if (!start) return cases;
    for (std::size_t n = 1; n <= neighbours; ++n) {
      Case c = question();
      constexpr int furthest = -6;  // as a power of two of the largest length
      const double by = std::ldexp(double(n) / neighbours, largest_exponent(c) + furthest);
      for (std::size_t k = 0; k < 3; ++k) {
        double& x = c.values[start->place + k];
        x = c.scalar == Scalar::float32 ? double(float(x + by)) : x + by;
      }
      cases.push_back(std::move(c));
    }
    return cases;
  }

  /// The same motion begins later and later: the contact stays, and less and less of the way to it is left.
  std::optional<Named> starts_of_motion() {
    const std::vector<Case> cases = later_starts();
    if (cases.empty() || (!roundings_.empty() && !same_in_all_roundings())) return std::nullopt;
    const std::vector<Trial> later = trials_.ask(cases);
    std::size_t right = 0, changes = 0, last_wrong = 0;
    bool before = false;
    for (std::size_t i = 0; i < later.size(); ++i) {
      const bool ended = has_ended(later[i]);
      right += ended, changes += ended != before;
      if (!ended) last_wrong = i;
      before = ended;
    }
    saw("The same motion began later, at points that come nearer and nearer to the contact.",
        fmt::format("The finding has ended in {}, and comes or goes {} times along the way.",
                    of_text(right, later.size()), changes));
    constexpr std::size_t least_changes = 3;
    const bool ends = changes == 1 && last_wrong + 1 < later.size();
    if (!ends && changes < least_changes) return std::nullopt;
    return Named{CauseKind::iteration_limit, "steps along the motion",
                 "The answer depends on where the same motion begins, in every rounding mode and at every scale: the "
                 "steps along the motion are too few."};
  }
  /// The answer is right or, where the finding is a wrong decision, the decision is.
  bool has_ended(const Trial& t) const {
    if (t.outcome == Outcome::right) return true;
    return t.outcome == Outcome::other && is_wrong_decision() && t.answer.status == Answer::Status::answered &&
           t.answer.yes == t.finding.truth_yes;
  }
  std::vector<Case> later_starts() const {
    std::vector<Case> cases;
    const auto& start = parts_of(trials_.query()).start;
    const auto& velocities = parts_of(trials_.query()).velocities;
    const double time = contact_time();
    if (!start || velocities.empty() || !(time > 0)) return cases;
    constexpr int starts = 32;
    for (int m = 1; m <= starts; ++m) {
      Case c = question();
      const double passed = time * m / (starts + 1);
      for (std::size_t k = 0; k < 3; ++k) c.values[start->place + k] += passed * c.values[velocities[0] + k];
      for (std::size_t i = 0; i < c.values.size(); ++i) {
        const Role role = c.query->inputs[i].role;
        if (role == Role::time) c.values[i] = std::max(0.0, c.values[i] - passed);
        if (c.scalar == Scalar::float32) c.values[i] = double(float(c.values[i]));
      }
      cases.push_back(std::move(c));
    }
    return cases;
  }
  /// Of the exact answer, or else of the given one; 0 where there is none.
  double contact_time() const {
    if (trials_.query().kind != Kind::impact) return 0;
    for (const Alternative& right : truth_of(question()).alternatives) {
      if (right.yes) return std::max(0.0, right.values[0].low);
    }
    const Answer& a = trials_.base().answer;
    return a.status == Answer::Status::answered && a.yes && std::isfinite(a.values[0]) ? std::max(0.0, a.values[0]) : 0;
  }

  // Logic

  /// Nothing that changes arithmetic alone changes the finding.
  std::optional<Named> logic() {
    const bool no_flip =
        std::none_of(scans_.begin(), scans_.end(), [](const ScaleScan& s) { return s.flip.has_value(); });
    if (is_exact() && no_flip)
      return Named{CauseKind::logic, "",
                   "The subject's arithmetic is exact here, and its answer is wrong at every scale."};
    constexpr int order = 13;
    const std::vector<Trial> around = trials_.ask(relative_neighbours(question(), neighbours, order, seed_ + 2));
    const std::size_t same = count(around, Outcome::same), all = around.size() - count(around, Outcome::none);
    saw("Cases were asked whose numbers differ by up to a ten-thousandth.",
        fmt::format("{} have the finding.", of_text(same, all)));
    const bool stays = same_in_all_roundings() && no_flip && nearly_all(near_same_, near_all_) && nearly_all(same, all);
    if (!stays) return std::nullopt;
    return Named{
        CauseKind::logic, "",
        "The answer stays wrong in every rounding mode, at every scale and for all cases nearby: the mistake is in "
        "the logic."};
  }

  Trials trials_;
  std::uint64_t seed_;
  IsRight is_right_ = [this](const Case& c, const Answer& a) { return trials_.is_right(c, a); };
  std::vector<Evidence> evidence_;
  std::optional<std::vector<Trial>> variants_;
  std::vector<Trial> sample_, roundings_;
  std::vector<ScaleScan> scans_;
  std::size_t near_same_ = 0, near_right_ = 0, near_all_ = 0;
};

}  // namespace

Cause cause_of(const Report& report, const Subject& subject, const CauseLimits& limits, Workers& workers) {
  return Investigation(report, subject, limits, workers).result();
}

std::string_view name_of(CauseKind kind) {
  switch (kind) {
    case CauseKind::rounding: return "rounding";
    case CauseKind::absolute_tolerance: return "absolute tolerance";
    case CauseKind::iteration_limit: return "iteration limit";
    case CauseKind::unsupported: return "unsupported";
    case CauseKind::overflow: return "overflow";
    case CauseKind::underflow: return "underflow";
    case CauseKind::convention: return "convention";
    case CauseKind::logic: return "logic";
    case CauseKind::unexplained: return "unexplained";
  }
  return "?";
}

nlohmann::ordered_json cause_to_json(const Cause& cause) {
  nlohmann::ordered_json evidence = nlohmann::ordered_json::array();
  for (const Evidence& e : cause.evidence) evidence.push_back({{"test", e.test}, {"result", e.result}});
  return {{"kind", name_of(cause.kind)},
          {"key", cause.key},
          {"text", cause.text},
          {"evidence", evidence},
          {"questions", cause.questions}};
}

std::string cause_text(const Cause& cause) {
  const std::string key = cause.key.empty() ? "" : fmt::format(" ({})", cause.key);
  std::string text = fmt::format("Cause: {}{}\n", name_of(cause.kind), key) + wrapped_text(cause.text, "  ");
  for (const Evidence& e : cause.evidence) text += wrapped_text(fmt::format("* {} {}", e.test, e.result), "  ");
  return text;
}

}  // namespace nearmiss
