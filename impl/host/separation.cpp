#include "impl/host/separation.hpp"

#include <fcntl.h>
#include <grp.h>
#include <linux/audit.h>
#include <linux/capability.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <linux/sockios.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/random.h>
#include <sys/resource.h>
#include <sys/sendfile.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <initializer_list>
#include <string>
#include <vector>

namespace nearmiss {

namespace {

// --- user ids
// ---------------------------------------------------------------------------------------------------------

struct IdRange {
  uid_t first, last;
};

/// Where no user of a system has an id: the range that systemd leaves unused (its UIDS-GIDS document), the range of its
/// dynamic users, which a container with 65,536 ids has as well, and "nobody".
constexpr std::array ranges_of_hosts{IdRange{0x70000000, 0x7ffffffe}, IdRange{61184, 65519}, IdRange{65534, 65534}};

/// Whether the user namespace of this process has all ids of the range.
bool is_mapped(IdRange range, const char* map) {
  std::ifstream file(map);
  for (std::uint64_t inside = 0, outside = 0, count = 0; file >> inside >> outside >> count;) {
    if (inside <= range.first && range.last < inside + count) return true;
  }
  return false;
}

bool has_capabilities(std::initializer_list<unsigned> wanted) {
  __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
  std::array<__user_cap_data_struct, 2> own{};
  if (syscall(SYS_capget, &header, own.data()) != 0) return false;
  return std::ranges::all_of(wanted, [&](unsigned c) { return (own[c / 32].effective >> (c % 32) & 1) != 0; });
}

/// Whether this process may leave its supplementary groups.
bool may_leave_groups() {
  std::ifstream file("/proc/self/setgroups");
  std::string word;
  return !(file >> word) || word == "allow" || getgroups(0, nullptr) == 0;
}

std::optional<IdRange> range_of_hosts() {
  if (geteuid() != 0 || !has_capabilities({CAP_SETUID, CAP_SETGID, CAP_KILL}) || !may_leave_groups()) return {};
  const auto found = std::ranges::find_if(ranges_of_hosts, [](IdRange r) {
    return is_mapped(r, "/proc/self/uid_map") && is_mapped(r, "/proc/self/gid_map");
  });
  return found == ranges_of_hosts.end() ? std::nullopt : std::optional(*found);
}

uid_t some_number() {
  uid_t number = 0;
  return getrandom(&number, sizeof number, GRND_NONBLOCK) == ssize_t(sizeof number) ? number : uid_t(getpid());
}

// --- filters
// ----------------------------------------------------------------------------------------------------------

static_assert(std::endian::native == std::endian::little, "the filter reads the lower half of an argument first");

#if defined(__x86_64__)
constexpr std::uint32_t architecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr std::uint32_t architecture = AUDIT_ARCH_AARCH64;
#else
constexpr std::uint32_t architecture = 0;  // no filter
#endif

constexpr std::uint32_t allowed = SECCOMP_RET_ALLOW;
constexpr std::uint32_t forbidden = SECCOMP_RET_ERRNO | EPERM;
constexpr std::uint32_t unknown = SECCOMP_RET_ERRNO | ENOSYS;  // a library then takes another call

/// A seccomp filter: system calls that fail where an argument has one of some values. The values are of 32 bits, as
/// the ids of processes are.
class CallFilter {
 public:
  using Values = std::vector<std::uint32_t>;
  struct Check {
    unsigned argument;
    Values values;
  };

  CallFilter() {
    load(offsetof(seccomp_data, arch));
    unless_equal(architecture, 1);
    give(unknown);
    load(offsetof(seccomp_data, nr));
#if defined(__x86_64__)
    constexpr std::uint32_t x32 = 0x40000000;  // the other numbers of the same calls
    program_.push_back(BPF_JUMP(BPF_JMP | BPF_JGE | BPF_K, x32, 0, 1));
    give(unknown);
#endif
  }
  void refuse(long call, std::initializer_list<Check> checks) {
    std::vector<sock_filter> body;
    body.swap(program_);
    for (const Check& c : checks) refuse_values(c);
    give(allowed);
    body.swap(program_);
    program_.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, std::uint32_t(call), 0, std::uint8_t(body.size())));
    program_.insert(program_.end(), body.begin(), body.end());
  }
  void hide(long call) {
    program_.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, std::uint32_t(call), 0, 1));
    give(unknown);
  }
  void install() {
    give(allowed);
    const sock_fprog all{std::uint16_t(program_.size()), program_.data()};
    syscall(SYS_seccomp, SECCOMP_SET_MODE_FILTER, 0, &all);
  }

 private:
  void load(std::size_t at) { program_.push_back(BPF_STMT(BPF_LD | BPF_W | BPF_ABS, std::uint32_t(at))); }
  void give(std::uint32_t result) { program_.push_back(BPF_STMT(BPF_RET | BPF_K, result)); }
  /// Leaves out the next `count` instructions where the loaded number is `value`.
  void unless_equal(std::uint32_t value, std::uint8_t count) {
    program_.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, value, count, 0));
  }
  void refuse_values(const Check& check) {
    load(offsetof(seccomp_data, args) + sizeof(std::uint64_t) * check.argument);
    for (const std::uint32_t v : check.values) {
      program_.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, v, 0, 1));
      give(forbidden);
    }
  }

  std::vector<sock_filter> program_;
};

