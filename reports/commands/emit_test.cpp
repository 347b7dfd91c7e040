#include "reports/upstream/emit_test.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "reports/commands/chosen_finding.hpp"
#include "reports/commands/command.hpp"
#include "reports/commands/options.hpp"

namespace nearmiss {

namespace {

class EmitTestCommand : public Command {
 public:
  Manual manual() const override {
    return {
        "emit-test",
        "turn a finding into a test for the library itself",
        {"FILE is a report, or a case with --for. The subject is asked again, and the answer becomes one source file "
         "that "
         "needs that library alone, not Nearmiss: with the exact numbers, the right answer and why it is right, and a "
         "check. The test asks the library in the same way as its adapter does. It fails as long as the library "
         "answers as now; it passes with a right answer, within the bound that the file states.",
         "The style is that of the library: GoogleTest for FCL and collide, a plain main for libccd, Bullet and ODE, "
         "and a program in C that is linked with the sources of a plugin. For an engine (docs/engines.md) it is a "
         "plain "
         "main where Debian has the engine, and a file for Node's test runner where npm has it. A comment has the "
         "command "
         "line that compiles or runs it.",
         "Where no finding is proved against the answer, the test passes now."},
        {{"0", "The test is written."},
         {"2", "It could not be written. One line on standard error says why."},
         internal_error_status()},
        {{"nearmiss emit-test small/moving_sphere_box/fcl-false-miss-*.json --out test.cpp", "A test for FCL."},
         {"nearmiss emit-test --for ode corpus/regressions/box_box_overlap/bullet-corner-with-margin.json",
          "The same case for another library."},
         {"nearmiss emit-test --for three corpus/upstream/three/slanted-capsule-and-box.json --out finding.test.mjs",
          "A test for an engine that './nearmiss engines three' has installed."}}};
  }
  void declare(CLI::App& app) override { chosen_.declare(app, "the test"); }
  int run(const CLI::App&) override {
    const ChosenFinding::Asked asked = chosen_.ask();
    chosen_.write(emit_test(asked.report, *asked.subject, chosen_.file()).text);
    return 0;
  }

 private:
  ChosenFinding chosen_;
};

}  // namespace

std::unique_ptr<Command> emit_test_command() { return std::make_unique<EmitTestCommand>(); }

}  // namespace nearmiss
