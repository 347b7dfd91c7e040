#include "reports/triage/proposals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "corpus/generator/fit.hpp"
#include "oracles/judge.hpp"
#include "oracles/scene_limits.hpp"
#include "reports/findings/text.hpp"
#include "reports/triage/causes/tested.hpp"

namespace nearmiss {

namespace {

/// The answer is proved wrong. Under the convention, where there is one.
bool is_wrong(const Case& c, const Answer& a, Standard standard, std::optional<Convention> declared = std::nullopt) {
  if (declared) standard.declared.add(*declared);
  return judge(c, a, standard, Detail::verdict).is_proved();
}

/// What a convention changes in the answers to generated cases.
struct Changed {
  std::size_t mended = 0, spoiled = 0;

  bool speaks_for_it() const { return 10 * spoiled <= mended; }
  bool is_harmless() const { return spoiled == 0; }
};

class Proposals {
 public:
  Proposals(std::span<const CasesOfRow> rows, Workers& workers, const std::function<bool()>& goes_on)
      : rows_(rows), workers_(workers), goes_on_(goes_on) {}

  std::vector<ProposedConvention> all() {
    for (const Subject* s : subjects_of_rows()) {
      std::vector<const CasesOfRow*> left = rows_of(*s);
      while (auto best = best_of(*s, left)) {
        std::erase_if(left, [&](const CasesOfRow* row) { return explains(*best, *row); });
        found_.push_back(std::move(*best));
      }
    }
    return std::move(found_);
  }

 private:
  std::set<const Subject*> subjects_of_rows() const {
    std::set<const Subject*> all;
    for (const CasesOfRow& row : rows_) {
      if (!row.cases.empty()) all.insert(row.cases.front()->filed->subject);
    }
    return all;
  }
  std::vector<const CasesOfRow*> rows_of(const Subject& s) const {
    std::vector<const CasesOfRow*> some;
    for (const CasesOfRow& row : rows_) {
      if (!row.cases.empty() && row.cases.front()->filed->subject == &s) some.push_back(&row);
    }
    return some;
  }
  static std::set<const Query*> queries_of(const CasesOfRow& row) {
    std::set<const Query*> queries;
    for (const Candidate* c : row.cases) queries.insert(c->filed->question.query);
    return queries;
  }

