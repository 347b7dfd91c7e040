/// What the launcher builds while this program runs.
#pragma once

#include <set>
#include <string>
#include <vector>

namespace nearmiss {

/// The environment variable with the descriptor of a pipe from the launcher. The launcher writes a line for each step
/// of a build that has succeeded, and closes the pipe at the end of the build.
inline constexpr const char* building_variable = "NEARMISS_BUILDING";

/// The steps of such a build: "subjects NAME...", some subjects; "hosts", all subjects; "properties", the property
/// tests; "targets", the fuzz targets. Without such a pipe every step is over: what is there is all there is.
class Building {
 public:
  Building();
  ~Building();
  Building(const Building&) = delete;
  Building& operator=(const Building&) = delete;

  /// Reads what the launcher has written, for at most so many milliseconds where it has written nothing.
  void poll(int milliseconds = 0);
  /// Waits for a few seconds, in which a build ends that has nothing to do.
  void wait_for_a_build_without_work();
  /// Whether the step has succeeded; true without a build.
  bool has(const std::string& step) const { return !there_is_ || steps_.contains(step); }
  /// Whether the step may still succeed.
  bool may_have(const std::string& step) const { return !ended_ && !steps_.contains(step); }
  /// Whether the build has ended before its last step.
  bool has_failed() const { return there_is_ && ended_ && !steps_.contains("targets"); }
  /// The subjects that the launcher has named.
  const std::vector<std::string>& subjects() const { return subjects_; }

 private:
  void take(const std::string& line);

  int pipe_ = -1;
  bool there_is_ = false, ended_ = true;
  std::string unread_;
  std::set<std::string> steps_;
  std::vector<std::string> subjects_;
};

}  // namespace nearmiss
