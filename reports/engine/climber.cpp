#include "reports/engine/climber.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "corpus/storage/codec.hpp"
#include "reports/findings/pretty_json.hpp"
#include "reports/findings/text.hpp"

namespace nearmiss {

namespace {

using Json = nlohmann::ordered_json;

std::vector<Case> questions_of(const std::vector<WorstCase>& stored) {
  std::vector<Case> all;
  for (const WorstCase& w : stored) all.push_back(w.question);
  return all;
}

Climb climb_of(const Climber::Settings& s, const Query& query, const Subject& subject, ErrorKind kind,
               const std::vector<WorstCase>& stored) {
  Climb::Settings climb{&query, &subject, kind, s.seed, s.source, questions_of(stored), {}};
  const auto own = std::find_if(stored.begin(), stored.end(), [&](const WorstCase& w) {
    return w.subject == subject.name && w.kind == kind && w.question.scalar == subject.scalar;
  });
  if (own != stored.end()) climb.stored = *own;
  return Climb(std::move(climb));
}

Json climb_to_json(const Climb& c) {
  return {{"query", c.query().name},   {"subject", c.subject().name},
          {"kind", name_of(c.kind())}, {"cases", c.asked()},
          {"hills", c.hills()},        {"error", c.record() ? Json(c.record()->error) : Json(nullptr)},
          {"unit", unit_of(c.kind())}};
}

double promised(const Climb& c) {
  const Standard s = c.subject().standard_for(c.query().name);
  return c.kind() == ErrorKind::forward ? s.contract.forward : s.contract.backward;
}

/// "12.5 of 24": the error and the promised bound.
std::string error_cell(const Climb* c) {
  if (c == nullptr || !c->record()) return "-";
  const double bound = promised(*c);
  return fmt::format("{:.4g}{}", c->record()->error, std::isfinite(bound) ? fmt::format(" of {:.4g}", bound) : "");
}

}  // namespace

Climber::Climber(Settings settings) : settings_(std::move(settings)) {
  for (const Query* q : settings_.queries) {
    const std::vector<WorstCase> stored = settings_.from_stored ? worst_cases(*q) : std::vector<WorstCase>{};
    for (const Subject* s : settings_.subjects) {
      if (s->offering(q->name).answer == nullptr) continue;
      for (const ErrorKind kind : error_kinds) {
        if (kind == ErrorKind::backward || !q->outputs.empty())
          climbs_.push_back(climb_of(settings_, *q, *s, kind, stored));
      }
    }
  }
}

std::size_t Climber::left(const Climb& c) const {
  const std::size_t most = Workers::capacity_for(c.query());
  return settings_.cases ? std::min(most, std::size_t(*settings_.cases - std::min(*settings_.cases, c.proposed())))
                         : most;
}

Climb* Climber::next() {
  Climb* least = nullptr;
  for (Climb& c : climbs_) {
    if (c.is_over() || left(c) == 0) continue;
    if (least == nullptr || c.seconds < least->seconds) least = &c;
  }
  return least;
}

void Climber::run(Campaign& campaign, const std::function<void(const Climb&)>& turn) {
  while (!campaign.should_stop() && (current_ = next()) != nullptr) {
    const auto begin = Campaign::Clock::now();
    turn(*current_);
    const Subject* subject = &current_->subject();
    campaign.examine_searched({&subject, 1}, current_->propose(left(*current_)), Climb::detail);
    current_->end_round();
    current_->seconds += Campaign::seconds_since(begin);
  }
}

Json Climber::to_json() const {
  Json j = Json::array();
  for (const Climb& c : climbs_) j.push_back(climb_to_json(c));
  return j;
}

std::string Climber::table() const {
  std::vector<std::vector<std::string>> rows{
      {"QUERY", "SUBJECT", "FORWARD ERROR, ULPS", "BACKWARD ERROR, EPSILON", "CASES", "HILLS"}};
  for (std::size_t i = 0; i < climbs_.size();) {
    const Climb& first = climbs_[i];
    const bool both = first.kind() == ErrorKind::forward;
    const Climb& last = climbs_[i + both];
    rows.push_back({std::string(first.query().name), first.subject().name, error_cell(both ? &first : nullptr),
                    error_cell(&last), count_text(first.asked() + (both ? last.asked() : 0)),
                    count_text(first.hills() + (both ? last.hills() : 0))});
    i += 1 + both;
  }
  return table_text(rows);
}

std::string Climber::summary() const {
  std::uint64_t cases = 0, hills = 0;
  for (const Climb& c : climbs_) cases += c.asked(), hills += c.hills();
  return fmt::format("{} on {}", plural_text(cases, "case"), plural_text(hills, "hill"));
}

namespace {

/// True where the file now holds another worst case than the one that the climb began with, and a worse one than its
/// record: another run wrote it.
bool was_overtaken(const std::filesystem::path& file, const Climb& c) {
  if (!std::filesystem::exists(file)) return false;
  const double now = read_worst_case(file).error;
  return now != (c.stored() ? c.stored()->error : 0) && (!c.record() || now >= c.record()->error);
}

/// The line about the file that the climb's record changes; empty where it changes none.
std::string update_worst_case(const Climb& c) {
  const std::filesystem::path file = worst_case_file(c.query(), c.subject().name, c.kind());
  if (c.stored() && !c.stored_now()) return "";  // interrupted before the stored case was asked
  const double before = c.stored() ? c.stored()->error : 0, after = c.record() ? c.record()->error : 0;
  const bool changed_today = c.stored_now().value_or(before) != before;
  if ((before == after && !changed_today) || was_overtaken(file, c)) return "";
  if (c.record_is_violation())
    return fmt::format("{}: not stored: the worst case breaks the contract", path_text(file));
  if (c.record()) {
    make_folder(file.parent_path());
    write_file(file, pretty_json(worst_case_to_json(*c.record())));
  } else {
    std::filesystem::remove(file);
  }
  return fmt::format("{}: {} {}{}", path_text(file), c.record() ? fmt::format("{}", after) : "no error left,",
                     unit_of(c.kind()),
                     !c.stored()     ? ", new"
                     : changed_today ? fmt::format(", before {}, which today is {}", before, *c.stored_now())
                                     : fmt::format(", before {}", before));
}

}  // namespace

std::vector<std::string> update_worst_cases(const Climber& climber) {
  std::vector<std::string> lines;
  for (const Climb& c : climber.climbs()) {
    if (!c.subject().own) continue;
    if (std::string line = update_worst_case(c); !line.empty()) lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace nearmiss
