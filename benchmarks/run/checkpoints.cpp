#include "benchmarks/run/checkpoints.hpp"

#include "common/base/error.hpp"
#include "common/io/checkpoint_file.hpp"

#include <charconv>
#include <fmt/format.h>
#include <map>
#include <system_error>

namespace diptych::harness {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view beginning = "checkpoint_", ending = ".hdf";
constexpr size_t n_generations = 2;

/// The step that the name tells; nothing where it is not that of a checkpoint.
std::optional<std::int64_t> step_of(const std::string& name) {
  if (!name.starts_with(beginning) || !name.ends_with(ending)) return std::nullopt;
  const char* first = name.data() + beginning.size();
  const char* last = name.data() + name.size() - ending.size();
  std::int64_t step = 0;
  const auto read = std::from_chars(first, last, step);
  const bool is_number = read.ec == std::errc() && read.ptr == last && step >= 0;
  return is_number ? std::optional(step) : std::nullopt;
}

/// The checkpoints of a folder by step.
std::map<std::int64_t, fs::path> checkpoints_in(const fs::path& directory) {
  std::map<std::int64_t, fs::path> found;
  std::error_code error;
  for (fs::directory_iterator entry(directory, error), end; !error && entry != end;
       entry.increment(error)) {
    if (const auto step = step_of(entry->path().filename().string())) found[*step] = entry->path();
  }
  if (error && error != std::errc::no_such_file_or_directory) {
    throw base::EnvironmentError(
        fmt::format("cannot read the folder '{}': {}", directory.string(), error.message()));
  }
  return found;
}

void remove_file(const fs::path& path) {
  std::error_code error;
  fs::remove(path, error);
  if (error) {
    throw base::EnvironmentError(
        fmt::format("cannot remove '{}': {}", path.string(), error.message()));
  }
}

}  // namespace

bool is_checkpoint_name(const std::string& name) {
  return step_of(name).has_value();
}

void write_checkpoint(const std::string& directory,
                      std::int64_t step,
                      const std::function<void(algebra::Archive&)>& archive) {
  const fs::path path = fs::path(directory) / fmt::format("{}{:08}{}", beginning, step, ending);
  io::CheckpointWriter writer(path.string());
  archive(writer);
  writer.publish();
  std::map<std::int64_t, fs::path> all = checkpoints_in(directory);
  for (auto oldest = all.begin(); all.size() > n_generations; oldest = all.erase(oldest))
    remove_file(oldest->second);
}

void remove_later_checkpoints(const std::string& directory, std::int64_t step) {
  for (const auto& [other, path] : checkpoints_in(directory)) {
    if (other > step) remove_file(path);
  }
}

FoundCheckpoint latest_checkpoint(const std::string& directory) {
  const std::map<std::int64_t, fs::path> all = checkpoints_in(directory);
  FoundCheckpoint found;
  for (auto one = all.rbegin(); one != all.rend(); ++one) {
    try {
      io::CheckpointReader reader(one->second.string());
      found.path = reader.path();
      return found;
    } catch (const base::InputError& error) {
      found.refused.emplace_back(error.what());
    }
  }
  if (!found.refused.empty()) {
    throw base::InputError(
        fmt::format("none of the checkpoints can be used\n  {}", fmt::join(found.refused, "\n  ")));
  }
  return found;
}

}  // namespace diptych::harness
