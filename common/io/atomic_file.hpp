#pragma once
/// Files that are there whole or not at all (write_file_atomically of run_record.hpp): written
/// under a temporary name in the same folder, synced, renamed, folder synced. A run that is killed
/// leaves the old file or the new one. Test: tests/common/io/atomic_file_test.cpp

#include <string>

namespace diptych::io {

/// Makes the folder with its parents where it is missing. @throws base::EnvironmentError
void make_directory(const std::string& directory);

/// Writes the text over what the file holds, in the space that it has: for a last word on a full
/// disk, where a file beside it cannot be made. @return whether all of it is there
bool write_over(const std::string& path, const std::string& text);

}  // namespace diptych::io
