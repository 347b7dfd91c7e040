#include "corpus/files/line_reader.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

namespace nearmiss {

namespace {

constexpr std::size_t block_size = std::size_t{1} << 16;
constexpr std::size_t longest_line = std::size_t{1} << 20;
constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

[[noreturn]] void fail(const std::string& name, int error) {
  throw BadInput(fmt::format("{}: cannot be read: {}", name, std::strerror(error)));
}

int opened(const std::string& name) {
  const int descriptor = ::open(name.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY);
  struct stat found {};
  if (descriptor < 0 || ::fstat(descriptor, &found) != 0) fail(name, errno);
  if (S_ISDIR(found.st_mode)) fail(name, EISDIR);
  return descriptor;
}

}  // namespace

LineReader::LineReader(const std::vector<std::string>& files) {
  if (::pipe2(stopping_, O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
  for (const std::string& f : files) {
    if (f == "-") {
      files_.push_back({"standard input", STDIN_FILENO});
    } else {
      files_.push_back({f, opened(f)});
    }
  }
}

LineReader::~LineReader() {
  for (const Open& f : files_) {
    if (f.descriptor != STDIN_FILENO) ::close(f.descriptor);
  }
  for (const int end : stopping_) {
    if (end >= 0) ::close(end);
  }
}

void LineReader::stop() {
  if (const int end = std::exchange(stopping_[1], -1); end >= 0) ::close(end);
}

/// False once stop() was called.
bool LineReader::wait_for(int descriptor) const {
  pollfd files[] = {{stopping_[0], POLLIN, 0}, {descriptor, POLLIN, 0}};
  while (::poll(files, 2, -1) < 0) {
    if (errno != EINTR) throw std::system_error(errno, std::generic_category(), "poll");
  }
  return files[0].revents == 0;
}

/// Returns the number of bytes, 0 at the end of the file.
std::size_t LineReader::read_some(Open& file) const {
  const std::size_t before = file.begun.size();
  file.begun.resize(before + block_size);
  ssize_t n = 0;
  do {
    n = ::read(file.descriptor, file.begun.data() + before, block_size);
  } while (n < 0 && errno == EINTR);
  if (n < 0) fail(file.name, errno);
  file.begun.resize(before + std::size_t(n));
  return std::size_t(n);
}

std::optional<LineBlock> LineReader::next() {
  while (!files_.empty()) {
    Open& f = files_.front();
    if (!wait_for(f.descriptor)) return std::nullopt;
    const bool at_end = read_some(f) == 0;
    const std::size_t end = at_end ? f.begun.size() : f.begun.rfind('\n') + 1;  // 0 where no line is complete
    if (f.begun.size() - end > longest_line) {
      const auto lines = std::size_t(std::count(f.begun.begin(), f.begun.end(), '\n'));
      throw BadInput(
          fmt::format("{}:{}: the line is longer than {} MiB", f.name, f.next_line + lines, longest_line >> 20));
    }
    std::optional<LineBlock> block;
    if (end > 0) {
      block = {f.begun.substr(0, end), f.name, f.next_line};
      f.begun.erase(0, end);
      f.next_line += std::size_t(std::count(block->text.begin(), block->text.end(), '\n'));
      if (block->first == 1 && block->text.starts_with(byte_order_mark)) block->text.erase(0, byte_order_mark.size());
    }
    if (at_end) {
      if (f.descriptor != STDIN_FILENO) ::close(f.descriptor);
      files_.pop_front();
    }
    if (block) return block;
  }
  return std::nullopt;
}

}  // namespace nearmiss
