/// One subcommand of the command line.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace nearmiss {

/// What a command's manual says beside its options.
struct Manual {
  std::string name;
  std::string summary;                   ///< half a sentence, begins with a small letter, no full stop
  std::vector<std::string> description;  ///< paragraphs
  struct Line {
    std::string left, right;
  };
  std::vector<Line> exit_status;
  std::vector<Line> examples;  ///< a command line; what it does
};

class Command {
 public:
  virtual ~Command() = default;
  virtual Manual manual() const = 0;
  /// Declares the options; they are filled in before run().
  virtual void declare(CLI::App& app) = 0;
  /// `root` knows all commands. Returns the exit code; throws BadInput for what cannot be done.
  virtual int run(const CLI::App& root) = 0;
};

std::unique_ptr<Command> list_command();
std::unique_ptr<Command> run_command();
std::unique_ptr<Command> nightly_command();
std::unique_ptr<Command> relations_command();
std::unique_ptr<Command> replay_command();
std::unique_ptr<Command> import_command();
std::unique_ptr<Command> extremes_command();
std::unique_ptr<Command> completion_command();

/// The exit status of every command that judges.
std::vector<Manual::Line> judging_exit_status();
/// Its line for a judge that contradicts itself.
Manual::Line internal_error_status();

/// The command line as typed, for the index of a run; set once by main.
std::string& typed_command_line();

}  // namespace nearmiss
