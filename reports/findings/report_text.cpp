#include "reports/findings/report_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "oracles/requirements.hpp"
#include "reports/findings/text.hpp"

namespace nearmiss {

namespace {

/// The decisions in the words of the query.
struct Phrases {
  std::string yes, no;              ///< "the sphere hits the box"
  std::string it_yes, it_no;        ///< "it is a hit"
  std::string still_yes, still_no;  ///< "it would still be a hit"
};

/// The phrases say "hit" and "miss" in the sense of the query: by its definition, for example, a separating contact is
/// a miss although the bodies touch.
Phrases phrases(const Query& query) {
  const auto& [yes, no] = query.traits.decision;
  if (!yes.empty()) {
    return {std::string(yes),
            std::string(no),
            "the answer is yes",
            "the answer is no",
            "the answer would still be yes",
            "the answer would still be no"};
  }
  const std::string &one = query.operands[0].words, &other = query.operands[1].words;
  if (query.kind == Kind::impact || !query.operands.velocities.empty()) {
    return {fmt::format("{} hits {}", one, other),
            fmt::format("{} does not hit {}", one, other),
            "it is a hit",
            "it is a miss",
            "it would still be a hit",
            "it would still be a miss"};
  }
  const std::string both = fmt::format("{} and {}", one, other);
  return {both + " touch or overlap",          both + " are apart",        "they touch or overlap", "they are apart",
          "they would still touch or overlap", "they would still be apart"};
}

/// The number that completes a decision: " at time 0.5", ", depth 0.25". Empty where the kind has no such number.
std::string measure_text(const Query& query, bool yes, const std::function<std::string(std::size_t)>& number) {
  const Layout::Part *time = query.layout.at(Role::time), *depth = query.layout.at(Role::depth);
  if (query.kind == Kind::impact && yes && time != nullptr) return " at time " + number(time->begin);
  if (query.kind == Kind::depth && depth != nullptr) return ", depth " + number(depth->begin);
  return "";
}

/// The numbers of a member: "0.5" or "(1, 2, 3)".
std::string member_text(const Query& query, std::size_t member, const std::function<std::string(std::size_t)>& number) {
  const Layout::Part& part = query.layout.parts[member];
  std::vector<std::string> parts;
  for (std::size_t i = part.begin; i < part.end; ++i) parts.push_back(number(i));
  return parts.size() == 1 ? parts[0] : fmt::format("({})", fmt::join(parts, ", "));
}

/// The largest distance of a given number of a member from the alternative, and the index of that number.
struct Off {
  double by = 0;
  std::size_t number = 0;
};
Off off_by(const Layout::Part& part, const Alternative& right, const Answer& given) {
  Off off{0, part.begin};
  for (std::size_t i = part.begin; i < part.end; ++i) {
    const Bounds& b = right.values[i];
    const double by = std::max({0.0, b.low - given.values[i], given.values[i] - b.high});
    if (by > off.by) off = {by, i};
  }
  return off;
}

double length(const Case& question, Role role) {
  double square = 0;
  for (std::size_t i = 0; i < question.values.size(); ++i) {
    if (question.role(i) == role) square += question.values[i] * question.values[i];
  }
  return std::sqrt(square);
}

/// The sentences of one report.
class Explanation {
 public:
  explicit Explanation(const Report& r)
      : r_(r), query_(*r.question.query), scalar_(r.question.scalar), phrases_(phrases(query_)) {}

