/// The command line `nearmiss`.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <limits>

#include "corpus/bad_input.hpp"
#include "oracles/environment.hpp"
#include "reports/commands/command.hpp"
#include "reports/commands/manual_page.hpp"
#include "reports/progress.hpp"
#include "reports/text.hpp"
#include "reports/version.hpp"

namespace nearmiss {

std::string& typed_command_line() {
  static std::string typed;
  return typed;
}

std::vector<Manual::Line> judging_exit_status() {
  return {{"0", "Nothing violated its contract, and nothing broke."},
          {"1", "Violations, or a subject that broke."},
          {"2",
           "It could not run: wrong arguments, malformed input, an output that cannot be written; or it was "
           "interrupted before it found a violation. One line on standard error says what and why."}};
}

namespace {

/// All commands and the parser that knows them.
class CommandLine {
 public:
  CommandLine()
      : root_("find out where a collision-detection library is wrong, by how much, and prove it", "nearmiss") {
    root_.set_help_flag("-h,--help", "Print a manual and exit");
    root_.set_version_flag("--version", version_text(), "Print the version and exit");
    for (auto make : {list_command, run_command, nightly_command, extremes_command, replay_command, import_command,
                      completion_command}) {
      add(make());
    }
    CLI::App* help = root_.add_subcommand("help", "print the manual of a command");
    help->set_help_flag("-h,--help", "Print a manual and exit");
    help->add_option("COMMAND", help_for_, "The command")->type_name("");
    root_.require_subcommand(0, 1);
  }

  int run(std::vector<std::string> arguments) {
    if (!arguments.empty() && !arguments[0].starts_with('-')) check_known(arguments[0]);
    std::reverse(arguments.begin(), arguments.end());  // as CLI11 takes them
    try {
      root_.parse(std::move(arguments));
    } catch (const CLI::CallForHelp&) {
      const auto chosen = root_.get_subcommands();
      return help(chosen.empty() ? "" : chosen[0]->get_name());
    } catch (const CLI::CallForVersion& e) {
      fmt::print("{}\n", e.what());
      return 0;
    }
    const auto chosen = root_.get_subcommands();
    if (chosen.empty()) throw BadInput("a command is missing; 'nearmiss help' lists them");
    for (const Entry& e : entries_) {
      if (e.app == chosen[0]) return e.command->run(root_);
    }
    return help(help_for_);
  }

 private:
  struct Entry {
    std::unique_ptr<Command> command;
    CLI::App* app;
  };

  void add(std::unique_ptr<Command> command) {
    CLI::App* app = root_.add_subcommand(command->manual().name, command->manual().summary);
    app->set_help_flag("-h,--help", "Print this manual and exit");
    command->declare(*app);
    entries_.push_back({std::move(command), app});
  }
  int help(const std::string& name) const {
    if (name.empty() || name == "help") {
      fmt::print("{}", overview_page(root_));
      return 0;
    }
    check_known(name);
    const auto entry =
        std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.app->get_name() == name; });
    fmt::print("{}", manual_page(*entry->app, entry->command->manual()));
    return 0;
  }
  void check_known(const std::string& name) const {
    std::vector<std::string> names;
    for (const CLI::App* c : root_.get_subcommands([](const CLI::App*) { return true; }))
      names.push_back(c->get_name());
    if (std::find(names.begin(), names.end(), name) != names.end()) return;
    const auto close = close_matches(name, names);
    throw BadInput(fmt::format("unknown command '{}'; {}", name,
                               close.empty() ? "'nearmiss help' lists them" : "did you mean " + close[0] + "?"));
  }
  static std::string version_text() {
    return fmt::format("nearmiss {} ({}, {}, {})", version(), compiler(), build_type(), platform());
  }

  CLI::App root_;
  std::vector<Entry> entries_;
  std::string help_for_;
};

/// "--cases -5" as "--cases=-5": a negative number is a value, never an option of its own.
std::vector<std::string> with_negative_values(const std::vector<std::string>& arguments) {
  std::vector<std::string> joined;
  for (const std::string& a : arguments) {
    const bool negative =
        a.size() > 1 && a[0] == '-' && (std::isdigit(static_cast<unsigned char>(a[1])) != 0 || a[1] == '.');
    const bool after_option =
        !joined.empty() && joined.back().starts_with("--") && joined.back().find('=') == std::string::npos;
    if (negative && after_option) {
      joined.back() += "=" + a;
    } else {
      joined.push_back(a);
    }
  }
  return joined;
}

int complain(std::string what) {
  std::replace(what.begin(), what.end(), '\n', ' ');
  say_on_stderr("nearmiss: " + what + "\n");
  return 2;
}

int run_or_complain(const std::vector<std::string>& arguments) {
  try {
    if (const auto broken = broken_environment()) return complain(*broken);
    const int code = CommandLine().run(with_negative_values(arguments));
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) return complain("standard output cannot be written");
    return code;
  } catch (const std::exception& e) {
    if (std::ferror(stdout) != 0) return complain("standard output cannot be written");  // a long text, half written
    return complain(e.what());
  }
}

}  // namespace
}  // namespace nearmiss

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  nearmiss::typed_command_line() = "nearmiss";
  for (const std::string& a : arguments) nearmiss::typed_command_line() += " " + nearmiss::shell_quoted(a);
  return nearmiss::run_or_complain(arguments);
}
