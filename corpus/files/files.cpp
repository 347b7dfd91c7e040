#include "corpus/files/files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <optional>
#include <utility>

namespace nearmiss {

namespace {

namespace fs = std::filesystem;

/// In bytes: far above the size of every file that is read. A device may have no end.
constexpr std::size_t most_of_a_file = std::size_t{256} << 20;

[[noreturn]] void fail_to_write(const fs::path& file, const std::string& why) {
  throw IoError(fmt::format("{}: cannot be written: {}", file.string(), why));
}

/// A link of /proc names an open file. It is not followed: its text need not be the name of any file.
bool is_of_proc(const fs::path& link) {
  std::error_code error;
  const fs::path folder = fs::canonical(link.has_parent_path() ? link.parent_path() : ".", error);
  return !error && folder.string().starts_with("/proc/");
}

/// Where links lead. The last part may not exist.
fs::path behind_links(const fs::path& file) {
  constexpr int most_links = 40;  // as of Linux
  fs::path at = file;
  for (int i = 0; i < most_links; ++i) {
    std::error_code error;
    if (!fs::is_symlink(fs::symlink_status(at, error)) || is_of_proc(at)) return at;
    const fs::path to = fs::read_symlink(at, error);
    if (error) fail_to_write(file, error.message());
    at = at.parent_path() / to;  // that is `to` where it is absolute
  }
  fail_to_write(file, std::strerror(ELOOP));
}

/// What is there now; empty where there is nothing.
std::optional<struct stat> what_is_at(const fs::path& at) {
  struct stat found {};
  return ::stat(at.c_str(), &found) == 0 ? std::optional(found) : std::nullopt;
}

bool is_replaced(const fs::path& at, const std::optional<struct stat>& found) {
  return !is_of_proc(at) && (!found || S_ISREG(found->st_mode));
}

/// A descriptor that closes itself.
class OpenFile {
 public:
  explicit OpenFile(int descriptor) : descriptor_(descriptor) {}
  ~OpenFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  bool is_open() const { return descriptor_ >= 0; }
  int descriptor() const { return descriptor_; }
  /// False where the system reports only now that the text is not written, with errno set.
  bool close() { return ::close(std::exchange(descriptor_, -1)) == 0; }

 private:
  int descriptor_;
};

/// False with errno set.
bool write_all(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t n = ::write(descriptor, text.data(), text.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return false;
    text.remove_prefix(std::size_t(n));
  }
  return true;
}

/// Standard output or standard error, where it is this file: what was printed before stays in its place.
std::optional<int> standard_file(const struct stat& found) {
  for (std::FILE* const stream : {stdout, stderr}) {
    const int descriptor = ::fileno(stream);
    struct stat own {};
    if (::fstat(descriptor, &own) != 0 || own.st_dev != found.st_dev || own.st_ino != found.st_ino) continue;
    if ((::fcntl(descriptor, F_GETFL) & O_ACCMODE) == O_RDONLY) continue;
    std::fflush(stream);
    return descriptor;
  }
  return std::nullopt;
}

/// Writes into what is there, and replaces nothing.
void write_into(const fs::path& file, const fs::path& at, const struct stat& found, std::string_view text) {
  if (const std::optional<int> own = standard_file(found)) {
    if (!write_all(*own, text)) fail_to_write(file, std::strerror(errno));
    return;
  }
  OpenFile out(::open(at.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC | O_NOCTTY));
  if (!out.is_open() || !write_all(out.descriptor(), text) || !out.close()) fail_to_write(file, std::strerror(errno));
}

fs::path temporary_beside(const fs::path& at) {
  fs::path temporary = at;
  temporary += fmt::format(".{}.part", ::getpid());
  return temporary;
}

/// Makes a new file; one of this name is left over from a process that was killed.
int make_file(const fs::path& file) {
  ::unlink(file.c_str());
  constexpr int for_all_by_umask = 0666;
  return ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, for_all_by_umask);
}

void replace_file(const fs::path& file, const fs::path& at, std::string_view text) {
  const fs::path temporary = temporary_beside(at);
  OpenFile out(make_file(temporary));
  const bool written =
      out.is_open() && write_all(out.descriptor(), text) && out.close() && ::rename(temporary.c_str(), at.c_str()) == 0;
  if (written) return;
  const std::string why = std::strerror(errno);
  ::unlink(temporary.c_str());
  fail_to_write(file, why);
}

/// Why no file can be made there; empty where one can.
std::string why_no_file(const fs::path& at) {
  const fs::path temporary = temporary_beside(at);
  const OpenFile trial(make_file(temporary));
  if (!trial.is_open()) return std::strerror(errno);
  ::unlink(temporary.c_str());
  return "";
}

}  // namespace

std::string read_file(const fs::path& file) {
  std::error_code ignored;
  if (fs::is_directory(file, ignored)) {
    throw BadInput(fmt::format("{}: cannot be read: it is a folder", file.string()));
  }
  std::ifstream in(file, std::ios::binary);
  if (!in) throw BadInput(fmt::format("{}: cannot be read: {}", file.string(), std::strerror(errno)));
  std::string text, block(std::size_t{1} << 16, '\0');
  while (in.read(block.data(), std::streamsize(block.size())) || in.gcount() > 0) {
    text.append(block, 0, std::size_t(in.gcount()));
    if (text.size() > most_of_a_file) {
      throw BadInput(fmt::format("{}: cannot be read: it is longer than {} MiB", file.string(), most_of_a_file >> 20));
    }
  }
  if (in.bad()) throw BadInput(fmt::format("{}: cannot be read: {}", file.string(), std::strerror(errno)));
  return text;
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw IoError(fmt::format("{}: the folder cannot be made: {}", folder.string(), error.message()));
}

void write_file(const fs::path& file, std::string_view text) {
  const fs::path at = behind_links(file);
  const std::optional<struct stat> found = what_is_at(at);
  if (is_replaced(at, found)) {
    replace_file(file, at, text);
  } else if (found) {
    write_into(file, at, *found, text);
  } else {
    fail_to_write(file, std::strerror(ENOENT));
  }
}

void check_can_write(const fs::path& file) {
  const fs::path at = behind_links(file);
  const std::optional<struct stat> found = what_is_at(at);
  if (is_replaced(at, found)) {
    if (const std::string why = why_no_file(at); !why.empty()) fail_to_write(file, why);
  } else if (!found || S_ISDIR(found->st_mode)) {
    fail_to_write(file, std::strerror(found ? EISDIR : ENOENT));
  } else if (!standard_file(*found) && ::access(at.c_str(), W_OK) != 0) {
    fail_to_write(file, std::strerror(errno));
  }
}

void make_writable_folder(const fs::path& folder) {
  make_folder(folder);
  check_can_write_in(folder);
}

void check_can_write_in(const fs::path& folder) {
  fs::path existing = fs::absolute(folder);
  std::error_code ignored;
  while (existing.has_relative_path() && !fs::exists(existing, ignored)) existing = existing.parent_path();
  if (const std::string why = why_no_file(existing / "file"); !why.empty())
    throw IoError(fmt::format("{}: no file can be made in this folder: {}", folder.string(), why));
}

}  // namespace nearmiss
