#include "reports/engine/relations_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "corpus/files/errors.hpp"
#include "corpus/storage/codec.hpp"
#include "reports/engine/interrupt.hpp"
#include "reports/engine/run_folder.hpp"
#include "reports/engine/schedule.hpp"
#include "reports/engine/tally.hpp"
#include "reports/engine/worst_findings.hpp"
#include "reports/findings/pretty_json.hpp"
#include "reports/findings/report_text.hpp"
#include "reports/findings/text.hpp"

namespace nearmiss {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t batch_size = 128;  ///< cases; each has follow-ups for every relation
/// The reports for one query, subject and relation: the first broken promises, the first contradiction, and then every
/// finding at least twice as bad as any before.
constexpr std::uint64_t first_broken = 3, first_contradictions = 1;

double worst_backward(const RelationFinding& f) {
  double worst = -1;
  for (const Finding& one : f.findings) {
    if (one.backward) worst = std::max(worst, one.backward->above);
  }
  return worst;
}

/// The position of the answer to a follow-up: the case, and the index among its answers.
struct Slot {
  std::size_t of, at;
};

}  // namespace

void RelationTally::count(const RelationFinding& f) {
  ++cases;
  numbers_differ += f.agreement == Agreement::numbers_differ;
  contradictions += f.breach == Breach::contradiction;
  bits += f.breach == Breach::bits;
  contract += f.breach == Breach::contract;
  broke += f.breach == Breach::broke;
  oracle += !f.oracle.empty();
  if (f.breach == Breach::contradiction || f.breach == Breach::contract) {
    worst_backward = std::max(worst_backward, nearmiss::worst_backward(f));
  }
}

void RelationTally::add(const RelationTally& other) {
  cases += other.cases, numbers_differ += other.numbers_differ, contradictions += other.contradictions;
  bits += other.bits, contract += other.contract, broke += other.broke, oracle += other.oracle;
  worst_backward = std::max(worst_backward, other.worst_backward);
}

RelationsRun::RelationsRun(RelationsSettings settings)
    : settings_(std::move(settings)),
      begin_(Clock::now()),
      dispatcher_([this] {
        show_progress();
        return !should_stop();
      }),
      internal_errors_(settings_.folder) {
  make_writable_folder(settings_.folder);
}

bool RelationsRun::should_stop() const { return interrupted() || (until_ && Clock::now() >= *until_); }

void RelationsRun::run(std::optional<std::uint64_t> cases, std::optional<Clock::time_point> until) {
  until_ = until;
  Schedule schedule(settings_.queries, settings_.subjects, cases, batch_size, settings_.scene);
  if (cases) {
    total_ = 0;
    for (const Stream& s : schedule.streams()) *total_ += *s.cases;
  }
  for (Stream* stream = schedule.next(); stream != nullptr && !should_stop(); stream = schedule.next()) {
    const Clock::time_point begin = Clock::now();
    progress_.set_activity(fmt::format("relations of {}", stream->query->name));
    batch(*stream, schedule.batch_of(*stream, Workers::capacity_for(*stream->query)));
    stream->seconds += std::chrono::duration<double>(Clock::now() - begin).count();
    show_progress();
  }
}

void RelationsRun::show_progress() {
  std::optional<double> seconds_left;
  if (until_) seconds_left = std::chrono::duration<double>(*until_ - Clock::now()).count();
  progress_.show(done_, total_, seconds_left, bad());
}

std::vector<Answer> RelationsRun::ask(const Subject& subject, const std::vector<Case>& cases) {
  std::vector<Answer> answers;
  if (cases.empty()) return answers;
  const Query& query = *cases.front().query;
  const std::size_t most = Workers::capacity_for(query);
  const Subject* const asked[] = {&subject};
  const std::uint64_t passed_over = dispatcher_.endurance(subject, query).gave_up;
  for (std::size_t at = 0; at < cases.size() && answers.size() == at; at += most) {
    dispatcher_.ask(
        asked, std::span(cases).subspan(at, std::min(most, cases.size() - at)), {},
        [&](const Subject&, std::span<const Answer> some) { answers.insert(answers.end(), some.begin(), some.end()); });
  }
  const std::uint64_t missing = cases.size() - answers.size();
  const std::uint64_t counted = dispatcher_.endurance(subject, query).gave_up - passed_over;
  if (!should_stop()) dispatcher_.pass_over(subject, query, missing - counted);
  answers.resize(cases.size(), answer_of_given_up());
  return answers;
}

