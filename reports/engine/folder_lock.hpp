/// One run at a time in a run folder.
#pragma once

#include <filesystem>

namespace nearmiss {

/// Holds a folder as long as it lives; the system lets go of it when the process ends, however it ends. It leaves no
/// file. A file system that knows no locks is taken without one.
class FolderLock {
 public:
  /// Throws BadInput where another process holds the folder.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int file_ = -1;
};

}  // namespace nearmiss
