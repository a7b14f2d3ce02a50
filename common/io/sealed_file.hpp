#pragma once
/// Files of which no flipped bit and no missing end goes unseen: the content, then the XXH3 hash of
/// every 64 KiB of it, then a last line with the size and the hash of all. Programs that look only
/// at what a file begins with, as HDF5 does, read the content as if the seal were not there.
/// Test: tests/common/io/sealed_file_test.cpp

#include "common/io/atomic_file.hpp"

#include <string>

namespace diptych::io {

/// Bytes that a hash of its own stands for: what a message can say of the place of a damage.
constexpr size_t sealed_piece = size_t{1} << 16;

/// The content with its seal behind it.
std::string sealed(std::string content);

/// Puts the content with its seal at the path, whole or not at all (write_file_atomically).
/// @throws base::EnvironmentError with path and errno
void write_sealed_file(const std::string& path, std::string content);

/// Puts its seal behind a content of this size that the file begins with; what it had there is
/// gone. Content of any size takes little memory.
void seal(UnfinishedFile& file, std::int64_t size);

/// The content. @throws base::InputError where the file is cut off, damaged or without a seal, with
/// the path and the first damaged bytes; base::EnvironmentError where it cannot be read
std::string read_sealed_file(const std::string& path);

/// Throws the same, and takes little memory.
void check_sealed_file(const std::string& path);

}  // namespace diptych::io
