#include "common/io/folder_lock.hpp"

#include "common/base/error.hpp"

#include <cerrno>
#include <chrono>
#include <fcntl.h>
#include <filesystem>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace diptych::io {

namespace {

std::string path_in(const std::string& directory) {
  return (std::filesystem::path(directory) / lock_file).string();
}

[[noreturn]] void fail(const std::string& path, int error) {
  throw base::EnvironmentError(fmt::format("cannot lock '{}': {} (errno {})", path,
                                           std::generic_category().message(error), error));
}

/// What the holder wrote; it may be just about to.
std::string holder_in(int descriptor) {
  char text[512];
  const ssize_t n = ::pread(descriptor, text, sizeof text, 0);
  std::string holder(text, static_cast<size_t>(n > 0 ? n : 0));
  while (!holder.empty() && holder.back() == '\n')
    holder.pop_back();
  return holder.empty() ? "another process" : holder;
}

/// Whether the file that was opened still stands at its path: the one who had it before removes it.
bool is_at(const std::string& path, int descriptor) {
  struct stat opened {
  }, standing{};
  return ::fstat(descriptor, &opened) == 0 && ::stat(path.c_str(), &standing) == 0 &&
         opened.st_ino == standing.st_ino && opened.st_dev == standing.st_dev;
}

/// This process. @return not empty
std::string this_process() {
  char host[256] = "unknown";
  ::gethostname(host, sizeof host - 1);
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  return fmt::format("process {} on {} since {:%Y-%m-%d %H:%M:%S} UTC", ::getpid(), host,
                     fmt::gmtime(now));
}

}  // namespace

FolderLock::FolderLock(const std::string& directory) : path_(path_in(directory)) {
  for (;;) {
    descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0644);
    if (descriptor_ < 0) fail(path_, errno);
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
      const int error = errno;
      const std::string holder = holder_in(descriptor_);
      ::close(descriptor_);
      if (error != EWOULDBLOCK) fail(path_, error);
      throw base::InputError(fmt::format(
          "{}: {} writes there; wait for its end, or give another --out", directory, holder));
    }
    if (is_at(path_, descriptor_)) break;
    ::close(descriptor_);
  }
  const std::string text = this_process() + "\n";
  const auto size = static_cast<ssize_t>(text.size());
  errno = ENOSPC;  // of a write that takes only a part
  if (::ftruncate(descriptor_, 0) == 0 &&
      ::pwrite(descriptor_, text.data(), text.size(), 0) == size)
    return;
  const int error = errno;  // nobody could be told who it is
  ::unlink(path_.c_str());
  ::close(descriptor_);
  fail(path_, error);
}

FolderLock::~FolderLock() {
  ::unlink(path_.c_str());
  ::close(descriptor_);
}

std::optional<std::string> lock_holder(const std::string& directory) {
  const int descriptor = ::open(path_in(directory).c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW);
  if (descriptor < 0) return std::nullopt;
  const bool is_free = ::flock(descriptor, LOCK_SH | LOCK_NB) == 0;
  std::optional<std::string> holder;
  if (!is_free) holder = holder_in(descriptor);
  ::close(descriptor);
  return holder;
}

}  // namespace diptych::io
