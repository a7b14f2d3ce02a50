#include "common/base/error.hpp"
#include "meshes/msh/source.hpp"

#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <memory>
#include <sys/stat.h>
#include <unistd.h>

namespace diptych::meshes::msh {

namespace {

/// A quarter of the machine's memory: the mesh itself, as it is read, takes more than its file.
std::int64_t most_bytes() {
  return static_cast<std::int64_t>(sysconf(_SC_PHYS_PAGES)) * sysconf(_SC_PAGESIZE) / 4;
}

}  // namespace

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
  if (status.st_size > most_bytes()) {
    throw base::EnvironmentError(
        fmt::format("{}: {} bytes; a mesh file of more than a quarter of the memory of the machine "
                    "({} bytes) leaves none for the mesh; use a coarser one",
                    path, status.st_size, most_bytes()));
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
