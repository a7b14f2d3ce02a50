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
#include <utility>

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

/// All of the bytes. Where they are not there errno is 0.
bool read_at(int descriptor, std::int64_t begin, std::span<char> bytes) noexcept {
  errno = 0;
  while (!bytes.empty()) {
    const ssize_t n = ::pread(descriptor, bytes.data(), bytes.size(), begin);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    bytes = bytes.subspan(static_cast<size_t>(n));
    begin += n;
  }
  return true;
}

[[noreturn]] void fail_to_read(const std::string& path, int error) {
  throw EnvironmentError(fmt::format("cannot read '{}': {}", path,
                                     error == 0 ? "it has become shorter" : reason(error)));
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

/// Of a folder that cannot be made: the link on its way that leads nowhere, which the system calls
/// a file that exists; empty where there is none.
std::string dead_link(const std::filesystem::path& directory) {
  std::filesystem::path at;
  std::error_code ignored;
  for (const std::filesystem::path& part : directory) {
    at /= part;
    if (!std::filesystem::is_symlink(at, ignored) ||
        std::filesystem::status(at, ignored).type() != std::filesystem::file_type::not_found)
      continue;
    return fmt::format("'{}' is a link to '{}', which is not there", at.string(),
                       std::filesystem::read_symlink(at, ignored).string());
  }
  return "";
}

}  // namespace

void make_directory(const std::string& directory) {
  std::error_code failure;
  std::filesystem::create_directories(directory, failure);
  if (!failure && !std::filesystem::is_directory(directory, failure)) {
    failure = std::make_error_code(std::errc::not_a_directory);
  }
  if (failure) {
    const std::string link = dead_link(directory);
    throw EnvironmentError(fmt::format("cannot make the folder '{}': {}", directory,
                                       link.empty() ? reason(failure.value()) : link));
  }
}

UnfinishedFile::UnfinishedFile(std::string path) : path_(std::move(path)) {
  const std::string unfinished = unfinished_name(path_);
  // A leftover of a killed run is replaced; O_EXCL then refuses a link planted in its place.
  if (::unlink(unfinished.c_str()) != 0 && errno != ENOENT) give_up(path_, "write", errno);
  descriptor_ =
      ::open(unfinished.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0644);
  if (descriptor_ < 0) give_up(path_, "write", errno);
}

UnfinishedFile::~UnfinishedFile() {
  if (descriptor_ < 0) return;
  ::close(descriptor_);
  ::unlink(unfinished_name(path_).c_str());
}

bool UnfinishedFile::put(std::int64_t begin, std::string_view bytes) noexcept {
  const auto n_bytes = static_cast<std::int64_t>(bytes.size());
  while (error_ == 0 && !bytes.empty()) {
    const ssize_t n = ::pwrite(descriptor_, bytes.data(), bytes.size(), begin);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) {
      error_ = errno;
      wanted_ = n_bytes;
      break;
    }
    bytes.remove_prefix(static_cast<size_t>(n));
    begin += n;
  }
  return error_ == 0;
}

bool UnfinishedFile::get(std::int64_t begin, std::span<char> bytes) const noexcept {
  return read_at(descriptor_, begin, bytes);
}

void UnfinishedFile::take(std::int64_t begin, std::span<char> bytes) const {
  if (!get(begin, bytes)) fail_to_read(path_, errno);
}

void UnfinishedFile::require_written() const {
  if (error_ != 0) give_up(path_, fmt::format("write {} bytes to", wanted_), error_);
}

void UnfinishedFile::cut(std::int64_t size) {
  require_written();
  if (::ftruncate(descriptor_, size) != 0) give_up(path_, "write", errno);
}

void UnfinishedFile::append(std::string_view bytes) {
  struct stat found {};
  if (::fstat(descriptor_, &found) != 0) give_up(path_, "write", errno);
  put(found.st_size, bytes);
  require_written();
}

void UnfinishedFile::publish() {
  require_written();
  if (::fsync(descriptor_) != 0) give_up(path_, "sync", errno);
  if (::close(std::exchange(descriptor_, -1)) != 0) give_up(path_, "close", errno);
  if (::rename(unfinished_name(path_).c_str(), path_.c_str()) != 0) give_up(path_, "write", errno);
  sync_folder(path_);
}

void write_file_atomically(const std::string& path, const std::string& text) {
  UnfinishedFile file(path);
  file.append(text);
  file.publish();
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

ReadableFile::ReadableFile(std::string path)
    : path_(std::move(path)), descriptor_(::open(path_.c_str(), O_RDONLY | O_CLOEXEC)) {
  if (descriptor_ < 0) fail_to_read(path_, errno);
  struct stat found {};
  if (::fstat(descriptor_, &found) == 0) {
    size_ = found.st_size;
    return;
  }
  const int error = errno;
  ::close(descriptor_);
  fail_to_read(path_, error);
}

ReadableFile::~ReadableFile() {
  ::close(descriptor_);
}

bool ReadableFile::get(std::int64_t begin, std::span<char> bytes) const noexcept {
  return read_at(descriptor_, begin, bytes);
}

void ReadableFile::take(std::int64_t begin, std::span<char> bytes) const {
  if (!get(begin, bytes)) fail_to_read(path_, errno);
}

std::string read_file(const std::string& path) {
  Descriptor descriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (descriptor.get() < 0) fail_to_read(path, errno);
  std::string text;
  char block[1 << 16];
  for (;;) {
    const ssize_t n = ::read(descriptor.get(), block, sizeof block);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail_to_read(path, errno);
    if (n == 0) return text;
    text.append(block, static_cast<size_t>(n));
  }
}

}  // namespace diptych::io
