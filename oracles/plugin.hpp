/// Libraries that are loaded at run time: the other side of impl/plugin/nearmiss_plugin.h.
#pragma once

#include <stdexcept>
#include <string>

namespace nearmiss {

/// What is wrong with a plugin, in one line that begins with its file.
struct BadPlugin : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Adds the subject of the shared library `file` to subjects(), for the rest of the process; pointers into subjects()
/// taken before do not stay valid. The library is first loaded by a process of its own, so that one that crashes as
/// it is loaded is refused like any other. Throws BadPlugin.
void load_plugin(const std::string& file);

/// Names files of plugins to the programs that have no command line for it, fuzz targets and properties; separated by
/// colons.
inline constexpr const char* plugins_variable = "NEARMISS_PLUGINS";
/// Loads them. Throws BadPlugin.
void load_plugins_of_environment();

}  // namespace nearmiss
