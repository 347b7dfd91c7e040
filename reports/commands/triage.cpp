#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "corpus/storage/codec.hpp"
#include "reports/commands/command.hpp"
#include "reports/commands/options.hpp"
#include "reports/engine/interrupt.hpp"
#include "reports/engine/progress.hpp"
#include "reports/engine/run.hpp"
#include "reports/findings/pretty_json.hpp"
#include "reports/findings/text.hpp"
#include "reports/triage/comparison/baseline.hpp"
#include "reports/triage/comparison/check.hpp"
#include "reports/triage/triage.hpp"
#include "reports/triage/triage_json.hpp"
#include "reports/triage/triage_text.hpp"

namespace nearmiss {

namespace {

namespace fs = std::filesystem;

class TriageCommand : public Command {
 public:
  Manual manual() const override {
    return {
        "triage",
        "group findings into bugs, with their causes, and compare them with a baseline",
        {"SOURCE is a run folder, a folder of reports or run folders, or a report. Every report's subject is asked "
         "again. Of each kind of finding a few reports are minimised, and their causes are looked for by asking the "
         "subject changed cases. Findings that are probably one bug have one signature: one row, with its number, its "
         "worst and its simplest case. Rows are in the order of severity; docs/triage.md has the formula. Findings "
         "that vanish where the same scene is asked at ordinary magnitude are one row for each query, the last ones; "
         "they do not change the exit status. Files that are no reports of this "
         "version are named on standard error and skipped.",
         "The result is written to FOLDER/triage.json, and the simplest cases to FOLDER/simplest/. What was "
         "examined is kept there, so that the same command goes on where an earlier one ended.",
         "With --baseline, rows are new or worse (proved by the numbers of findings and cases of both runs, or by the "
         "same cases), known, unproved (too rare to be proved new), or fixed: the subject, asked the cases of the "
         "baseline again, is right. A line 'ID accepted|upstream|reported URL|fixed VERSION "
         "[at N %]  # why' in the file of --decisions takes a row out of the exit status until its proved size is "
         "at least twice N % of the scene, or until it is found in that version.",
         "With --check and without a SOURCE, triage itself asks: first the cases that the baseline keeps, then those "
         "of "
         "its run, which are the same in every check, then fresh ones for what is left of --minutes. Only what may be "
         "new is examined. The fresh run is in the folder of --out, with its triage."},
        {{"0", "Nothing is new or worse, or decisions about it hold."},
         {"1", "A row is new, worse or open again. Without --baseline every row is new."},
         {"2",
          "It could not run: wrong arguments, no report could be read, or an output that cannot be written. Or no "
          "row is new, and it was interrupted. One line on standard error says why."},
         internal_error_status()},
        {{"nearmiss triage reports/runs/tuesday", "How many bugs is that?"},
         {"nearmiss triage reports/runs/tuesday --baseline reports/runs/monday", "What has changed since?"},
         {"nearmiss triage --check --baseline known.json --minutes 2",
          "A step of continuous integration: is anything new or worse?"},
         {"nearmiss triage run --baseline known.json --decisions decisions.txt --junit triage.xml",
          "The same for a run."}}};
  }
  void declare(CLI::App& app) override {
    CLI::Option* source =
        app.add_option("SOURCE", sources_, "A run folder, a folder of reports, or a report")->type_name("");
    declare_foreign_subjects(app);
    CLI::Option* baseline = app.add_option("--baseline", baseline_, "An earlier triage.json, or an earlier run folder")
                                ->type_name("FILE|DIR");
    CLI::Option* check =
        app.add_flag("--check", check_, "Ask what the baseline asked, and fresh cases, in place of a SOURCE")
            ->needs(baseline)
            ->excludes(source);
    add_whole_number(app, "--seed", seed_, "The seed of the fresh cases. Default: a random one, which is printed", 0,
                     std::numeric_limits<std::uint64_t>::max());
    app.get_option("--seed")->needs(check);
    app.add_option("--decisions", decisions_, "The file of what was decided about signatures")->type_name("FILE");
    add_positive_number(app, "--minutes", minutes_,
                        "The most time to examine findings, with --check of all. Default: 5, with --check 1", "M", 1e5);
    add_whole_number(app, "--rows", rows_, "How many rows are printed. Default: 8", 0, 1'000'000);
    app.add_flag("--ordinary", ordinary_, "Leave out findings that vanish at ordinary magnitude");
    app.add_flag("--all-magnitudes", all_magnitudes_, "Let these findings change the exit status, too")
        ->excludes("--ordinary");
    add_output_folder(app, out_, "The folder. Default: SOURCE/triage of the first folder; with --check that of a run");
    app.add_option("--json", json_, "Also write the result to this file as JSON")->type_name("FILE");
    app.add_option("--sarif", sarif_, "Also write it as SARIF 2.1.0")->type_name("FILE");
    app.add_option("--junit", junit_, "Also write it as JUnit XML")->type_name("FILE");
  }
  int run(const CLI::App&) override {
    decisions_now_ =
        decisions_.empty() ? std::vector<SignatureDecision>() : decisions_in(read_file(decisions_), decisions_);
    return check_ ? check() : triage_sources();
  }

