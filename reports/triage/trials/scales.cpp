#include "reports/triage/trials/scales.hpp"

#include <algorithm>
#include <cmath>

namespace nearmiss {

namespace {

int lengths(Role role) {
  return role == Role::position || role == Role::size || role == Role::velocity || role == Role::offset ? 1 : 0;
}
int speeds(Role role) { return role == Role::velocity ? 1 : role == Role::time ? -1 : 0; }
int directions(Role role) { return role == Role::direction || role == Role::offset ? 1 : 0; }
int rotations(Role role) { return role == Role::rotation ? 1 : 0; }

constexpr ScaleGroup groups[] = {{"lengths and velocities", "length", lengths},
                                 {"velocities", "speed", speeds},
                                 {"directions", "length of a direction", directions},
                                 {"quaternions", "length of a quaternion", rotations}};

/// The exponents of a scan in one direction.
constexpr int steps[] = {1, 2, 3, 4, 6, 8, 11, 16, 23, 32, 45, 64, 91, 128, 181, 256, 362, 512, 724, 1024};

bool has_raised(const Trial& t, Raised exception) { return (t.raised & exception) != 0; }

/// The trials at these exponents; exponents that are not exact are left out.
std::vector<ScaleScan::At> ask_at(Trials& trials, const Case& c, const ScaleGroup& group, std::span<const int> ks) {
  std::vector<Case> cases;
  std::vector<ScaleScan::At> at;
  for (const int k : ks) {
    const auto other = k == 0 ? std::optional(c) : scaled(c, group, k);
    if (!other) continue;
    cases.push_back(*other);
    at.push_back({k, {}});
  }
  std::vector<Trial> asked = trials.ask(cases, trials.sets_rounding() ? Rounding::to_nearest : Rounding::its_own);
  for (std::size_t i = 0; i < at.size(); ++i) at[i].trial = std::move(asked[i]);
  return at;
}

/// The trials in this direction, the nearest to scale 1 first.
std::vector<const ScaleScan::At*> from_one(std::span<const ScaleScan::At> all, int direction) {
  std::vector<const ScaleScan::At*> sorted;
  for (const ScaleScan::At& a : all) {
    if (a.k * direction > 0) sorted.push_back(&a);
  }
  std::sort(sorted.begin(), sorted.end(), [](const auto* a, const auto* b) { return std::abs(a->k) < std::abs(b->k); });
  return sorted;
}

/// The last trial with the finding in an unbroken row from scale 1, and the first right one beyond.
std::optional<Flip> first_flip(std::span<const ScaleScan::At> all, int direction) {
  int last = 0;
  bool unbroken = true;
  for (const ScaleScan::At* a : from_one(all, direction)) {
    if (a->trial.outcome == Outcome::right) return Flip{last, a->k};
    unbroken = unbroken && a->trial.outcome == Outcome::same;
    if (unbroken) last = a->k;
  }
  return std::nullopt;
}

/// Bisects the row of trials until the exponents are neighbours, or an answer between is neither.
Flip bisected(Trials& trials, const Case& c, const ScaleGroup& group, Flip f, std::vector<ScaleScan::At>& into) {
  while (!f.is_sharp()) {
    const int middle = (f.wrong + f.right) / 2;
    std::vector<ScaleScan::At> asked = ask_at(trials, c, group, std::span(&middle, 1));
    const Outcome outcome = asked.empty() ? Outcome::none : asked.front().trial.outcome;
    if (outcome != Outcome::same && outcome != Outcome::right) return f;
    into.push_back(std::move(asked.front()));
    (outcome == Outcome::same ? f.wrong : f.right) = middle;
  }
  return f;
}

/// The flip nearest to scale 1.
std::optional<Flip> nearest_flip(Trials& trials, const Case& c, const ScaleGroup& group,
                                 std::vector<ScaleScan::At>& at) {
  std::optional<Flip> nearest;
  for (const int direction : {1, -1}) {
    auto flip = first_flip(at, direction);
    if (flip) flip = bisected(trials, c, group, *flip, at);
    if (flip && (!nearest || std::abs(flip->right) < std::abs(nearest->right))) nearest = flip;
  }
  return nearest;
}

/// The exponents of a scan: steps from scale 1 that grow, and a denser row where the largest number is about 1.
std::vector<int> exponents_of(const Case& c, const ScaleGroup& group) {
  std::vector<int> ks{0};
  for (const int step : steps) ks.insert(ks.end(), {step, -step});
  const double largest = largest_of(c, group);
  if (largest > 0) {
    for (int d = -24; d <= 24; d += 4) ks.push_back(d - std::ilogb(largest));
  }
  std::sort(ks.begin(), ks.end());
  ks.erase(std::unique(ks.begin(), ks.end()), ks.end());
  return ks;
}

}  // namespace

std::span<const ScaleGroup> scale_groups() { return groups; }

double largest_of(const Case& c, const ScaleGroup& group) {
  double largest = 0;
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    if (group.order(c.role(i)) != 0) largest = std::max(largest, std::abs(c.values[i]));
  }
  return largest;
}

