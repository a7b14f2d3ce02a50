#pragma once
/// DIR/checksums.txt: the XXH3 hash (128 bits) of files of the folder, a line each, in the format
/// of `xxh128sum -c`. Test: tests/common/io/checksums_test.cpp

#include <string>
#include <vector>

namespace diptych::io {

constexpr const char* checksums_file = "checksums.txt";

/// Writes it for those of the names that are files of the folder.
/// @throws base::EnvironmentError
void write_checksums(const std::string& directory, const std::vector<std::string>& names);

/// What differs from it, a message a file; empty where all files are as they were.
/// @throws base::InputError where it is no list of checksums; base::EnvironmentError
std::vector<std::string> changed_files(const std::string& directory);

}  // namespace diptych::io
