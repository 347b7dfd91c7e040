/// Finds the commit of a library that brought a finding: drives `git bisect`, and replays the case at each step.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace nearmiss {

struct Bisection {
  std::filesystem::path repository;  ///< a working tree of the library; stays as it is
  std::string good, bad;             ///< revisions without and with the finding
  std::string build;                 ///< the shell command that builds a revision, run at its top; may be empty
  /// The shell command that replays the case, run at the top of a revision; prints a JSON array with one report.
  std::string replay;
  /// The finding, as a report has it: its verdict and its disagreement.
  std::string verdict, disagreement;
};

/// What was seen at a revision.
enum class Seen {
  absent,   ///< the subject has no such finding there
  present,  ///< it has the finding
  unknown,  ///< the revision cannot be built, or the case not be asked
};
std::string_view name_of(Seen s);

struct BisectionStep {
  std::string revision, subject;  ///< the abbreviated commit and the first line of its message
  Seen seen;
  std::string why;  ///< what the replay gave: "false miss", "agrees", the end of a log
};

struct FirstWithFinding {
  std::vector<std::string>
      commits;  ///< the commit; several, where revisions between them are unknown; none: interrupted
  std::vector<BisectionStep> steps;
};

/// Works in a working tree of its own below the system's folder of temporary files, and removes it. Throws BadInput
/// where git refuses, and where the ends are not as said. `tell` is called after each step. Stops between steps when
/// `stopped` returns true.
FirstWithFinding bisect(const Bisection& b, const std::function<void(const BisectionStep&)>& tell,
                        const std::function<bool()>& stopped);

}  // namespace nearmiss
