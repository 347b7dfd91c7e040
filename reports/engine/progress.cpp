#include "reports/engine/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "reports/findings/encoded.hpp"
#include "reports/findings/text.hpp"

namespace nearmiss {

using namespace std::chrono_literals;

namespace {

constexpr const char* erase_line = "\r\033[K";

void show_on_terminal(const std::string& line) {
  std::fprintf(stderr, "%s%s", erase_line, for_terminal(line).c_str());
  std::fflush(stderr);
}

}  // namespace

Progress::Progress() : terminal_(isatty(STDERR_FILENO) == 1), begin_(Clock::now()), last_shown_(begin_) {}

Progress::~Progress() {
  if (shown_ && terminal_) show_on_terminal("");
}

void Progress::set_activity(std::string what) { what_ = std::move(what); }

void Progress::show(std::uint64_t done, std::optional<std::uint64_t> total, std::optional<double> seconds_left,
                    std::optional<std::uint64_t> findings) {
  const auto now = Clock::now();
  if (now - last_shown_ < (terminal_ ? Clock::duration(200ms) : Clock::duration(10s))) return;
  last_shown_ = now;
  shown_ = true;
  const std::string text = line(done, total, seconds_left, findings);
  if (terminal_) return show_on_terminal(text);
  say_on_stderr("nearmiss: " + text + "\n");
}

std::string Progress::line(std::uint64_t done, std::optional<std::uint64_t> total, std::optional<double> seconds_left,
                           std::optional<std::uint64_t> findings) const {
  const double seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
  const double rate = double(done) / std::max(seconds, 1e-9);
  if (total && rate > 0) seconds_left = double(*total - std::min(done, *total)) / rate;
  std::string text = what_.empty() ? "" : what_ + ": ";
  text += count_text(done) + (total ? " of " + count_text(*total) : "") + " cases, ";
  if (findings) text += plural_text(*findings, "finding") + ", ";
  text += count_text(std::uint64_t(rate)) + " cases/s";
  if (seconds_left) text += ", " + duration_text(*seconds_left) + " left";
  return text;
}

std::string duration_text(double seconds) {
  if (seconds < 10) return fmt::format("{:.1f} s", std::max(0.0, seconds));
  const auto s = std::uint64_t(std::llround(seconds));
  if (s >= 3600) return fmt::format("{} h {:02} min", s / 3600, s % 3600 / 60);
  if (s >= 60) return fmt::format("{} min {:02} s", s / 60, s % 60);
  return fmt::format("{} s", s);
}

}  // namespace nearmiss
