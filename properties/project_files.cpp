#include "properties/project_files.hpp"

#include <cstdio>
#include <fstream>
#include <memory>
#include <sstream>
#include <stdexcept>

#include "corpus/files/source_folder.hpp"
#include "reports/findings/encoded.hpp"

namespace nearmiss {

std::vector<std::string> project_files() {
  const std::string top = source_folder();
  const std::string command = shell_quoted(top + "/cmake/sources") + " " + shell_quoted(top);
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  if (pipe == nullptr) throw std::runtime_error("no shell");
  std::vector<std::string> files{""};
  for (int c = 0; (c = std::fgetc(pipe.get())) != EOF;) {
    if (c == '\0') {
      files.emplace_back();
    } else {
      files.back() += char(c);
    }
  }
  files.pop_back();
  return files;
}

std::string text_of_file(const std::string& name) {
  std::ifstream in(source_folder() + "/" + name);
  if (!in) throw std::runtime_error(name + " cannot be read");
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

}  // namespace nearmiss
