#include "reports/triage/candidates.hpp"

#include <algorithm>
#include <set>

#include "oracles/confirmed.hpp"
#include "oracles/requirements.hpp"
#include "reports/findings/report_text.hpp"

namespace nearmiss {

namespace {

/// The regions that a candidate's finding needs, as far as they are known.
FeatureRegions needed_by(const Candidate& c) { return c.examined ? c.examined->regions : c.variant.regions; }

/// The scene at ordinary magnitude, where the subject has the same fault there.
std::optional<Case> with_fault_near_one(const Candidate& c, Workers& workers) {
  const Subject& subject = *c.filed->subject;
  const Standard standard = subject.standard_for(c.kind.query);
  for (const Case& scene : at_ordinary_magnitude(c.filed->question)) {
    const Finding f = confirmed(scene, workers.ask(subject, scene), standard, Detail::full);
    if (is_bad(f) && kind_of_finding(*scene.query, subject.name, f).fault == c.kind.fault) return scene;
  }
  return std::nullopt;
}

/// The better to examine, the less: ordinary scenes first, then the worst, then the simplest.
auto order_of_examining(const Candidate& c) {
  return std::tuple(c.extreme.has_value(), !c.variant.ordinary, -c.size.relative, plainness_of(c.filed->question));
}

}  // namespace

std::optional<Candidate> asked_again(const FiledReport& r, Workers& workers) {
  use_measure(r.measure);
  const Standard standard = r.subject->standard_for(r.question.query->name);
  Report now;
  now.question = r.question;
  now.subject = r.subject->name;
  now.answer = workers.ask(*r.subject, r.question);
  now.finding = confirmed(r.question, now.answer, standard, Detail::full);
  now.standard = standard;
  if (!is_bad(now.finding)) return std::nullopt;
  Candidate c;
  c.filed = &r;
  c.answer = now.answer, c.finding = now.finding;
  c.kind = kind_of_finding(*r.question.query, r.subject->name, now.finding);
  c.size = error_size(r.question, now.finding);
  c.headline = headline(now);
  c.variant = {confirmed(r.question, now.answer, standard, Detail::verdict).branches, feature_regions_of(r.question),
               is_ordinary(r.question)};
  c.plain = r.question;
  if (!is_extreme_scene(r.question)) return c;
  if (auto plain = with_fault_near_one(c, workers)) {
    c.plain = std::move(*plain);
  } else {
    c.extreme = magnitudes_of(r.question);
  }
  return c;
}

void choose(CandidatesOfKind& group) {
  std::vector<Candidate>& all = group.all;
  std::stable_sort(all.begin(), all.end(), [](const Candidate& a, const Candidate& b) {
    return order_of_examining(a) < order_of_examining(b);
  });
  const auto extreme = std::find_if(all.begin(), all.end(), [](const Candidate& c) { return c.extreme.has_value(); });
  const auto ordinary = std::size_t(extreme - all.begin());
  if (ordinary == 0) return;
  std::set<Variant> chosen;
  const auto move_to_front = [&](std::size_t from) {
    std::rotate(all.begin() + std::ptrdiff_t(group.to_examine), all.begin() + std::ptrdiff_t(from),
                all.begin() + std::ptrdiff_t(from) + 1);
    chosen.insert(all[group.to_examine++].variant);
  };
  move_to_front(0);
  const auto simplest = std::min_element(all.begin() + 1, extreme, [](const Candidate& a, const Candidate& b) {
    return plainness_of(a.filed->question) < plainness_of(b.filed->question);
  });
  if (simplest != extreme) move_to_front(std::size_t(simplest - all.begin()));
  for (std::size_t i = group.to_examine; i < ordinary && group.to_examine < most_examined; ++i) {
    if (!chosen.contains(all[i].variant)) move_to_front(i);
  }
}

Likeness likeness(const Candidate& c, const Variant& variant) {
  const FeatureRegions needed = needed_by(c);
  const bool within = needed.within(variant.regions);
  return {c.variant == variant, within && c.variant.ordinary == variant.ordinary, within,
          within ? needed.names().size() : 0, c.variant.branches == variant.branches};
}

}  // namespace nearmiss
