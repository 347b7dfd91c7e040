#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "corpus/files/errors.hpp"
#include "corpus/files/file_value.hpp"
#include "corpus/files/files.hpp"
#include "corpus/storage/codec.hpp"
#include "reports/commands/command.hpp"
#include "reports/commands/options.hpp"
#include "reports/commands/tasks.hpp"
#include "reports/engine/output.hpp"
#include "reports/engine/replay.hpp"
#include "reports/findings/text.hpp"
#include "reports/picture/flat_picture.hpp"
#include "reports/picture/svg_picture.hpp"
#include "reports/picture/text_picture.hpp"
#include "reports/triage/causes/cause_json.hpp"
#include "reports/triage/minimisation/minimise.hpp"

namespace nearmiss {

namespace {

class ShowCommand : public Command {
 public:
  Manual manual() const override {
    return {
        "show",
        "show a finding with a picture of its scene, and what is known of it",
        {"FILE is a case, a stored case or a report, as JSON. The subject of the report is asked again, as by "
         "'nearmiss replay'. Below the page of the case stand a picture of the scene in characters, and what the "
         "report holds of earlier work: the cause and its evidence, found by 'nearmiss explain', and the numbers "
         "that matter, found by 'nearmiss minimise'.",
         "--picture writes the scene as an SVG file with the exact and the given answer: two views, and a third one "
         "enlarged where something is too small to be seen.",
         "'nearmiss render' makes the page with pictures that can be turned."},
        judging_exit_status(),
        {{"nearmiss show reports/runs/*/findings/moving_sphere_box/fcl-false-miss-*.json", "Findings of a run."},
         {"nearmiss show --subject fcl corpus/seeds/moving_sphere_box/hit-corner.json", "One subject, a stored case."},
         {"nearmiss show --subject ode corpus/upstream/ode/overlapping-boxes.json --picture boxes.svg",
          "A picture for an issue or a page."}}};
  }
  void declare(CLI::App& app) override {
    app.add_option("FILE", files_, "A case file or a report")->required()->type_name("");
    selection_.declare_subjects(app);
    add_measure(app, measure_);
    add_exact(app);
    app.add_option("--picture", picture_, "Write the scene and the answer of the first subject to this SVG file")
        ->type_name("FILE");
  }
  int run(const CLI::App&) override {
    if (!picture_.empty() && files_.size() > 1) throw BadInput("--picture: it is for one FILE");
    if (!picture_.empty()) check_can_write(picture_);
    std::vector<Task> tasks;
    for (const std::string& f : files_) tasks.push_back(read_task(f, selection_, measure_, "shown"));
    for (const Task& t : tasks) {
      use_measure(t.measure);
      show(t);
    }
    return bad_ ? 1 : 0;
  }

 private:
  void show(const Task& t) {
    const Replay r = replay(t.question, t.file, t.subjects, workers_);
    say("{}{}", std::exchange(first_, false) ? "" : "\n", replay_text(r));
    for (const Report& report : r.reports) bad_ = bad_ || is_bad(report.finding);
    if (r.reports.empty()) return;
    if (const std::string picture = text_picture(r.reports.front()); !picture.empty()) say("\nScene\n{}", picture);
    show_earlier_work(t, r.reports.front());
    if (!picture_.empty()) write_picture(t.file, r.reports.front());
  }
  void write_picture(const std::string& file, const Report& report) const {
    const std::string picture = svg_picture(flat_picture(report));
    if (picture.empty()) throw BadInput(fmt::format("{}: it has no shape that can be drawn", file));
    write_file(picture_, picture);
    say("\n{}\n", one_line(picture_));
  }
  static void show_earlier_work(const Task& t, const Report& report) {
    const nlohmann::json j = parse_json(t.text, t.file);
    const FileValue whole(j, t.file);
    if (const auto cause = whole.find("cause")) say("\n{}", cause_text(cause_from_json(*cause)));
    if (const auto minimised = whole.find("minimised"))
      say("\n{}", ranges_text(minimised_from_json(*minimised, report)));
  }

  std::vector<std::string> files_;
  std::string picture_;
  Selection selection_;
  std::optional<double> measure_;
  bool bad_ = false, first_ = true;
  Workers workers_;
};

}  // namespace

std::unique_ptr<Command> show_command() { return std::make_unique<ShowCommand>(); }

}  // namespace nearmiss
