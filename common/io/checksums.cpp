#include "common/io/checksums.hpp"

#include "common/base/error.hpp"
#include "common/io/run_record.hpp"

#include <filesystem>
#include <fmt/format.h>
#include <sstream>
#include <system_error>
#include <xxhash.h>

namespace diptych::io {

namespace {

namespace fs = std::filesystem;

constexpr size_t n_digits = 32;

std::string hash_of(const std::string& text) {
  const XXH128_hash_t hash = XXH3_128bits(text.data(), text.size());
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

std::string in_folder(const std::string& directory, const std::string& name) {
  return (fs::path(directory) / name).string();
}

/// A line is "HASH  NAME".
bool is_line(const std::string& line) {
  return line.size() > n_digits + 2 && line.substr(n_digits, 2) == "  " &&
         line.find_first_not_of("0123456789abcdef") == n_digits &&
         line.find('/') == std::string::npos;
}

}  // namespace

void write_checksums(const std::string& directory, const std::vector<std::string>& names) {
  std::string text;
  std::error_code error;
  for (const std::string& name : names) {
    const std::string path = in_folder(directory, name);
    if (fs::is_regular_file(path, error)) text += hash_of(read_file(path)) + "  " + name + "\n";
  }
  write_file_atomically(in_folder(directory, checksums_file), text);
}

std::vector<std::string> changed_files(const std::string& directory) {
  const std::string path = in_folder(directory, checksums_file);
  std::istringstream lines(read_file(path));
  std::vector<std::string> changed;
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (!is_line(line)) {
      throw base::InputError(
          fmt::format("{}:{}: not a line of checksums: the file is damaged", path, number));
    }
    const std::string name = line.substr(n_digits + 2), file = in_folder(directory, name);
    std::error_code error;
    if (!fs::is_regular_file(file, error)) {
      changed.push_back(file + ": is missing");
    } else if (hash_of(read_file(file)) != line.substr(0, n_digits)) {
      changed.push_back(fmt::format("{}: is not as the run left it: its checksum in {} differs",
                                    file, checksums_file));
    }
  }
  if (number == 0) throw base::InputError(path + ": is empty: the file is damaged");
  return changed;
}

}  // namespace diptych::io
