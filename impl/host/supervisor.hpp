/// Runs a program under a supervisor process, which ends the program together with every process that it started.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "impl/catalogue/break_cause.hpp"

namespace nearmiss {

/// The resource limits of a program. Each number may be `unlimited`.
struct Confinement {
  static constexpr std::size_t unlimited = 0;
  std::size_t bytes = std::size_t{2} << 30;        ///< of private memory, for each process
  std::size_t file_bytes = std::size_t{16} << 20;  ///< of each file that it writes, including its captured output
  std::size_t processes = 256;                     ///< beyond the processes of its user
  std::size_t files = 256;                         ///< open files of each process
  bool pid_namespace = true;  ///< request a namespace; without one the supervisor searches for leftover processes
  /// The program runs with the rights of this process. Otherwise it loses every privilege, and neither it nor any other
  /// such program can read, trace or signal this process (docs/explanation/threat-model.md).
  bool trusted = false;

  /// No limits: for programs of this project.
  static Confinement none() { return {unlimited, unlimited, unlimited, unlimited, true, true}; }
};

/// A program and its open files. Its standard input is empty, its standard output and error are captured, and it
/// inherits no other file.
struct Program {
  std::vector<std::string> arguments;  ///< the program first: its file, or a name that is searched in PATH
  std::function<int()> body{};         ///< runs in a fork of this process, in place of a program
  struct File {
    int here, there;
  };
  std::vector<File> files{};
  struct NamedFile {
    std::string path;
    int there;
  };
  /// Files and folders that the program opens by their path. Where it has a user of its own, who may not reach them, it
  /// inherits each of them as a descriptor; one that this process cannot open is left out.
  std::vector<NamedFile> named_files{};
  std::vector<std::string>
      environment{};  ///< "NAME=value" entries, added to those of this process; an entry here takes precedence
  std::string log{};  ///< the file for standard output and error; empty: memory
};

/// A running program. Its parent is a *supervisor*, a process that runs no foreign code. Where the system allows a
/// process namespace, the supervisor is its init; elsewhere it is the reaper of orphans (a child subreaper), and a
/// second supervisor above it ends everything if the first is killed. So no process that the program starts outlives
/// this object, whatever sessions and groups it joins, and program and supervisors never outlive this process. There is
/// one exception, of programs that have neither a namespace nor a user of their own: a program that starts processes
/// faster than the supervisor finds them.
///
/// A program that is not trusted makes this process not dumpable.
class SupervisedProcess {
 public:
  /// Throws std::system_error where the operating system refuses a process, a pipe or memory.
  explicit SupervisedProcess(const Program& program, const Confinement& confinement = {});
  ~SupervisedProcess();
  SupervisedProcess(const SupervisedProcess&) = delete;
  SupervisedProcess& operator=(const SupervisedProcess&) = delete;

  /// Waits for the end at most so long. Returns true once the program and all processes that it started have ended.
  bool has_ended(int milliseconds = 0);
  /// The way it ended, in one line: "left with exit code 3", "killed by signal 11 (Segmentation fault)".
  std::string exit_text() const;
  BreakCause break_cause() const;
  std::optional<int> exit_code() const;
  /// The errno of a failed start; 0: it started.
  int failed_to_start() const { return failed_to_start_; }
  /// Sends a signal to the program, but not to the processes that it started.
  void send(int signal);
  /// Ends the program and all processes that it started.
  void end();

  /// Seconds of processor time that the program itself has used; 0 where the system does not report it.
  double processor_seconds();
  /// Seconds that the program itself was runnable and waited for a processor; 0 where the system does not report it.
  double run_queue_seconds();
  /// Whether the program, or all processes that it started together, use more memory.
  bool uses_more_memory_than(std::size_t bytes);

  /// The last bytes of its standard output and error, at most `most`.
  std::string output(std::size_t most = 4096) const;
  /// A file descriptor that becomes readable when the program has ended.
  int status_file() const { return status_; }

 private:
  void read_messages();
  pid_t process();
  std::vector<pid_t> processes();

  pid_t supervisor_ = -1;
  bool namespaced_ = false;
  int status_ = -1, output_ = -1;
  std::optional<pid_t> process_;  ///< its id in the namespace of this process; 0: unknown
  pid_t second_supervisor_ = 0;   ///< likewise; 0: there is none
  std::optional<int> wait_status_;
  int failed_to_start_ = 0;  ///< errno
  bool reaped_ = false;
};

}  // namespace nearmiss
