/// Describes the machine, for the results.
#pragma once

#include <fstream>
#include <string>

namespace nearmiss::benchmarks {

/// The processor's name from the kernel; empty where unknown.
inline std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "";
}

}  // namespace nearmiss::benchmarks
