#pragma once
/// A table that grows while a run goes on: lines are appended, and what has been flushed is there
/// whole for whoever reads the file then, also after the program was killed. There is never a part
/// of a line in the file unless the disk is full. Test: tests/common/io/row_file_test.cpp

#include <string>
#include <string_view>

namespace diptych::io {

class RowFile {
 public:
  /// Replaces what stood at the path. @throws base::EnvironmentError with path and reason
  RowFile(std::string path, const std::string& header);
  ~RowFile();
  RowFile(const RowFile&) = delete;
  RowFile& operator=(const RowFile&) = delete;

  /// Keeps a line, with its end, for the next flush.
  void append(std::string_view line) { waiting_ += line; }
  /// Hands the waiting lines to the system: one write. @throws base::EnvironmentError
  void flush();
  /// Flushes, waits until the disk has all, and closes. @throws base::EnvironmentError
  void finish();

 private:
  [[noreturn]] void fail(const char* what, int error) const;

  std::string path_, waiting_;
  int descriptor_ = -1;
};

}  // namespace diptych::io
