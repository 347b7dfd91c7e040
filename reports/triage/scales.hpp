/// Multiplies a case by powers of two, which changes no rounding, and finds where the verdict flips.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reports/triage/trials.hpp"

namespace nearmiss {

/// Numbers of a case that are multiplied together, so that the exact answer follows.
struct ScaleGroup {
  std::string_view name;  ///< "lengths and velocities"
  std::string_view unit;  ///< of a tolerance that the group shows: "length"
  int (*order)(Role role);
};
std::span<const ScaleGroup> scale_groups();

/// The case with each number multiplied by 2^(k * order); empty where that is not exact, or changes nothing.
std::optional<Case> scaled(const Case& c, const ScaleGroup& group, int k);

/// The scale at which a finding ends: at 2^wrong the finding is there, at 2^right the answer is right, and the two
/// exponents are neighbours.
struct Flip {
  int wrong = 0, right = 0;
  bool operator==(const Flip&) const = default;
};

/// The trials of one group, and the flip next to scale 1.
struct ScaleScan {
  const ScaleGroup* group = nullptr;
  struct At {
    int k;
    Trial trial;
  };
  std::vector<At> trials;  ///< by k; k = 0 is among them
  std::optional<Flip> flip;

  /// Whether every trial with the finding between scale 1 and the flip raised the exception, and some trial with a
  /// right answer beyond the flip did not.
  bool explained_by(Raised exception) const;
};

/// Scans one group; answers have the raised exceptions where the subject can be asked so.
ScaleScan scan(Trials& trials, const ScaleGroup& group);
/// The flip of another case with the same finding, sought from a flip known of a similar case. Empty where there is
/// none.
std::optional<Flip> flip_near(Trials& trials, const Case& c, const ScaleGroup& group, const Flip& known);

}  // namespace nearmiss
