/// Locks a run folder for one run at a time.
#pragma once

#include <filesystem>

namespace nearmiss {

/// Holds the lock of a folder for its lifetime. The system releases the lock when the process ends in any way. Leaves
/// no file. Does nothing on a file system without locks.
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
