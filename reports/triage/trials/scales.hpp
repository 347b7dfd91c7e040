/// Multiplies a case by powers of two, which changes no rounding, and finds where the verdict flips.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reports/triage/trials/trials.hpp"

namespace nearmiss {

/// Numbers of a case that are multiplied together, so that the exact answer follows.
struct ScaleGroup {
  std::string_view name;  ///< "lengths and velocities"
  std::string_view unit;  ///< of a tolerance that the group shows: "length"
  int (*order)(Role role);
};
std::span<const ScaleGroup> scale_groups();

/// The largest magnitude of the group's numbers.
double largest_of(const Case& c, const ScaleGroup& group);
/// The case with each number multiplied by 2^(k * order); empty where that is not exact, or changes nothing.
std::optional<Case> scaled(const Case& c, const ScaleGroup& group, int k);

/// Where a finding ends: from 2^0 to 2^wrong the finding is there, and at 2^right the answer is right. Between the two,
/// answers may have other findings; without such answers, the exponents are neighbours.
struct Flip {
  int wrong = 0, right = 0;
  bool is_sharp() const { return wrong - right == 1 || right - wrong == 1; }
};

/// The trials of one group, and the flip nearest to scale 1.
struct ScaleScan {
  const ScaleGroup* group = nullptr;
  struct At {
    int k;
    Trial trial;
  };
  std::vector<At> trials;  ///< by k; k = 0 is among them
  std::optional<Flip> flip;

  /// There is a flip, and no overflow and no underflow from its one side to the other.
  bool has_clean_flip() const;
  /// Every answer with the finding from scale 1 to the flip raised the exception, and a right answer beyond did not.
  /// The first answer in the other direction is not right.
  bool explained_by(Raised exception) const;
  /// Where the finding ends together with the exception, though no answer is right: in one direction every answer with
  /// the finding raised the exception, and at least three beyond have another finding, or none, and raised nothing.
  std::optional<Flip> ends_with(Raised exception) const;
};

/// Scans one group; answers have the raised exceptions where the subject can be asked so.
ScaleScan scan(Trials& trials, const ScaleGroup& group);
/// The flip of another case with the same finding, sought from a flip known of a similar case; empty where there
/// is none.
std::optional<Flip> flip_near(Trials& trials, const Case& c, const ScaleGroup& group, const Flip& known);

}  // namespace nearmiss