void RelationsRun::batch(Stream& stream, std::size_t count) {
  std::vector<Case> cases;
  generate_next(stream, settings_.seed, count, cases);
  done_ += count;
  std::map<const Subject*, std::vector<Answer>> own;
  for (const Subject* s : stream.subjects) {
    own[s] = ask(*s, cases);
    const auto broke =
        std::count_if(own[s].begin(), own[s].end(), [](const Answer& a) { return a.status == Answer::Status::broke; });
    if (broke > 0) broke_alone_[{s, stream.query}] += std::uint64_t(broke);
  }
  for (const Relation* r : settings_.relations) {
    if (should_stop()) return;
    relate_all(*r, cases, own);
  }
}

void RelationsRun::relate_all(const Relation& relation, const std::vector<Case>& cases,
                              const std::map<const Subject*, std::vector<Answer>>& own) {
  std::vector<std::optional<FollowUps>> follow_ups;
  std::map<const Query*, std::pair<std::vector<Case>, std::vector<Slot>>> asked;  // a batch holds cases of one query
  for (std::size_t i = 0; i < cases.size(); ++i) {
    follow_ups.push_back(relation.of(cases[i], cases[i].index));
    if (!follow_ups[i]) continue;
    for (std::size_t k = 0; k < follow_ups[i]->cases.size(); ++k) {
      auto& [questions, slots] = asked[follow_ups[i]->cases[k].query];
      questions.push_back(follow_ups[i]->cases[k]);
      slots.push_back({i, k + 1});
    }
  }
  if (asked.empty()) return;
  for (const auto& [subject, first_answers] : own) {
    if (should_stop()) return;
    std::vector<std::vector<Answer>> answers(cases.size());
    for (std::size_t i = 0; i < cases.size(); ++i) {
      if (follow_ups[i]) answers[i].resize(1 + follow_ups[i]->cases.size());
      if (follow_ups[i]) answers[i][0] = first_answers[i];
    }
    for (const auto& [query, questions] : asked) {
      if (subject->offering(query->name).answer == nullptr) continue;
      const std::vector<Answer> theirs = ask(*subject, questions.first);
      for (std::size_t n = 0; n < theirs.size(); ++n)
        answers[questions.second[n].of][questions.second[n].at] = theirs[n];
    }
    if (should_stop()) return;  // some answers may be missing
    const bool bits = settings_.bit_for_bit || claims_same_bits(*subject);
    for (std::size_t i = 0; i < cases.size(); ++i) {
      // Without an answer to the original case there is nothing to compare.
      if (!follow_ups[i] || first_answers[i].status != Answer::Status::answered) continue;
      if (!offers_all(*subject, *follow_ups[i])) continue;
      if (!may_be_asked_all(*subject, *follow_ups[i])) {
        ++not_asked_;
        continue;
      }
      try {
        take({subject, &relation, cases[i].query}, {&relation, cases[i].index, bits},
             relate(relation, *follow_ups[i], cases[i], std::move(answers[i]), *subject, bits));
      } catch (const InternalError& error) {
        internal_errors_.add(*subject, error);
      }
    }
  }
}

bool RelationsRun::worth_a_report(const Key& key, const RelationFinding& found, double above) {
  if (found.breach == Breach::none && found.oracle.empty()) return false;
  const std::uint64_t few = found.breach == Breach::contradiction ? first_contradictions : first_broken;
  const std::string_view what = found.oracle.empty() ? name_of(found.breach) : "oracle";
  return retention_.keep(fmt::format("{}/{}/{}/{}", key.subject->name, key.relation->name, key.query->name, what),
                         above, few);
}

