#pragma once
/// What a study is doing, on the standard error stream: one line that is rewritten on a terminal,
/// plain lines in a log.

#include <string>

namespace diptych::harness {

class StatusLine {
 public:
  explicit StatusLine(bool quiet);
  ~StatusLine();
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;
  /// What is under way: rewritten on a terminal, not shown in a log.
  void show(const std::string& text);
  /// What has been done: stays.
  void keep(const std::string& text);

 private:
  bool quiet_, on_terminal_;
  bool open_ = false;
};

}  // namespace diptych::harness
