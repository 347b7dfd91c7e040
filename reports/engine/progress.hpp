/// Shows progress on standard error: on a terminal one line that is rewritten, elsewhere a line every ten seconds.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "reports/engine/output.hpp"

namespace nearmiss {

class Progress {
 public:
  Progress();
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Names the current work: "stored cases", "fuzzing moving_sphere_box".
  void set_activity(std::string what);
  /// Also shows the time left where the total, or the seconds until the end, are known, and the findings where they are
  /// counted.
  void show(std::uint64_t done, std::optional<std::uint64_t> total, std::optional<double> seconds_left,
            std::optional<std::uint64_t> findings);

 private:
  using Clock = std::chrono::steady_clock;
  std::string line(std::uint64_t done, std::optional<std::uint64_t> total, std::optional<double> seconds_left,
                   std::optional<std::uint64_t> findings) const;

  const bool terminal_;
  const Clock::time_point begin_;
  Clock::time_point last_shown_;
  std::string what_;
  bool shown_ = false;
};

/// "1 h 02 min", "3 min 05 s", "12 s", "0.4 s".
std::string duration_text(double seconds);

}  // namespace nearmiss