  std::string text() const {
    std::vector<std::string> sentences = statement();
    if (const std::string s = excuse(); !s.empty()) sentences.push_back(s);
    if (const std::string s = others(); !s.empty()) sentences.push_back(s);
    if (const std::string s = promise(); !s.empty()) sentences.push_back(s);
    if (!r_.declared.empty()) sentences.push_back("It declares: " + declarations_text(r_.declared));
    return fmt::format("{}.", fmt::join(sentences, ". "));
  }
  /// "misses a collision", "gives a wrong time".
  std::string fault() const {
    switch (r_.finding.verdict) {
      case Verdict::broke: return "broke";
      case Verdict::cannot_answer: return "cannot answer";
      case Verdict::out_of_domain: return "promises nothing for a case";
      case Verdict::not_asked: return "is not asked a case";
      default: return fault_of(r_.finding.disagreement, member());
    }
  }
  /// The proved backward bound of the member in the headline, or of the whole answer.
  std::optional<double> above() const {
    const MemberFinding* head = r_.finding.headline_member();
    if (head != nullptr) return head->backward ? std::optional(head->backward->above) : std::nullopt;
    return r_.finding.backward ? std::optional(r_.finding.backward->above) : std::nullopt;
  }

 private:
  std::string given(std::size_t i) const { return value_text(r_.answer.values[i], scalar_); }
  /// The index in the layout of the member in the headline.
  std::size_t member() const {
    const MemberFinding* head = r_.finding.headline_member();
    return head == nullptr || head->member < 0 ? 0 : std::size_t(head->member);
  }
  std::string name_of_member(std::size_t member) const {
    return query_.layout.parts.empty() ? "answer" : query_.layout.parts[member].name;
  }
  std::string given_member(std::size_t member) const {
    return member_text(query_, member, [&](auto i) { return given(i); });
  }
  static bool is_plural(std::string_view noun) { return noun.ends_with('s') && !noun.ends_with("is"); }  // not "axis"

  std::string fault_of(Disagreement d, std::size_t member) const {
    const bool moving = query_.kind == Kind::impact;
    const std::string name = name_of_member(member);
    switch (d) {
      case Disagreement::none: return "agrees with the exact answer";
      case Disagreement::false_hit:
        return moving ? "reports a collision that is not there" : "says yes where no is right";
      case Disagreement::false_miss: return moving ? "misses a collision" : "says no where yes is right";
      case Disagreement::not_finite: return fmt::format("gives a {} that is not finite", name);
      case Disagreement::not_unit: return fmt::format("gives a {} that is not a unit vector", name);
      case Disagreement::negative_time: return fmt::format("gives a negative {}", name);
      case Disagreement::off_surface: return fmt::format("gives a {} off the surface", name);
      case Disagreement::wrong_combination: return "gives members that are not right together";
      default: return (is_plural(name) ? "gives wrong " : "gives a wrong ") + name;
    }
  }

