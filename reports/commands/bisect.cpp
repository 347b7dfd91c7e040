#include "reports/triage/comparison/bisect.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "corpus/storage/codec.hpp"
#include "reports/commands/command.hpp"
#include "reports/commands/options.hpp"
#include "reports/engine/interrupt.hpp"
#include "reports/engine/progress.hpp"
#include "reports/engine/replay.hpp"
#include "reports/findings/report.hpp"
#include "reports/findings/text.hpp"

namespace nearmiss {

namespace {

namespace fs = std::filesystem;

class BisectCommand : public Command {
 public:
  Manual manual() const override {
    return {
        "bisect",
        "find the commit of a library that brought a finding",
        {"FILE is a report. 'git bisect' chooses revisions between --good and --bad; each one is checked out into a "
         "temporary folder, built there by --build, and asked the case of the report. The repository's own working "
         "tree stays as it is.",
         "The subject of a revision is the plugin or the command that --plugin or --command names, relative to the top "
         "of the revision. Without either, the repository is that of Nearmiss, and each revision asks its own "
         "subjects, by './nearmiss replay'.",
         "A revision has the finding where the subject's answer has the verdict and the disagreement of the report. "
         "Another finding counts as none. A revision that cannot be built or asked is left out, as by 'git bisect "
         "skip'."},
        {{"0",
          "The commit is found. Its hash is the last line of the output, or several where revisions were left out."},
         {"2",
          "It could not run: wrong arguments, a malformed file, a revision that git does not know, or an end of the "
          "range that is not as said. One line on standard error states the reason. Or it was interrupted."}},
        {{"nearmiss bisect report.json --good v1.2 --build 'make plugin' --plugin build/plugin.so",
          "In the repository of a library that has a plugin."},
         {"nearmiss bisect report.json --good HEAD~50", "In the repository of Nearmiss."}}};
  }
  void declare(CLI::App& app) override {
    app.add_option("FILE", file_, "A report")->required()->type_name("");
    app.add_option("--good", bisection_.good, "A revision without the finding")->required()->type_name("REVISION");
    app.add_option("--bad", bisection_.bad, "A revision with the finding. Default: HEAD")->type_name("REVISION");
    app.add_option("--repository", repository_, "The repository. Default: that of the current folder")
        ->type_name("DIR");
    app.add_option("--build", bisection_.build, "The shell command that builds a revision, run at its top")
        ->type_name("COMMAND");
    CLI::Option* plugin =
        app.add_option("--plugin", plugin_, "The shared library that a revision builds")->type_name("FILE");
    app.add_option("--command", command_, "The program that a revision builds")->type_name("COMMAND")->excludes(plugin);
  }
  int run(const CLI::App&) override {
    read_report();
    bisection_.repository = fs::absolute(repository_);
    catch_interrupts();
    const FirstWithFinding found = bisect(
        bisection_, [](const BisectionStep& s) { say("{}\n", step_text(s)); }, [] { return interrupted(); });
    if (found.commits.empty()) {
      say_on_stderr("nearmiss: interrupted\n");
      return 2;
    }
    say("\n{}\n", found.commits.size() == 1 ? "The first commit with the finding:"
                                            : "The first commit with the finding is one of these:");
    for (const std::string& commit : found.commits) say("{}\n", commit);
    return 0;
  }

 private:
  static std::string step_text(const BisectionStep& s) {
    return fmt::format("{}  {}, {}  {}", s.revision, name_of(s.seen), s.why, s.subject);
  }
  void read_report() {
    const nlohmann::json j = parse_json(read_file(file_), file_);
    case_of(j, file_);  // rejects what holds no case
    if (!j.is_object() || !j.contains("finding") || !j.contains("subject")) {
      throw BadInput(fmt::format("{}: it is no report, so it does not say which finding to look for", file_));
    }
    bisection_.verdict = text_at(j["finding"], "verdict");
    bisection_.disagreement = text_at(j["finding"], "disagreement");
    const std::string subject = text_at(j["subject"], "name");
    const std::string asked =
        fmt::format("replay --json --subject {} {}", shell_quoted(subject), shell_quoted(fs::absolute(file_).string()));
    const std::string self = shell_quoted(fs::read_symlink("/proc/self/exe").string());
    bisection_.replay = !plugin_.empty()    ? fmt::format("{} {} --plugin {}", self, asked, shell_quoted(plugin_))
                        : !command_.empty() ? fmt::format("{} {} --command {}", self, asked, shell_quoted(command_))
                                            : "./nearmiss " + asked;
  }
  std::string text_at(const nlohmann::json& object, const char* key) const {
    if (object.is_object() && object.contains(key) && object[key].is_string()) return object[key];
    throw BadInput(fmt::format("{}: '{}' is missing or no text", file_, key));
  }

  std::string file_, repository_ = ".", plugin_, command_;
  Bisection bisection_{
      .repository = {}, .good = {}, .bad = "HEAD", .build = {}, .replay = {}, .verdict = {}, .disagreement = {}};
};

}  // namespace

std::unique_ptr<Command> bisect_command() { return std::make_unique<BisectCommand>(); }

}  // namespace nearmiss