/// The numbers by which a call names one of the processes, alone or as a group.
CallFilter::Values names_of(std::span<const pid_t> processes) {
  CallFilter::Values names;
  for (const pid_t p : processes) {
    if (p != 0) names.insert(names.end(), {std::uint32_t(p), std::uint32_t(-p)});  // 0: in no namespace of this process
  }
  return names;
}

void filter_calls(std::span<const pid_t> processes) {
  if (architecture == 0) return;
  const CallFilter::Values names = names_of(processes);
  CallFilter::Values names_and_all = names;
  names_and_all.push_back(std::uint32_t(-1));
  constexpr std::uint32_t of_a_user_for_io = 3;  // IOPRIO_WHO_USER
  CallFilter filter;
  filter.refuse(SYS_kill, {{0, names_and_all}});
  for (const long call : {SYS_tkill, SYS_tgkill, SYS_rt_sigqueueinfo, SYS_rt_tgsigqueueinfo, SYS_prlimit64,
                          SYS_sched_setaffinity, SYS_sched_setparam, SYS_sched_setscheduler, SYS_sched_setattr}) {
    filter.refuse(call, {{0, names}});
  }
  filter.refuse(SYS_setpriority, {{0, {PRIO_USER}}, {1, names}});
  filter.refuse(SYS_ioprio_set, {{0, {of_a_user_for_io}}, {1, names}});
  filter.refuse(SYS_fcntl, {{1, {F_SETOWN, F_SETOWN_EX}}});  // who gets the signals of a file
  filter.refuse(SYS_ioctl, {{1, {FIOSETOWN, SIOCSPGRP}}});
  filter.hide(SYS_pidfd_send_signal);  // any folder in /proc names a process there
  filter.install();
}

/// Landlock's ruleset since its sixth version; the header of Linux 6.1 has its first member alone.
struct LandlockScopes {
  std::uint64_t files, network, scoped;
};

/// Without rules for files and networks, only the scope of signals and of tracing is restricted.
void enter_landlock_domain() {
  constexpr long first_with_scopes = 6;
  constexpr unsigned ask_version = 1;
  constexpr std::uint64_t scope_of_signals = 2;
  if (syscall(SYS_landlock_create_ruleset, nullptr, 0, ask_version) < first_with_scopes) return;
  const LandlockScopes scopes{0, 0, scope_of_signals};
  const int ruleset = int(syscall(SYS_landlock_create_ruleset, &scopes, sizeof scopes, 0));
  if (ruleset < 0) return;
  syscall(SYS_landlock_restrict_self, ruleset, 0);
  close(ruleset);
}

// --- files
// ------------------------------------------------------------------------------------------------------------

/// A copy of the file in memory that every user can read and execute; -1 and errno where there is no room.
int copy_in_memory(int original, off_t size) {
  const int copy = memfd_create("nearmiss-copy", MFD_CLOEXEC);
  for (off_t at = 0; copy >= 0 && at < size;) {
    if (sendfile(copy, original, &at, std::size_t(size - at)) <= 0) {
      close(copy);
      return -1;
    }
  }
  return copy;
}

}  // namespace

std::optional<uid_t> user_for_a_host() {
  static const std::optional<IdRange> range = range_of_hosts();
  static uid_t next = some_number();
  if (!range || geteuid() != 0) return std::nullopt;
  return range->first + next++ % (range->last - range->first + 1);
}

int become_unprivileged(std::optional<uid_t> user) {
  for (unsigned long c = 0; prctl(PR_CAPBSET_DROP, c, 0, 0, 0) == 0; ++c) {
  }
  if (user) {
    if (getgroups(0, nullptr) > 0 && setgroups(0, nullptr) != 0) return errno;
    if (setresgid(*user, *user, *user) != 0 || setresuid(*user, *user, *user) != 0) return errno;
  }
  prctl(PR_CAP_AMBIENT, PR_CAP_AMBIENT_CLEAR_ALL, 0, 0, 0);
  __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
  const std::array<__user_cap_data_struct, 2> none{};
  return syscall(SYS_capset, &header, none.data()) == 0 && prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 ? 0 : errno;
}

int open_for_other_users(const char* file) {
  const int original = open(file, O_RDONLY | O_CLOEXEC);
  struct stat about {};
  constexpr mode_t read_and_execute = S_IROTH | S_IXOTH;
  if (original < 0 || fstat(original, &about) != 0) return original;
  if ((about.st_mode & read_and_execute) == read_and_execute || !S_ISREG(about.st_mode)) return original;
  const int copy = copy_in_memory(original, about.st_size);
  close(original);
  return copy;
}

void shield(std::span<const pid_t> processes) {
  enter_landlock_domain();
  filter_calls(processes);
}

}  // namespace nearmiss
