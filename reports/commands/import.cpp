#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "corpus/importers/nyu_ccd.hpp"
#include "corpus/scenes/recorded_cases.hpp"
#include "corpus/scenes/trace_scene.hpp"
#include "corpus/storage/codec.hpp"
#include "impl/catalogue/query_ids.hpp"
#include "oracles/exact/oracle.hpp"
#include "reports/commands/command.hpp"
#include "reports/commands/options.hpp"
#include "reports/engine/campaign.hpp"
#include "reports/engine/interrupt.hpp"
#include "reports/engine/progress.hpp"
#include "reports/engine/run.hpp"
#include "reports/engine/tally.hpp"
#include "reports/findings/pretty_json.hpp"
#include "reports/findings/report.hpp"
#include "reports/findings/report_text.hpp"
#include "reports/findings/text.hpp"

namespace nearmiss {

namespace {

namespace fs = std::filesystem;

/// The benchmark asks about the times from 0 to 1, both included.
constexpr double end_of_time = 1;

/// The index of the time among the numbers of an answer.
std::size_t time_of(const Query& query) { return query.layout.at(Role::time)->begin; }

/// The oracle's exact decision of the benchmark's question.
bool exactly_collides(const Case& question) {
  Answer at_end;
  at_end.yes = true;
  at_end.values[time_of(*question.query)] = end_of_time;
  const Enclosure e = oracle_of(*question.query).exact(question.values, at_end, question.scalar, nullptr);
  return e.may_be_yes && e.error[time_of(*question.query)].high <= 0;  // error is the exact time less end_of_time
}

bool says_collides(const Query& query, const Answer& a) { return a.yes && a.values[time_of(query)] <= end_of_time; }

std::string word(bool collides) { return collides ? "collides" : "does not collide"; }

/// One subject's answers, compared with the benchmark's truth.
struct Score {
  const Subject* subject = nullptr;
  std::uint64_t right = 0, false_hits = 0, false_misses = 0, outside = 0, cannot_answer = 0, broke = 0, violations = 0;
  std::uint64_t gave_up = 0;       ///< cases not asked because it was given up
  std::vector<std::string> wrong;  ///< one line each
};

/// Counts and lists the results of an import.
class NyuCcd : public Sink {
 public:
  NyuCcd(std::span<const Subject* const> subjects, fs::path out)
      : out_(std::move(out)), campaign_({out_.empty() ? runs_folder() : out_, [this] { show_progress(); }}, {this}) {
    for (const Subject* s : subjects) {
      if (s->offering(query()).answer != nullptr) scores_.emplace_back().subject = s;
    }
  }
  static std::string_view query() { return query_of(QueryId::moving_point_triangle).name; }

  void take(const GroundTruths& read) {
    queries_ += read.queries;
    skipped_ += read.skipped;
    for (std::size_t at = 0; at < read.fit.size() && !interrupted(); at += Worker::capacity) {
      take_batch({read.fit.data() + at, std::min(Worker::capacity, read.fit.size() - at)});
      show_progress();
    }
  }
  void take(const Examined& e) override { score(*now_, e, batch_[at_[e.of_batch]].where, truth_[at_[e.of_batch]]); }
  void take_given_up(const Query&, const Subject&, std::uint64_t cases, const Endurance&) override {
    now_->gave_up += cases;
  }
  std::string text();
  std::string summary() const;
  std::uint64_t queries() const { return queries_; }
  int exit_code() const {
    if (campaign_.internal_errors().count() > 0) return InternalError::exit_code;
    const bool violated =
        std::any_of(scores_.begin(), scores_.end(), [](const Score& s) { return s.violations + s.broke > 0; });
    return !oracle_wrong_.empty() || violated ? 1 : interrupted() ? 2 : 0;
  }

