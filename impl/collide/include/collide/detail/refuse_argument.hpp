/// The refusal of an argument that a function of this library does not accept by its contract.
#pragma once

#if defined(__cpp_exceptions) || defined(_CPPUNWIND)
#define COLLIDE_EXCEPTIONS
#endif

#if defined(COLLIDE_EXCEPTIONS)
#include <stdexcept>
#else
#include <cstdio>
#include <cstdlib>
#endif
#include <string>

namespace collide::detail {

/// Throws std::invalid_argument with the message, which is one line. With -fno-exceptions it writes the message to
/// standard error and aborts.
[[noreturn]] inline void refuse_argument(const std::string& message) {
#if defined(COLLIDE_EXCEPTIONS)
  throw std::invalid_argument(message);
#else
  std::fprintf(stderr, "collide: %s\n", message.c_str());
  std::abort();
#endif
}

}  // namespace collide::detail
#undef COLLIDE_EXCEPTIONS
