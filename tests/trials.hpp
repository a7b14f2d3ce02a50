#pragma once
/// Random trials of one kind: few in the suite, many where tests/trust asks for them, counted for
/// its page.

#include <cstdlib>
#include <fstream>
#include <string>
#include <utility>

namespace diptych::tests {

/// Counts the trials of a kind. With DIPTYCH_TRIALS=many there are many; with DIPTYCH_TRIALS_FILE a
/// line "KIND,TRIALS,FAILURES" is appended to that file at the end.
class Trials {
 public:
  explicit Trials(std::string kind) : kind_(std::move(kind)) {}
  Trials(const Trials&) = delete;
  Trials& operator=(const Trials&) = delete;
  ~Trials() {
    const char* file = std::getenv("DIPTYCH_TRIALS_FILE");
    if (file != nullptr)
      std::ofstream(file, std::ios::app) << kind_ << "," << n_made_ << "," << n_failed_ << "\n";
  }
  /// How many to make: so many in the suite, so many where many are asked for.
  static int n(int few, int many) {
    const char* asked = std::getenv("DIPTYCH_TRIALS");
    return asked != nullptr && std::string(asked) == "many" ? many : few;
  }
  void add(bool is_good) {
    ++n_made_;
    n_failed_ += !is_good;
  }
  int n_made() const { return n_made_; }

 private:
  std::string kind_;
  int n_made_ = 0, n_failed_ = 0;
};

}  // namespace diptych::tests
