#pragma once
/// Files that are there whole or not at all (write_file_atomically of run_record.hpp): written
/// under a temporary name in the same folder, synced, renamed, folder synced. A run that is killed
/// leaves the old file or the new one. Test: tests/common/io/atomic_file_test.cpp

#include <string>

namespace diptych::io {

/// Makes the folder with its parents where it is missing. @throws base::EnvironmentError
void make_directory(const std::string& directory);

}  // namespace diptych::io