  /// The given and the exact answer.
  std::vector<std::string> statement() const {
    const std::string exactly = "Exactly, " + truth_text(query_, r_.truth);
    const Finding& f = r_.finding;
    if (f.verdict == Verdict::broke) return {fmt::format("{} gave no answer: {}", r_.subject, f.clause), exactly};
    if (f.verdict == Verdict::cannot_answer) {
      return {fmt::format("{} says that it cannot answer this case: {}", r_.subject, f.clause), exactly};
    }
    if (f.verdict == Verdict::not_asked) return {fmt::format("{} is not asked: {}", r_.subject, f.clause), exactly};
    if (f.verdict == Verdict::out_of_domain) {
      return {fmt::format("{} promises nothing for numbers of this size: {}", r_.subject, domain()),
              "It says: " + decision(), exactly};
    }
    switch (f.disagreement) {
      case Disagreement::false_hit:
      case Disagreement::false_miss: return {fmt::format("{} says that {}", r_.subject, decision()), exactly};
      case Disagreement::none: return {fmt::format("{} agrees with the exact answer", r_.subject), exactly};
      case Disagreement::not_finite: return {fmt::format("{} answers, but {}", r_.subject, not_finite()), exactly};
      case Disagreement::not_unit: return {not_unit(), exactly};
      case Disagreement::wrong_combination:
        return {fmt::format("{} gives members that no right answer has together", r_.subject), exactly};
      default: return wrong_member();
    }
  }
  /// The domain of the contract, in words.
  std::string domain() const {
    const collide::Contract& c = r_.standard.contract;
    return fmt::format("the largest number of each group must be 0 or lie between 2^{} and 2^{}", c.lowest, c.highest);
  }
  std::string not_finite() const { return r_.finding.headline_member()->clause; }
  std::string decision() const {
    const Answer& a = r_.answer;
    if (!decides(query_.kind)) return name_of_member(member()) + " is " + given_member(member());
    const Layout::Part* measure = query_.layout.at(query_.kind == Kind::depth ? Role::depth : Role::time);
    const bool measured = measure != nullptr && is_part(query_, a, measure->begin);
    return (a.yes ? phrases_.yes : phrases_.no) +
           (measured ? measure_text(query_, a.yes, [&](auto i) { return given(i); }) : "");
  }
  std::string not_unit() const {
    return fmt::format("{} gives a normal of length {}, which is {:.3g} epsilon from 1", r_.subject,
                       number_text(length_of_normal()), std::abs(r_.finding.unit_error));
  }
  double length_of_normal() const {
    double length = 0;
    for (std::size_t i = 0; i < query_.outputs.size(); ++i) {
      if (query_.outputs[i].role == Role::normal) length = std::hypot(length, r_.answer.values[i]);
    }
    return length;
  }
  /// The given member is a normal, and zero.
  bool is_without_direction(std::size_t member) const {
    return query_.layout.parts[member].role == Role::normal && length_of_normal() == 0;
  }
  /// The right answer whose member is nearest to the given one.
  const Alternative* nearest(std::size_t member) const {
    const Layout::Part& part = query_.layout.parts[member];
    const Alternative* nearest = nullptr;
    for (const Alternative& a : r_.truth.alternatives) {
      if (a.yes != r_.answer.yes || a.count < part.end) continue;
      if (nearest == nullptr || off_by(part, a, r_.answer).by < off_by(part, *nearest, r_.answer).by) nearest = &a;
    }
    return nearest;
  }
  std::vector<std::string> wrong_member() const {
    const MemberFinding& head = *r_.finding.headline_member();
    const Layout::Part& part = query_.layout.parts[member()];
    std::string said = fmt::format("{} gives {} {}", r_.subject, name_of_member(member()), given_member(member()));
    if (head.disagreement == Disagreement::off_surface) said += ", which is off the surface that it is to lie on";
    if (is_without_direction(member())) said += ", which has no direction";
    if (r_.answer.yes != r_.truth.yes) {
      return {
          said, "Exactly, " + truth_text(query_, r_.truth),
          fmt::format("But for that decision the {} is wrong wherever it would be right", name_of_member(member()))};
    }
    const Alternative* right = nearest(member());
    if (right == nullptr) return {said};
    if (right->many_normals && part.role == Role::normal) {
      return {said, right->facing.empty() ? "Any unit vector is right there"
                                          : "Many normals are right there, and this is none of them"};
    }
    const std::string exact = member_text(query_, member(), [&](std::size_t i) { return right->decimals[i]; });
    const std::string one_of = r_.truth.alternatives.size() > 1 ? "The nearest exact answer is " : "Exactly, it is ";
    const Off off = off_by(part, *right, r_.answer);
    return {said, fmt::format("{}{}: {} is off by {:.3g}{}, {:.3g} units in the last place", one_of, exact,
                              query_.outputs[off.number].name, off.by, travelled(part, off.by), head.forward_ulps)};
  }
  /// The length of the motion in the time `by`, and its share of the scene: puts an error of a time into proportion.
  std::string travelled(const Layout::Part& part, double by) const {
    const double speed = length(r_.question, Role::velocity);
    if (part.role != Role::time || !(speed > 0)) return "";
    double extent = 0;
    for (std::size_t i = 0; i < r_.question.values.size(); ++i) {
      const Role role = r_.question.role(i);
      if (role == Role::position || role == Role::size) extent = std::max(extent, std::abs(r_.question.values[i]));
    }
    const std::string share =
        extent > 0 ? fmt::format(", {:.2g} of the largest position or size", by * speed / extent) : "";
    return fmt::format(" (in which the motion covers {:.2g}{})", by * speed, share);
  }

