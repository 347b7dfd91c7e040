/// Turns a failed system call into an exception.
#pragma once

#include <cerrno>
#include <system_error>

namespace nearmiss {

/// Throws the error that `errno` holds. `what` says what this process could not get.
[[noreturn]] inline void throw_errno(const char* what) {
  throw std::system_error(errno, std::generic_category(), what);
}

}  // namespace nearmiss
