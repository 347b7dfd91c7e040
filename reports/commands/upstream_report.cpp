#include "reports/upstream/upstream_report.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "corpus/files/files.hpp"
#include "reports/commands/chosen_finding.hpp"
#include "reports/commands/command.hpp"
#include "reports/picture/flat_picture.hpp"
#include "reports/picture/svg_picture.hpp"

namespace nearmiss {

namespace {

class UpstreamReportCommand : public Command {
 public:
  Manual manual() const override {
    return {
        "upstream-report",
        "write a finding down for the authors of the library",
        {"FILE is a report, or a case with --for. The subject is asked again. The text is Markdown, ready to be sent: "
         "what is wrong and what is proved, the version of the library and the environment, the numbers and a picture "
         "of the scene, the given and the exact answer, the program of 'nearmiss emit-test', and what other libraries "
         "answer. It names no folder of this machine. --picture writes the scene with both answers as an SVG file, "
         "which the text shows: the authors of a library see at a glance what an issue is about. Upload it with the "
         "text.",
         "Look first whether the library's own documentation allows the answer, and whether the finding is known: "
         "docs/measured/upstream.md has those that are."},
        {{"0", "The report is written."},
         {"2", "It could not be written, or nothing is to be reported. One line on standard error says why."},
         internal_error_status()},
        {{"nearmiss upstream-report small/moving_sphere_box/fcl-false-miss-*.json --out issue.md --picture issue.svg",
          "For FCL's tracker."}}};
  }
  void declare(CLI::App& app) override {
    chosen_.declare(app, "the report");
    app.add_option("--picture", picture_, "Write the scene and both answers to this SVG file, and show it in the text")
        ->type_name("FILE");
  }
  int run(const CLI::App&) override {
    if (!picture_.empty()) check_can_write(picture_);
    const ChosenFinding::Asked asked = chosen_.ask();
    const std::string picture = picture_.empty() ? "" : svg_picture(flat_picture(asked.report));
    const std::string shown = picture.empty() ? "" : std::filesystem::path(picture_).filename().string();
    const std::string text = upstream_report(asked.report, *asked.subject, shown);
    if (!picture.empty()) write_file(picture_, picture);
    chosen_.write(text);
    return 0;
  }

 private:
  ChosenFinding chosen_;
  std::string picture_;
};

}  // namespace

std::unique_ptr<Command> upstream_report_command() { return std::make_unique<UpstreamReportCommand>(); }

}  // namespace nearmiss
