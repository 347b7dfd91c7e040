#include "impl/host/processes.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <memory>
#include <optional>
#include <string>

namespace nearmiss {

namespace {

/// The numbers among the names in a folder of /proc.
std::vector<pid_t> numbers_in(const char* folder) {
  std::vector<pid_t> all;
  const std::unique_ptr<DIR, int (*)(DIR*)> open(opendir(folder), closedir);
  if (!open) return all;
  while (const dirent* entry = readdir(open.get())) {
    if (const int number = std::atoi(entry->d_name); number > 0) all.push_back(number);
  }
  return all;
}

/// The parent of the process; 0: there is no such process.
pid_t parent_of(pid_t process) {
  std::array<char, 64> name;
  std::array<char, 512> text;
  std::snprintf(name.data(), name.size(), "/proc/%d/stat", process);
  const int file = open(name.data(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return 0;
  const ssize_t got = read(file, text.data(), text.size() - 1);
  close(file);
  if (got <= 0) return 0;
  text[std::size_t(got)] = '\0';
  const char* after_name = std::strrchr(text.data(), ')');
  char state;
  int parent = 0;
  const bool known = after_name != nullptr && std::sscanf(after_name + 1, " %c %d", &state, &parent) == 2;
  return known ? parent : 0;
}

std::vector<pid_t> children_by_search(pid_t process) {
  std::vector<pid_t> all;
  for (const pid_t other : numbers_in("/proc")) {
    if (parent_of(other) == process) all.push_back(other);
  }
  return all;
}

/// Whether /proc lists the children of a thread. Debian's kernels do.
bool children_are_listed() {
  static const bool listed = access("/proc/thread-self/children", R_OK) == 0;
  return listed;
}

/// The number of bytes in the line of smaps_rollup that begins with `name`, in kilobytes there.
std::optional<std::size_t> bytes_in_rollup(pid_t process, const std::string& name) {
  std::ifstream file("/proc/" + std::to_string(process) + "/smaps_rollup");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with(name)) return std::strtoull(line.c_str() + name.size(), nullptr, 10) << 10;
  }
  return std::nullopt;
}

}  // namespace

std::vector<pid_t> children_of(pid_t process) {
  if (!children_are_listed()) return children_by_search(process);
  std::vector<pid_t> all;
  const std::string tasks = "/proc/" + std::to_string(process) + "/task/";
  for (const pid_t thread : numbers_in(tasks.c_str())) {
    std::ifstream file(tasks + std::to_string(thread) + "/children");
    for (pid_t child = 0; file >> child;) all.push_back(child);
  }
  return all;
}

std::vector<pid_t> descendants_of(pid_t process) {
  std::vector<pid_t> all = children_of(process);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::vector<pid_t> more = children_of(all[i]);
    all.insert(all.end(), more.begin(), more.end());
  }
  return all;
}

std::size_t count_processes() { return numbers_in("/proc").size(); }

std::size_t resident_bytes_of(pid_t process) {
  std::size_t all = 0, resident = 0;
  std::ifstream("/proc/" + std::to_string(process) + "/statm") >> all >> resident;
  return resident * std::size_t(sysconf(_SC_PAGESIZE));
}

std::size_t proportional_bytes_of(pid_t process) {
  const auto bytes = bytes_in_rollup(process, "Pss:");
  return bytes ? *bytes : resident_bytes_of(process);
}

}  // namespace nearmiss
