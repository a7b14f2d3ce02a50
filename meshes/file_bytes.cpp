#include "common/base/error.hpp"
#include "meshes/msh_source.hpp"

#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <memory>
#include <sys/stat.h>

namespace diptych::meshes::msh {

std::string file_bytes(const std::string& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) {
    const std::string message =
        fmt::format("{}: the mesh file cannot be opened: {}", path, std::strerror(errno));
    if (errno == ENOENT || errno == ENOTDIR || errno == ENAMETOOLONG) {
      throw base::InputError(message);
    }
    throw base::EnvironmentError(message);
  }
  if (!S_ISREG(status.st_mode)) {
    throw base::InputError(fmt::format("{}: not a regular file, give a .msh file", path));
  }
  const std::unique_ptr<FILE, int (*)(FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) {
    throw base::EnvironmentError(
        fmt::format("{}: the mesh file cannot be opened: {}", path, std::strerror(errno)));
  }
  std::string bytes(static_cast<size_t>(status.st_size), '\0');
  if (std::fread(bytes.data(), 1, bytes.size(), file.get()) != bytes.size()) {
    throw base::EnvironmentError(
        fmt::format("{}: the mesh file cannot be read to its end: {}", path,
                    std::ferror(file.get()) != 0 ? std::strerror(errno) : "it became shorter"));
  }
  return bytes;
}

}  // namespace diptych::meshes::msh
