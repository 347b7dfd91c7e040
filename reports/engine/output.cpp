#include "reports/engine/output.hpp"

#include <cerrno>
#include <cstdio>
#include <new>
#include <system_error>

#include "reports/findings/encoded.hpp"

namespace nearmiss {

void say_text(std::string_view text) {
  const std::string shown = for_terminal(text);
  if (std::fwrite(shown.data(), 1, shown.size(), stdout) != shown.size())
    throw std::system_error(errno, std::generic_category(), "standard output");
}

void flush_output() {
  if (std::fflush(stdout) != 0) throw std::system_error(errno, std::generic_category(), "standard output");
}

void say_on_stderr(std::string_view text) noexcept try {
  const std::string shown = for_terminal(text);
  std::fwrite(shown.data(), 1, shown.size(), stderr);
  std::fflush(stderr);
} catch (const std::bad_alloc&) {  // the caller says so too
}

}  // namespace nearmiss
