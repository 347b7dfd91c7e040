#include "reports/triage/examination/subject_check.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "corpus/generator/fit.hpp"
#include "corpus/storage/store.hpp"
#include "impl/subject/printable.hpp"
#include "oracles/confirmed.hpp"
#include "oracles/declared_oracle.hpp"
#include "oracles/requirements.hpp"
#include "reports/findings/report_text.hpp"
#include "reports/findings/text.hpp"
#include "reports/triage/causes/tested.hpp"

namespace nearmiss {

namespace {

/// An ordinary case with the subject's answer.
struct Ordinary {
  Case question;
  std::string note;
  Answer answer{};
  bool is_right = false;
};

class SubjectCheck {
 public:
  SubjectCheck(const Query& query, const Subject& subject, Workers& workers)
      : query_(query), subject_(subject), standard_(subject.standard_for(query.name)), workers_(workers) {}

  CheckedQuery checked() {
    add_seeds();
    add_scenes();
    ask();
    CheckedQuery c;
    c.query = &query_;
    c.subject = subject_.name;
    c.asked = cases_.size();
    c.not_asked = not_asked_;
    for (const Ordinary& o : cases_) count(o, c);
    if (!wrong_.empty()) c.misreading = misreading();
    return c;
  }

 private:
  void add(const Case& question, std::string note) {
    const std::optional<Case> same = in_scalar(question, subject_.scalar);
    if (same && unmet_by(*same, standard_.required).empty()) cases_.push_back({*same, std::move(note)});
  }
  void add_seeds() {
    for (const StoredCase& s : stored_cases(query_)) {
      if (s.file.parent_path().parent_path().filename() == "seeds") add(s.question, s.note);
    }
  }
  void add_scenes() {
    constexpr std::size_t scenes = 64;
    constexpr std::uint64_t seed = 1;
    Case c;
    std::uint64_t index = 0;
    for (std::size_t added = 0; added < scenes;) {
      generate_inside(c, query_, subject_.scalar, seed, index++, standard_.required);
      if (c.moves.empty()) add(c, ""), ++added;
    }
  }
  /// A subject that breaks in half of such cases breaks in each of the first 16 with a chance of 2^-16: what does so
  /// has no answer to the query. To start a program again takes a third of a second.
  static constexpr std::size_t most_broken = 16;

  /// Without the cases behind those after which the subject is given up.
  void ask() {
    const std::size_t most = Workers::capacity_for(query_);
    std::vector<Case> questions;
    for (const Ordinary& o : cases_) questions.push_back(o.question);
    for (std::size_t first = 0; first < questions.size(); first += most) {
      const auto batch = std::span(questions).subspan(first, std::min(most, questions.size() - first));
      workers_.send(subject_, batch);
      const std::span<const Answer> answers = workers_.receive(subject_, most_broken);
      for (std::size_t k = 0; k < answers.size(); ++k) cases_[first + k].answer = answers[k];
      if (answers.size() < batch.size()) {
        not_asked_ = cases_.size() - first - answers.size();
        cases_.resize(first + answers.size());
        break;
      }
    }
    for (Ordinary& o : cases_) o.is_right = is_right(o.question, o.answer);
  }
  bool is_right(const Case& c, const Answer& a) const {
    if (a.status != Answer::Status::answered) return false;
    const Verdict v = confirmed(c, a, standard_, Detail::verdict).verdict;
    return v == Verdict::agrees || v == Verdict::not_proved || v == Verdict::out_of_domain;
  }
  void count(const Ordinary& o, CheckedQuery& c) {
    if (o.answer.status == Answer::Status::cannot_answer) {
      ++c.without_answer;
    } else if (o.answer.status == Answer::Status::broke) {
      if (c.broke++ == 0) c.why_broke = o.answer.reason();
    } else if (o.is_right) {
      ++c.right;
      right_.push_back(&o);
    } else {
      ++c.wrong;
      wrong_.push_back(&o);
      if (!c.example) c.example = {o.question, o.answer, truth_of(o.question, standard_.declared), o.note};
    }
  }

