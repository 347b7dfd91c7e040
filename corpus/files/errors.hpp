/// The errors whose cause lies outside of Nearmiss.
#pragma once

#include <stdexcept>
#include <string>

namespace nearmiss {

/// One line: what is wrong, where, and why. The command line prints the line and exits with 2.
class ReportedError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An argument, a file or an environment variable that breaks a rule.
class BadInput : public ReportedError {
 public:
  using ReportedError::ReportedError;
};

/// A file that cannot be written or a folder that cannot be made, such as on a full disk.
class IoError : public ReportedError {
 public:
  using ReportedError::ReportedError;
};

}  // namespace nearmiss
