/// Loaded before a program (LD_PRELOAD): makes its n-th call that puts bytes or names on the disk
/// fail. Counted are open for writing, write, pwrite, fsync, rename, ftruncate, close of what was
/// opened for writing, unlink and mkdir, of files other than the standard streams.
///   DIPTYCH_FAIL_AT=N      the N-th call, from 1; 0: none
///   DIPTYCH_FAIL_AS=ERRNO  with that errno; "short": a write takes half of its bytes and the next
///                          one fails with ENOSPC; "kill": the process is killed instead
///   DIPTYCH_FAIL_FROM=1    and every later one too, as on a disk that stays full
///   DIPTYCH_FAIL_COUNT=F   the number of calls is written to the file F at the end
/// Linked into a test it fails the calls that the test asks for (failing_calls.hpp).

#include "tests/command_line/failing_calls.hpp"

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

namespace {

std::atomic<long> n_calls{0};
std::atomic<bool> is_short{false};  // a write has taken half
bool is_written[4096] = {};         // descriptors that were opened for writing

long number_of(const char* name) {
  const char* text = std::getenv(name);
  return text != nullptr ? std::atol(text) : 0;
}

enum class Fate { good, fail, half };

/// What is asked.
struct Asked {
  long at = number_of("DIPTYCH_FAIL_AT");
  bool goes_on = number_of("DIPTYCH_FAIL_FROM") != 0;
  const char* as = std::getenv("DIPTYCH_FAIL_AS");
};
Asked& asked() {
  static Asked of_environment;
  return of_environment;
}

/// Of the next call.
Fate next_call(bool is_write) {
  const auto& [at, goes_on, as] = asked();
  const long call = ++n_calls;
  if (is_short.exchange(false)) {
    errno = ENOSPC;
    return Fate::fail;
  }
  if (at == 0 || !(call == at || (goes_on && call > at))) return Fate::good;
  if (as != nullptr && std::strcmp(as, "kill") == 0) ::kill(::getpid(), SIGKILL);
  if (as != nullptr && std::strcmp(as, "short") == 0) {
    if (!is_write) return Fate::good;
    is_short = true;
    return Fate::half;
  }
  errno = as != nullptr ? std::atoi(as) : EIO;
  return Fate::fail;
}

template <class Function>
Function real(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

bool is_watched(int descriptor) {
  return descriptor > 2 && descriptor < 4096 && is_written[descriptor];
}

int opened(int descriptor, int flags) {
  if (descriptor > 2 && descriptor < 4096) is_written[descriptor] = (flags & O_ACCMODE) != O_RDONLY;
  return descriptor;
}

__attribute__((destructor)) void tell() {
  const char* path = std::getenv("DIPTYCH_FAIL_COUNT");
  if (path == nullptr) return;
  if (FILE* file = std::fopen(path, "w")) {
    std::fprintf(file, "%ld\n", n_calls.load());
    std::fclose(file);
  }
}

bool makes_files(int flags) {
  return (flags & O_ACCMODE) != O_RDONLY;
}

}  // namespace

namespace diptych::tests {

void fail_call(long at, const char* as) {
  asked() = {at, false, as};
  n_calls = 0;
  is_short = false;
}
long n_calls_made() {
  return n_calls;
}

}  // namespace diptych::tests

extern "C" {

int open(const char* path, int flags, ...) {
  mode_t mode = 0;
  if (flags & O_CREAT) {
    va_list arguments;
    va_start(arguments, flags);
    mode = va_arg(arguments, mode_t);
    va_end(arguments);
  }
  static const auto next = real<int (*)(const char*, int, ...)>("open");
  const bool is_device = std::strncmp(path, "/dev/", 5) == 0;
  if (makes_files(flags) && !is_device && next_call(false) == Fate::fail) return -1;
  return opened(next(path, flags, mode), is_device ? O_RDONLY : flags);
}

int open64(const char* path, int flags, ...) {
  mode_t mode = 0;
  if (flags & O_CREAT) {
    va_list arguments;
    va_start(arguments, flags);
    mode = va_arg(arguments, mode_t);
    va_end(arguments);
  }
  return open(path, flags, mode);
}

ssize_t write(int descriptor, const void* bytes, size_t n) {
  static const auto next = real<ssize_t (*)(int, const void*, size_t)>("write");
  if (!is_watched(descriptor)) return next(descriptor, bytes, n);
  const Fate fate = next_call(true);
  if (fate == Fate::fail) return -1;
  return next(descriptor, bytes, fate == Fate::half ? (n + 1) / 2 : n);
}

ssize_t pwrite(int descriptor, const void* bytes, size_t n, off_t offset) {
  static const auto next = real<ssize_t (*)(int, const void*, size_t, off_t)>("pwrite");
  if (!is_watched(descriptor)) return next(descriptor, bytes, n, offset);
  const Fate fate = next_call(true);
  if (fate == Fate::fail) return -1;
  return next(descriptor, bytes, fate == Fate::half ? (n + 1) / 2 : n, offset);
}

ssize_t pwrite64(int descriptor, const void* bytes, size_t n, off64_t offset) {
  return pwrite(descriptor, bytes, n, offset);
}

int fsync(int descriptor) {
  static const auto next = real<int (*)(int)>("fsync");
  return next_call(false) == Fate::fail ? -1 : next(descriptor);
}

int ftruncate(int descriptor, off_t size) {
  static const auto next = real<int (*)(int, off_t)>("ftruncate");
  return next_call(false) == Fate::fail ? -1 : next(descriptor, size);
}

int ftruncate64(int descriptor, off64_t size) {
  return ftruncate(descriptor, size);
}

int close(int descriptor) {
  static const auto next = real<int (*)(int)>("close");
  if (!is_watched(descriptor)) return next(descriptor);
  is_written[descriptor] = false;
  const Fate fate = next_call(false);
  const int error = errno, result = next(descriptor);
  if (fate != Fate::fail) return result;
  errno = error;
  return -1;
}

int rename(const char* from, const char* to) {
  static const auto next = real<int (*)(const char*, const char*)>("rename");
  return next_call(false) == Fate::fail ? -1 : next(from, to);
}

int unlink(const char* path) {
  static const auto next = real<int (*)(const char*)>("unlink");
  // of a temporary file that is mostly not there: nothing on the disk would change
  struct stat found {};
  if (::stat(path, &found) != 0) return next(path);
  return next_call(false) == Fate::fail ? -1 : next(path);
}

int mkdir(const char* path, mode_t mode) {
  static const auto next = real<int (*)(const char*, mode_t)>("mkdir");
  return next_call(false) == Fate::fail ? -1 : next(path, mode);
}

}  // extern "C"
