#include "reports/page/page_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <tuple>

#include "corpus/files/errors.hpp"
#include "corpus/files/file_value.hpp"
#include "corpus/storage/codec.hpp"
#include "oracles/confirmed.hpp"
#include "reports/engine/night_changes.hpp"
#include "reports/engine/replay.hpp"
#include "reports/engine/run_folder.hpp"
#include "reports/findings/hash.hpp"
#include "reports/findings/report.hpp"
#include "reports/page/error_plot.hpp"
#include "reports/page/picture.hpp"
#include "reports/page/trade_page.hpp"

namespace nearmiss {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// An object that meets the given check. Throws BadInput.
Json read_object(const fs::path& file, void (*check)(const FileValue&)) {
  const std::string text = read_file(file);
  const nlohmann::json j = parse_json(text, file.string());
  if (!j.is_object()) throw BadInput(fmt::format("{}: it is not a JSON object", file.string()));
  check(FileValue(j, file.string()));
  return Json::parse(text);
}

/// What the page reads of the index of a run.
void check_index(const FileValue& index) {
  index.expect_schema(run_schema_version);
  for (const FileValue& t : index.at("tallies").items()) {
    (void)t.at("query").text(), (void)t.at("subject").text(), (void)t.at("cases").count();
    for (const auto& [verdict, count] : t.at("verdicts").members()) (void)count.count();
  }
  for (const FileValue& r : index.at("reports").items()) {
    for (const char* member : {"file", "query", "subject", "verdict", "disagreement", "headline"})
      (void)r.at(member).text();
    (void)r.at("backward_above_epsilon").number_or_null();
  }
  (void)index.at("cases").count(), (void)index.at("findings").count(), (void)index.at("started").text();
}

/// What the page reads of a triage. It shows what is there: each member of a signature may be missing.
void check_triage(const FileValue& triage) {
  triage.expect_schema(1);
  for (const FileValue& s : triage.at("signatures").items()) {
    for (const char* member :
         {"query", "subject", "id", "version", "scalar", "fault", "member", "clause", "headline", "worst", "simplest"})
      if (const auto text = s.find(member)) (void)text->text();
    for (const char* member : {"severity", "relative", "ordinary_share"})
      if (const auto number = s.find(member)) (void)number->not_negative();
    for (const char* member : {"count", "findings"})
      if (const auto count = s.find(member)) (void)count->count();
    for (const char* member : {"reports", "ids", "regions"})
      if (const auto texts = s.find(member)) (void)texts->texts();
  }
}

/// The triage in the folder, or that of the run in it: triage writes to a folder of that name.
std::optional<fs::path> triage_in(const fs::path& folder) {
  for (const fs::path& file : {folder / "triage.json", folder / "triage" / "triage.json"}) {
    if (fs::exists(file)) return file;
  }
  return std::nullopt;
}

bool is_run(const fs::path& folder) { return fs::exists(folder / "index.json"); }

/// The member, or null.
const Json& member_of(const Json& j, const char* name) {
  static const Json none;
  if (!j.is_object()) return none;
  const auto at = j.find(name);
  return at == j.end() ? none : *at;
}
std::string text_of_member(const Json& j, const char* name) {
  const Json& m = member_of(j, name);
  return m.is_string() ? m.get<std::string>() : "";
}
double number_of_member(const Json& j, const char* name) {
  const Json& m = member_of(j, name);
  return m.is_number() ? m.get<double>() : 0;
}

// --- a run without a triage ------------------------------------------------------------------------------------------

/// The words for the fault of a report in an index.
std::string fault_in_index(const Json& report) {
  const std::string breakage = text_of_member(report, "breakage");
  return breakage.empty() ? text_of_member(report, "disagreement") : breakage;
}

/// A wrong decision or a breakage is above every wrong number; among its like the proved bound decides.
double severity_of(const Json& report) {
  const std::string d = text_of_member(report, "disagreement");
  const bool is_grave =
      text_of_member(report, "verdict") == "broke" || d == "false miss" || d == "false hit" || d == "not finite";
  const double above = number_of_member(report, "backward_above_epsilon");
  return (is_grave ? 100 : 0) + std::log2(1 + std::max(0.0, above));
}

/// How many findings of this kind the run counted.
Json counted_in(const Json& index, const Json& report) {
  for (const Json& t : member_of(index, "tallies")) {
    if (member_of(t, "query") != report.at("query") || member_of(t, "subject") != report.at("subject")) continue;
    const std::string breakage = text_of_member(report, "breakage");
    if (!breakage.empty()) return member_of(member_of(t, "breakages"), breakage.c_str());
    const std::string d = text_of_member(report, "disagreement");
    return member_of(member_of(member_of(t, "disagreements"), d.c_str()), "violations");
  }
  return nullptr;
}

using RowKey = std::tuple<std::string, std::string, std::string>;
RowKey kind_in_index(const Json& report) {
  return {text_of_member(report, "query"), text_of_member(report, "subject"), fault_in_index(report)};
}

/// What a night says about each kind: "new", "worse", "known" or "fixed".
std::map<RowKey, std::string> changes_in(const Json& index) {
  std::map<RowKey, std::string> changes;
  for (const char* whose : {"ours", "others"}) {
    const Json& kinds = member_of(member_of(index, "night"), whose);
    for (const char* change : {"new", "worse", "known", "fixed"}) {
      for (const Json& report : member_of(kinds, change)) changes[kind_in_index(report)] = change;
    }
  }
  return changes;
}

Json signature_in_index(const Json& index, const RowKey& kind, const std::vector<const Json*>& reports) {
  const Json& worst = **std::max_element(
      reports.begin(), reports.end(), [](const Json* a, const Json* b) { return severity_of(*a) < severity_of(*b); });
  Fnv1a hash;
  for (const std::string& word : {std::get<0>(kind), std::get<1>(kind), std::get<2>(kind)}) hash.add(word);
  const std::string file = text_of_member(worst, "file");
  Json s{{"id", hash.id()},
         {"query", std::get<0>(kind)},
         {"subject", std::get<1>(kind)},
         {"fault", std::get<2>(kind)},
         {"severity", severity_of(worst)},
         {"count", reports.size()},
         {"findings", counted_in(index, worst)},
         {"headline", text_of_member(worst, "headline")},
         {"above_epsilon", member_of(worst, "backward_above_epsilon")},
         {"worst", file},
         {"simplest", file},
         {"reports", Json::array()}};
  for (const Json* r : reports) s["reports"].push_back(text_of_member(*r, "file"));
  return s;
}

std::vector<Json> signatures_in_index(const Json& index) {
  const std::map<RowKey, std::string> changes = changes_in(index);
  std::map<RowKey, std::vector<const Json*>> kinds;
  const auto reports = index.find("reports");
  if (reports != index.end()) {
    for (const Json& r : *reports) kinds[kind_in_index(r)].push_back(&r);
  }
  std::vector<Json> signatures;
  for (const auto& [kind, list] : kinds) {
    signatures.push_back(signature_in_index(index, kind, list));
    const auto change = changes.find(kind);
    signatures.back()["change"] = change == changes.end() ? Json(nullptr) : Json(change->second);
  }
  return signatures;
}

// --- the trend -------------------------------------------------------------------------------------------------------

/// One night: what each subject was asked, and how often it was wrong.
Json night_of(const fs::path& run, const Json& index) {
  std::map<std::string, double> wrong;
  for (const Json& t : member_of(index, "tallies")) {
    const Json& verdicts = member_of(t, "verdicts");
    wrong[text_of_member(t, "subject")] += number_of_member(verdicts, "violates contract") +
                                           number_of_member(verdicts, "differs by more than the measure") +
                                           number_of_member(verdicts, "broke");
  }
  return {{"run", run.filename().string()},
          {"started", text_of_member(index, "started")},
          {"cases", number_of_member(index, "cases")},
          {"findings", number_of_member(index, "findings")},
          {"subjects", wrong}};
}

// --- the answers of all subjects -------------------------------------------------------------------------------------

/// A list for each tally, in the order that page.schema.json states.
Json answers_in(const Json& index) {
  Json answers = Json::array();
  for (const Json& t : member_of(index, "tallies")) {
    const auto violations = [&](const char* fault) {
      return number_of_member(member_of(member_of(t, "disagreements"), fault), "violations");
    };
    const Json& verdicts = member_of(t, "verdicts");
    const double hits = violations("false hit"), misses = violations("false miss");
    const double wrong = number_of_member(verdicts, "violates contract") +
                         number_of_member(verdicts, "differs by more than the measure");
    answers.push_back({member_of(t, "query"), member_of(t, "subject"), member_of(t, "cases"), hits, misses,
                       wrong - hits - misses, member_of(verdicts, "broke"), member_of(verdicts, "cannot answer"),
                       member_of(t, "worst_backward_above_epsilon")});
  }
  return answers;
}

// --- compact rows ----------------------------------------------------------------------------------------------------

/// Numbers for words, so that a word of many rows is written once.
class PageWords {
 public:
  Json index_of(const Json& word) {
    if (!word.is_string()) return nullptr;
    const auto [at, is_new] = indices_.try_emplace(word.get<std::string>(), indices_.size());
    if (is_new) words_.push_back(word);
    return at->second;
  }
  const Json& words() const { return words_; }

