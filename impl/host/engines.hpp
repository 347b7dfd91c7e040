/// Engines: libraries that people ship and Debian lacks, each with its subject in impl/engines/NAME. './nearmiss
/// engines NAME' installs one into the build folder. An engine is asked only where it is named. One with other
/// settings, a word of each line of impl/engines/NAME/settings.txt, is a subject too: NAME-SETTING.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace nearmiss {

struct Engine {
  std::string name;
  std::string setting;  ///< empty: the usual settings
  std::string sources;  ///< its folder in impl/engines
  std::string folder;   ///< what is installed of it
  bool is_installed;    ///< the version that its sources name
  bool is_plugin;       ///< its subject is a shared library; otherwise a program
};

/// Every engine with each of its settings, by name.
std::vector<Engine> engines();

/// "jolt is not installed; './nearmiss engines jolt' installs it"; empty where no engine has that name or it is
/// installed.
std::string how_to_install(std::string_view name);

/// The environment variable with the folder in which engines are installed, in place of build/engines.
inline constexpr const char* engines_variable = "NEARMISS_ENGINES";

}  // namespace nearmiss
