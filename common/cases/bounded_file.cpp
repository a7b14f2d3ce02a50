#include "common/cases/bounded_file.hpp"

#include "common/base/error.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fmt/format.h>
#include <memory>
#include <sys/stat.h>

namespace diptych::cases {

std::string bounded_file(const std::string& path, size_t most_bytes, const std::string& what) {
  const auto cannot = [&] {
    return base::EnvironmentError(fmt::format("cannot read {}: {}", path, std::strerror(errno)));
  };
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) throw cannot();
  if (!S_ISREG(status.st_mode)) {
    throw base::InputError(
        fmt::format("{}: not a regular file; give {} that has an end", path, what));
  }
  const std::unique_ptr<FILE, int (*)(FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) throw cannot();
  // One byte more than allowed: a file may grow, and those of /proc tell no size.
  std::string bytes;
  char block[65536];
  while (const size_t n = std::fread(block, 1, sizeof block, file.get())) {
    bytes.append(block, n);
    if (bytes.size() > most_bytes) {
      throw base::InputError(
          fmt::format("{}: more than {} bytes; {} has at most so many", path, most_bytes, what));
    }
  }
  if (std::ferror(file.get()) != 0) throw cannot();
  return bytes;
}

}  // namespace diptych::cases
