#include "impl/host/error_line.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <vector>

namespace nearmiss {

namespace {

using Lines = std::vector<std::string_view>;

bool is_space(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }
bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }
bool is_of_name(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.' || c == '$'; }

std::string_view trimmed(std::string_view line) {
  while (!line.empty() && is_space(line.front())) line.remove_prefix(1);
  while (!line.empty() && is_space(line.back())) line.remove_suffix(1);
  return line;
}

Lines lines_of(std::string_view text) {
  Lines lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    lines.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

bool begins_with_any(std::string_view line, std::initializer_list<std::string_view> words) {
  return std::any_of(words.begin(), words.end(), [&](std::string_view word) { return line.starts_with(word); });
}

bool contains(std::string_view line, std::string_view word) { return line.find(word) != std::string_view::npos; }

/// "12: 0xb7…" and "#3 0x55…", frames of Node.js and of sanitizers.
bool is_numbered_frame(std::string_view line) {
  if (line.starts_with('#')) line.remove_prefix(1);
  const std::string_view digits =
      line.substr(0, std::size_t(std::find_if_not(line.begin(), line.end(), is_digit) - line.begin()));
  if (digits.empty()) return false;
  line.remove_prefix(digits.size());
  return begins_with_any(line, {": 0x", " 0x", " {main}", " /"});
}

/// Lines at the margin that runtimes write below an error.
bool is_below_an_error(std::string_view line) {
  return line.empty() || line == "}" || line == "^" || is_numbered_frame(line) ||
         begins_with_any(
             line, {"Node.js v", "(Use `node", "note: run with `RUST_BACKTRACE", "note: Some details are omitted",
                    "stack backtrace:", "Stack trace:", "Caused by:", "goroutine ", "exit status ", "Current thread 0x",
                    "Thread 0x", "Extension modules:", "Shadow byte", "=>0x", "-----", "Aborted (core dumped)"}) ||
         (line.starts_with("==") && line.ends_with("==ABORTING"));
}

/// True for a line at the margin that begins with the name of an error: "TypeError: …", "java.lang.Error: …",
/// "AssertionError [ERR_ASSERTION]: …".
bool names_an_error(std::string_view line) {
  for (const std::string_view word : {"Uncaught ", "Unhandled exception. "}) {
    if (line.starts_with(word)) line.remove_prefix(word.size());
  }
  const std::string_view name =
      line.substr(0, std::size_t(std::find_if_not(line.begin(), line.end(), is_of_name) - line.begin()));
  const std::string_view rest = line.substr(name.size());
  return (name.ends_with("Error") || name.ends_with("Exception")) &&
         (rest.empty() || begins_with_any(rest, {":", " ["}));
}

bool is_error(std::string_view line) {
  return names_an_error(line) || contains(line, "runtime error: ") || contains(line, "Assertion `") ||
         (line.starts_with("SUMMARY: ") && contains(line, "Sanitizer")) ||
         contains(line, ": ERROR: AddressSanitizer") ||
         begins_with_any(line, {"Exception in thread ", "Unhandled exception", "terminate called",
                                "what(): ", "libc++abi: ", "Fatal ", "fatal error: ", "FATAL ERROR: ",
                                "PHP Fatal error: ", "panic: ", "thread '", "[UnhandledPromiseRejection"}) ||
         (line.starts_with("*** ") && contains(line, " detected ***")) || line.ends_with("Error)");
}

/// The last line before `end` that begins with one of the words.
std::optional<std::string> last_of(const Lines& lines, std::size_t end, std::initializer_list<std::string_view> words) {
  for (std::size_t i = end; i-- > 0;) {
    if (begins_with_any(trimmed(lines[i]), words)) return std::string(trimmed(lines[i]));
  }
  return std::nullopt;
}

/// Below the error, Go writes lines at the margin that only its own order tells from messages.
std::optional<std::string> error_of_go(const Lines& lines) {
  const auto stack = std::find_if(lines.begin(), lines.end(), [](auto line) { return line.starts_with("goroutine "); });
  if (stack == lines.end()) return std::nullopt;
  return last_of(lines, std::size_t(stack - lines.begin()), {"panic: ", "fatal error: "});
}

/// The Java virtual machine writes its crash as a comment of many lines.
std::optional<std::string> error_of_java_machine(const Lines& lines) {
  const auto is_headline = [](auto line) {
    return contains(line, "A fatal error has been detected by the Java Runtime");
  };
  const auto headline = std::find_if(lines.begin(), lines.end(), is_headline);
  for (auto line = headline; line != lines.end(); ++line) {
    if (line->starts_with("#  ") && !is_headline(*line)) return std::string(trimmed(line->substr(1)));
  }
  return std::nullopt;
}

/// Rust writes the message of a panic below its place.
std::optional<std::string> panic_above(const Lines& lines, std::size_t message) {
  constexpr std::size_t most_above = 4;  // lines of a message
  for (std::size_t i = message; i-- > 0 && message - i <= most_above;) {
    if (!contains(lines[i], " panicked at ") || !lines[i].ends_with(':')) continue;
    return std::string(trimmed(lines[i])) + " " + std::string(trimmed(lines[i + 1]));
  }
  return std::nullopt;
}

/// The line of an undefined behaviour says more than its summary.
std::optional<std::string> runtime_error_above(const Lines& lines, std::size_t summary) {
  if (!contains(lines[summary], "UndefinedBehaviorSanitizer")) return std::nullopt;
  for (std::size_t i = summary; i-- > 0;) {
    if (contains(lines[i], "runtime error: ")) return std::string(trimmed(lines[i]));
  }
  return std::nullopt;
}

}  // namespace

std::string error_line_of(std::string_view output) {
  const Lines lines = lines_of(output);
  for (const auto find : {error_of_java_machine, error_of_go}) {
    if (auto found = find(lines)) return *found;
  }
  std::string_view last;  // what a person reads last
  bool saw_frames = false;
  for (std::size_t i = lines.size(); i-- > 0;) {
    const std::string_view line = trimmed(lines[i]);
    const bool is_indented = !lines[i].empty() && is_space(lines[i].front());
    const bool is_of_terminate = line.starts_with("what(): ");
    if (is_below_an_error(line) || (is_indented && !is_of_terminate)) {
      if (last.empty() && is_indented) last = line;
      saw_frames = saw_frames || begins_with_any(line, {"at ", "from ", "File \""});
      continue;
    }
    if (auto panic = panic_above(lines, i)) return *panic;
    if (auto error = runtime_error_above(lines, i)) return *error;
    if (is_error(line) || saw_frames || last.empty()) return std::string(line);
    break;
  }
  if (!last.empty()) return std::string(last);
  for (std::size_t i = lines.size(); i-- > 0;) {
    if (!trimmed(lines[i]).empty()) return std::string(trimmed(lines[i]));
  }
  return {};
}

}  // namespace nearmiss
