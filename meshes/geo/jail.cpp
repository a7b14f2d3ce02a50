#include "meshes/geo/jail.hpp"

#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <fcntl.h>
#include <iterator>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/sched.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace diptych::meshes {

namespace {

// Landlock, as the kernel's headers have it from 5.13 on: those of a build machine may be older
// than the kernel that runs the program.
constexpr long create_ruleset = 444, add_rule = 445, restrict_self = 446;
struct RulesetAttributes {
  std::uint64_t handled_file_access;
};
struct __attribute__((packed)) BelowPath {
  std::uint64_t allowed_access;
  std::int32_t parent;
};
constexpr std::uint64_t write_file = 1u << 1, truncate = 1u << 14, refer = 1u << 13;
/// remove (dir, file), make (char, dir, reg, sock, fifo, block, sym)
constexpr std::uint64_t change_folders = 0x1ff0;

/// All that changes files, as far as the kernel knows it.
std::uint64_t changes(long version) {
  std::uint64_t all = write_file | change_folders;
  if (version >= 2) all |= refer;
  if (version >= 3) all |= truncate;
  return all;
}

void allow(int rules, const char* path, std::uint64_t access) {
  const int parent = open(path, O_PATH | O_CLOEXEC);
  if (parent < 0) return;
  const BelowPath rule{access, parent};
  syscall(add_rule, rules, 1, &rule, 0);  // without it the program cannot write and says so
  close(parent);
}

#if defined(__x86_64__)
constexpr std::uint32_t machine = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr std::uint32_t machine = AUDIT_ARCH_AARCH64;
#else
constexpr std::uint32_t machine = 0;  // no filter
#endif

constexpr sock_filter load(std::uint32_t offset) {
  return BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offset);
}
constexpr sock_filter otherwise_skip(std::uint32_t value, std::uint8_t n) {
  return BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, value, 0, n);
}
constexpr sock_filter skip(std::uint32_t n) {
  return BPF_STMT(BPF_JMP | BPF_JA, n);
}
constexpr sock_filter skip_where_set(std::uint32_t bits, std::uint8_t n) {
  return BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, bits, n, 0);
}
constexpr sock_filter result(std::uint32_t value) {
  return BPF_STMT(BPF_RET | BPF_K, value);
}
constexpr std::uint32_t number = offsetof(seccomp_data, nr);
constexpr std::uint32_t first_argument = offsetof(seccomp_data, args);
constexpr std::uint32_t refused = SECCOMP_RET_ERRNO | EPERM;

/// No new process and no socket. clone3, whose flags a filter cannot see, is said not to exist:
/// libraries then fall back on clone, which passes where it makes a thread.
constexpr sock_filter alone[] = {
    load(offsetof(seccomp_data, arch)),
    otherwise_skip(machine, 1),
    BPF_STMT(BPF_JMP | BPF_JA, 1),
    result(refused),
    load(number),
#if defined(__x86_64__)
    otherwise_skip(SYS_fork, 1),
    result(refused),
    otherwise_skip(SYS_vfork, 1),
    result(refused),
#endif
    otherwise_skip(SYS_socket, 1),
    result(refused),
    otherwise_skip(SYS_clone3, 1),
    result(SECCOMP_RET_ERRNO | ENOSYS),
    otherwise_skip(SYS_clone, 3),
    load(first_argument),
    BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, CLONE_THREAD, 1, 0),
    result(refused),
    result(SECCOMP_RET_ALLOW),
};

/// Never above what holds already.
void set_limit(__rlimit_resource resource, rlim_t most) noexcept {
  rlimit limit{};
  if (getrlimit(resource, &limit) != 0) return;
  if (limit.rlim_cur > most) limit.rlim_cur = most;
  if (limit.rlim_max > most) limit.rlim_max = most;
  setrlimit(resource, &limit);
}

}  // namespace

Jail::Jail(const std::string& folder, bool is_alone) : folder_(folder), is_alone_(is_alone) {
  const long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
  if (pages > 0 && page > 0) {
    most_memory_ = static_cast<unsigned long long>(pages) * static_cast<unsigned long long>(page);
  }
  constexpr int ask_version = 1;
  const long version = syscall(create_ruleset, nullptr, 0, ask_version);
  if (version < 1) return;
  const RulesetAttributes attributes{changes(version)};
  rules_ = static_cast<int>(syscall(create_ruleset, &attributes, sizeof attributes, 0));
  if (rules_ < 0) return;
  allow(rules_, folder_.c_str(), changes(version));
  const std::uint64_t of_a_file = changes(version) & (write_file | truncate);
  allow(rules_, "/dev/null", of_a_file);
}

Jail::~Jail() {
  if (rules_ >= 0) close(rules_);
}

int Jail::enter() const noexcept {
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // ends with this process, however that ends
  if (chdir(folder_.c_str()) != 0) return errno;
  set_limit(RLIMIT_CORE, 0);
  set_limit(RLIMIT_FSIZE, most_file_bytes);
  set_limit(RLIMIT_CPU, most_seconds);
  if (most_memory_ > 0) set_limit(RLIMIT_AS, most_memory_);
  if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) return 0;  // the kernel has neither
  if (rules_ >= 0) syscall(restrict_self, rules_, 0);
  if (is_alone_ && machine != 0) {
    const sock_fprog program{static_cast<unsigned short>(std::size(alone)),
                             const_cast<sock_filter*>(alone)};
    prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program);
  }
  return 0;
}

}  // namespace diptych::meshes