 private:
  const Endurance& endurance_of(const Score& s) {
    return campaign_.dispatcher().endurance(*s.subject, query_of(QueryId::moving_point_triangle));
  }
  void show_progress() { progress_.show(fit_, std::nullopt, std::nullopt, oracle_wrong_.size()); }
  void take_batch(std::span<const GroundTruth> batch) {
    batch_ = batch;
    truth_.clear();
    for (const GroundTruth& g : batch) {
      if (interrupted()) return;
      const bool exact = exactly_collides(g.question);
      compare_oracle(g, exact);
      truth_.push_back(g.parallel ? exact : g.collides);
      if (!out_.empty()) write(g);
    }
    for (Score& s : scores_) ask(s);
  }
  void compare_oracle(const GroundTruth& g, bool exact) {
    ++fit_;
    if (g.parallel) ++parallel_;
    if (exact == g.collides) return;
    const std::string line =
        fmt::format("{}: the benchmark says that it {}, the oracle that it {}", g.where, word(g.collides), word(exact));
    (g.parallel ? parallel_wrong_ : oracle_wrong_).push_back(line);
  }
  void ask(Score& s) {
    std::vector<Case> cases;
    at_.clear();
    for (std::size_t i = 0; i < batch_.size(); ++i) {
      if (auto same = in_scalar(batch_[i].question, s.subject->scalar)) {
        cases.push_back(std::move(*same));
        at_.push_back(i);
      }
    }
    s.outside += batch_.size() - cases.size();
    now_ = &s;
    if (!cases.empty()) campaign_.examine({&s.subject, 1}, cases);
  }
  static void score(Score& s, const Examined& e, const std::string& where, bool truth) {
    const Finding& f = e.finding;
    const Answer& a = e.answer;
    if (f.is_proved()) ++s.violations;
    if (f.verdict == Verdict::broke) ++s.broke;
    if (f.verdict == Verdict::cannot_answer) ++s.cannot_answer;
    if (f.verdict == Verdict::not_asked) ++s.outside;
    if (a.status != Answer::Status::answered) return;
    if (says_collides(*e.question.query, a) == truth) {
      ++s.right;
      return;
    }
    ++(truth ? s.false_misses : s.false_hits);
    s.wrong.push_back(
        fmt::format("{}: {} says {}, but it {} until time {:g} (verdict: {}{})", where, s.subject->name,
                    answer_text(*e.question.query, a, e.question.scalar), word(truth), end_of_time, name_of(f.verdict),
                    f.backward ? ", backward error > " + epsilons_text(f.backward->above) + " epsilon" : ""));
  }
  void write(const GroundTruth& g) const {
    const std::size_t colon = g.where.rfind(':');  // "erleben-spikes/data_0_0.csv:1"
    const fs::path file = fs::absolute(g.where.substr(0, colon));
    write_file(out_ / fmt::format("{}-{}-{}.json", file.parent_path().filename().string(), file.stem().string(),
                                  g.where.substr(colon + 1)),
               pretty_json(case_to_json(g.question)));
  }

