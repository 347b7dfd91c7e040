/// How much a finding matters: docs/triage.md has the formula.
#pragma once

#include <optional>
#include <string>

#include "reports/findings/report.hpp"

namespace nearmiss {

/// A finding is worse than an earlier one where its proved size is at least so many times as large.
inline constexpr double much_worse = 2;

/// The proved size of a finding's error.
struct ErrorSize {
  /// Of the largest number in its group, or of the scene: the smaller one of the backward and the forward error of the
  /// headline's member, where both are proved. So an error of two ulps is small even where no input near by has the
  /// answer. 1 where there is no usable answer: it broke, or a number is not finite.
  double relative = 0;
  std::optional<double> above_epsilon;  ///< the proved backward error of the headline; empty: none
  double amount = 0;                    ///< `relative` in the unit of the scene; 0: there is none
  std::string unit;                     ///< of `amount`: "units of length", "units of time"; empty: there is none
};
ErrorSize error_size(const Case& question, const Finding& f);

/// From 0 to 100: the product of the harm of the fault's direction, of the bits of the error's size, and of the share
/// of ordinary cases.
double severity_of(const Finding& f, const ErrorSize& size, double ordinary_share);

/// "12 % of the scene, 0.35 units of length (> 2^50 epsilon)".
std::string size_text(const ErrorSize& size);
/// A share from 0 to 1: "88 %", "0.0012 %", "3e-14 %".
std::string share_text(double share);

}  // namespace nearmiss
