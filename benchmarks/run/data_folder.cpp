#include "benchmarks/run/data_folder.hpp"

#include "common/base/error.hpp"
#include "common/base/text.hpp"

namespace diptych::harness {

namespace fs = std::filesystem;

std::vector<fs::path> data_places(const fs::path& program) {
  const fs::path folder = program.parent_path();
  return {(folder / "../share/diptych").lexically_normal(),
          (folder / "../../benchmarks").lexically_normal(),  // of build/release
          DIPTYCH_SOURCE_DATA, folder / "share/diptych"};
}

std::string data_folder(const std::string& name, const std::vector<fs::path>& places) {
  std::vector<std::string> looked_in;
  for (const fs::path& place : places) {
    std::error_code error;
    if (fs::is_directory(place / name, error)) return (place / name).string();
    looked_in.push_back((place / name).string());
  }
  throw base::EnvironmentError("the shipped " + name + " are not found in any of " +
                               base::joined(looked_in) +
                               "; install the program again, or build it in its source tree");
}

std::string data_folder(const std::string& name) {
  std::error_code error;
  return data_folder(name, data_places(fs::read_symlink("/proc/self/exe", error)));
}

}  // namespace diptych::harness
