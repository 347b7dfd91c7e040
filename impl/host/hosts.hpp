/// Subjects that run in programs of their own: the subjects of this build, plugins, and any program that speaks the
/// protocol (docs/reference/protocol.md). The functions here check every member of such a program's hello.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "impl/host/worker.hpp"

namespace nearmiss {

/// Reports in one line why a program or a plugin cannot be used; the line begins with its file or its command.
struct BadSubject : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What happens to a subject whose name another one has.
enum class SameName {
  refused,
  numbered,  ///< it becomes NAME-2, NAME-3 …
};

/// Adds the subject of the shared library `file` to subjects() for the rest of the process. Invalidates pointers into
/// subjects(). This process never loads the library. Throws BadSubject.
/// Returns its name.
std::string load_plugin(const std::string& file, SameName rule = SameName::refused);

/// Adds the subject that a command line starts: a program with arguments in shell syntax, or any other command that
/// /bin/sh runs. Otherwise like load_plugin.
std::string load_command(const std::string& command, SameName rule = SameName::refused);

/// The environment variable that passes files of plugins, separated by colons, to programs without an option for them:
/// fuzz targets and property tests.
inline constexpr const char* plugins_variable = "NEARMISS_PLUGINS";
/// The same for commands, one in each line.
inline constexpr const char* commands_variable = "NEARMISS_COMMANDS";
/// Loads the plugins and commands of both variables. Throws BadSubject.
void load_subjects_of_environment();

/// A subject of this build and the program that is its host.
struct HostOfBuild {
  std::string name, file;
};
/// Starts all hosts at once and returns the subjects that their hellos describe. Throws BadSubject.
std::vector<Subject> hosted(const std::vector<HostOfBuild>& hosts);
/// The environment variable with the launcher's file, where the launcher started this program.
inline constexpr const char* launcher_variable = "NEARMISS_LAUNCHER";
/// Has the launcher build these hosts where they are missing or older than their sources, and starts them as hosted()
/// does. Without a launcher they must be there. Throws BadSubject.
std::vector<Subject> built_and_hosted(const std::vector<HostOfBuild>& hosts);
/// Starts those of the hosts that are there and are of this build.
std::vector<Subject> hosted_at_hand(const std::vector<HostOfBuild>& hosts);

/// The subject that a hello describes. Throws BadSubject, with `where` at the beginning of the line. Declared here for
/// fuzz_protocol.
Subject subject_from_hello(const std::string& where, std::string_view hello, HostProgram program);

}  // namespace nearmiss