 private:
  std::map<std::string, std::size_t> indices_;
  Json words_ = Json::array();
};

constexpr const char* word_columns[] = {"query",  "subject", "version", "scalar",        "fault",
                                        "member", "clause",  "change",  "severity_text", "asked_as"};
constexpr const char* plain_columns[] = {"id",      "severity", "count", "findings", "ordinary_share", "above_epsilon",
                                         "relative"};

/// Further rows have no headline of their own: 100,000 of them would be most of the page.
constexpr std::size_t most_headlines = 20'000;
constexpr std::size_t most_trade_data = 6'000'000;  ///< bytes: a third of the page, so that it has reports too

Json columns_of_rows() {
  Json columns = Json::array();
  for (const char* c : word_columns) columns.push_back(c);
  for (const char* c : {"headline", "cause", "cause_text", "decision"}) columns.push_back(c);
  for (const char* c : plain_columns) columns.push_back(c);
  columns.push_back("ours");
  return columns;
}

Json row_of(const Json& s, bool ours, bool with_headline, PageWords& words) {
  Json row = Json::array();
  for (const char* c : word_columns) row.push_back(words.index_of(member_of(s, c)));
  row.push_back(with_headline ? words.index_of(member_of(s, "headline")) : Json(nullptr));
  row.push_back(words.index_of(member_of(member_of(s, "cause"), "kind")));
  row.push_back(words.index_of(member_of(member_of(s, "cause"), "text")));
  const Json& decision = member_of(s, "decision");
  row.push_back(member_of(decision, "reopened") == true ? words.index_of("reopened")
                                                        : words.index_of(member_of(decision, "kind")));
  for (const char* c : plain_columns) row.push_back(member_of(s, c));
  row.push_back(ours ? 1 : 0);
  return row;
}

/// The regressions of the night come first: those of the subjects whose night it is, then those of others.
int rank_of(const Json& s, bool ours) {
  if (member_of(member_of(s, "decision"), "reopened") == true) return 0;
  const std::string change = text_of_member(s, "change");
  const int other = ours ? 0 : 2;
  return change == "worse" ? 1 + other : change == "new" ? 2 + other : change == "fixed" ? 6 : 5;
}

}  // namespace

