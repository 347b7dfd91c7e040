#include "reports/explain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "reports/text.hpp"

namespace nearmiss {

namespace {

std::string top_member(std::string_view field) { return std::string(field.substr(0, field.find('.'))); }

bool has_role(const std::vector<Field>& fields, Role role) {
  return std::any_of(fields.begin(), fields.end(), [&](const Field& f) { return f.role == role; });
}

int index_of(const std::vector<Field>& fields, Role role) {
  const auto at = std::find_if(fields.begin(), fields.end(), [&](const Field& f) { return f.role == role; });
  return at == fields.end() ? -1 : int(at - fields.begin());
}

/// The two things of which the query asks whether they meet: inputs whose names are words of its own
/// name ("the sphere", "the box"; "box 1", "box 2"). Empty where there are not just two.
std::vector<std::string> things(const Query& query) {
  const std::string words = fmt::format("_{}_", query.name);
  std::vector<std::string> members, found;
  for (const Field& f : query.inputs) {
    const std::string member = top_member(f.name);
    if (!members.empty() && members.back() == member) continue;
    members.push_back(member);
    const std::string noun = member.substr(0, member.find_last_not_of("0123456789") + 1);
    if (words.find(fmt::format("_{}_", noun)) == std::string::npos) continue;
    found.push_back(noun == member ? fmt::format("the {}", noun)
                                   : fmt::format("{} {}", noun, member.substr(noun.size())));
  }
  return found.size() == 2 ? found : std::vector<std::string>{};
}

/// Yes and no in the words of the query.
struct Phrases {
  std::string yes, no;              ///< "the sphere touches the box"
  std::string they_yes, they_no;    ///< "they touch"
  std::string still_yes, still_no;  ///< "they would still touch"
};

Phrases phrases(const Query& query) {
  const std::vector<std::string> two = things(query);
  if (two.empty()) {
    return {"the answer is yes",           "the answer is no", "it is yes", "it is no", "the answer would still be yes",
            "the answer would still be no"};
  }
  if (query.kind == Kind::impact || has_role(query.inputs, Role::velocity)) {
    return {two[0] + " touches " + two[1], two[0] + " never touches " + two[1], "they touch", "they never touch",
            "they would still touch",      "they would still never touch"};
  }
  const std::string both = two[0] + " and " + two[1];
  return {both + " touch or overlap",          both + " are apart",        "they touch or overlap", "they are apart",
          "they would still touch or overlap", "they would still be apart"};
}

/// " at time 0.5", " by 0.25": what makes a yes or no precise. Empty where the kind has no such number.
std::string measure_text(const Query& query, bool yes, const std::function<std::string(std::size_t)>& number) {
  const int time = index_of(query.outputs, Role::time), depth = index_of(query.outputs, Role::depth);
  if (query.kind == Kind::impact && yes && time >= 0) return " at time " + number(std::size_t(time));
  if (query.kind == Kind::depth && depth >= 0) return ", depth " + number(std::size_t(depth));
  return "";
}

/// The leaves of the member that `output` belongs to: "0.5" or "(1, 2, 3)".
std::string member_text(const Query& query, std::size_t output, const std::function<std::string(std::size_t)>& number) {
  const std::string member = top_member(query.outputs[output].name);
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < query.outputs.size(); ++i) {
    if (top_member(query.outputs[i].name) == member) parts.push_back(number(i));
  }
  return parts.size() == 1 ? parts[0] : fmt::format("({})", fmt::join(parts, ", "));
}


/// The sentences of one report.
class Explanation {
 public:
  explicit Explanation(const Report& r)
      : r_(r), query_(*r.question.query), scalar_(r.question.scalar), phrases_(phrases(query_)) {}