  fs::path out_;
  Progress progress_;
  std::vector<Score> scores_;
  std::uint64_t queries_ = 0, skipped_ = 0, fit_ = 0, parallel_ = 0;
  std::vector<std::string> oracle_wrong_, parallel_wrong_;
  std::span<const GroundTruth> batch_;
  std::vector<bool> truth_;      ///< for each case of the batch
  Score* now_ = nullptr;         ///< the score of the subject that is asked
  std::vector<std::size_t> at_;  ///< index in the batch of each case that the subject is asked
  Campaign campaign_;
};

std::string lines_of(std::string_view heading, const std::vector<std::string>& lines) {
  if (lines.empty()) return "";
  return fmt::format("\n{}\n  {}\n", heading, fmt::join(lines, "\n  "));
}

std::string NyuCcd::text() {
  std::string text = fmt::format(
      "{} queries: {} fit {}, {} skipped (the corners move differently, or no double holds the relative velocity)\n"
      "The oracle agrees with the truth column on {} of {}; {} of them move parallel to the face, where the\n"
      "one-sided query has no hit by definition.\n",
      count_text(queries_), count_text(fit_), query(), count_text(skipped_),
      count_text(fit_ - oracle_wrong_.size() - parallel_wrong_.size()), count_text(fit_), count_text(parallel_));
  text += lines_of("The oracle contradicts the truth column:", oracle_wrong_);
  text += lines_of("Motion parallel to the face (not counted against anybody):", parallel_wrong_);
  std::vector<std::vector<std::string>> rows{
      {"SUBJECT", "RIGHT", "FALSE HITS", "FALSE MISSES", "OUTSIDE", "NO ANSWER", "BROKE", "VIOLATIONS"}};
  for (const Score& s : scores_) {
    rows.push_back({s.subject->name, count_text(s.right), count_text(s.false_hits), count_text(s.false_misses),
                    count_text(s.outside), count_text(s.cannot_answer), count_text(s.broke), count_text(s.violations)});
  }
  text +=
      "\nCollides until time 1, by subject (OUTSIDE: a number is not exact in the subject's scalar, or the case "
      "outside of what it\nrequires)\n" +
      table_text(rows, "", 1);
  for (const Score& s : scores_) {
    if (s.gave_up > 0) text += fmt::format("\n{}\n", given_up_text(s.subject->name, query(), endurance_of(s)));
  }
  for (const Score& s : scores_) text += lines_of("Wrong: " + s.subject->name, s.wrong);
  return text;
}

std::string NyuCcd::summary() const {
  return fmt::format(
      "{}{} queries, {} fit, {} skipped; the oracle contradicts the truth column on {}, and on {} parallel ones",
      interrupted() ? "interrupted: " : "", count_text(queries_), count_text(fit_), count_text(skipped_),
      count_text(oracle_wrong_.size()), count_text(parallel_wrong_.size()));
}

class ImportCommand : public Command {
 public:
  Manual manual() const override {
    return {"import",
            "read cases of a benchmark whose truth is known, and compare; or make a scene of recorded cases",
            {"With the FORMAT nyu-ccd, the files hold vertex-face queries of the NYU continuous-collision benchmark. A "
             "query has 8 "
             "rows (the vertex and three face corners at time 0, then at time 1) of 7 integer columns (x, y, z as "
             "pairs of numerator and denominator, then the truth). Queries whose corners all move alike become "
             "cases of moving_point_triangle, with the triangle turned towards the point; the others are counted "
             "as skipped.",
             "Compares the exact oracle's decision (a hit at a time of at most 1) with the truth column, and so "
             "the answer of every subject that offers the query. A motion exactly parallel to the face has no hit "
             "by the query's definition; where the truth column says otherwise, the case is listed separately.",
             "With the FORMAT jsonl or csv, the files hold inputs of queries that a program recorded "
             "(corpus/scenes/nearmiss_record.h writes jsonl), and --scene is needed: nothing is asked, and the cases "
             "become a scene (docs/scenes.md). A line of jsonl is {\"query\", \"scalar\", \"values\"}, a row of csv "
             "query, scalar, values; the values are the inputs in the order of 'nearmiss list --members QUERY'. A "
             "decimal means the nearest number of the "
             "scalar; a note says how many were rounded.",
             "--scene FILE.json writes the scene, and its cases beside it as FILE.jsonl; it also works with nyu-ccd."},
            {{"0", "The oracle agrees with the truth column, and no subject violates its contract."},
             {"1", "The oracle contradicts the truth column, or a subject violates its contract."},
             {"2",
              "A file cannot be read or is malformed, none holds a query, the output cannot be written, or it was "
              "interrupted."},
             internal_error_status()},
            {{"nearmiss import nyu-ccd erleben-spikes/*.csv", "Compare."},
             {"nearmiss import nyu-ccd erleben-spikes/*.csv --out cases", "Also write each case as a JSON file."},
             {"nearmiss import jsonl trace.jsonl --scene mine.json", "Make a scene of a recorded trace."}}};
  }
  void declare(CLI::App& app) override {
    app.add_option("FORMAT", format_, "The format of the files: nyu-ccd, jsonl or csv")
        ->required()
        ->type_name("")
        ->check(CLI::Validator(
            [](const std::string& t) {
              const bool known = t == "nyu-ccd" || t == "jsonl" || t == "csv";
              return known ? "" : "unknown format '" + t + "'; known are nyu-ccd, jsonl, csv";
            },
            ""));
    app.add_option("FILE", files_, "A file of the benchmark, or of recorded cases")->required()->type_name("");
    app.add_option("--scene", scene_, "Write a scene of the cases into this file, which must end with .json")
        ->type_name("FILE");
    add_exact(app);
    add_output_folder(app, out_, "Write each case that fits as a JSON file into this folder");
    selection_.declare_subjects(app);
  }
  int run(const CLI::App&) override {
    catch_interrupts();
    if (!out_.empty()) make_writable_folder(out_);
    if (!scene_.empty()) check_can_write(scene_);
    if (format_ != "nyu-ccd") return import_recorded();
    NyuCcd import(selection_.subjects(), out_);
    std::vector<Case> cases;
    for (const std::string& f : files_) {
      if (interrupted()) break;
      const GroundTruths read = read_nyu_ccd({f});
      import.take(read);
      if (scene_.empty()) continue;
      for (const GroundTruth& g : read.fit) cases.push_back(g.question);
    }
    if (import.queries() == 0 && !interrupted()) throw BadInput("nothing to compare: no file holds a query");
    say("{}\n{}\n", import.text(), import.summary());
    if (!scene_.empty() && !interrupted()) write_scene(cases);
    if (interrupted()) say_on_stderr(fmt::format("nearmiss: {}\n", import.summary()));
    return import.exit_code();
  }

 private:
  int import_recorded() const {
    if (scene_.empty())
      throw BadInput(
          fmt::format("import {}: --scene is missing: recorded cases have no truth to compare with, and can "
                      "become a scene",
                      format_));
    if (!out_.empty()) throw BadInput(fmt::format("import {}: --out: it writes the cases of nyu-ccd alone", format_));
    std::vector<Case> cases;
    for (const std::string& f : files_) {
      for (Case& c : format_ == "csv" ? scenes::read_csv(f) : scenes::read_json_lines(f)) cases.push_back(std::move(c));
    }
    write_scene(cases);
    return 0;
  }
  void write_scene(const std::vector<Case>& cases) const {
    std::vector<std::string> names;
    for (const std::string& f : files_) names.push_back(fs::path(f).filename().string());
    const scenes::Scene s = scenes::write_trace_scene(scene_, cases, fmt::format("{}", fmt::join(names, ", ")));
    std::vector<std::string_view> asked;
    for (const Query* q : s.all_queries()) asked.push_back(q->name);
    say("{}: {} cases, asking {}; what the scene requires is chosen from their sizes: state what the program "
        "needs\n",
        path_text(s.file), count_text(s.recorded.size()), fmt::join(asked, ", "));
  }

  std::string format_, out_, scene_;
  std::vector<std::string> files_;
  Selection selection_;
};

}  // namespace

std::unique_ptr<Command> import_command() { return std::make_unique<ImportCommand>(); }

}  // namespace nearmiss
