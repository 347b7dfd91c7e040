#include "reports/triage/one_bug.hpp"

#include <algorithm>
#include <map>
#include <numeric>

#include "oracles/confirmed.hpp"
#include "reports/triage/causes/shares.hpp"
#include "reports/triage/hypotheses/readings.hpp"
#include "reports/triage/trials/trials.hpp"

namespace nearmiss {

namespace {

/// All, or with that confidence more than half: what holds of a finding holds more often than not.
bool is_proved_of_most(std::size_t part, std::size_t whole) {
  if (whole == 0 || part == whole) return whole > 0;
  return proved_at_least(part, whole) > 0.5;
}

/// Of so many findings a part was seen, and the true share may be this one.
bool may_have_share(std::size_t part, std::size_t whole, double share) {
  return part > 0 && proved_at_most(part, whole) >= share;
}

bool is_reading(const std::string& key) {
  return std::any_of(readings().begin(), readings().end(), [&](const Reading& r) { return r.name == key; });
}

bool is_tolerance(CauseKind kind) {
  return kind == CauseKind::absolute_tolerance || kind == CauseKind::relative_tolerance;
}

bool is_mechanism(const ExaminedFinding& f) { return f.has_cause() && told_by_regions(f.cause()) == 0; }

bool same_query(const ExaminedFinding& a, const ExaminedFinding& b) { return a.kind().query == b.kind().query; }

bool shares_key(const ExaminedFinding& a, const ExaminedFinding& b) {
  return a.has_cause() && b.has_cause() && is_shared_by_queries(a.cause()) && a.cause().kind == b.cause().kind &&
         a.cause().key == b.cause().key;
}

bool same_mechanism(const ExaminedFinding& a, const ExaminedFinding& b) {
  if (!same_query(a, b) || !is_mechanism(a) || !is_mechanism(b)) return false;
  const Cause &x = a.cause(), &y = b.cause();
  return x.kind == y.kind && x.kind != CauseKind::convention && (x.key == y.key || x.key.empty() || y.key.empty());
}

bool same_regions(const ExaminedFinding& a, const ExaminedFinding& b) {
  return a.kind() == b.kind() && !is_mechanism(a) && !is_mechanism(b) && a.regions() == b.regions() &&
         a.has_cause() == b.has_cause();
}

/// The answers of a finding's reports are wrong in this way, too, at least as often as not.
bool shows(const ExaminedFinding& f, Disagreement d) {
  const auto with =
      std::count_if(f.cases.begin(), f.cases.end(), [&](const Candidate* c) { return c->finding.has(d); });
  return !f.cases.empty() && 2 * std::size_t(with) >= f.cases.size();
}

bool is_of_a_member(const ExaminedFinding& f) {
  const Disagreement d = f.examined->finding.disagreement;
  return f.examined->finding.verdict != Verdict::broke && d != Disagreement::false_hit && d != Disagreement::false_miss;
}

bool wrong_together(const ExaminedFinding& a, const ExaminedFinding& b) {
  if (!same_query(a, b) || a.kind() == b.kind() || !is_of_a_member(a) || !is_of_a_member(b)) return false;
  return shows(a, b.examined->finding.disagreement) && shows(b, a.examined->finding.disagreement);
}

/// Joins findings to bugs.
class Joining {
 public:
  Joining(const std::vector<ExaminedFinding>& all, Workers& workers)
      : all_(all), workers_(workers), parent_(all.size()) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }

  std::vector<std::vector<std::size_t>> groups() {
    join_where([](const ExaminedFinding& a, const ExaminedFinding& b) {
      return shares_key(a, b) || same_mechanism(a, b) || same_regions(a, b) || wrong_together(a, b);
    });
    join_where([&](const ExaminedFinding& a, const ExaminedFinding& b) {
      return is_explained_by(a, b) || is_explained_by(b, a);
    });
    join_where([&](const ExaminedFinding& a, const ExaminedFinding& b) { return turn_into_each_other(a, b); });
    std::map<std::size_t, std::vector<std::size_t>> by_root;
    for (std::size_t i = 0; i < all_.size(); ++i) by_root[root(i)].push_back(i);
    std::vector<std::vector<std::size_t>> groups;
    for (auto& [root, members] : by_root) groups.push_back(std::move(members));
    return groups;
  }

 private:
  std::size_t root(std::size_t i) const {
    while (parent_[i] != i) i = parent_[i];
    return i;
  }
  template <class Same>
  void join_where(const Same& same) {
    for (std::size_t i = 0; i < all_.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) {
        if (root(i) == root(k) || all_[i].kind().subject != all_[k].kind().subject) continue;
        if (same(all_[i], all_[k])) parent_[std::max(root(i), root(k))] = std::min(root(i), root(k));
      }
    }
  }