  std::string text() const {
    std::vector<std::string> sentences = says();
    if (const std::string s = excuse(); !s.empty()) sentences.push_back(s);
    if (const std::string s = promise(); !s.empty()) sentences.push_back(s);
    return fmt::format("{}.", fmt::join(sentences, ". "));
  }
  /// "misses a collision", "gives a wrong time".
  std::string fault() const {
    const bool moving = query_.kind == Kind::impact;
    switch (r_.finding.verdict) {
      case Verdict::broke: return "broke";
      case Verdict::cannot_answer: return "cannot answer";
      case Verdict::out_of_domain: return "promises nothing for a case";
      default: break;
    }
    switch (r_.finding.disagreement) {
      case Disagreement::none: return "agrees with the exact answer";
      case Disagreement::false_hit:
        return moving ? "reports a collision that is not there" : "says yes where no is right";
      case Disagreement::false_miss: return moving ? "misses a collision" : "says no where yes is right";
      case Disagreement::not_finite: return "answers with a number that is not finite";
      case Disagreement::not_unit: return "gives a normal that is not a unit vector";
      case Disagreement::off_surface: return "gives a " + worst_member() + " off the surface";
      default: return (is_plural(worst_member()) ? "gives wrong " : "gives a wrong ") + worst_member();
    }
  }

 private:
  std::string given(std::size_t i) const { return number_text(r_.answer.values[i], scalar_); }
  std::size_t worst() const { return r_.finding.worst < 0 ? 0 : std::size_t(r_.finding.worst); }
  std::string worst_member() const {
    return query_.outputs.empty() ? "answer" : top_member(query_.outputs[worst()].name);
  }
  static bool is_plural(std::string_view noun) { return noun.ends_with('s') && !noun.ends_with("is"); }  // not "axis"
  const Alternative* right_answer() const {
    return r_.truth.alternatives.empty() ? nullptr : &r_.truth.alternatives[0];
  }

  /// What it said, and what is true.
  std::vector<std::string> says() const {
    const std::string exactly = "Exactly, " + truth_text(query_, r_.truth);
    const Finding& f = r_.finding;
    if (f.verdict == Verdict::broke) return {fmt::format("{} gave no answer: {}", r_.subject, f.clause), exactly};
    if (f.verdict == Verdict::cannot_answer) {
      return {fmt::format("{} says that it cannot answer this case: {}", r_.subject, f.clause), exactly};
    }
    if (f.verdict == Verdict::out_of_domain) {
      return {r_.subject + " promises nothing for numbers of this size", "It says: " + decision(), exactly};
    }
    switch (f.disagreement) {
      case Disagreement::false_hit:
      case Disagreement::false_miss: return {fmt::format("{} says that {}", r_.subject, decision()), exactly};
      case Disagreement::none: return {fmt::format("{} agrees with the exact answer", r_.subject), exactly};
      case Disagreement::not_finite: return {fmt::format("{} answers, but {}", r_.subject, f.clause), exactly};
      case Disagreement::not_unit: return {not_unit(), exactly};
      default: return wrong_member();
    }
  }
  std::string decision() const {
    const Answer& a = r_.answer;
    if (!decides(query_.kind))
      return worst_member() + " is " + member_text(query_, worst(), [&](auto i) { return given(i); });
    const int measure = index_of(query_.outputs, query_.kind == Kind::depth ? Role::depth : Role::time);
    const bool measured = measure >= 0 && is_part(query_, a, std::size_t(measure));
    return (a.yes ? phrases_.yes : phrases_.no) +
           (measured ? measure_text(query_, a.yes, [&](auto i) { return given(i); }) : "");
  }
  std::string not_unit() const {
    const double length = 1 + r_.finding.unit_error * unit_roundoff(scalar_);
    return fmt::format("{} gives a normal of length {}, which is {:.3g} epsilon from 1", r_.subject,
                       number_text(length), std::abs(r_.finding.unit_error));
  }
  std::vector<std::string> wrong_member() const {
    const std::string member = worst_member();
    std::string said = fmt::format("{} gives {} {}", r_.subject, member,
                                   member_text(query_, worst(), [&](auto i) { return given(i); }));
    if (r_.finding.disagreement == Disagreement::off_surface) {
      said += ", which is off the surface that it is to lie on";
    }
    const Alternative* right = right_answer();
    if (right == nullptr) return {said};
    if (right->many_normals && query_.outputs[worst()].role == Role::normal) {
      return {said, "Many normals are right there, and this is none of them"};
    }
    const std::string exact =
        member_text(query_, worst(), [&](std::size_t i) { return bounds_text(right->values[i]); });
    const std::string one_of = r_.truth.alternatives.size() > 1 ? "One exact answer is " : "Exactly, it is ";
    return {said, fmt::format("{}{}: {} is off by {:.3g}, {:.3g} units in the last place", one_of, exact,
                              query_.outputs[worst()].name, r_.finding.forward_absolute, r_.finding.forward_ulps)};
  }