  /// How far the inputs may move without making the answer right; empty where nothing is proved.
  std::string excuse() const {
    const Finding& f = r_.finding;
    const std::optional<double> proved = above();
    if (f.disagreement == Disagreement::none || !proved) return "";
    const std::string why = f.ended_by.empty() ? "" : ", which may break a precondition: " + requires_text(f.ended_by);
    if (*proved == 0) {
      return "This is proved for exactly these numbers; nothing is proved for the numbers next to them" + why;
    }
    if (const double still = same_decision_within(); still > 0 && still >= *proved) {
      return fmt::format("Even after moving {}, {}", moves_text(r_.question, still),
                         r_.truth.yes ? phrases_.still_yes : phrases_.still_no);
    }
    const std::string beyond = why.empty() ? "" : "; nothing is proved for inputs further away" + why;
    return fmt::format("Moving {} cannot make that {} right{}", moves_text(r_.question, *proved), what_differs(),
                       beyond);
  }
  std::string what_differs() const {
    const MemberFinding* head = r_.finding.headline_member();
    return head == nullptr || head->member < 0 ? "answer" : name_of_member(member());
  }
  /// For a wrong decision: the exact decision is proved to be the same for all inputs within this many epsilon.
  double same_decision_within() const {
    const Finding& f = r_.finding;
    if (!f.ended_by.empty()) return -1;
    if (f.disagreement == Disagreement::false_miss && query_.kind != Kind::depth) {
      return std::max(f.backward->above, r_.truth.margin_at_least);  // a miss has no number that could differ
    }
    return f.disagreement == Disagreement::false_miss || f.disagreement == Disagreement::false_hit
               ? r_.truth.margin_at_least
               : -1;
  }
  /// The other wrong members.
  std::string others() const {
    std::vector<std::string> faults;
    for (std::size_t i = 0; i < r_.finding.members.size(); ++i) {
      const MemberFinding& m = r_.finding.members[i];
      if (int(i) == r_.finding.headline) continue;
      const std::string how = !m.backward ? ""
                              : m.backward->above == 0
                                  ? " for exactly these numbers"
                                  : fmt::format(", by more than {} epsilon", epsilons_text(m.backward->above));
      faults.push_back(fault_of(m.disagreement, m.member < 0 ? 0 : std::size_t(m.member)) + how);
    }
    return faults.empty() ? "" : "It also " + list_text(faults);
  }

  std::string promise() const {
    const collide::Contract& contract = r_.standard.contract;
    const char* it = r_.standard.promised ? "It promises"
                     : r_.scene           ? "The scene requires nothing of it; the measure is"
                                          : "It promises nothing; the measure is";
    const Finding& f = r_.finding;
    if (f.verdict == Verdict::not_proved) {
      if (promises_nothing(contract)) return "It promises nothing that this would break";
      if (r_.standard.promised) return "It is not proved to differ by more than it promises";
      if (r_.scene)
        return fmt::format("It is not proved to differ by more than the scene {} tolerates", r_.scene->scene);
      return "It promises nothing, and is not proved to differ by more than the measure";
    }
    const MemberFinding* head = f.headline_member();
    const bool clause_is_in_the_text =
        head != nullptr && !head->backward && head->disagreement != Disagreement::not_unit;
    if (!is_bad(f) || f.verdict == Verdict::broke || clause_is_in_the_text) return "";
    if (f.broken == Clause::scene) return "T" + f.clause.substr(1);  // "the scene NAME requires ..."
    if (f.broken == Clause::backward && !r_.standard.promised) {
      return fmt::format("{} a backward error of at most {:g} times the largest number in each group", it,
                         measure().error);
    }
    if (f.broken == Clause::backward) {
      return fmt::format("{} a backward error of at most {} epsilon", it, epsilons_text(contract.backward));
    }
    return fmt::format("{} {}", it, f.clause);
  }

