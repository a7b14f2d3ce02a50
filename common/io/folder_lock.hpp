#pragma once
/// One writer at a time in a folder: a lock that the kernel holds for the process, so that it ends
/// with it, whatever ends it, on one machine and, on file systems that have such locks, on all. The
/// file DIR/diptych.lock says who has it; it goes with the lock.
/// Test: tests/common/io/folder_lock_test.cpp

#include <optional>
#include <string>

namespace diptych::io {

/// The file in a folder that is locked.
constexpr const char* lock_file = "diptych.lock";

class FolderLock {
 public:
  /// Takes the folder. @throws base::InputError where another process has it, with who;
  /// base::EnvironmentError where no lock can be made
  explicit FolderLock(const std::string& directory);
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  ~FolderLock();

 private:
  std::string path_;
  int descriptor_ = -1;
};

/// Who has the folder ("process 4711 on host a since ..."); nothing where it is free.
std::optional<std::string> lock_holder(const std::string& directory);

}  // namespace diptych::io
