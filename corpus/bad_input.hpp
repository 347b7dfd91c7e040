/// The error for anything that comes from outside and is not as it must be.
#pragma once

#include <stdexcept>
#include <string>

namespace nearmiss {

/// One line: what is wrong, where, and why. The command line prints it and exits with 2.
class BadInput : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace nearmiss
