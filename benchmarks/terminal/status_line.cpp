#include "benchmarks/terminal/status_line.hpp"

#include <cstdio>
#include <unistd.h>

namespace diptych::harness {

StatusLine::StatusLine(bool quiet) : quiet_(quiet), on_terminal_(isatty(STDERR_FILENO) != 0) {}

StatusLine::~StatusLine() {
  if (open_) std::fputs("\r\033[K", stderr);
}

void StatusLine::show(const std::string& text) {
  if (quiet_ || !on_terminal_) return;
  std::fputs(("\r\033[K" + text.substr(0, 99)).c_str(), stderr);
  std::fflush(stderr);
  open_ = true;
}

void StatusLine::keep(const std::string& text) {
  if (quiet_) return;
  std::fputs(((open_ ? "\r\033[K" : "") + text + "\n").c_str(), stderr);
  std::fflush(stderr);
  open_ = false;
}

}  // namespace diptych::harness
