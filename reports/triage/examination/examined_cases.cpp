#include "reports/triage/examination/examined_cases.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "corpus/files/file_value.hpp"
#include "corpus/storage/codec.hpp"
#include "reports/engine/interrupt.hpp"
#include "reports/engine/replay.hpp"
#include "reports/findings/pretty_json.hpp"
#include "reports/findings/version.hpp"
#include "reports/triage/causes/cause_json.hpp"
#include "reports/triage/hypotheses/cause_of.hpp"
#include "reports/triage/minimisation/minimise.hpp"

namespace nearmiss {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int examined_schema_version = 1;

/// The part of the time that the search for a simpler case may take; the cause may take the rest.
constexpr double share_of_minimising = 0.25;

}  // namespace

std::optional<ExaminedCase> ExaminedCases::earlier(const FiledReport& of) try {
  std::error_code error;
  if (!fs::is_regular_file(file_of(of), error)) return std::nullopt;
  const json kept = parse_json(read_file(file_of(of)), file_of(of).string());
  if (kept.at("schema") != examined_schema_version || kept.at("version") != of.subject->version ||
      kept.at("nearmiss") != version()) {
    return std::nullopt;
  }
  const fs::path file = folder_ / kept.at("simplest").get<std::string>();
  const json report = parse_json(read_file(file), file.string());
  ExaminedCase e{
      case_of(report, file.string()), file, 0, {}, cause_from_json(FileValue(report, file.string()).at("cause"))};
  const Report now = nearmiss::examine(e.simplest, *of.subject, workers_);
  if (!is_bad(now.finding) || json(answer_to_json(*e.simplest.query, now.answer)) != report.at("answer"))
    return std::nullopt;
  e.branches = now.finding.branches;
  e.regions = feature_regions_of(e.simplest);
  return e;
} catch (const BadInput&) {  // unreadable, or written by another version: the case is examined again
  return std::nullopt;
} catch (const json::exception&) {
  return std::nullopt;
}

std::optional<ExaminedCase> ExaminedCases::examine(const FiledReport& of, const Case& plain,
                                                   std::chrono::duration<double> time,
                                                   const std::function<void(std::uint64_t)>& tick) {
  const MinimiseLimits limits{MinimiseLimits().questions, share_of_minimising * time, true, false};
  std::optional<Minimised> m = minimise(plain, *of.subject, limits, workers_, tick);
  if (!m || interrupted()) return std::nullopt;
  Report& r = m->report;
  const CauseLimits cause_limits{CauseLimits().questions, (1 - share_of_minimising) * time};
  ExaminedCase e{r.question,
                 {},
                 r.finding.branches,
                 feature_regions_of(r.question),
                 cause_of(r, *of.subject, cause_limits, workers_)};
  if (interrupted()) return std::nullopt;
  r.question.origin = "minimise";
  r.question.moves.clear();
  const fs::path below = fs::path("simplest") / r.question.query->name /
                         fmt::format("{}-{}-{}.json", r.subject, fault_of(r.finding), nearmiss::id_of(r));
  e.file = folder_ / below;
  r.replay = replay_command(*of.subject, e.file.string());
  make_folder(e.file.parent_path());
  nlohmann::ordered_json report = minimised_to_json(*m);
  report["cause"] = cause_to_json(e.cause);
  write_file(e.file, pretty_json(report));
  make_folder(file_of(of).parent_path());
  write_file(file_of(of), pretty_json({{"schema", examined_schema_version},
                                       {"version", of.subject->version},
                                       {"nearmiss", version()},
                                       {"simplest", below.generic_string()}}));
  return e;
}

void ExaminedCases::add_ranges(const ExaminedCase& e, const Subject& subject, std::chrono::duration<double> time,
                               const std::function<void(std::uint64_t)>& tick) {
  nlohmann::ordered_json report = nlohmann::ordered_json::parse(read_file(e.file), nullptr, false);
  if (!report.is_object() || !report.contains("minimised") || !report["minimised"]["same_finding"].empty()) return;
  const std::optional<Minimised> m = ranges_around(e.simplest, subject, time, workers_, tick);
  if (!m) return;
  report["minimised"]["same_finding"] = ranges_to_json(m->ranges, e.simplest);
  report["minimised"]["ranges_ended_by"] = name_of(m->ranges_end);
  report["minimised"]["questions"] = report["minimised"]["questions"].get<std::uint64_t>() + m->questions;
  write_file(e.file, pretty_json(report));
}

}  // namespace nearmiss
