#include "reports/engine/climb.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "corpus/generator/fit.hpp"
#include "corpus/generator/generator.hpp"
#include "corpus/search/neighbours.hpp"
#include "reports/findings/hash.hpp"
#include "reports/findings/workers.hpp"

namespace nearmiss {

namespace {

/// Cases of a round. A hill takes about as many cases as one round of generated cases.
constexpr std::size_t steps_in_round = 64, generated_in_round = 1024;
/// The hills that begin at the worst cases of one round of generated or known cases, or of kicks.
constexpr std::size_t starts_from_round = 2, starts_from_known = 8;
/// A hill counts as climbed after so many rounds that were not higher, by this part, than a round before them: where
/// errors are near the size of the numbers, a climb could go on ulp by ulp without end.
constexpr int patience = 8;
constexpr double clear_part = 1.0 / 64;
constexpr std::size_t most_tops = 8;
/// Numbers that a kick changes: enough to leave the hill, too few to forget it.
constexpr int least_kick = 2, most_kick = 6;
/// The lengths of a jump along the last step that led up, in steps.
constexpr double jumps[] = {1, 2, 4, 8, 16, 64, 0.5, -0.5};

constexpr std::string_view climbed_prefix = "climb from ";

/// A seed for each climb of a run, so that their steps are unrelated.
std::uint64_t seed_of(const Climb::Settings& s) {
  Fnv1a fnv;
  for (const std::string_view part : {std::string_view(s.subject->name), s.query->name, name_of(s.kind)}) fnv.add(part);
  return fnv.value() ^ s.seed;
}

/// The name of the origin of cases that a climb from this one makes.
void mark_as_climbed(Case& c) {
  if (!c.origin.starts_with(climbed_prefix)) c.origin = std::string(climbed_prefix) + c.origin;
}

}  // namespace

bool Climb::Height::clearly_above(const Height& other) const {
  if (error != other.error) return error > other.error * (1 + clear_part);
  return guide > other.guide + clear_part * std::abs(other.guide);
}

Climb::Climb(Settings settings) : settings_(std::move(settings)), random_(seed_of(settings_)) {
  if (settings_.stored) settings_.known.insert(settings_.known.begin(), settings_.stored->question);
  std::vector<Case> exact;
  for (const Case& c : settings_.known) {
    if (auto same = in_scalar(c, subject().scalar)) exact.push_back(std::move(*same));
  }
  settings_.known = std::move(exact);
  if (settings_.known.empty() || settings_.source == Source::generator) phase_ = Phase::scout;
  if (query().outputs.empty()) guide_ = Guide::decision;
}

std::span<const Case> Climb::propose(std::size_t most) {
  proposed_.clear();
  found_.clear();
  taken_ = 0;
  switch (phase_) {
    case Phase::known:
      proposed_.assign(settings_.known.begin(),
                       settings_.known.begin() + std::ptrdiff_t(std::min(most, settings_.known.size())));
      break;
    case Phase::scout: propose_generated(std::min(most, generated_in_round)); break;
    case Phase::kick: propose_kicks(std::min(most, steps_in_round)); break;
    case Phase::hill: propose_steps(std::min(most, steps_in_round)); break;
  }
  if (phase_ == Phase::kick || phase_ == Phase::hill) fit_proposed();
  proposed_count_ += proposed_.size();
  return proposed_;
}

void Climb::propose_generated(std::size_t count) {
  proposed_.resize(count);
  const Preconditions required = subject().offering(query().name).required;
  for (Case& c : proposed_) generate_inside(c, query(), subject().scalar, settings_.seed, next_generated_++, required);
}

/// Cases that differ in several numbers from the top of a hill, half of them by a mutator of the generator.
void Climb::propose_kicks(std::size_t count) {
  const Case& top = tops_[random_() % tops_.size()].question;
  while (proposed_.size() < count) {
    const std::uint64_t seed = random_();
    const int changes = least_kick + int(seed % std::uint64_t(most_kick - least_kick + 1));
    Case c = neighbour(top, changes, seed);
    if (proposed_.size() % 2 == 1) mutate(c, seed);
    c.moves = top.moves;
    proposed_.push_back(std::move(c));
  }
}

void Climb::propose_steps(std::size_t count) {
  for (const double factor : jumps) {
    if (!rising_ || proposed_.size() == count) break;
    if (auto c = beyond(before_, here_.question, factor)) proposed_.push_back(std::move(*c));
  }
  constexpr std::uint64_t one_in = 4;  // half of the cases change one number, a quarter two, a quarter three
  while (proposed_.size() < count) {
    const std::uint64_t seed = random_(), draw = seed % one_in;
    proposed_.push_back(neighbour(here_.question, draw == 0 ? 3 : draw == 1 ? 2 : 1, seed / one_in));
  }
}

/// Changes neighbours that break a precondition of the subject. The origin stays that of the climb.
void Climb::fit_proposed() {
  const Preconditions required = subject().offering(query().name).required;
  if (required.empty()) return;
  for (Case& c : proposed_) {
    std::string origin = c.origin;
    fit(c, required);
    c.origin = std::move(origin);
  }
}

double Climb::guide_of(const Case& c, const Answer& answer, const Finding& f) const {
  constexpr double beyond_the_flip = 1;  // a wrong decision lies beyond it; before it the guide is at most 0
  if (guide_ == Guide::decision)
    return answer.yes != f.truth_yes ? beyond_the_flip : -std::max(0.0, decision_margin(c));
  return f.forward_ulps > 1 ? estimated_backward(c, answer, f.forward_ulps) : f.forward_ulps - 1;
}

Climb::Height Climb::backward_height(const Case& c, const Answer& answer, const Finding& f) const {
  Height h{f.backward ? f.backward->above : 0, guide_of(c, answer, f)};
  const double next_rung = std::max(1.0, 2 * h.error);
  const bool may_be_worse = phase_ != Phase::hill || next_rung > here_.height.error;
  if (!f.backward || !may_be_worse) return h;
  const Standard standard = subject().standard_for(query().name);
  h.error = finer_backward(c, answer, *f.backward, standard.required, standard.declared);
  return h;
}

std::optional<Climb::Height> Climb::height_of(const Case& c, const Answer& answer, const Finding& f) const {
  if (!is_compared(f) || !std::isfinite(f.forward_ulps)) return std::nullopt;
  return kind() == ErrorKind::forward ? Height{f.forward_ulps, 0} : backward_height(c, answer, f);
}

void Climb::take(std::size_t i, const Answer& answer, const Finding& f) {
  const Case& c = proposed_[i];
  ++taken_;
  ++asked_;
  if (phase_ == Phase::known && i == 0 && settings_.stored)
    stored_now_ = error_of(c, answer, subject().standard_for(query().name), kind()).value_or(0);
  const std::optional<Height> h = height_of(c, answer, f);
  if (!h) return;
  if (h->error > 0 && (!record_ || h->error > record_->error)) compare_with_record(c, answer, f);
  keep(c, *h);
}

/// Measures at full detail: the error of a record is the one that error_of() gives.
void Climb::compare_with_record(const Case& c, const Answer& answer, const Finding& f) {
  const std::optional<double> error = error_of(c, answer, subject().standard_for(query().name), kind());
  if (!error || !(*error > 0) || (record_ && *error <= record_->error)) return;
  record_ = WorstCase{c, subject().name, kind(), *error};
  record_is_violation_ = f.is_proved();
}

void Climb::keep(const Case& c, const Height& h) {
  const std::size_t most = phase_ == Phase::hill ? 1 : phase_ == Phase::known ? starts_from_known : starts_from_round;
  if (found_.size() == most && h <= found_.back().height) return;
  if (found_.size() == most) found_.pop_back();
  const auto at = std::find_if(found_.begin(), found_.end(), [&](const Place& p) { return h > p.height; });
  found_.insert(at, {c, h});
}

void Climb::end_round() {
  if (taken_ == 0) over_ = true;
  if (over_ || settings_.source == Source::generator) return;
  if (phase_ == Phase::hill) return end_steps();
  starts_.assign(std::make_move_iterator(found_.rbegin()), std::make_move_iterator(found_.rend()));
  begin_hill();
}

/// Moves to the worst case of the round. A case that is as bad takes the place of the last one too, so that the climb
/// crosses level ground.
void Climb::end_steps() {
  rising_ = false;
  if (!found_.empty() && found_.front().height >= here_.height) {
    rising_ = found_.front().height > here_.height;
    if (rising_) before_ = std::move(here_.question.values);
    here_ = std::move(found_.front());
  }
  ++rounds_below_milestone_;
  if (here_.height.clearly_above(milestone_)) milestone_ = here_.height, rounds_below_milestone_ = 0;
  if (rounds_below_milestone_ == patience) end_hill();
}

void Climb::end_hill() {
  ++hills_;
  const auto at = std::find_if(tops_.begin(), tops_.end(), [&](const Place& p) { return here_.height > p.height; });
  tops_.insert(at, std::move(here_));
  if (tops_.size() > most_tops) tops_.pop_back();
  begin_hill();
}

/// Begins at the worst start left.
void Climb::begin_hill() {
  rising_ = false;
  rounds_below_milestone_ = 0;
  before_.clear();
  if (starts_.empty()) return look_for_starts();
  phase_ = Phase::hill;
  here_ = std::move(starts_.back());
  starts_.pop_back();
  milestone_ = here_.height;
  mark_as_climbed(here_.question);
}

/// The next round looks for starts: in turn around the tops of earlier hills and among generated cases. The guides take
/// turns every second time, so that each looks in both ways.
void Climb::look_for_starts() {
  phase_ = kicks_next_ && !tops_.empty() ? Phase::kick : Phase::scout;
  kicks_next_ = !kicks_next_;
  if (kicks_next_ && decides(query().kind) && !query().outputs.empty())
    guide_ = guide_ == Guide::numbers ? Guide::decision : Guide::numbers;
}

}  // namespace nearmiss