PageData::PageData(fs::path folder, fs::path page_folder)
    : folder_(std::move(folder)), page_folder_(std::move(page_folder)), run_(folder_) {
  if (!fs::is_directory(folder_)) throw BadInput(fmt::format("{}: it is not a folder", folder_.string()));
  settle_run(folder_);
  settle_runs_below(folder_);
  read_trend();
  const std::optional<fs::path> triage = triage_in(folder_);
  if (triage) {
    read_triage(*triage);
  } else if (is_run(folder_)) {
    read_run(folder_);
  } else if (!trend_.empty()) {
    read_run(folder_ / text_of_member(trend_.back(), "run"));
  } else {
    throw BadInput(fmt::format("{}: it holds neither triage.json nor a run's index.json", folder_.string()));
  }
  trades_ = trades_for_page(folder_, most_trade_data, skipped_);
  sort_signatures();
}

void PageData::read_triage(const fs::path& file) {
  const Json j = read_object(file, check_triage);
  for (const Json& s : member_of(j, "signatures")) {
    Json& added = signatures_.emplace_back(s);
    if (std::string fault = text_of_member(s, "fault"); !fault.empty()) {  // a name for files: "false-miss"
      std::replace(fault.begin(), fault.end(), '-', ' ');
      added["fault"] = fault;
    }
  }
  summary_ = {{"kind", "triage"},
              {"totals", member_of(j, "totals")},
              {"sources", member_of(j, "sources")},
              {"environment", member_of(j, "environment")}};
  if (is_run(folder_)) summary_["run"] = read_object(folder_ / "index.json", check_index);
  const Json& skipped = member_of(j, "skipped");
  if (skipped.is_array()) skipped_ = skipped;
}