  /// How far the inputs may move without making the answer right.
  std::string excuse() const {
    const Finding& f = r_.finding;
    if (f.disagreement == Disagreement::none || !f.backward) return "";
    if (f.disagreement == Disagreement::not_finite || f.disagreement == Disagreement::not_unit) return "";
    const double above = f.backward->above;
    if (above == 0) {
      return "This is proved for exactly these numbers; moving them by one rounding error may make the answer right";
    }
    if (const double still = same_decision_within(); still > 0 && still >= above) {
      return fmt::format("Even if every input number were moved by up to {}, {}", amount_text(still, scalar_),
                         r_.truth.yes ? phrases_.still_yes : phrases_.still_no);
    }
    return fmt::format("Moving every input number by up to {} cannot make that answer right",
                       amount_text(above, scalar_));
  }
  /// For a wrong decision: the truth is proved to stay as it is for inputs this near, in epsilon.
  double same_decision_within() const {
    const Finding& f = r_.finding;
    if (f.disagreement == Disagreement::false_miss && query_.kind != Kind::depth) {
      return std::max(f.backward->above, r_.truth.margin_at_least);  // a miss has no number that could differ
    }
    return f.disagreement == Disagreement::false_miss || f.disagreement == Disagreement::false_hit
               ? r_.truth.margin_at_least
               : -1;
  }

  std::string promise() const {
    const char* it = held_to_one_measure() ? "It is held to" : "It promises";
    const Finding& f = r_.finding;
    if (f.verdict == Verdict::within_contract) {
      return r_.contract.backward == collide::Contract::none && r_.contract.forward == collide::Contract::none
                 ? "It promises nothing that this would break"
                 : "Its contract allows that";
    }
    if (f.verdict != Verdict::violates_contract || f.disagreement == Disagreement::not_finite) return "";
    if (f.clause.starts_with("backward")) {
      return fmt::format("{} a backward error of at most {} epsilon, which is {} times less", it,
                         epsilons_text(r_.contract.backward), factor());
    }
    return fmt::format("{} {}", it, f.clause);
  }
  std::string factor() const {
    const double above = r_.finding.backward->above;
    return r_.contract.backward > 0 ? count_text(std::uint64_t(std::max(1.0, above / r_.contract.backward)))
                                    : std::string("infinitely many");
  }

  const Report& r_;
  const Query& query_;
  const Scalar scalar_;
  const Phrases phrases_;
};

}  // namespace

std::string headline(const Report& r) {
  std::string line = fmt::format("{} {} in {}", r.subject, Explanation(r).fault(), r.question.query->name);
  if (r.finding.verdict == Verdict::broke) return line + ": " + r.finding.clause;
  if (r.finding.disagreement == Disagreement::none || !r.finding.backward) return line;
  const double above = r.finding.backward->above;
  return line + (above == 0 ? ", on a knife's edge"
                            : fmt::format(", by more than {} epsilon of backward error", epsilons_text(above)));
}

std::string explanation(const Report& r) { return Explanation(r).text(); }

std::string answer_text(const Query& query, const Answer& answer, Scalar scalar) {
  if (answer.status == Answer::Status::cannot_answer) return "cannot answer";
  if (answer.status == Answer::Status::broke) return "broke";
  const auto number = [&](std::size_t i) {
    return is_part(query, answer, i) ? number_text(answer.values[i], scalar) : "?";
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
    return right != nullptr && i < right->count ? bounds_text(right->values[i]) : std::string("?");
  };
  if (!decides(query.kind)) {
    return top_member(query.outputs[0].name) + " is " + member_text(query, 0, number);
  }
  const Phrases p = phrases(query);
  return (truth.yes ? p.they_yes : p.they_no) + (right == nullptr ? "" : measure_text(query, truth.yes, number));
}

}  // namespace nearmiss
