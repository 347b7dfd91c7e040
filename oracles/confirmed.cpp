#include "oracles/confirmed.hpp"

#include <fmt/format.h>

namespace nearmiss {

namespace {

bool accuses(const Finding& f) {
  return f.is_proved() || f.has(Disagreement::false_hit) || f.has(Disagreement::false_miss) ||
         f.has(Disagreement::not_finite);
}

bool same_word(const Finding& a, const Finding& b) { return a.verdict == b.verdict && a.truth_yes == b.truth_yes; }

std::string word_of(const Finding& f) {
  return fmt::format("\"{}{}{}\", the truth is {}", name_of(f.verdict),
                     f.disagreement == Disagreement::none ? "" : ": ",
                     f.disagreement == Disagreement::none ? "" : name_of(f.disagreement), f.truth_yes ? "yes" : "no");
}

}  // namespace

InternalError::InternalError(const Case& question, const Finding& first, const Finding& in_full)
    : std::runtime_error(fmt::format("the judge contradicts itself about {}: at first {}; in full {}",
                                     question.query->name, word_of(first), word_of(in_full))),
      question_(question) {}

Finding confirmed(const Case& question, const Answer& answer, const Standard& standard, Detail detail,
                  const SecondLook& needs_second, const SceneLimits* scene) {
  const bool in_full = detail == Detail::full;
  const Finding first = judge(question, answer, standard, in_full ? Detail::verdict : detail, scene);
  if (!accuses(first) && !in_full) return first;
  const bool may_be_saved = !in_full && needs_second && first.is_proved() && first.settled;
  if (may_be_saved && !needs_second(first)) return first;
  Finding full = judge(question, answer, standard, Detail::full, scene);
  if (accuses(first) && !same_word(first, full)) throw InternalError(question, first, full);
  if (!in_full) full.branches = first.branches;
  return full;
}

}  // namespace nearmiss
