#pragma once
/// Files that are there whole or not at all (write_file_atomically of run_record.hpp): written
/// under a temporary name in the same folder, synced, renamed, folder synced. A run that is killed
/// leaves the old file or the new one. Test: tests/common/io/atomic_file_test.cpp

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace diptych::io {

/// A file that is written bit by bit, at any place, under its temporary name; gone where it is not
/// published. All but fails() throw base::EnvironmentError with path and errno.
class UnfinishedFile {
 public:
  explicit UnfinishedFile(std::string path);
  UnfinishedFile(const UnfinishedFile&) = delete;
  UnfinishedFile& operator=(const UnfinishedFile&) = delete;
  ~UnfinishedFile();

  /// For who cannot be thrown through: what fails is remembered, and thrown by the next other call.
  /// @return false from the first failure on
  bool put(std::int64_t begin, std::string_view bytes) noexcept;
  /// @return whether so many bytes were there
  bool get(std::int64_t begin, std::span<char> bytes) const noexcept;

  /// Throws what has failed so far.
  void require_written() const;
  /// Bytes from there on, which have been put.
  void take(std::int64_t begin, std::span<char> bytes) const;

  /// Behind the last byte; nothing stays from there on.
  void cut(std::int64_t size);
  void append(std::string_view bytes);
  /// Puts it at its path, on the disk.
  void publish();

 private:
  std::string path_;
  int descriptor_ = -1;
  int error_ = 0;
  std::int64_t wanted_ = 0;  ///< bytes of the write that failed
};

/// Makes the folder with its parents where it is missing. @throws base::EnvironmentError
void make_directory(const std::string& directory);

/// A file that is there, read at any place.
class ReadableFile {
 public:
  /// @throws base::EnvironmentError
  explicit ReadableFile(std::string path);
  ReadableFile(const ReadableFile&) = delete;
  ReadableFile& operator=(const ReadableFile&) = delete;
  ~ReadableFile();

  std::int64_t size() const { return size_; }
  /// @return whether so many bytes are there
  bool get(std::int64_t begin, std::span<char> bytes) const noexcept;
  /// @throws base::EnvironmentError where so many are not there
  void take(std::int64_t begin, std::span<char> bytes) const;

 private:
  std::string path_;
  int descriptor_ = -1;
  std::int64_t size_ = 0;
};

/// Writes the text over what the file holds, in the space that it has: for a last word on a full
/// disk, where a file beside it cannot be made. @return whether all of it is there
bool write_over(const std::string& path, const std::string& text);

}  // namespace diptych::io
