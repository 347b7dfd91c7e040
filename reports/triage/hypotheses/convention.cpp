#include "reports/triage/hypotheses/hypotheses.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/findings/text.hpp"
#include "reports/triage/geometry/magnitudes.hpp"
#include "reports/triage/hypotheses/readings.hpp"

namespace nearmiss {

namespace {

class TestOfReadings : public TestOfCause {
 public:
  using TestOfCause::TestOfCause;

  /// Of the readings that hold, the one that makes the most wrong answers right: a part of a convention explains fewer.
  std::optional<Named> named() {
    if (trials().base().answer.status != Answer::Status::answered) return std::nullopt;
    std::optional<Held> best;
    for (const Reading& reading : readings()) {
      const auto held = held_by(reading);
      if (held && (!best || held->made_right() > best->made_right())) best = held;
    }
    if (best) return named_reading(*best);
    const std::string which =
        by_chance_.empty() ? "" : fmt::format(" Right for this case, but not for others: {}.", list_text(by_chance_));
    saw(fmt::format("{} other meanings of the inputs and of the answer were tried.", readings().size()),
        "None explains the answers." + which,
        explains_most_ ? std::vector{CauseKind::logic} : std::vector<CauseKind>{});
    return std::nullopt;
  }

 private:
  /// A number of the answer is not finite.
  bool is_undefined() const { return trials().base().finding.disagreement == Disagreement::not_finite; }
  /// Whether the reading replaces this number in other answers.
  bool replaces_undefined(const Reading& reading) {
    const Answer& own = trials().base().answer;
    bool replaces = false;
    for (const Trial& t : asked_.sample()) {
      if (t.answer.status != Answer::Status::answered || replaces) continue;
      reading.right(t.question, t.answer, [&](const Case&, const Answer& read) {
        for (std::size_t i = 0; i < trials().query().outputs.size(); ++i)
          replaces |= own.gives(i) && !std::isfinite(own.values[i]) && read.values[i] != t.answer.values[i];
        return false;
      });
    }
    return replaces;
  }
  /// A right answer without numbers is right by chance in half of the cases.
  bool gives_numbers() const { return trials().query().kind != Kind::decision; }
  /// How the subject's answers fit a reading.
  struct Support {
    std::size_t with_finding = 0, explained = 0;  ///< cases with the finding, and those that the reading explains
    std::size_t for_it = 0;      ///< generated cases with a wrong answer that is right under the reading
    std::size_t wrong = 0;       ///< generated cases with a wrong answer, of which the reading says something
    std::size_t against_it = 0;  ///< generated cases with a right answer that is wrong under the reading
    static constexpr std::size_t least_generated = 2;

