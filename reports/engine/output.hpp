/// Prints. Whatever a text holds, a terminal shows it and does nothing else: control characters, bytes that are not
/// UTF-8 and changes of the writing direction are shown as printable() writes them. Line breaks stay.
#pragma once

#include <fmt/core.h>

#include <string>
#include <string_view>
#include <utility>

namespace nearmiss {

/// Prints to standard output. Throws std::system_error where it cannot be written.
void say_text(std::string_view text);

template <class... Arguments>
void say(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  say_text(fmt::format(format, std::forward<Arguments>(arguments)...));
}

/// Hands on what was printed. Throws std::system_error where it cannot be written.
void flush_output();

/// Prints to standard error and ignores errors: they change neither the work nor the exit code.
void say_on_stderr(std::string_view text) noexcept;

}  // namespace nearmiss