 private:
  static constexpr double default_minutes = 5, default_check_minutes = 1;
  static constexpr std::uint64_t default_rows = 8;

  int triage_sources() {
    if (sources_.empty()) throw BadInput("SOURCE is required, or --check");
    const Sources sources = read_sources(sources_);
    name_skipped(sources);
    if (sources.reports.empty() && !sources.skipped.empty())
      throw BadInput(fmt::format("no report could be read; {} skipped", plural_text(sources.skipped.size(), "file")));
    check_outputs(folder());
    catch_interrupts();
    const TriageSettings settings = settings_for(folder(), default_minutes);
    std::optional<Baseline> before;
    if (!baseline_.empty()) before = read_baseline(baseline_, settings, workers_);
    Triage t = triage(sources, settings, workers_);
    if (before && !interrupted()) name_not_asked(compare_with(*before, t, settings, workers_));
    finish(settings.folder, t);
    say("{}", triage_text(t, rows_.value_or(default_rows)));
    return exit_status(t);
  }
  int check() {
    const std::uint64_t seed = seed_or_random(seed_);
    const fs::path run_folder = out_.empty() ? new_run_folder(seed) : fs::path(out_);
    check_outputs(run_folder / "triage");
    catch_interrupts();
    const TriageSettings settings = settings_for(run_folder / "triage", default_check_minutes);
    const Baseline before = read_baseline(baseline_, settings, workers_);
    Check checked =
        check_against(before, {typed_command_line(), run_folder, seed, settings.time, settings.tick}, workers_);
    name_not_asked(checked.not_asked);
    finish(settings.folder, checked.triage);
    say("{}", check_text(checked));
    return exit_status(checked.triage);
  }
  TriageSettings settings_for(const fs::path& folder, double usual_minutes) {
    return {folder, std::chrono::duration<double>(60 * minutes_.value_or(usual_minutes)),
            [this](const std::string& what, std::uint64_t done, std::uint64_t of) {
              progress_.set_activity(what);
              progress_.show(done, of, std::nullopt, std::nullopt);
            }};
  }
  /// Chooses the magnitudes, applies the decisions, and writes the files.
  void finish(const fs::path& folder, Triage& t) const {
    choose_magnitudes(t);
    for (const std::string& id : apply(decisions_now_, t)) {
      say_on_stderr(fmt::format("nearmiss: {}: no signature has the id {}\n", decisions_, id));
    }
    write(folder, t);
  }
  static int exit_status(const Triage& t) {
    const bool stands = std::any_of(t.signatures.begin(), t.signatures.end(), [](const auto& s) { return s.stands(); });
    if (interrupted()) say_on_stderr("nearmiss: interrupted\n");
    return stands ? 1 : interrupted() ? 2 : 0;
  }

  fs::path folder() const {
    if (!out_.empty()) return out_;
    for (const std::string& s : sources_) {
      std::error_code error;
      if (fs::is_directory(s, error)) return fs::path(s) / "triage";
    }
    return runs_folder() / "triage";
  }
  /// Before the work.
  void check_outputs(const fs::path& folder) const {
    make_writable_folder(folder);
    for (const std::string& file : {json_, sarif_, junit_}) {
      if (!file.empty()) check_can_write(file);
    }
  }
  void choose_magnitudes(Triage& t) const {
    for (TriagedSignature& s : t.signatures) {
      if (s.range) s.may_stand = all_magnitudes_;
      if (s.range && ordinary_) t.left_out += s.findings;
    }
    if (ordinary_) std::erase_if(t.signatures, [](const TriagedSignature& s) { return s.range.has_value(); });
  }
  void name_not_asked(const std::vector<std::string>& subjects) const {
    for (const std::string& subject : subjects) {
      say_on_stderr(
          fmt::format("nearmiss: {}: findings of {} are left out, which cannot be asked here\n", baseline_, subject));
    }
  }
  void write(const fs::path& folder, const Triage& t) const {
    make_folder(folder);
    const std::string text = pretty_json(triage_to_json(t));
    write_file(folder / "triage.json", text);
    if (!json_.empty()) write_file(json_, text);
    if (!sarif_.empty()) write_file(sarif_, pretty_json(triage_to_sarif(t)));
    if (!junit_.empty()) write_file(junit_, triage_to_junit(t));
  }

  std::vector<std::string> sources_;
  std::string baseline_, decisions_, out_, json_, sarif_, junit_;
  bool ordinary_ = false, all_magnitudes_ = false, check_ = false;
  std::optional<std::uint64_t> seed_;
  std::vector<SignatureDecision> decisions_now_;
  std::optional<double> minutes_;
  std::optional<std::uint64_t> rows_;
  Workers workers_{[] { return !interrupted(); }};
  Progress progress_;
};

}  // namespace

std::unique_ptr<Command> triage_command() { return std::make_unique<TriageCommand>(); }

}  // namespace nearmiss
