#include "meshes/geo/child_watch.hpp"

#include "common/base/error.hpp"
#include "common/base/interruption.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace diptych::meshes {

namespace {

/// How long a request to end may go unseen: a handler's signal need not end the wait, as another
/// thread may have taken it.
constexpr int glance_ms = 50;

[[noreturn]] void fail(const std::string& program, const char* what, int error) {
  throw base::EnvironmentError(fmt::format("{}: {}: {}", program, what, std::strerror(error)));
}

/// The child and what it has started, reaped. It made its group itself, perhaps not yet.
void end(pid_t child) {
  setpgid(child, child);
  kill(-child, SIGKILL);
  kill(child, SIGKILL);
  while (waitpid(child, nullptr, 0) < 0 && errno == EINTR) {
  }
}

}  // namespace

bool join_parent(pid_t parent) noexcept {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  for (const int signal : {SIGHUP, SIGINT, SIGTERM, SIGPIPE, SIGXFSZ})
    std::signal(signal, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  return getppid() == parent;  // it may have ended before the kernel was told
}

std::string output_of(pid_t child, int descriptor, const std::string& program, size_t most) {
  std::string output;
  std::array<char, 4096> block{};
  pollfd watched{descriptor, POLLIN, 0};
  for (;;) {
    if (base::interrupt_requested()) {
      end(child);
      throw base::Interruption(program + ": ended with this program");
    }
    const int ready = poll(&watched, 1, glance_ms);
    if (ready == 0 || (ready < 0 && errno == EINTR)) continue;
    const ssize_t n = ready < 0 ? -1 : ::read(descriptor, block.data(), block.size());
    if (n == 0) return output;
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) {
      const int error = errno;
      end(child);
      fail(program, "its output cannot be read", error);
    }
    output.append(block.data(), static_cast<size_t>(n));
    if (output.size() > 2 * most) output.erase(0, output.size() - most);
  }
}

int exit_status_of(pid_t child, const std::string& program) {
  int status = 0;
  for (;;) {
    const pid_t ended = waitpid(child, &status, WNOHANG);
    if (ended == child) return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
    if (ended < 0 && errno != EINTR) fail(program, "waiting for it failed", errno);
    if (base::interrupt_requested()) {
      end(child);
      throw base::Interruption(program + ": ended with this program");
    }
    usleep(1000);  // its output is closed: it is about to end
  }
}

}  // namespace diptych::meshes