    /// A convention holds in every case. A reading that explains wrong answers by chance makes right ones wrong.
    bool holds(bool is_of_numbers) const {
      constexpr std::size_t least = 4, many = 16;
      const auto nearly = is_of_numbers ? all_but_few : nearly_all;
      const bool is_rare = explained >= many && explained == with_finding && for_it == wrong;  // among generated cases
      return explained >= least && nearly(explained, with_finding) && for_it >= (is_rare ? 1 : least_generated) &&
             nearly(for_it, for_it + against_it);
    }
    /// Where the reading says nothing about the case, it must explain nearly all wrong answers, and make none wrong.
    bool holds_without_case() const {
      constexpr std::size_t least = 16;
      return for_it >= least && nearly_all(for_it, wrong) && against_it == 0;
    }
    /// Other numbers may explain most answers of a wrong formula by chance: more than a few exceptions count.
    static bool all_but_few(std::size_t part, std::size_t all) {
      constexpr std::size_t one_in = 32;
      return nearly_all(part, all) && all - part <= 1 + all / one_in;
    }
  };
  struct Held {
    const Reading* reading;
    Support support, fresh{};
    std::size_t made_right() const { return support.for_it + fresh.for_it; }
  };
  std::optional<Held> held_by(const Reading& reading) {
    if (reading.decides && !asked_.is_wrong_decision()) return std::nullopt;
    const auto fits = reading.right(question(), trials().base().answer, asked_.is_right());
    if (!fits.value_or(is_undefined() && replaces_undefined(reading))) return std::nullopt;
    if (is_miss() && is_vacuous(reading)) return std::nullopt;
    if (reading.decides && is_wrong_without(reading)) return std::nullopt;
    const Support s = support_of(reading);
    if (!fits) return s.holds_without_case() ? std::optional(Held{&reading, s}) : std::nullopt;
    const bool is_exact = !reading.decides && gives_numbers();  // what decides holds in every case
    const bool holds = s.holds(!reading.decides) && (is_exact || s.against_it == 0);
    Support fresh;
    if (holds) count_generated(reading, asked_.fresh(), fresh);
    if (holds && holds_for_fresh_cases(reading, s, fresh)) return Held{&reading, s, fresh};
    asked_.refute(reading.name);
    // A mistake of logic is left over where nothing else explains the answers: this explains most of them.
    if (most(s.explained, s.with_finding) && s.for_it >= Support::least_generated && s.against_it == 0)
      explains_most_ = true;
    by_chance_.push_back(fmt::format("{} ({} with the finding, {} generated ones made right, {} wrong)", reading.name,
                                     of_text(s.explained, s.with_finding), s.for_it, s.against_it));
    return std::nullopt;
  }
  /// Whether most answers have the finding where the reading makes no difference. Then it explains the others by
  /// chance.
  bool is_wrong_without(const Reading& reading) {
    constexpr std::size_t least = 4;
    std::size_t all = 0, wrong = 0;
    for (const Trial& t : asked_.sample()) {
      const bool is_alike = t.outcome != Outcome::none && t.finding.truth_yes == trials().base().finding.truth_yes;
      if (!is_alike || is_of_another_branch(reading, t.question)) continue;
      if (reading.right(t.question, t.answer, asked_.is_right())) continue;
      ++all, wrong += t.outcome == Outcome::same;
    }
    return all >= least && most(wrong, all);
  }
  bool is_miss() const { return trials().base().finding.disagreement == Disagreement::false_miss; }
  /// Whether the reading says of nearly every hit that it is a miss, and explains no hit that the subject gives. Then
  /// it explains every false miss, whatever its cause.
  bool is_vacuous(const Reading& reading) {
    Answer miss;
    if (const auto* time = trials().query().layout.at(Role::time)) miss.values[time->begin] = INFINITY;
    std::size_t hits = 0, misses = 0, explained = 0;
    for (const Trial& t : asked_.sample()) {
      if (t.outcome == Outcome::none) continue;
      if (t.finding.truth_yes) ++hits, misses += reading.right(t.question, miss, asked_.is_right()).value_or(false);
      const bool is_wrong_hit = t.outcome != Outcome::right && t.answer.yes;
      explained += is_wrong_hit && reading.right(t.question, t.answer, asked_.is_right()).value_or(false);
    }
    return nearly_all(misses, hits) && explained == 0;
  }
  /// As the sample was used to choose among the readings, other generated cases must not contradict the chosen one.
  bool holds_for_fresh_cases(const Reading& reading, const Support& s, const Support& fresh) const {
    const bool contradicts =
        (reading.decides || (!gives_numbers() && asked_.is_wrong_decision())) && fresh.against_it > 0;
    return !contradicts &&
           (fresh.for_it + fresh.against_it == 0 ||
            nearly_all(s.for_it + fresh.for_it, s.for_it + fresh.for_it + s.against_it + fresh.against_it)) &&
           (fresh.with_finding == 0 || nearly_all(fresh.explained, fresh.with_finding));
  }
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
  /// A start in contact is a branch of its own in many implementations, and so is each value of a flag. A reading of
  /// the flag itself is about both values.
  bool is_of_another_branch(const Reading& reading, const Case& c) const {
    const auto inputs = c.fields();
    const bool is_of_flag = reading.name.starts_with("flag");
    for (std::size_t i = 0; i < inputs.size() && !is_of_flag; ++i) {
      if (inputs[i].role == Role::flag && c.values[i] != question().values[i]) return true;
    }
    return starts_in_contact(c) != starts_in_contact(question());
  }
  Support support_of(const Reading& reading) {
    Support s;
    for (const Trial& t : asked_.similar())
      count_finding(reading, reading.right(t.question, t.answer, asked_.is_right()), s);
    count_generated(reading, asked_.sample(), s);
    return s;
  }
  void count_generated(const Reading& reading, const std::vector<Trial>& generated, Support& s) {
    for (const Trial& t : generated) {
      if (t.outcome == Outcome::none) continue;
      if (t.outcome == Outcome::right && is_of_another_branch(reading, t.question)) continue;
      const std::optional<bool> fits = reading.right(t.question, t.answer, asked_.is_right());
      s.against_it += contradicts(reading, t) && !fits.value_or(true);
      s.for_it += t.outcome != Outcome::right && fits.value_or(false);
      s.wrong += t.outcome != Outcome::right && fits.has_value();
      if (t.outcome == Outcome::same) count_finding(reading, fits, s);
    }
  }

