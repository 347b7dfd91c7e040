#include "reports/engine/folder_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>

#include "corpus/files/errors.hpp"

namespace nearmiss {

FolderLock::FolderLock(const std::filesystem::path& folder)
    : file_(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (file_ < 0 || flock(file_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
  close(file_);
  throw BadInput(
      fmt::format("{}: another run writes there now; wait for its end or give another --out", folder.string()));
}

FolderLock::~FolderLock() {
  if (file_ >= 0) close(file_);
}

}  // namespace nearmiss