std::optional<Case> scaled(const Case& c, const ScaleGroup& group, int k) {
  Case other = c;
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    const int by = k * group.order(c.role(i));
    other.values[i] = std::ldexp(c.values[i], by);
    if (!std::isfinite(other.values[i]) || !representable(other.values[i], c.scalar)) return std::nullopt;
    if (std::ldexp(other.values[i], -by) != c.values[i]) return std::nullopt;
  }
  if (other.values == c.values || c.query->broken(other.values)) return std::nullopt;
  return other;
}

bool ScaleScan::has_clean_flip() const {
  if (!flip) return false;
  const auto [low, high] = std::minmax(flip->wrong, flip->right);
  return std::none_of(trials.begin(), trials.end(), [low = low, high = high](const At& a) {
    return a.k >= low && a.k <= high && (a.trial.raised & (raised_overflow | raised_underflow)) != 0;
  });
}

bool ScaleScan::explained_by(Raised exception) const {
  if (!flip) return false;
  const int direction = flip->right > 0 ? 1 : -1;
  bool always = true, never_beyond = false;
  for (const At& a : trials) {
    const int k = a.k * direction;
    const bool with_finding = a.trial.outcome == Outcome::same && k >= 0 && k <= flip->wrong * direction;
    if (with_finding) always = always && has_raised(a.trial, exception);
    if (a.trial.outcome == Outcome::right && k >= flip->right * direction)
      never_beyond |= !has_raised(a.trial, exception);
  }
  const auto behind = from_one(trials, -direction);
  const bool right_behind = !behind.empty() && behind.front()->trial.outcome == Outcome::right;
  return always && never_beyond && !right_behind;
}

std::optional<Flip> ScaleScan::ends_with(Raised exception) const {
  constexpr int least_beyond = 3;
  const auto base = std::find_if(trials.begin(), trials.end(), [](const At& a) { return a.k == 0; });
  if (base == trials.end() || !has_raised(base->trial, exception)) return std::nullopt;
  for (const int direction : {1, -1}) {
    Flip ends;
    int beyond = 0;
    bool together = true;
    for (const At* a : from_one(trials, direction)) {
      if (a->trial.outcome == Outcome::none) continue;
      const bool with_finding = a->trial.outcome == Outcome::same, raised = has_raised(a->trial, exception);
      together = together && with_finding == raised && !(with_finding && beyond > 0);
      if (with_finding && beyond == 0) ends.wrong = a->k;
      if (!with_finding && beyond++ == 0) ends.right = a->k;
    }
    if (together && beyond >= least_beyond) return ends;
  }
  return std::nullopt;
}

ScaleScan scan(Trials& trials, const ScaleGroup& group) {
  ScaleScan s;
  s.group = &group;
  const Case& c = trials.base().question;
  s.trials = ask_at(trials, c, group, exponents_of(c, group));
  if (s.trials.size() > 1) s.flip = nearest_flip(trials, c, group, s.trials);
  std::sort(s.trials.begin(), s.trials.end(), [](const auto& a, const auto& b) { return a.k < b.k; });
  return s;
}

std::optional<Flip> flip_near(Trials& trials, const Case& c, const ScaleGroup& group, const Flip& known) {
  std::vector<int> ks;
  const int direction = known.right > known.wrong ? 1 : -1;
  for (int k = 0; k <= 64; k += k < 8 ? 1 : 4) ks.push_back(direction * k);
  for (int d = -6; d <= 6; ++d) ks.push_back(known.right + d);
  std::sort(ks.begin(), ks.end());
  ks.erase(std::unique(ks.begin(), ks.end()), ks.end());
  std::erase_if(ks, [&](int k) { return k * direction < 0; });
  std::vector<ScaleScan::At> at = ask_at(trials, c, group, ks);
  auto flip = first_flip(at, direction);
  if (flip) flip = bisected(trials, c, group, *flip, at);
  return flip;
}

}  // namespace nearmiss
