#include "impl/host/exposure.hpp"

#include <fcntl.h>
#include <linux/mount.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <system_error>

// <linux/mount.h> and <sys/mount.h> define the same names.
extern "C" int mount(const char*, const char*, const char*, unsigned long, const void*) noexcept;

namespace nearmiss {

namespace {

namespace fs = std::filesystem;

/// Whether other users than its owner may pass through the folder, or read the file.
bool is_open(const fs::path& path) {
  struct stat about {};
  const mode_t needed = stat(path.c_str(), &about) == 0 && S_ISDIR(about.st_mode) ? S_IXOTH : S_IROTH;
  return (about.st_mode & needed) != 0;
}

/// The folders above the path that are closed to other users, the outermost first.
std::vector<fs::path> closed_folders_above(const fs::path& path) {
  std::vector<fs::path> closed;
  fs::path above = "/";
  for (const fs::path& part : path.parent_path().relative_path()) {
    above /= part;
    if (!is_open(above)) closed.push_back(above);
  }
  return closed;
}

bool is_within(const fs::path& path, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

/// Adds what makes the file or folder reachable: what lies in the innermost closed folder above it, with all that is
/// below, because an interpreter needs its libraries.
void add_hidden(const fs::path& path, std::vector<fs::path>& all) {
  const std::vector<fs::path> closed = closed_folders_above(path);
  if (closed.empty()) return;
  const fs::path& innermost = closed.back();  // the path goes on below it
  const fs::path exposed = innermost / *std::next(path.begin(), std::distance(innermost.begin(), innermost.end()));
  if (std::ranges::any_of(all, [&](const fs::path& p) { return is_within(exposed, p); })) return;
  std::erase_if(all, [&](const fs::path& p) { return is_within(p, exposed); });
  all.push_back(exposed);
}

/// A copy of the mount at the path, in no folder yet; -1 and errno.
int detached_mount(const fs::path& path) {
  return int(syscall(SYS_open_tree, AT_FDCWD, path.c_str(), OPEN_TREE_CLONE | OPEN_TREE_CLOEXEC | AT_RECURSIVE));
}

/// Makes a place of the same kind as `like`, and moves the mount there.
int attach(int mount_of_path, const fs::path& path, bool is_folder) {
  std::error_code error;
  fs::create_directories(is_folder ? path : path.parent_path(), error);
  if (error) return error.value();
  if (!is_folder && !std::ofstream(path)) return EIO;
  const long moved = syscall(SYS_move_mount, mount_of_path, "", AT_FDCWD, path.c_str(), MOVE_MOUNT_F_EMPTY_PATH);
  return moved == 0 ? 0 : errno;
}

int cover(const fs::path& folder) {
  constexpr unsigned long plain = 2 | 4;  // MS_NOSUID, MS_NODEV
  return mount("nearmiss", folder.c_str(), "tmpfs", plain, "mode=0755,size=1m") == 0 ? 0 : errno;
}

/// Makes all mounts of this process private. After a chroot its root is no mount, which could be made private, so a
/// private copy of all that is below becomes the root. The copy is mounted where no other process can see it: in a
/// folder that covers /proc, which is a mount. Returns 0 or an errno.
int make_mounts_private() {
  constexpr unsigned long recursive = 16384, is_private = 1ul << 18;  // MS_REC, MS_PRIVATE
  if (mount(nullptr, "/", nullptr, recursive | is_private, nullptr) == 0) return 0;
  if (errno != EINVAL) return errno;
  std::error_code error;
  const fs::path here = fs::current_path(error);
  if (error) return error.value();
  const int copy = detached_mount("/");
  mount_attr attributes{};
  attributes.propagation = is_private;
  if (copy < 0 ||
      syscall(SYS_mount_setattr, copy, "", AT_EMPTY_PATH | AT_RECURSIVE, &attributes, sizeof attributes) != 0)
    return errno;
  if (mount(nullptr, "/proc", nullptr, is_private, nullptr) != 0) return errno;
  if (const int why = cover("/proc"); why != 0) return why;
  if (const int why = attach(copy, "/proc/root", true); why != 0) return why;
  close(copy);
  return chroot("/proc/root") == 0 && chdir(here.c_str()) == 0 ? 0 : errno;
}

}  // namespace

std::vector<fs::path> hidden_paths(std::span<const std::string> names) {
  std::vector<fs::path> all;
  std::error_code none;
  const fs::path here = fs::current_path(none);
  if (!none && is_open(here)) add_hidden(here / ".", all);
  for (const std::string& name : names) {
    const fs::path path = fs::canonical(name, none);
    if (name.empty() || none) continue;
    add_hidden((here / name).lexically_normal(), all);
    add_hidden(path, all);
  }
  return all;
}

int expose(std::span<const fs::path> paths) {
  if (const int why = make_mounts_private(); why != 0) return why;
  std::vector<int> mounts;
  std::vector<bool> folders;
  std::vector<fs::path> closed;
  for (const fs::path& p : paths) {
    mounts.push_back(detached_mount(p));
    if (mounts.back() < 0) return errno;
    folders.push_back(fs::is_directory(p));
    closed.push_back(closed_folders_above(p).front());
  }
  umask(022);
  for (const fs::path& folder : closed) {
    if (is_open(folder)) continue;  // covered already
    if (const int why = cover(folder); why != 0) return why;
  }
  for (std::size_t i = 0; i < paths.size(); ++i) {
    if (const int why = attach(mounts[i], paths[i], folders[i]); why != 0) return why;
    close(mounts[i]);
  }
  return 0;
}

}  // namespace nearmiss
