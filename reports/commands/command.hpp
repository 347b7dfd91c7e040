/// One subcommand of the command line.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace nearmiss {

/// The manual of a command, beside its options.
struct Manual {
  std::string name;
  std::string summary;                   ///< a phrase that begins with a small letter, without a full stop
  std::vector<std::string> description;  ///< paragraphs
  struct Line {
    std::string left, right;
  };
  std::vector<Line> exit_status;
  std::vector<Line> examples;  ///< a command line and its effect
};

class Command {
 public:
  virtual ~Command() = default;
  virtual Manual manual() const = 0;
  /// Declares the options; they are filled in before run().
  virtual void declare(CLI::App& app) = 0;
  /// `root` is the parser of all commands. Returns the exit code. Throws BadInput for input that cannot be used.
  virtual int run(const CLI::App& root) = 0;
};

std::unique_ptr<Command> list_command();
std::unique_ptr<Command> run_command();
std::unique_ptr<Command> nightly_command();
std::unique_ptr<Command> relations_command();
std::unique_ptr<Command> render_command();
std::unique_ptr<Command> replay_command();
std::unique_ptr<Command> show_command();
std::unique_ptr<Command> minimise_command();
std::unique_ptr<Command> diff_command();
std::unique_ptr<Command> explain_command();
std::unique_ptr<Command> triage_command();
std::unique_ptr<Command> truth_command();
std::unique_ptr<Command> trade_command();
std::unique_ptr<Command> builds_command();
std::unique_ptr<Command> promote_command();
std::unique_ptr<Command> bisect_command();
std::unique_ptr<Command> emit_test_command();
std::unique_ptr<Command> upstream_report_command();
std::unique_ptr<Command> check_subject_command();
std::unique_ptr<Command> import_command();
std::unique_ptr<Command> scene_command();
std::unique_ptr<Command> extremes_command();
std::unique_ptr<Command> sweep_command();
std::unique_ptr<Command> oss_fuzz_command();
std::unique_ptr<Command> completion_command();

/// The exit status of every command that judges.
std::vector<Manual::Line> judging_exit_status();
/// The line for an internal error.
Manual::Line internal_error_status();

/// The command line as typed, for the index of a run; set once by main.
std::string& typed_command_line();

}  // namespace nearmiss
