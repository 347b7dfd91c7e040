/// A program that runs beside this one.
#pragma once

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

namespace nearmiss {

/// A child in a process group of its own, so that a terminal's interrupt does not reach it and that its
/// own children end with it. Its standard output and error go to `log`. Throws std::system_error where it cannot start.
class Child {
 public:
  Child(const std::vector<std::string>& arguments, const std::vector<std::string>& more_environment,
        const std::filesystem::path& log) {
    std::vector<char*> argv, envp;
    for (const std::string& a : arguments) argv.push_back(const_cast<char*>(a.c_str()));
    for (const std::string& e : more_environment) envp.push_back(const_cast<char*>(e.c_str()));  // the first one counts
    for (char** e = environ; *e != nullptr; ++e) envp.push_back(*e);
    argv.push_back(nullptr);
    envp.push_back(nullptr);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    posix_spawn_file_actions_adddup2(&files, STDOUT_FILENO, STDERR_FILENO);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t defaults;  // what this process ignores is no matter of the child's
    sigemptyset(&defaults);
    for (const int s : {SIGPIPE, SIGXFSZ}) sigaddset(&defaults, s);
    posix_spawnattr_setsigdefault(&attributes, &defaults);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF);
    const int error = posix_spawn(&pid_, argv[0], &files, &attributes, argv.data(), envp.data());
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&attributes);
    if (error != 0) throw std::system_error(error, std::generic_category(), arguments[0]);
  }
  ~Child() {
    if (status_) return;
    send(SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  bool ended() {
    int status = 0;
    if (!status_ && waitpid(pid_, &status, WNOHANG) == pid_) status_ = status;
    return status_.has_value();
  }
  void send(int signal) { kill(-pid_, signal); }
  int status() const { return *status_; }

 private:
  pid_t pid_ = -1;
  std::optional<int> status_;
};

}  // namespace nearmiss
