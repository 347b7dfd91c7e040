/// The processes of a host, as /proc shows them.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <vector>

namespace nearmiss {

/// The children of the process. Reads one small file for each of its threads; where the system has no such files, it
/// reads the whole of /proc.
std::vector<pid_t> children_of(pid_t process);
/// The children of the process, their children, and so on.
std::vector<pid_t> descendants_of(pid_t process);
/// The number of processes on the system.
std::size_t count_processes();

/// The resident memory of the process in bytes, with all that it shares; 0: there is no such process.
std::size_t resident_bytes_of(pid_t process);
/// The same, but of memory that n processes share an n-th part. The resident memory where the system does not tell it.
std::size_t proportional_bytes_of(pid_t process);

}  // namespace nearmiss
