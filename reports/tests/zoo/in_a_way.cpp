/// Starts a program in one of the ways in which Nearmiss is used: in_a_way FOLDER WAY PROGRAM [ARGUMENT ...]
///
///   chroot          as the superuser whose root folder is no mount, as after a chroot
///   user            as an ordinary user
///   container       as an ordinary user to whom the system refuses namespaces, as containers do by default
///   container-root  as the superuser of such a container, with the capabilities that it has by default
///
/// FOLDER becomes the current folder and, as the program's and its arguments' folders, can be reached. Exit status 77:
/// this system cannot do it; one line says why.
#include <grp.h>
#include <linux/capability.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "impl/host/exposure.hpp"

namespace {

[[noreturn]] void impossible(const char* what) {
  std::fprintf(stderr, "%s: %s\n", what, std::strerror(errno));
  std::exit(77);
}

/// Refuses new namespaces and mounts.
void refuse_namespaces() {
  constexpr std::uint32_t new_namespaces =
      CLONE_NEWNS | CLONE_NEWCGROUP | CLONE_NEWUTS | CLONE_NEWIPC | CLONE_NEWUSER | CLONE_NEWPID | CLONE_NEWNET;
  constexpr auto load = [](std::size_t at) {
    return sock_filter BPF_STMT(BPF_LD | BPF_W | BPF_ABS, std::uint32_t(at));
  };
  constexpr auto unless = [](long call, std::uint8_t skip) {
    return sock_filter BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, std::uint32_t(call), 0, skip);
  };
  constexpr auto fail = [](std::uint32_t why) {
    return sock_filter BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | why);
  };
  std::array filter{load(offsetof(seccomp_data, nr)),
                    unless(SYS_clone3, 1),
                    fail(ENOSYS),
                    unless(SYS_unshare, 1),
                    fail(EPERM),
                    unless(SYS_setns, 1),
                    fail(EPERM),
                    unless(SYS_mount, 1),
                    fail(EPERM),
                    unless(SYS_clone, 3),
                    load(offsetof(seccomp_data, args)),
                    sock_filter BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, new_namespaces, 0, 1),
                    fail(EPERM),
                    sock_filter BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW)};
  const sock_fprog all{std::uint16_t(filter.size()), filter.data()};
  if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0 || syscall(SYS_seccomp, SECCOMP_SET_MODE_FILTER, 0, &all) != 0)
    impossible("a filter of system calls");
}

void become_ordinary() {
  constexpr uid_t user = 61001;  // of nobody
  if (geteuid() != 0) return;
  if (setgroups(0, nullptr) != 0 || setresgid(user, user, user) != 0 || setresuid(user, user, user) != 0)
    impossible("another user");
}

void keep_capabilities_of_a_container() {
  constexpr std::array kept{CAP_CHOWN,  CAP_DAC_OVERRIDE, CAP_FOWNER,     CAP_FSETID,     CAP_KILL,
                            CAP_SETGID, CAP_SETUID,       CAP_SETPCAP,    CAP_SETFCAP,    CAP_NET_BIND_SERVICE,
                            CAP_MKNOD,  CAP_NET_RAW,      CAP_SYS_CHROOT, CAP_AUDIT_WRITE};
  for (int c = 0; prctl(PR_CAPBSET_READ, c, 0, 0, 0) >= 0; ++c) {
    if (std::ranges::find(kept, c) == kept.end() && prctl(PR_CAPBSET_DROP, c, 0, 0, 0) != 0)
      impossible("fewer capabilities");
  }
}

/// Makes the folders reachable for other users, in a mount namespace of this program.
void show(const std::vector<std::string>& names) {
  const auto hidden = nearmiss::hidden_paths(names);
  if (hidden.empty() || geteuid() != 0) return;
  if (unshare(CLONE_NEWNS) != 0) impossible("a mount namespace");
  if (errno = nearmiss::expose(hidden); errno != 0) impossible("mounts");
}

/// Changes the root to a folder, in a mount namespace of this program, in which everything is mounted that is in the
/// root.
void change_root() {
  namespace fs = std::filesystem;
  if (unshare(CLONE_NEWNS) != 0 || mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
      mount("nearmiss", "/mnt", "tmpfs", 0, "mode=0755,size=1m") != 0)
    impossible("a mount namespace");
  const fs::path root = "/mnt/root";
  fs::create_directory(root);
  for (const fs::directory_entry& e : fs::directory_iterator("/")) {
    const fs::path inside = root / e.path().filename();
    if (e.is_symlink()) {
      fs::copy_symlink(e.path(), inside);
    } else if (e.is_directory()) {
      fs::create_directory(inside);
      if (mount(e.path().c_str(), inside.c_str(), nullptr, MS_BIND | MS_REC, nullptr) != 0) impossible("a mount");
    }
  }
  if (chroot(root.c_str()) != 0) impossible("another root");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4 || chdir(argv[1]) != 0) return 2;
  const std::string_view way = argv[2];
  if (way == "chroot") {
    if (geteuid() != 0) impossible("this program does not run as the superuser");
    change_root();
    if (chdir(argv[1]) != 0) impossible(argv[1]);
  } else if (way == "container-root") {
    if (geteuid() != 0) impossible("this program does not run as the superuser");
    keep_capabilities_of_a_container();
  } else {
    show({argv + 3, argv + argc});
    if (chdir(argv[1]) != 0) impossible(argv[1]);
    become_ordinary();
  }
  if (way != "user" && way != "chroot") refuse_namespaces();
  execvp(argv[3], argv + 3);
  impossible(argv[3]);
}