void PageData::read_run(const fs::path& run) {
  run_ = run;
  const Json index = read_object(run / "index.json", check_index);
  signatures_ = signatures_in_index(index);
  std::uint64_t reports = 0;
  for (const Json& s : signatures_) reports += s.at("count").get<std::uint64_t>();
  summary_ = {{"kind", "run"},
              {"totals",
               {{"signatures", signatures_.size()}, {"reports", reports}, {"findings", member_of(index, "findings")}}},
              {"environment", member_of(index, "environment")},
              {"run", index}};
}

void PageData::read_trend() {
  std::vector<Json> nights;
  for (const auto& entry : fs::directory_iterator(folder_)) {
    if (!entry.is_directory() || !is_run(entry.path())) continue;
    const fs::path file = entry.path() / "index.json";
    try {
      nights.push_back(night_of(entry.path(), read_object(file, check_index)));
    } catch (const BadInput& e) {
      skipped_.push_back({{"file", file.string()}, {"why", e.what()}});
    }
  }
  std::sort(nights.begin(), nights.end(), [](const Json& a, const Json& b) {
    return std::tuple(text_of_member(a, "started"), text_of_member(a, "run")) <
           std::tuple(text_of_member(b, "started"), text_of_member(b, "run"));
  });
  for (Json& n : nights) trend_.push_back(std::move(n));
}

void PageData::sort_signatures() {
  for (const Json& s : signatures_) ours_.try_emplace(text_of_member(s, "subject"), false);
  for (auto& [subject, ours] : ours_) ours = is_ours(subject);
  std::vector<std::tuple<int, double, std::size_t>> order;
  for (std::size_t i = 0; i < signatures_.size(); ++i) {
    const bool ours = ours_.at(text_of_member(signatures_[i], "subject"));
    order.emplace_back(rank_of(signatures_[i], ours), -number_of_member(signatures_[i], "severity"), i);
  }
  std::sort(order.begin(), order.end());
  std::vector<Json> sorted;
  for (const auto& [rank, severity, i] : order) sorted.push_back(std::move(signatures_[i]));
  signatures_ = std::move(sorted);
}

fs::path PageData::file_of(const std::string& path) const {
  const fs::path below = run_ / path;
  if (fs::exists(below)) return below;
  if (fs::exists(path)) return path;
  // The folder was moved, or named from elsewhere: the end of the path stays.
  const fs::path given(path);
  for (auto part = given.begin(); part != given.end(); ++part) {
    fs::path end;
    for (auto rest = part; rest != given.end(); ++rest) end /= *rest;
    for (const fs::path& base : {run_, run_.parent_path()}) {
      if (std::distance(part, given.end()) > 1 && fs::exists(base / end)) return base / end;
    }
  }
  return path;
}

