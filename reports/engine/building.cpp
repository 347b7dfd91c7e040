#include "reports/engine/building.hpp"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstdlib>
#include <iterator>
#include <sstream>
#include <string_view>

namespace nearmiss {

Building::Building() {
  const char* named = std::getenv(building_variable);
  if (named == nullptr) return;
  const std::string_view text(named);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), pipe_);
  const bool is_open =
      error == std::errc() && end == text.data() + text.size() && fcntl(pipe_, F_SETFD, FD_CLOEXEC) == 0;
  if (!is_open) pipe_ = -1;
  there_is_ = is_open;
  ended_ = !is_open;
}

Building::~Building() {
  if (pipe_ >= 0) close(pipe_);
}

void Building::poll(int milliseconds) {
  std::array<char, 4096> read_now{};
  while (!ended_) {
    pollfd waiting{pipe_, POLLIN, 0};
    if (::poll(&waiting, 1, milliseconds) <= 0) return;  // nothing yet, or interrupted
    const ssize_t got = read(pipe_, read_now.data(), read_now.size());
    if (got < 0 && errno == EINTR) return;
    ended_ = got <= 0;
    unread_.append(read_now.data(), std::size_t(got < 0 ? 0 : got));
    for (std::size_t end = 0; (end = unread_.find('\n')) != std::string::npos; unread_.erase(0, end + 1)) {
      take(unread_.substr(0, end));
    }
    milliseconds = 0;
  }
}

void Building::wait_for_a_build_without_work() {
  using namespace std::chrono;
  constexpr milliseconds patience = 3s;
  for (const auto end = steady_clock::now() + patience; !ended_ && steady_clock::now() < end;) {
    poll(int(duration_cast<milliseconds>(end - steady_clock::now()).count()));
  }
}

void Building::take(const std::string& line) {
  std::istringstream words(line);
  std::string step;
  words >> step;
  steps_.insert(step);
  if (step == "subjects") subjects_.insert(subjects_.end(), std::istream_iterator<std::string>(words), {});
}

}  // namespace nearmiss
