#include "reports/upstream/upstream_report.hpp"

#include <fmt/format.h>

#include "corpus/codec.hpp"
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
         "docs/upstream.md has those that are."},
        {{"0", "The report is written."},
         {"2", "It could not be written, or nothing is to be reported. One line on standard error says why."},
         internal_error_status()},
        {{"nearmiss upstream-report small/moving_sphere_box/fcl-false-miss-*.json --out issue.md",
          "For FCL's tracker."}}};
  }
  void declare(CLI::App& app) override {
    app.add_option("FILE", file_, "A report or a case file")->required()->type_name("");
    chosen_.declare(app);
    app.add_option("--out", out_, "Write to this file. Default: print the report")->type_name("FILE");
  }
  int run(const CLI::App&) override {
    const ChosenFinding::Asked asked = chosen_.ask(file_);
    const std::string text = upstream_report(asked.report, *asked.subject);
    if (out_.empty()) {
      fmt::print("{}", text);
    } else {
      write_file(out_, text);
      fmt::print("{}\n", out_);
    }
    return 0;
  }

 private:
  std::string file_, out_;
  ChosenFinding chosen_;
};

}  // namespace

std::unique_ptr<Command> upstream_report_command() { return std::make_unique<UpstreamReportCommand>(); }

}  // namespace nearmiss