  /// Whether the answer is right under the readings; empty where none of them makes a difference. Two readings together
  /// must judge every number that the answer gives: one that leaves some out explains more by chance.
  std::optional<bool> fits(std::span<const Reading* const> all, const Case& c, const Answer& a) const {
    const auto judged = [this](const Case& other, const Answer& given) { return is_right(other, given); };
    if (all.size() == 1) return all[0]->right(c, a, judged);
    bool is_judged = false;
    const auto in_full = [&](const Case& other, const Answer& given) {
      is_judged = given.given == a.given;
      return is_judged && is_right(other, given);
    };
    const auto read_on = [&](const Case& other, const Answer& given) {
      return all[1]->right(other, given, in_full).value_or(in_full(other, given));
    };
    std::optional<bool> fit = all[0]->right(c, a, read_on);
    if (!fit) fit = all[1]->right(c, a, in_full);
    return fit ? std::optional(*fit && is_judged) : fit;
  }
  using Together = std::vector<const Reading*>;

  bool explains(const Together& all, const Ordinary& o) const {
    return fits(all, o.question, o.answer).value_or(false);
  }
  /// A meaning under which nearly everything is a miss explains a subject that misses everything: an answer that is a
  /// yes must speak for the readings or, where they are about decisions alone, be right without them.
  bool is_seen_in_a_yes(const Together& all) const {
    const bool decide = are_about_decisions(all);
    const auto speaks = [&](const Ordinary* o) { return o->answer.yes && (decide || explains(all, *o)); };
    return (!decide && std::any_of(wrong_.begin(), wrong_.end(), speaks)) ||
           std::any_of(right_.begin(), right_.end(), speaks);
  }
  static bool are_about_decisions(const Together& all) {
    return std::all_of(all.begin(), all.end(), [](const Reading* r) { return r->decides; });
  }
  bool spoil_a_right_answer(const Together& all) const {
    return std::any_of(right_.begin(), right_.end(),
                       [&](const Ordinary* o) { return !fits(all, o->question, o->answer).value_or(true); });
  }
  /// Takes the readings where they explain more wrong answers than `best`: nearly all, or for readings about decisions
  /// nearly all for which they make a difference.
  void try_together(Together all, Misreading& best) const {
    std::size_t explained = 0, affected = 0;
    const bool decide = are_about_decisions(all);
    for (const Ordinary* o : wrong_) {
      if (decide && o->answer.yes == exact_decision(o->question, standard_.declared))
        continue;  // its numbers are wrong
      const std::optional<bool> fit = fits(all, o->question, o->answer);
      affected += fit.has_value(), explained += fit.value_or(false);
    }
    if (!is_enough(all, explained, affected)) return;
    if (explained <= best.explained || spoil_a_right_answer(all) || !is_seen_in_a_yes(all)) return;
    best = {std::move(all), explained};
  }
  /// A decision without numbers is right by chance in half of the cases.
  bool is_enough(const Together& all, std::size_t explained, std::size_t affected) const {
    constexpr std::size_t least_of_decisions = 8;
    if (are_about_decisions(all)) return nearly_all(explained, affected);
    if (query_.kind != Kind::decision) return nearly_all(explained, wrong_.size());
    return explained == wrong_.size() && explained >= least_of_decisions;
  }
  /// Two meanings that are taken for others make most answers wrong.
  bool is_mostly_wrong() const {
    const auto yes = [](const Ordinary* o) { return o->answer.yes; };
    return 2 * wrong_.size() >= wrong_.size() + std::size_t(std::count_if(right_.begin(), right_.end(), yes));
  }
  /// Whether the readings explain some wrong answers, all but one: a look before all are judged.
  bool are_worth_a_try(const Together& all) const {
    constexpr std::size_t few = 6;
    const std::size_t step = std::max<std::size_t>(1, wrong_.size() / few);
    std::size_t unexplained = 0;
    for (std::size_t i = 0; i < wrong_.size() && unexplained < 2; i += step) unexplained += !explains(all, *wrong_[i]);
    return unexplained < 2;
  }
  void try_pairs(Misreading& best) const {
    const auto may_be_one_of_two = [](const Reading& r) { return r.kind == CauseKind::convention && !r.decides; };
    for (const Reading& first : readings()) {
      for (const Reading& second : readings()) {
        if (best.explained == wrong_.size()) return;
        if (&first == &second || !may_be_one_of_two(first) || !may_be_one_of_two(second)) continue;
        if (are_worth_a_try({&first, &second})) try_together({&first, &second}, best);
      }
    }
  }
  /// One wrong answer may be right by chance under some reading.
  std::optional<Misreading> misreading() const {
    constexpr std::size_t least = 2;
    Misreading best{{}, least - 1};
    if (wrong_.size() < least) return std::nullopt;
    for (const Reading& r : readings()) try_together({&r}, best);
    if (is_mostly_wrong()) try_pairs(best);
    return best.readings.empty() ? std::nullopt : std::optional(best);
  }