  /// The convention that explains most findings of these rows; empty where none explains a row.
  std::optional<ProposedConvention> best_of(const Subject& s, std::span<const CasesOfRow* const> rows) {
    std::optional<ProposedConvention> best;
    for (const Convention c : all_conventions) {
      if (c == Convention::unit_directions || !goes_on_()) continue;  // that one only restricts what is asked
      ProposedConvention p{s.name, c, {}, 0};
      std::set<std::string> queries;
      for (const CasesOfRow* row : rows) {
        if (!is_explained(*row, s, c)) continue;
        p.findings += row->findings;
        for (const Query* q : queries_of(*row)) queries.insert(std::string(q->name));
      }
      p.queries.assign(queries.begin(), queries.end());
      if (p.findings > (best ? best->findings : 0)) best = std::move(p);
    }
    if (best && is_harmless_elsewhere(s, *best)) best->queries.clear();
    return best;
  }
  bool explains(const ProposedConvention& p, const CasesOfRow& row) {
    return is_explained(row, *row.cases.front()->filed->subject, p.convention);
  }
  bool is_explained(const CasesOfRow& row, const Subject& s, Convention convention) {
    const auto [at, is_new] = known_.try_emplace({&row, convention}, false);
    if (!is_new) return at->second;
    if (!makes_right(row, s, convention)) return false;
    for (const Query* q : queries_of(row)) {
      if (!changed(s, *q, convention).speaks_for_it()) return false;
    }
    return known_[{&row, convention}] = true;
  }
  static bool may_be_declared(const Subject& s, const Query& q, Convention convention) {
    const Conventions declared = s.standard_for(q.name).declared;
    return concerns(convention, q) && !declared.has(convention) && !contradicted(convention, declared);
  }
  static bool makes_right(const CasesOfRow& row, const Subject& s, Convention convention) {
    constexpr std::size_t most = 32;
    const std::size_t step = std::max<std::size_t>(1, row.cases.size() / most);
    std::size_t seen = 0, right = 0;
    const std::size_t all = (row.cases.size() + step - 1) / step;
    for (std::size_t i = 0; i < row.cases.size(); i += step) {
      const Candidate& c = *row.cases[i];
      const Case& question = c.filed->question;
      use_measure(c.filed->measure);
      ++seen;
      right += may_be_declared(s, *question.query, convention) && c.answer.status == Answer::Status::answered &&
               !is_wrong(question, c.answer, s.standard_for(question.query->name), convention);
      if (!nearly_all(right + all - seen, all)) return false;
    }
    return nearly_all(right, seen);
  }
  /// True where declaring it for all queries that it concerns makes no right answer wrong.
  bool is_harmless_elsewhere(const Subject& s, const ProposedConvention& p) {
    return std::all_of(s.offerings.begin(), s.offerings.end(), [&](const Offering& o) {
      const Query* q = find_query(o.query);
      const bool is_in = std::find(p.queries.begin(), p.queries.end(), o.query) != p.queries.end();
      return q == nullptr || is_in || o.answer == nullptr || !may_be_declared(s, *q, p.convention) ||
             changed(s, *q, p.convention).is_harmless();
    });
  }
  const Changed& changed(const Subject& s, const Query& q, Convention convention) {
    const auto [at, is_new] = changed_.try_emplace({&s, &q, convention});
    if (!is_new) return at->second;
    const Standard standard = s.standard_for(q.name);
    const auto& [cases, answers] = asked(s, q);
    for (std::size_t i = 0; i < cases.size(); ++i) {
      if (answers[i].status != Answer::Status::answered) continue;
      const bool now = is_wrong(cases[i], answers[i], standard),
                 then = is_wrong(cases[i], answers[i], standard, convention);
      at->second.mended += now && !then, at->second.spoiled += then && !now;
    }
    return at->second;
  }
  using Sample = std::pair<std::vector<Case>, std::vector<Answer>>;
  const Sample& asked(const Subject& s, const Query& q) {
    const auto [at, is_new] = samples_.try_emplace({&s, &q});
    if (!is_new) return at->second;
    constexpr std::size_t size = 256;
    constexpr std::uint64_t seed = 1;
    auto& [cases, answers] = at->second;
    for (std::uint64_t i = 0; i < size; ++i)
      generate_inside(cases.emplace_back(), q, s.scalar, seed, i, s.offering(q.name).required);
    for (std::size_t first = 0; first < size; first += Workers::capacity_for(q)) {
      workers_.send(s, std::span(cases).subspan(first, std::min(Workers::capacity_for(q), size - first)));
      const std::span<const Answer> some = workers_.receive(s);
      answers.insert(answers.end(), some.begin(), some.end());
    }
    answers.resize(size, Answer::without(Answer::Status::broke, "not asked"));
    return at->second;
  }

  std::span<const CasesOfRow> rows_;
  Workers& workers_;
  const std::function<bool()>& goes_on_;
  std::vector<ProposedConvention> found_;
  std::map<std::pair<const CasesOfRow*, Convention>, bool> known_;
  std::map<std::tuple<const Subject*, const Query*, Convention>, Changed> changed_;
  std::map<std::pair<const Subject*, const Query*>, Sample> samples_;
};

}  // namespace

std::vector<ProposedConvention> proposed_conventions(std::span<const CasesOfRow> rows, Workers& workers,
                                                     const std::function<bool()>& goes_on) {
  return Proposals(rows, workers, goes_on).all();
}

std::vector<std::string> declarations_of(const ProposedConvention& p) {
  if (p.queries.empty()) return {fmt::format("{}: {}", p.subject, name_of(p.convention))};
  std::vector<std::string> all;
  for (const std::string& q : p.queries) all.push_back(fmt::format("{} {}: {}", p.subject, q, name_of(p.convention)));
  return all;
}

std::string proposals_text(std::span<const ProposedConvention> proposals) {
  std::string text;
  for (const ProposedConvention& p : proposals) {
    std::vector<std::string> quoted;
    for (const std::string& d : declarations_of(p)) quoted.push_back(fmt::format("\"{}\"", d));
    text += fmt::format("declare {}, and {} go\n", list_text(quoted), plural_text(p.findings, "finding"));
  }
  return text;
}

}  // namespace nearmiss
