/// A process that runs a program for this one, and ends it with all that it started.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "impl/catalogue/break_cause.hpp"

namespace nearmiss {

/// Each number may be `unlimited`.
struct Confinement {
  static constexpr std::size_t unlimited = 0;
  std::size_t bytes = std::size_t{2} << 30;        ///< of memory of its own
  std::size_t file_bytes = std::size_t{16} << 20;  ///< of any file that it writes, its output among them
  std::size_t processes = 256;                     ///< beyond those that its user has; the superuser has no such limit
  std::size_t files = 256;                         ///< that are open, of each process
  bool pid_namespace = true;  ///< ask the system for one; where it refuses, the keeper looks for what is left

  /// For a program of our own, of which only the end is to be seen to.
  static Confinement none() { return {unlimited, unlimited, unlimited, unlimited}; }
};

/// What is run, and the files that it has. Its standard input is empty, its standard output and error are captured, and
/// it has no other file.
struct Program {
  std::vector<std::string> arguments;  ///< the program first: its file, or a name to be found in PATH
  std::function<int()> body{};         ///< in place of a program: what a copy of this process does
  struct File {
    int here, there;
  };
  std::vector<File> files{};
  std::vector<std::string>
      environment{};  ///< "NAME=value", beside this process's own; of two the one given here counts
  std::string log{};  ///< the file that gets standard output and error; empty: it is kept in memory
};

/// A running program. Between it and this process stands its *keeper*, a process without any foreign code: it is the
/// init of a process namespace of its own where the system allows that, and the reaper of orphans elsewhere. So nothing
/// that the program starts outlives this object, whatever sessions and groups it joins, and neither outlives this
/// process. Without a namespace this has two exceptions: what starts processes faster than a keeper finds them, and
/// what ends its keeper.
class SupervisedProcess {
 public:
  /// Throws std::system_error where the operating system refuses a process, a pipe or memory.
  explicit SupervisedProcess(const Program& program, const Confinement& confinement = {});
  ~SupervisedProcess();
  SupervisedProcess(const SupervisedProcess&) = delete;
  SupervisedProcess& operator=(const SupervisedProcess&) = delete;

  /// Looks whether it has ended, for at most so long; all that it started has ended with it then.
  bool has_ended(int milliseconds = 0);
  /// How, in one line for people: "left with exit code 3", "killed by signal 11 (Segmentation fault)".
  std::string exit_text() const;
  BreakCause break_cause() const;
  std::optional<int> exit_code() const;
  /// Where it could not be started: why, as errno.
  int failed_to_start() const { return failed_to_start_; }
  /// Sends the program a signal; those that it started get none.
  void send(int signal);
  /// Ends it with all that it started.
  void end();

  /// Seconds of processor time that the program itself has used, and seconds that it waited for a processor; 0 where
  /// the system does not tell.
  double processor_seconds();
  double run_queue_seconds();
  /// The memory that it has now, in bytes.
  std::size_t resident_bytes();

  /// The end of what it wrote to standard output and error: at most so many bytes.
  std::string output(std::size_t most = 4096) const;
  /// Becomes readable when it has ended.
  int status_file() const { return status_; }

 private:
  void read_messages();
  pid_t process();

  pid_t keeper_ = -1;
  bool namespaced_ = false;
  int status_ = -1, output_ = -1;
  std::optional<pid_t> process_;  ///< as this process numbers it; 0 where that is not known
  std::optional<int> wait_status_;
  int failed_to_start_ = 0;  ///< errno
  bool reaped_ = false;
};

}  // namespace nearmiss
