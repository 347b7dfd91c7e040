/// Runs the built command line as a user would.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace nearmiss {

struct Ran {
  int exit_code = -1;
  std::string out, err;
};

/// Runs a program with the arguments; standard input is empty. `environment` holds "NAME=value".
Ran run_program(const std::string& program, const std::vector<std::string>& arguments,
                const std::vector<std::string>& environment = {});
/// The same for the command line under test.
Ran nearmiss(const std::vector<std::string>& arguments, const std::vector<std::string>& environment = {});

std::string last_line(const std::string& text);

/// A folder of its own, removed at the end.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }
  /// Writes a file and returns its name.
  std::string file(const std::string& name, const std::string& text) const;

 private:
  std::filesystem::path path_;
};

}  // namespace nearmiss
