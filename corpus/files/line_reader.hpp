/// Reads files and standard input line by line, as far as they have been written.
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "corpus/files/errors.hpp"

namespace nearmiss {

/// Whole lines of one file.
struct LineBlock {
  std::string text;  ///< the lines with their ends; the last line of a file may lack its end
  std::string file;
  std::size_t first = 1;  ///< the number of the first line in its file

  /// Calls `each` with every line that is not blank, without its end, and with its place: "FILE:3". Stops where it
  /// returns false.
  template <class Each>
  void for_each_line(const Each& each) const {
    std::string_view rest = text;
    for (std::size_t number = first; !rest.empty(); ++number) {
      const std::size_t end = rest.find('\n');
      const std::string_view line = rest.substr(0, end);
      rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
      if (line.find_first_not_of(" \t\r") == std::string_view::npos) continue;
      if (!each(line, file + ":" + std::to_string(number))) return;
    }
  }
};

/// Not thread-safe, apart from stop().
class LineReader {
 public:
  /// Opens all files; "-" is standard input. Throws BadInput for one that cannot be read.
  explicit LineReader(const std::vector<std::string>& files);
  ~LineReader();
  LineReader(const LineReader&) = delete;
  LineReader& operator=(const LineReader&) = delete;

  /// The lines that can be read now, about 64 KiB at most. Waits for the first of them, as a pipe may be idle. Empty at
  /// the end of the last file, and after stop(). Throws BadInput for a file that cannot be read on, and for a line
  /// longer than 1 MiB; after that, call it no more.
  std::optional<LineBlock> next();
  /// Ends the waiting of next() for good. Thread-safe.
  void stop();

 private:
  struct Open {
    std::string name;
    int descriptor;
    std::size_t next_line = 1;
    std::string begun{};  ///< the beginning of a line that is not complete
  };
  bool wait_for(int descriptor) const;
  std::size_t read_some(Open& file) const;

  std::deque<Open> files_;
  int stopping_[2] = {-1, -1};  ///< a pipe: its end is closed by stop()
};

}  // namespace nearmiss