  Named named_reading(const Held& held) {
    const Reading& reading = *held.reading;
    const Support& s = held.support;
    if (held.fresh.wrong > 0)
      saw(fmt::format("Other cases were generated and judged as if {}.", reading.what),
          fmt::format("{} with the finding are right then; {} wrong answers become right, and {} right ones wrong.",
                      of_text(held.fresh.explained, held.fresh.with_finding), held.fresh.for_it,
                      held.fresh.against_it));
    saw(fmt::format("The answers were judged as if {}.", reading.what),
        fmt::format("The answer to the case is right then, and so are those to {} other cases with the finding. Of the "
                    "generated cases, {} wrong answers become right, and {} right ones become wrong.",
                    of_text(s.explained, s.with_finding), s.for_it, s.against_it));
    const std::string divisor = reading.name == "normal not of unit length" ? told_length_of_normals() : "";
    return {reading.kind, std::string(reading.name), fmt::format("The answer is right if {}.{}", reading.what, divisor),
            predictions_of(reading)};
  }
  /// The length of the given normal; 0 where there is none.
  static double length_of_normal(const Trial& t) {
    const Layout::Part* p = given_part(t.question, t.answer, Role::normal);
    if (p == nullptr || p->end - p->begin != 3) return 0;
    return std::hypot(t.answer.values[p->begin], t.answer.values[p->begin + 1], t.answer.values[p->begin + 2]);
  }
  /// " The length of the normal is A over B.", where the lengths A and B of each case have this quotient; or that of A
  /// or of 1 over A alone.
  std::string told_length_of_normals() {
    constexpr std::size_t least = 4, most_cases = 12;
    std::vector<std::pair<double, std::vector<Magnitude>>> cases;
    const auto add = [&](const Trial& t) {
      const double size = length_of_normal(t);
      if (t.outcome != Outcome::same || !(size > 0) || cases.size() == most_cases) return;
      cases.emplace_back(size, magnitudes_of(t.question).lengths);
      cases.back().second.push_back({"1", 1});
    };
    add(trials().base());
    for (const auto* list : {&asked_.sample(), &asked_.similar()}) std::for_each(list->begin(), list->end(), add);
    if (cases.size() < least) return "";
    const std::size_t count = cases[0].second.size();
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t k = 0; k < count; ++k) {
        if (i != k && are_quotients(cases, i, k))
          return fmt::format(" The length of the normal is {} over {}.", cases[0].second[i].name,
                             cases[0].second[k].name);
      }
    }
    return "";
  }
  static bool are_quotients(const std::vector<std::pair<double, std::vector<Magnitude>>>& cases, std::size_t i,
                            std::size_t k) {
    constexpr double known = 1e-6;  // less than the measure, more than the rounding of what is computed here
    return std::all_of(cases.begin(), cases.end(), [&](const auto& c) {
      const double above = double(c.second[i].value), below = double(c.second[k].value);
      return below > 0 && std::abs(c.first * below - above) <= known * above;
    });
  }

  std::vector<std::string> by_chance_;  ///< readings under which the answer to this case alone is right
  bool explains_most_ = false;          ///< one of them makes most of the wrong answers right, and no right one wrong
};

}  // namespace

Tested convention_of(AskedCases& asked) {
  TestOfReadings test(asked);
  return test.finished(test.named());
}

}  // namespace nearmiss
