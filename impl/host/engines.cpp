#include "impl/host/engines.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace nearmiss {

namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

fs::path folder_of_installed() {
  const char* other = std::getenv(engines_variable);
  return other != nullptr ? other : NEARMISS_TOP "/build/engines";
}

bool is_there(const fs::path& file) {
  std::error_code error;
  return fs::exists(file, error);
}

/// The settings of the engine whose sources are in this folder: the usual ones first.
std::vector<std::string> settings_in(const fs::path& sources) {
  std::vector<std::string> all{""};
  std::ifstream in(sources / "settings.txt");
  for (std::string word; in >> word;) all.push_back(word);
  return all;
}

}  // namespace

std::vector<Engine> engines() {
  std::vector<Engine> all;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(NEARMISS_TOP "/impl/engines", error)) {
    const fs::path& sources = entry.path();
    const bool is_plugin = is_there(sources / "subject.cpp");
    if (!is_plugin && !is_there(sources / "subject.mjs")) continue;
    const std::string name = sources.filename().string();
    const fs::path folder = folder_of_installed() / name;
    // The launcher copies the file that pins the version at the end of an installation.
    const fs::path pinned = sources / (is_plugin ? "subject.cpp" : "package-lock.json");
    const bool is_installed = is_there(folder / "installed") && text_of(folder / "installed") == text_of(pinned);
    for (const std::string& setting : settings_in(sources)) {
      std::string subject = name;
      if (!setting.empty()) subject.append("-").append(setting);
      all.push_back({subject, setting, sources.string(), folder.string(), is_installed, is_plugin});
    }
  }
  std::sort(all.begin(), all.end(), [](const Engine& a, const Engine& b) { return a.name < b.name; });
  return all;
}

std::string how_to_install(std::string_view name) {
  for (const Engine& e : engines()) {
    if (e.name == name && !e.is_installed)
      return e.name + " is not installed; './nearmiss engines " + fs::path(e.sources).filename().string() +
             "' installs it";
  }
  return {};
}

}  // namespace nearmiss
