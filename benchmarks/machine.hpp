/// What the results say about where they were measured.
#pragma once

#include <fstream>
#include <string>

namespace nearmiss::benchmarks {

/// As the kernel names it; empty where it does not.
inline std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "";
}

}  // namespace nearmiss::benchmarks