void RelationsRun::take(const Key& key, const RelationChoice& choice, const RelationFinding& found) {
  tallies_[key].count(found);
  const double above = worst_backward(found);
  if (!worth_a_report(key, found, above)) return;
  RelationReport r = report_of(choice, found, *key.subject, dispatcher_.workers());
  const std::string name =
      fmt::format("{}-{}-{}-{}.json", key.subject->name, choice.relation->name, breach_of(r), id_of(r));
  const std::filesystem::path below = std::filesystem::path("relations") / key.query->name / name;
  const std::filesystem::path file = settings_.folder / below;
  r.replay = replay_command(*key.subject, file.string());
  make_folder(file.parent_path());
  write_file(file, pretty_json(report_to_json(r)));
  put_in_order({key, below.generic_string(), r.breach, !r.oracle.empty(), headline(r), above});
}

/// By name: the order in which answers arrive depends on the speed of hosts.
void RelationsRun::put_in_order(Written w) {
  const auto behind = std::upper_bound(written_.begin(), written_.end(), w,
                                       [](const Written& a, const Written& b) { return a.file < b.file; });
  written_.insert(behind, std::move(w));
}

std::vector<std::string> RelationsRun::vanished() const {
  std::vector<std::string> files;
  for (const Written& w : written_) files.push_back(w.file);
  return vanished_from(settings_.folder, files);
}

RelationTally RelationsRun::sum() const {
  RelationTally all;
  for (const auto& [key, t] : tallies_) all.add(t);
  return all;
}
std::uint64_t RelationsRun::broke_alone() const {
  std::uint64_t cases = 0;
  for (const auto& [key, some] : broke_alone_) cases += some;
  return cases;
}
std::uint64_t RelationsRun::bad() const { return sum().bad() + broke_alone(); }
std::uint64_t RelationsRun::bad_of(const std::function<bool(const Subject&)>& some) const {
  RelationTally all;
  for (const auto& [key, t] : tallies_) {
    if (some(*key.subject)) all.add(t);
  }
  std::uint64_t alone = 0;
  for (const auto& [key, cases] : broke_alone_) alone += some(*key.first) ? cases : 0;
  return all.bad() + alone;
}
std::uint64_t RelationsRun::contradicted() const { return sum().oracle + internal_errors_.count(); }

Json RelationsRun::to_json() const {
  Json j{{"schema", 1},
         {"state", interrupted() ? "interrupted" : "finished"},
         {"command", settings_.command},
         {"seed", settings_.seed},
         {"tallies", Json::array()},
         {"gave_up", Json::array()},
         {"broke_alone", Json::array()},
         {"reports", Json::array()}};
  for (const Query* q : settings_.queries) {
    for (const Subject* s : settings_.subjects) {
      for (const Relation* r : settings_.relations) {
        const auto found = tallies_.find({s, r, q});
        if (found == tallies_.end()) continue;
        const RelationTally& t = found->second;
        j["tallies"].push_back(
            {{"query", q->name},
             {"subject", s->name},
             {"relation", r->name},
             {"cases", t.cases},
             {"numbers_differ", t.numbers_differ},
             {"contradictions", t.contradictions},
             {"bits", t.bits},
             {"contract", t.contract},
             {"broke", t.broke},
             {"oracle", t.oracle},
             {"worst_backward_above_epsilon", t.worst_backward < 0 ? Json(nullptr) : Json(t.worst_backward)}});
      }
    }
  }
  for (const auto& [key, l] : dispatcher_.all_endurance()) {
    if (l.gave_up == 0) continue;
    j["gave_up"].push_back({{"subject", key.first->name},
                            {"query", key.second->name},
                            {"late", l.late},
                            {"why", given_up_text(key.first->name, key.second->name, l)},
                            {"cases", l.gave_up}});
  }
  for (const auto& [key, cases] : broke_alone_)
    j["broke_alone"].push_back({{"subject", key.first->name}, {"query", key.second->name}, {"cases", cases}});
  for (const Written& w : written_) {
    j["reports"].push_back({{"file", w.file},
                            {"query", w.key.query->name},
                            {"subject", w.key.subject->name},
                            {"relation", w.key.relation->name},
                            {"breach", w.breach_name()},
                            {"headline", w.headline}});
  }
  if (const SceneLimits* scene = scene_limits()) j["required"] = limits_to_json(*scene);
  if (const auto lost = vanished(); !lost.empty()) j["vanished"] = lost;
  if (internal_errors_.count() > 0) j["internal_errors"] = internal_errors_.to_json();
  j["environment"] = environment_to_json();
  return j;
}

