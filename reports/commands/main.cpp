/// The command line `nearmiss`.
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <limits>
#include <new>

#include "corpus/files/errors.hpp"
#include "corpus/storage/codec.hpp"
#include "impl/subject/floating_point.hpp"
#include "oracles/confirmed.hpp"
#include "oracles/environment.hpp"
#include "oracles/exact/number_memory.hpp"
#include "reports/commands/command.hpp"
#include "reports/commands/manual_page.hpp"
#include "reports/engine/progress.hpp"
#include "reports/findings/text.hpp"
#include "reports/findings/version.hpp"

namespace nearmiss {

std::string& typed_command_line() {
  static std::string typed;
  return typed;
}

std::vector<Manual::Line> judging_exit_status() {
  return {{"0", "Nothing violated its contract, and nothing broke."},
          {"1", "Violations, or a subject that broke."},
          {"2",
           "It could not run, or not to its end: wrong arguments, malformed input, or an output that cannot be "
           "written. Or there is no violation, and it was interrupted or had no time to ask anything. One line "
           "on standard error states the reason."},
          internal_error_status()};
}

Manual::Line internal_error_status() {
  return {std::to_string(InternalError::exit_code),
          "An internal error: the judge contradicts itself. Every answer with a finding against it is judged "
          "twice; the two findings, or the findings on related cases, differ. This is a fault of Nearmiss and "
          "is not counted; all other findings are kept. One line on standard error has both findings, and "
          "internal-errors/ in the folder holds the case."};
}

namespace {

/// All commands and their parser.
class CommandLine {
 public:
  CommandLine()
      : root_("find out where a collision-detection library is wrong, by how much, and prove it", "nearmiss") {
    root_.set_help_flag("-h,--help", "Print a manual and exit");
    root_.set_version_flag("--version", version_text(), "Print the version and exit");
    for (auto make :
         {list_command,    run_command,    nightly_command,       relations_command,       extremes_command,
          sweep_command,   replay_command, show_command,          truth_command,           minimise_command,
          explain_command, triage_command, diff_command,          render_command,          trade_command,
          builds_command,  bisect_command, emit_test_command,     upstream_report_command, promote_command,
          import_command,  scene_command,  check_subject_command, oss_fuzz_command,        completion_command}) {
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
      say("{}\n", e.what());
      return 0;
    } catch (const CLI::ExtrasError&) {
      throw BadInput(unexpected_text());
    } catch (const CLI::ArgumentMismatch& e) {
      const std::string what = e.what();
      if (what.find("disallowed flag") != std::string::npos)
        throw BadInput(fmt::format("{} takes no value", flag_in(what)));
      const auto [name, type] = named_in(what);
      throw BadInput(fmt::format("{} needs a value{}", name, type));
    } catch (const CLI::ExcludesError& e) {
      throw BadInput(fmt::format("{} cannot be given together", options_in(e.what())));
    } catch (const CLI::RequiredError& e) {
      const std::string what = e.what();
      throw BadInput(fmt::format("{} is missing; 'nearmiss help {}' shows what it takes",
                                 what.substr(0, what.find(' ')),
                                 root_.get_subcommands().empty() ? "" : root_.get_subcommands()[0]->get_name()));
    }
    const auto chosen = root_.get_subcommands();
    if (chosen.empty()) throw BadInput("a command is missing; 'nearmiss help' lists them");
    for (const Entry& e : entries_) {
      if (e.app != chosen[0]) continue;
      const int code = e.command->run(root_);
      if (const std::string note = rounded_numbers_text(); !note.empty())
        say_on_stderr(fmt::format("nearmiss: note: {}\n", note));
      return code;
    }
    return help(help_for_);
  }

 private:
  // Translates the messages of CLI11.

  /// "--cases" and ": N" of "--cases: 1 required N missing".
  static std::pair<std::string, std::string> named_in(const std::string& what) {
    const std::string name = what.substr(0, what.find(':'));
    constexpr std::string_view before = " required ", behind = " missing";
    const std::size_t from = what.find(before), to = what.rfind(behind);
    if (from == std::string::npos || to == std::string::npos || from + before.size() >= to) return {name, ""};
    return {name, ": " + what.substr(from + before.size(), to - from - before.size())};
  }
  /// "--json" of "json was given a disallowed flag override".
  static std::string flag_in(const std::string& what) {
    const std::string name = what.substr(0, what.find(' '));
    return name.starts_with('-') ? name : "--" + name;
  }
  /// "--cases and --seconds" of "--cases excludes --seconds".
  static std::string options_in(std::string what) {
    constexpr std::string_view word = " excludes ";
    if (const std::size_t at = what.find(word); at != std::string::npos) what.replace(at, word.size(), " and ");
    return what;
  }

  struct Entry {
    std::unique_ptr<Command> command;
    CLI::App* app;
  };

