#pragma once
/// HDF5 on files of ours: what it writes goes to an UnfinishedFile, what it reads comes from a
/// ReadableFile, at once and of any size. HDF5 1.10 that cannot write leaves the file half open and
/// crashes when the program exits; here it never learns of that: the file remembers what has
/// failed, and says so when it is published. Test: tests/common/io/failing_disk_test.cpp

#include "common/io/atomic_file.hpp"

#include <cstdint>

namespace diptych::io {

/// Sets the access (hid_t of a property list) to such a file.
/// @param file, end  must outlive what is opened; `end` becomes the size of what HDF5 has made of
///                   it when that is closed
/// @return whether HDF5 has taken it
bool set_driver(std::int64_t access, UnfinishedFile& file, std::int64_t& end);
bool set_driver(std::int64_t access, const ReadableFile& file);

}  // namespace diptych::io