  /// The reading that is the cause of `a` makes most answers of `b` right, of which no mechanism is known.
  bool is_explained_by(const ExaminedFinding& a, const ExaminedFinding& b) const {
    if (!is_mechanism(a) || a.cause().key.empty() || is_mechanism(b) || !b.has_cause()) return false;
    if (b.examined->finding.verdict == Verdict::broke) return false;
    for (const Reading& r : readings()) {
      if (r.name == a.cause().key && explains(r, b)) return true;
    }
    return false;
  }
  bool explains(const Reading& reading, const ExaminedFinding& f) const {
    const IsRight is_right = [&](const Case& c, const Answer& answer) {
      const Standard standard = f.examined->filed->subject->standard_for(c.query->name);
      const Verdict v = confirmed(c, answer, standard, Detail::verdict).verdict;
      return v == Verdict::agrees || v == Verdict::not_proved;
    };
    std::size_t right = 0;
    for (const Candidate* c : f.cases) {
      if (c->answer.status != Answer::Status::answered) continue;
      use_measure(c->filed->measure);
      right += reading.right(c->filed->question, c->answer, is_right).value_or(false);
    }
    return is_proved_of_most(right, f.cases.size());
  }

  bool turn_into_each_other(const ExaminedFinding& a, const ExaminedFinding& b) {
    if (!same_query(a, b) || is_mechanism(a) || is_mechanism(b) || a.regions() != b.regions()) return false;
    if (!a.has_cause() || !b.has_cause() || a.kind().fault == b.kind().fault) return false;
    return turns_into(a, b) && turns_into(b, a);
  }
  /// Around the simplest case of one, the faults of both are mixed as in their reports. Two bugs are not: around a case
  /// of one, the other is rarer than its share.
  bool turns_into(const ExaminedFinding& from, const ExaminedFinding& to) {
    const std::size_t own = around(from, from), other = around(from, to);
    return may_have_share(other, own + other, double(to.cases.size()) / double(from.cases.size() + to.cases.size()));
  }
  /// The wrong answers around the case of one that have the fault of another.
  std::size_t around(const ExaminedFinding& of, const ExaminedFinding& with_fault_of) {
    const std::map<Disagreement, std::size_t>& seen = faults_around(of);
    const auto found = seen.find(with_fault_of.examined->finding.disagreement);
    return found == seen.end() ? 0 : found->second;
  }
  /// The faults of the answers to cases around the simplest one, each answer by its headline.
  const std::map<Disagreement, std::size_t>& faults_around(const ExaminedFinding& f) {
    const auto [at, is_new] = around_.try_emplace(&f);
    if (!is_new) return at->second;
    const Subject& subject = *f.examined->filed->subject;
    use_measure(f.examined->filed->measure);
    const Standard standard = subject.standard_for(f.kind().query);
    for (const Case& c : changed(f.simplest())) {
      if (!is_valid(c)) continue;
      const Finding seen = confirmed(c, workers_.ask(subject, c), standard, Detail::verdict);
      if (is_bad(seen)) ++at->second[seen.disagreement];
    }
    return at->second;
  }
  /// Cases in which every number changes by little, by a part, or as much as it is.
  static std::vector<Case> changed(const Case& c) {
    constexpr std::size_t of_each_order = 16;
    std::vector<Case> cases;
    for (const int order : {0, 2, 5, 10}) {
      for (Case& other : relative_neighbours(c, of_each_order, order, seed_of(c) + std::uint64_t(order)))
        cases.push_back(std::move(other));
      for (Case& other : with_moved_zeros(c, of_each_order / 2, order, seed_of(c) + std::uint64_t(order)))
        cases.push_back(std::move(other));
    }
    return cases;
  }

  const std::vector<ExaminedFinding>& all_;
  Workers& workers_;
  std::vector<std::size_t> parent_;
  std::map<const ExaminedFinding*, std::map<Disagreement, std::size_t>> around_;
};

}  // namespace

int told_by_regions(const Cause& cause) {
  switch (cause.kind) {
    case CauseKind::unexplained: return 1;
    case CauseKind::logic: return 2;
    case CauseKind::unsupported: return is_reading(cause.key) ? 0 : 3;
    default: return 0;
  }
}

bool is_shared_by_queries(const Cause& cause) {
  return !cause.key.empty() && told_by_regions(cause) == 0 && (is_reading(cause.key) || is_tolerance(cause.kind));
}

std::vector<std::vector<std::size_t>> one_bug_each(const std::vector<ExaminedFinding>& all, Workers& workers) {
  return Joining(all, workers).groups();
}

}  // namespace nearmiss
