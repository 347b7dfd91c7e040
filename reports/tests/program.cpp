#include "reports/tests/program.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <system_error>

#include "corpus/storage/codec.hpp"
#include "reports/findings/text.hpp"

namespace nearmiss {

Ran run_program(const std::string& program, const std::vector<std::string>& arguments,
                const std::vector<std::string>& environment) {
  const TemporaryFolder folder;
  std::vector<std::string> words{"env"};
  words.insert(words.end(), environment.begin(), environment.end());
  words.push_back(program);
  words.insert(words.end(), arguments.begin(), arguments.end());
  for (std::string& w : words) w = shell_quoted(w);
  const std::string command = fmt::format("{} < /dev/null > {} 2> {}", fmt::join(words, " "), (folder / "out").string(),
                                          (folder / "err").string());
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_file(folder / "out"), read_file(folder / "err")};
}

Ran nearmiss(const std::vector<std::string>& arguments, const std::vector<std::string>& environment) {
  return run_program(nearmiss_program(), arguments, environment);
}

Started::Started(const std::string& program, const std::vector<std::string>& arguments,
                 const std::vector<std::string>& environment)
    : folder_(std::make_unique<TemporaryFolder>()) {
  std::vector<char*> argv{const_cast<char*>(program.c_str())}, envp;
  for (const std::string& a : arguments) argv.push_back(const_cast<char*>(a.c_str()));
  for (const std::string& e : environment) envp.push_back(const_cast<char*>(e.c_str()));
  for (char** e = environ; *e != nullptr; ++e) envp.push_back(*e);
  argv.push_back(nullptr);
  envp.push_back(nullptr);
  const std::string out = (*folder_ / "out").string(), err = (*folder_ / "err").string();
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, out.c_str(), O_WRONLY | O_CREAT, 0600);
  posix_spawn_file_actions_addopen(&files, STDERR_FILENO, err.c_str(), O_WRONLY | O_CREAT, 0600);
  const int error = posix_spawn(&process_, program.c_str(), &files, nullptr, argv.data(), envp.data());
  posix_spawn_file_actions_destroy(&files);
  if (error != 0) throw std::system_error(error, std::generic_category(), program);
}

Started::~Started() {
  if (process_ <= 0) return;
  send(SIGKILL);
  waitpid(process_, nullptr, 0);
}

void Started::send(int signal) const {
  if (process_ > 0) kill(process_, signal);
}

std::optional<Ran> Started::wait(double seconds) {
  using Clock = std::chrono::steady_clock;
  const auto until = Clock::now() + std::chrono::duration<double>(seconds);
  int status = 0;
  while (waitpid(process_, &status, WNOHANG) == 0) {
    if (Clock::now() >= until) return std::nullopt;
    usleep(2'000);
  }
  process_ = -1;
  return Ran{WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status), read_file(*folder_ / "out"),
             read_file(*folder_ / "err")};
}

std::string new_mark() {
  static int count = 0;
  return fmt::format("NEARMISS_TEST_MARK={}-{}", getpid(), ++count);
}

std::vector<int> processes_with(const std::string& mark) {
  std::vector<int> found;
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    const int process = std::atoi(entry.path().filename().c_str());
    if (process <= 0) continue;
    std::ifstream file(entry.path() / "environ", std::ios::binary);
    for (std::string variable; std::getline(file, variable, '\0');) {
      if (variable == mark) found.push_back(process);
    }
  }
  return found;
}

bool nothing_is_left(const std::string& mark) {
  for (int i = 0; i < 100; ++i) {
    if (processes_with(mark).empty()) return true;
    usleep(50'000);
  }
  return false;
}

std::string last_line(const std::string& text) {
  const std::size_t end = text.find_last_not_of('\n');
  if (end == std::string::npos) return "";
  const std::size_t before = text.rfind('\n', end);
  return text.substr(before == std::string::npos ? 0 : before + 1,
                     end - (before == std::string::npos ? 0 : before + 1) + 1);
}

TemporaryFolder::TemporaryFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "nearmiss-XXXXXX").string();
  constexpr mode_t passable = 0711;
  if (mkdtemp(name.data()) == nullptr || chmod(name.c_str(), passable) != 0)
    throw std::runtime_error("no temporary folder");
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;  // a destructor cannot report it
  std::filesystem::remove_all(path_, ignored);
}

std::string TemporaryFolder::file(const std::string& name, const std::string& text) const {
  std::ofstream(path_ / name, std::ios::binary) << text;
  return (path_ / name).string();
}

}  // namespace nearmiss
