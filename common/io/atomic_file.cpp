#include "common/io/atomic_file.hpp"

#include "common/base/error.hpp"
#include "common/io/run_record.hpp"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <string_view>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace diptych::io {
namespace {

using base::EnvironmentError;

/// The name under which `path` is written before it is renamed.
std::string unfinished_name(const std::string& path) {
  return path + ".tmp";
}

std::string reason(int error) {
  return fmt::format("{} (errno {})", std::generic_category().message(error), error);
}

std::string advice(int error) {
  switch (error) {
    case ENOSPC:
    case EDQUOT:
    case EFBIG:
      return "; free space or choose another folder";
    case EACCES:
    case EPERM:
    case EROFS:
      return "; choose a folder that you may write to";
    case ENOENT:
    case ENOTDIR:
      return "; check that the folder exists";
    default:
      return "";
  }
}

/// A file descriptor that closes itself; close() reports what closing found.
class Descriptor {
 public:
  explicit Descriptor(int descriptor) : descriptor_(descriptor) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  int get() const { return descriptor_; }
  bool close() {
    const int descriptor = descriptor_;
    descriptor_ = -1;
    return ::close(descriptor) == 0;
  }

 private:
  int descriptor_;
};

/// Removes what was begun and reports why; `error` is taken first, since unlink changes errno.
[[noreturn]] void give_up(const std::string& path, const std::string& what, int error) {
  ::unlink(unfinished_name(path).c_str());
  throw EnvironmentError(
      fmt::format("cannot {} '{}': {}{}", what, path, reason(error), advice(error)));
}

void write_all(int descriptor, std::string_view text, const std::string& path) {
  const std::string what = fmt::format("write {} bytes to", text.size());
  while (!text.empty()) {
    const ssize_t n = ::write(descriptor, text.data(), text.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) give_up(path, what, errno);
    text.remove_prefix(static_cast<size_t>(n));
  }
}

/// The rename itself is durable only once the folder is on disk. File systems that cannot sync a
/// folder say EINVAL; there is nothing more to be done there.
void sync_folder(const std::string& path) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  Descriptor descriptor(::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY));
  if (descriptor.get() < 0 || (::fsync(descriptor.get()) != 0 && errno != EINVAL)) {
    const int error = errno;
    throw EnvironmentError(
        fmt::format("cannot sync the folder of '{}': {}{}", path, reason(error), advice(error)));
  }
}

}  // namespace

void make_directory(const std::string& directory) {
  std::error_code failure;
  std::filesystem::create_directories(directory, failure);
  if (!failure && !std::filesystem::is_directory(directory, failure)) {
    failure = std::make_error_code(std::errc::not_a_directory);
  }
  if (failure) {
    throw EnvironmentError(
        fmt::format("cannot make the folder '{}': {}", directory, reason(failure.value())));
  }
}

void write_file_atomically(const std::string& path, const std::string& text) {
  const std::string unfinished = unfinished_name(path);
  // A leftover of a killed run is replaced; O_EXCL then refuses a link planted in its place.
  if (::unlink(unfinished.c_str()) != 0 && errno != ENOENT) give_up(path, "write", errno);
  Descriptor descriptor(
      ::open(unfinished.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0644));
  if (descriptor.get() < 0) give_up(path, "write", errno);
  write_all(descriptor.get(), text, path);
  if (::fsync(descriptor.get()) != 0) give_up(path, "sync", errno);
  if (!descriptor.close()) give_up(path, "close", errno);
  if (::rename(unfinished.c_str(), path.c_str()) != 0) give_up(path, "write", errno);
  sync_folder(path);
}

bool write_over(const std::string& path, const std::string& text) {
  Descriptor descriptor(::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NOFOLLOW));
  if (descriptor.get() < 0) return false;
  size_t written = 0;
  while (written < text.size()) {
    const ssize_t n = ::pwrite(descriptor.get(), text.data() + written, text.size() - written,
                               static_cast<off_t>(written));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    written += static_cast<size_t>(n);
  }
  return ::ftruncate(descriptor.get(), static_cast<off_t>(text.size())) == 0 &&
         ::fsync(descriptor.get()) == 0 && descriptor.close();
}

std::string read_file(const std::string& path) {
  Descriptor descriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  const auto fail = [&path](int error) {
    throw EnvironmentError(fmt::format("cannot read '{}': {}", path, reason(error)));
  };
  if (descriptor.get() < 0) fail(errno);
  std::string text;
  char block[1 << 16];
  for (;;) {
    const ssize_t n = ::read(descriptor.get(), block, sizeof block);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail(errno);
    if (n == 0) return text;
    text.append(block, static_cast<size_t>(n));
  }
}

}  // namespace diptych::io