void PageData::add_reports(std::size_t byte_limit, Workers& workers, const std::function<bool()>& has_time,
                           const std::function<bool(std::size_t)>& tick) {
  std::size_t bytes = to_json().dump(-1, ' ', false, Json::error_handler_t::replace).size();
  for (const Json& s : signatures_) {
    if (!tick(reports_.size())) return;
    const std::string worst = text_of_member(s, "worst"), simplest = text_of_member(s, "simplest");
    Json both{{"worst", nullptr}, {"simplest", nullptr}, {"details", details_of(s)}};
    if (!worst.empty()) both["worst"] = report_text(worst, workers, has_time);
    if (!simplest.empty() && simplest != worst) both["simplest"] = report_text(simplest, workers, has_time);
    bytes += both.dump(-1, ' ', false, Json::error_handler_t::replace).size();
    if (bytes > byte_limit) return;
    reports_.push_back(std::move(both));
  }
}

std::string PageData::report_text(const std::string& path, Workers& workers, const std::function<bool()>& has_time) {
  const fs::path file = file_of(path);
  try {
    const std::string text = read_file(file);
    const nlohmann::json report = parse_json(text, file.string());
    const FileValue whole(report, file.string());
    const Case question = case_of(report, file.string());
    Json j{{"file", path}, {"report", Json::parse(text)}, {"picture", picture_of(question, whole)}, {"plots", nullptr}};
    const Subject* subject = find_subject(whole.at("subject").at("name").text());
    const bool can_ask = subject != nullptr && subject->scalar == question.scalar &&
                         !(subject->offering(question.query->name).answer == nullptr);
    if (can_ask && has_time()) {
      use_measure(measure_of(report, file.string()));
      j["plots"] = error_plots(question, *subject, workers, has_time);
    }
    return j.dump(-1, ' ', false, Json::error_handler_t::replace);
  } catch (const InternalError& e) {
    ++internal_errors_;
    skipped_.push_back({{"file", path}, {"why", fmt::format("internal error: {}", e.what())}});
  } catch (const ReportedError& e) {
    skipped_.push_back({{"file", path}, {"why", e.what()}});
  }
  return "null";
}

std::string PageData::link_to(const fs::path& file) const {
  return fs::absolute(file)
      .lexically_normal()
      .lexically_relative(fs::absolute(page_folder_).lexically_normal())
      .generic_string();
}

/// The rest of a signature, for those whose reports are in the page.
Json PageData::details_of(const Json& s) const {
  constexpr std::size_t most_reports = 20;
  Json d{{"cause", member_of(s, "cause")},
         {"regions", member_of(s, "regions")},
         {"decision", member_of(s, "decision")},
         {"test", member_of(s, "test")},
         {"files", Json::array()}};
  const Json& files = member_of(s, "reports");
  for (std::size_t i = 0; files.is_array() && i < std::min(files.size(), most_reports); ++i) {
    if (files[i].is_string()) d["files"].push_back(link_to(file_of(files[i].get<std::string>())));
  }
  return d;
}

Json PageData::extremes() const {
  Json pages = Json::array();
  for (const fs::path& folder : {folder_, run_}) {
    for (const char* name : {"extremes.html", "extremes/extremes.html"}) {
      const std::string link = link_to(folder / name);
      if (fs::exists(folder / name) && std::find(pages.begin(), pages.end(), link) == pages.end())
        pages.push_back(link);
    }
  }
  return pages;
}

nlohmann::ordered_json PageData::to_json() const {
  PageWords words;
  Json rows = Json::array();
  for (const Json& s : signatures_) {
    rows.push_back(row_of(s, ours_.at(text_of_member(s, "subject")), rows.size() < most_headlines, words));
  }
  Json summary = summary_;
  if (member_of(summary, "run").is_object()) {  // the page needs none of the lists of an index
    for (const char* list : {"reports", "tallies", "stages", "touches", "not_offered", "by_class", "night", "climbs"})
      summary["run"].erase(list);
  }
  return {{"schema", 1},
          {"name", fs::absolute(folder_).lexically_normal().filename().string()},
          {"summary", summary},
          {"trend", trend_},
          {"skipped", skipped_},
          {"extremes", extremes()},
          {"answers", answers_in(member_of(summary_, "run"))},
          {"trades", trades_},
          {"words", words.words()},
          {"columns", columns_of_rows()},
          {"rows", rows},
          {"reports", reports_}};
}

}  // namespace nearmiss
