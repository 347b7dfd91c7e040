/// Subjects that are asked in programs of their own: those of this build, plugins, and any program that speaks the
/// protocol (docs/protocol.md). What such a program says of itself is checked here, word by word.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "impl/host/worker.hpp"

namespace nearmiss {

/// Why a program or a plugin is no subject, in one line that begins with its file or its command.
struct BadSubject : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Adds the subject of the shared library `file` to subjects(), for the rest of the process; pointers into subjects()
/// taken before do not stay valid. Nothing of the library is ever loaded by this process. Throws BadSubject.
void load_plugin(const std::string& file);

/// Adds the subject that this command line is: a program with its arguments, in a shell's words, or whatever else
/// /bin/sh runs. Otherwise like load_plugin.
void load_command(const std::string& command);

/// Names files of plugins to the programs that have no command line for it, fuzz targets and properties; separated by
/// colons.
inline constexpr const char* plugins_variable = "NEARMISS_PLUGINS";
/// The same for commands, one on each line.
inline constexpr const char* commands_variable = "NEARMISS_COMMANDS";
/// Loads them. Throws BadSubject.
void load_subjects_of_environment();

/// A subject of this build whose host is the program `file`.
struct HostOfBuild {
  std::string name, file;
};
/// They are started, all at once, to hear what they offer. Throws BadSubject.
std::vector<Subject> hosted(const std::vector<HostOfBuild>& hosts);

/// The subject that a hello describes. `where` begins the line that says what is wrong with it. Exported for who fuzzes
/// it.
Subject subject_from_hello(const std::string& where, std::string_view hello, HostProgram program);

}  // namespace nearmiss
