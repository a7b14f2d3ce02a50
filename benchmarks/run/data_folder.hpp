#pragma once
/// Where the data that is shipped with the program lies: cases, baselines, verification,
/// literature, atlas. Test: tests/harness/data_folder_test.cpp, tests/bare

#include <filesystem>
#include <string>
#include <vector>

namespace diptych::harness {

/// Folders that may hold the shipped data, the nearest to the program first: where it was installed
/// (PREFIX/bin beside PREFIX/share/diptych), the source tree that it was built in, wherever that is
/// now, the source tree as it stood when it was built, and the copy beside a program that was built
/// outside of its source tree.
/// @param program  path of the program
std::vector<std::filesystem::path> data_places(const std::filesystem::path& program);

/// The first of the places that has a folder of this name, "cases" for instance.
/// @throws base::EnvironmentError naming the places where there is none
std::string data_folder(const std::string& name);
std::string data_folder(const std::string& name, const std::vector<std::filesystem::path>& places);

}  // namespace diptych::harness