  const Query& query_;
  const Subject& subject_;
  Standard standard_;
  std::size_t not_asked_ = 0;  ///< of the cases
  Workers& workers_;
  std::vector<Ordinary> cases_;
  std::vector<const Ordinary*> right_, wrong_;
};

std::string counts_text(const CheckedQuery& c) {
  std::string text = fmt::format("{}: {} of {} right", c.query->name, c.right, plural_text(c.asked, "case"));
  if (c.wrong > 0) text += fmt::format(", {} wrong", c.wrong);
  if (c.broke > 0) text += fmt::format(", {} broke the subject", c.broke);
  if (c.without_answer > 0) text += fmt::format(", {} without an answer", c.without_answer);
  if (c.not_asked > 0) text += fmt::format("; given up, {} not asked", plural_text(c.not_asked, "case"));
  return text + "\n";
}

/// What to declare where the documentation defines that meaning; empty where it is no convention.
std::string declaration_text(const CheckedQuery& c) {
  std::vector<std::string> names;
  for (const Reading* r : c.misreading->readings) {
    if (!r->convention || !concerns(*r->convention, *c.query)) return "";
    names.push_back(fmt::format("\"{} {}: {}\"", c.subject, c.query->name, name_of(*r->convention)));
  }
  return fmt::format(" If its documentation says so, declare {}.", list_text(names));
}

std::string misreading_text(const CheckedQuery& c) {
  if (c.wrong == 1) return "One wrong answer says nothing about other meanings.";
  if (!c.misreading) return "No other meaning of the inputs and of the answer explains the wrong answers.";
  std::vector<std::string> meanings;
  for (const Reading* r : c.misreading->readings) meanings.emplace_back(r->what);
  const bool all = c.is_explained();
  return fmt::format("{} right if {}.{}{}",
                     all ? fmt::format("All {} wrong answers are", c.wrong)
                         : fmt::format("{} of the {} wrong answers are", c.misreading->explained, c.wrong),
                     list_text(meanings), all ? "" : " Nothing explains the others.", declaration_text(c));
}

std::string example_text(const CheckedQuery& c, Scalar scalar) {
  const WrongOrdinary& w = *c.example;
  std::string text = fmt::format(
      "For example {}: ", w.note.empty() ? fmt::format("generated case {}", w.question.index) : w.question.origin);
  if (!w.note.empty()) text += w.note + (w.note.ends_with('.') ? " " : ". ");
  return text + fmt::format("The answer is {}; exactly, {}.", answer_text(*c.query, w.answer, scalar),
                            truth_text(*c.query, w.truth));
}

}  // namespace

CheckedQuery check_query(const Query& query, const Subject& subject, Workers& workers) {
  return SubjectCheck(query, subject, workers).checked();
}

std::string checked_text(const CheckedQuery& checked, Scalar scalar) {
  std::string text = counts_text(checked);
  if (checked.broke > 0) text += wrapped_text(fmt::format("It broke: {}", one_line(checked.why_broke, 200)), "  ");
  if (checked.wrong == 0) return text;
  text += wrapped_text(misreading_text(checked), "  ");
  if (checked.example) text += wrapped_text(example_text(checked, scalar), "  ");
  return text;
}

}  // namespace nearmiss