void RelationsRun::write() const { write_file(settings_.folder / "relations.json", pretty_json(to_json())); }

std::string RelationsRun::table() const {
  std::vector<std::vector<std::string>> rows{
      {"", "PAIRS", "NUMBERS DIFFER", "CONTRADICT", "BITS", "CONTRACT", "BROKE", "BACKWARD"}};
  const auto row = [](const std::string& name, const RelationTally& t) -> std::vector<std::string> {
    return {fmt::format("  {}", name),    count_text(t.cases),
            count_text(t.numbers_differ), count_text(t.contradictions),
            count_text(t.bits),           count_text(t.contract),
            count_text(t.broke),          t.worst_backward < 0 ? "-" : "> " + epsilons_text(t.worst_backward)};
  };
  for (const Subject* s : settings_.subjects) {
    RelationTally all;
    std::vector<std::vector<std::string>> own;
    for (const Relation* r : settings_.relations) {
      RelationTally one;
      for (const Query* q : settings_.queries) {
        if (const auto t = tallies_.find({s, r, q}); t != tallies_.end()) one.add(t->second);
      }
      if (one.cases == 0) continue;
      all.add(one);
      own.push_back(row(std::string(r->name), one));
    }
    if (own.empty()) continue;
    rows.push_back({s->name});
    rows.insert(rows.end(), own.begin(), own.end());
    if (own.size() > 1) rows.push_back(row("all relations", all));
  }
  const std::vector<std::string> lines = given_up();
  return table_text(rows, "", 1) + (lines.empty() ? "" : fmt::format("\n{}\n", fmt::join(lines, "\n")));
}

std::vector<std::string> RelationsRun::given_up() const {
  std::vector<std::string> lines;
  for (const auto& [key, l] : dispatcher_.all_endurance()) {
    if (l.gave_up > 0) lines.push_back(given_up_text(key.first->name, key.second->name, l));
  }
  return lines;
}

std::string RelationsRun::worst_findings() const {
  std::vector<WorstFinding> findings;
  for (const Written& w : written_) {
    const bool promised = w.breach != Breach::contradiction || w.is_of_the_oracle;
    findings.push_back({fmt::format("{}/{}/{}", w.key.subject->name, w.key.relation->name, w.breach_name()), w.above,
                        w.headline, w.file, !promised});
  }
  return worst_text(findings, settings_.folder, "relations.json");
}

std::string RelationsRun::summary() const {
  const RelationTally all = sum();
  std::string text = fmt::format(
      "{}{} compared in {}: {}, {} within promises; {} in {}", interrupted() ? "interrupted: " : "",
      plural_text(all.cases, "pair"), duration_text(std::chrono::duration<double>(Clock::now() - begin_).count()),
      plural_text(all.bad(), "broken promise"), plural_text(all.contradictions, "contradiction"),
      plural_text(written_.size(), "report"), path_text(settings_.folder));
  if (broke_alone() > 0)
    text += fmt::format("; {} before they could be compared", plural_text(broke_alone(), "breakage"));
  if (not_asked_ > 0) text += fmt::format("; {} not asked, for what subjects require", plural_text(not_asked_, "pair"));
  if (all.oracle > 0) text += fmt::format("; Nearmiss contradicts itself {} times", count_text(all.oracle));
  if (const auto lost = vanished(); !lost.empty())
    text += "; " + vanished_text(lost, written_.size(), settings_.folder);
  return text + scene_measure_text() + internal_errors_.text();
}

}  // namespace nearmiss
