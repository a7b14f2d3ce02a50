#include "common/io/row_file.hpp"

#include "common/base/error.hpp"

#include <cerrno>
#include <fcntl.h>
#include <fmt/format.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace diptych::io {

RowFile::RowFile(std::string path, const std::string& header) : path_(std::move(path)) {
  // O_EXCL refuses a link planted in the place of what is removed
  if (::unlink(path_.c_str()) != 0 && errno != ENOENT) fail("replace", errno);
  descriptor_ =
      ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_APPEND | O_CLOEXEC | O_NOFOLLOW, 0644);
  if (descriptor_ < 0) fail("write", errno);
  append(header);
  flush();
}

RowFile::~RowFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void RowFile::flush() {
  std::string_view text = waiting_;
  while (!text.empty()) {
    const ssize_t n = ::write(descriptor_, text.data(), text.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail("write", errno);
    text.remove_prefix(static_cast<size_t>(n));
  }
  waiting_.clear();
}

void RowFile::finish() {
  flush();
  if (::fsync(descriptor_) != 0) fail("sync", errno);
  const int descriptor = std::exchange(descriptor_, -1);
  if (::close(descriptor) != 0) fail("close", errno);
}

void RowFile::fail(const char* what, int error) const {
  const bool is_full = error == ENOSPC || error == EDQUOT || error == EFBIG;
  throw base::EnvironmentError(fmt::format("cannot {} '{}': {} (errno {}){}", what, path_,
                                           std::generic_category().message(error), error,
                                           is_full ? "; free space or choose another folder" : ""));
}

}  // namespace diptych::io
