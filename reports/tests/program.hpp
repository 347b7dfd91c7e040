/// Runs the built command line as a user would.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace nearmiss {

/// True in a build with the address sanitizer, in which programs are slow.
#if defined(__SANITIZE_ADDRESS__)
inline constexpr bool is_sanitized = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
inline constexpr bool is_sanitized = true;
#else
inline constexpr bool is_sanitized = false;
#endif
#else
inline constexpr bool is_sanitized = false;
#endif

/// What the tests start: files of programs and plugins, interpreters, and command lines of examples ("" without their
/// interpreter).
/// One generated source has their absolute paths, so that the compiler cache serves every other source to another
/// clone.
std::string nearmiss_program();
std::string properties_program();
std::string contradicting_program();
std::string in_a_way();
std::string zoo_program();
/// The linker's options that find the library collide::certified of this build.
std::string certified_library();
std::string plugin_file(const std::string& name);
std::string record_example();
std::string python();
std::string node();
std::string example_c();
std::string example_py();
std::string example_js();

struct Ran {
  int exit_code = -1;
  std::string out, err;
};

/// Runs a program with the arguments; standard input is empty. `environment` holds "NAME=value".
Ran run_program(const std::string& program, const std::vector<std::string>& arguments,
                const std::vector<std::string>& environment = {});
/// The same for the command line under test.
Ran nearmiss(const std::vector<std::string>& arguments, const std::vector<std::string>& environment = {});

/// A program that runs beside the test. The destructor ends it.
class Started {
 public:
  Started(const std::string& program, const std::vector<std::string>& arguments,
          const std::vector<std::string>& environment);
  ~Started();
  Started(const Started&) = delete;
  Started& operator=(const Started&) = delete;
  void send(int signal) const;
  /// Waits for the end at most so long; empty where the program still runs. The exit code is minus a signal that killed
  /// it.
  std::optional<Ran> wait(double seconds);

 private:
  std::unique_ptr<class TemporaryFolder> folder_;
  int process_ = -1;
};

/// A unique variable "NAME=value" for a program's environment, by which the test finds the program and its descendants.
std::string new_mark();
std::vector<int> processes_with(const std::string& mark);
/// True once all of them have ended; waits a while, because the system ends the processes of a namespace one by one.
bool nothing_is_left(const std::string& mark);

std::string last_line(const std::string& text);

/// A temporary folder, removed by the destructor. Every user may pass through it, as a host may be of another user.
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