  /// No option means anything by an empty value; most take it for no value.
  static void refuse_empty_values(CLI::App& app) {
    const auto check = [](const std::string& value) { return value.empty() ? "the value is empty" : ""; };
    for (CLI::Option* o : app.get_options()) {
      if (o->get_items_expected_max() > 0) o->check(CLI::Validator(check, ""));
    }
  }
  void add(std::unique_ptr<Command> command) {
    CLI::App* app = root_.add_subcommand(command->manual().name, command->manual().summary);
    app->set_help_flag("-h,--help", "Print this manual and exit");
    command->declare(*app);
    refuse_empty_values(*app);
    entries_.push_back({std::move(command), app});
  }
  int help(const std::string& name) const {
    if (name.empty() || name == "help") {
      say("{}", overview_page(root_));
      return 0;
    }
    check_known(name);
    const auto entry =
        std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.app->get_name() == name; });
    say("{}", manual_page(*entry->app, entry->command->manual()));
    return 0;
  }
  void check_known(const std::string& name) const {
    std::vector<std::string> names;
    for (const CLI::App* c : root_.get_subcommands([](const CLI::App*) { return true; }))
      names.push_back(c->get_name());
    if (std::find(names.begin(), names.end(), name) != names.end()) return;
    throw BadInput(unknown_text("command", name, names, "nearmiss help"));
  }
  /// The message for the first argument that the chosen command does not know.
  std::string unexpected_text() const {
    const auto chosen = root_.get_subcommands();
    const CLI::App& app = chosen.empty() ? root_ : *chosen[0];
    const std::string manual =
        chosen.empty() || app.get_name() == "help" ? "nearmiss help" : "nearmiss help " + app.get_name();
    const std::string word = root_.remaining(true).at(0);
    if (!word.starts_with('-'))
      return fmt::format("unexpected word '{}'; '{}' shows what it takes", one_line(word, 100), manual);
    std::vector<std::string> options;
    for (const CLI::Option* o : app.get_options()) {
      for (const std::string& l : o->get_lnames()) options.push_back("--" + l);
    }
    return unknown_text("option", std::string_view(word).substr(0, word.find('=')), options, manual);
  }
  static std::string version_text() {
    return fmt::format("nearmiss {} ({}, {}, {})", version(), compiler(), build_type(), platform());
  }

  CLI::App root_;
  std::vector<Entry> entries_;
  std::string help_for_;
};

/// Turns "--cases -5" into "--cases=-5": a negative number is a value, never an option.
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
  say_on_stderr("nearmiss: " + one_line(what) + "\n");
  return 2;
}

/// The reader of standard output, for example "head", has closed the pipe: ends by SIGPIPE, as programs usually do.
int reader_left() {
  signal(SIGPIPE, SIG_DFL);
  raise(SIGPIPE);
  return 2;
}

int complain_of_output() {
  pollfd output{STDOUT_FILENO, POLLOUT, 0};
  const bool broken_pipe = poll(&output, 1, 0) == 1 && (output.revents & POLLERR) != 0;
  return broken_pipe ? reader_left() : complain("standard output cannot be written");
}

int run_or_complain(const std::vector<std::string>& arguments) {
  try {
    if (const auto broken = broken_environment()) return complain(*broken);
    const int code = CommandLine().run(with_negative_values(arguments));
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) return complain_of_output();
    return code;
  } catch (const InternalError& e) {
    complain(fmt::format("internal error: {}", e.what()));
    return InternalError::exit_code;
  } catch (const std::bad_alloc&) {
    return complain("out of memory");
  } catch (const std::exception& e) {
    if (std::ferror(stdout) != 0) return complain_of_output();  // a long text was written in part
    return complain(e.what());
  }
}

/// Opens /dev/null for each closed standard file; otherwise the next opened file, such as a pipe to a worker, would
/// take its number and receive printed text. For standard output /dev/null is opened read-only, so that printing fails.
void hold_standard_files() {
  for (const int file : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(file, F_GETFD) != -1) continue;
    open("/dev/null",
         file == STDERR_FILENO ? O_WRONLY : O_RDONLY);  // open takes the lowest free number, which is this one
  }
}

}  // namespace
}  // namespace nearmiss

#if defined(__SANITIZE_ADDRESS__)
#define NEARMISS_SANITIZED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define NEARMISS_SANITIZED
#endif
#endif
#if defined(NEARMISS_SANITIZED)
/// To look for uses of a frame after its return takes a third of the time here; the tests of properties/ look for them.
/// To keep 256 MB of freed memory from reuse, as is usual, takes another third: a case frees far less than 16 MB.
/// ASAN_OPTIONS takes precedence.
// NOLINTNEXTLINE(bugprone-reserved-identifier): the name is that of the sanitizer
extern "C" const char* __asan_default_options() { return "detect_stack_use_after_return=0:quarantine_size_mb=16"; }
#endif

int main(int argc, char** argv) {
  nearmiss::FloatingPointModes::standard().set();  // a library may have changed them when it was loaded
  nearmiss::hold_standard_files();
  nearmiss::use_pool_for_numbers();
  signal(SIGCHLD, SIG_DFL);  // the parent may have it ignored, and then the end of a host would not be reported
  for (const int s : {SIGPIPE, SIGXFSZ}) signal(s, SIG_IGN);  // a failed write returns an error code instead
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  nearmiss::typed_command_line() = "nearmiss";
  for (const std::string& a : arguments) nearmiss::typed_command_line() += " " + nearmiss::shell_quoted(a);
  return nearmiss::run_or_complain(arguments);
}
