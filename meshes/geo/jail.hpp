#pragma once
/// What a child program may do: a second wall behind the search of a .geo file (geo_scan.hpp). It
/// needs neither privileges nor packages; what a kernel does not offer is left out, and the program
/// runs all the same. Test: tests/meshes/jail_test.cpp

#include <string>

namespace diptych::meshes {

/// Made before the fork, entered after it.
class Jail {
 public:
  /// @param folder    its current folder, the only one that it may write in (Landlock, Linux 5.13)
  /// @param is_alone  no other program, no socket (seccomp); threads are free. Not for a program
  ///                  that is a script of a shell, which would not start
  Jail(const std::string& folder, bool is_alone);
  Jail(const Jail&) = delete;
  Jail& operator=(const Jail&) = delete;
  ~Jail();

  /// In the child, before it becomes the program. Calls nothing but the system, as a fork of a
  /// process with threads must. @return errno, 0: done
  int enter() const noexcept;

  /// Limits, beyond which the system ends the program.
  static constexpr unsigned long long most_file_bytes = 1ull << 34;
  static constexpr unsigned long long most_seconds = 7200;  ///< of processor

 private:
  std::string folder_;
  bool is_alone_;
  int rules_ = -1;  ///< descriptor of the Landlock rules, or -1
  unsigned long long most_memory_ = 0;
};

}  // namespace diptych::meshes
