#include "reports/upstream/upstream_report.hpp"

#include <fmt/format.h>

#include "reports/commands/chosen_finding.hpp"
#include "reports/commands/command.hpp"

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
         "answer. It names no folder of this machine.",
         "Look first whether the library's own documentation allows the answer, and whether the finding is known: "
         "docs/measured/upstream.md has those that are."},
        {{"0", "The report is written."},
         {"2", "It could not be written, or nothing is to be reported. One line on standard error says why."},
         internal_error_status()},
        {{"nearmiss upstream-report small/moving_sphere_box/fcl-false-miss-*.json --out issue.md",
          "For FCL's tracker."}}};
  }
  void declare(CLI::App& app) override { chosen_.declare(app, "the report"); }
  int run(const CLI::App&) override {
    const ChosenFinding::Asked asked = chosen_.ask();
    chosen_.write(upstream_report(asked.report, *asked.subject));
    return 0;
  }

 private:
  ChosenFinding chosen_;
};

}  // namespace

std::unique_ptr<Command> upstream_report_command() { return std::make_unique<UpstreamReportCommand>(); }

}  // namespace nearmiss