  const Report& r_;
  const Query& query_;
  const Scalar scalar_;
  const Phrases phrases_;
};

}  // namespace

std::string declarations_text(const std::vector<Declaration>& declared) {
  std::vector<std::string> each;
  for (const Declaration& d : declared) {
    const std::string sentence = one_line(d.sentence, 300);
    each.push_back(sentence.empty() ? std::string(name_of(d.convention))
                                    : fmt::format("{} (\"{}\")", name_of(d.convention), sentence));
  }
  return fmt::format("{}", fmt::join(each, ", "));
}

std::string requirement_text(const SceneLimits& limits) {
  return fmt::format(
      "places and depths within {0:g} {1},{2} missed contacts at most {3:g} {1} deep, phantom contacts at most "
      "{0:g} {1} apart",
      limits.error, limits.unit, limits.time ? fmt::format(" times of impact within {:g} s,", *limits.time) : "",
      limits.missed_depth);
}

std::string scene_measure_text() {
  const SceneLimits* scene = scene_limits();
  return scene == nullptr ? "" : fmt::format("; the measure is what the scene {} requires", scene->scene);
}

std::string headline(const Report& r) {
  const Explanation e(r);
  std::string line = fmt::format("{} {} in {}", r.subject, e.fault(), r.question.query->name);
  if (r.finding.verdict == Verdict::broke) return line + ": " + r.finding.clause;
  const std::optional<double> above = e.above();
  if (r.finding.disagreement == Disagreement::none || !above) return line;
  return line + (*above == 0 ? ", for exactly these numbers"
                             : fmt::format(", by more than {} epsilon of backward error", epsilons_text(*above)));
}

std::string moves_text(const Case& question, double k) {
  const std::vector<double> by = widening(*question.query, question.values, question.scalar, k);
  std::vector<std::string> groups;
  const auto is_zero = [&](Role role) {  // such a group moves by the least number, which says nothing
    for (std::size_t i = 0; i < by.size(); ++i) {
      if (question.role(i) == role && question.values[i] != 0) return false;
    }
    return true;
  };
  for (std::size_t i = 0; i < by.size(); ++i) {
    if (!(by[i] > 0) || is_zero(question.role(i))) continue;
    std::string text = fmt::format("every {} by up to {:.2g}", name_of(question.role(i)), by[i]);
    if (std::find(groups.begin(), groups.end(), text) == groups.end()) groups.push_back(std::move(text));
  }
  const std::string moved = groups.empty() ? "every number by up to the least one" : list_text(groups);
  return fmt::format("{} ({})", moved, amount_text(k, question.scalar));
}

std::string explanation(const Report& r) { return Explanation(r).text(); }

std::string answer_text(const Query& query, const Answer& answer, Scalar scalar) {
  if (answer.status == Answer::Status::cannot_answer) return "cannot answer";
  if (answer.status == Answer::Status::broke) return "broke";
  const auto number = [&](std::size_t i) {
    return is_part(query, answer, i) ? value_text(answer.values[i], scalar) : "?";
  };
  switch (query.kind) {
    case Kind::decision: return answer.yes ? "yes" : "no";
    case Kind::impact: return answer.yes ? "hit" + measure_text(query, true, number) : "miss";
    case Kind::depth: return (answer.yes ? "overlap" : "apart") + measure_text(query, answer.yes, number);
    default: return member_text(query, 0, number);
  }
}

std::string truth_text(const Query& query, const Truth& truth) {
  const Alternative* right = truth.alternatives.empty() ? nullptr : &truth.alternatives[0];
  const auto number = [&](std::size_t i) {
    return right != nullptr && i < right->count ? right->decimals[i] : std::string("?");
  };
  if (!decides(query.kind)) return query.layout.parts[0].name + " is " + member_text(query, 0, number);
  const Phrases p = phrases(query);
  const std::string because = truth.because.empty() ? "" : ", because " + truth.because;
  return (truth.yes ? p.it_yes : p.it_no) + (right == nullptr ? "" : measure_text(query, truth.yes, number)) + because;
}

}  // namespace nearmiss
