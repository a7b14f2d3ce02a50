#include "common/mpi/watch.hpp"

#include <chrono>
#include <condition_variable>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <unistd.h>

namespace diptych::parallel {

namespace {

constexpr std::chrono::milliseconds interval{1000};

/// Signals are for the thread that works.
struct SignalsBlocked {
  SignalsBlocked() {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_BLOCK, &all, &before);
  }
  ~SignalsBlocked() { pthread_sigmask(SIG_SETMASK, &before, nullptr); }
  SignalsBlocked(const SignalsBlocked&) = delete;
  SignalsBlocked& operator=(const SignalsBlocked&) = delete;
  sigset_t before{};
};

constexpr std::chrono::milliseconds no_pause{1};
enum Tag { beat_tag, signal_tag };
/// What MPI_Abort may take.
constexpr int abort_seconds = 5;

}  // namespace

Countdown::Countdown(int seconds, std::string message) {
  const SignalsBlocked blocked;
  thread_ = std::jthread([seconds, text = std::move(message)](const std::stop_token& stop) {
    std::mutex mutex;
    std::condition_variable_any woken;
    std::unique_lock lock(mutex);
    for (std::chrono::milliseconds passed{0}; passed < std::chrono::seconds(seconds);
         passed += interval) {
      woken.wait_for(lock, stop, interval, [] { return false; });
      if (stop.stop_requested()) return;
    }
    std::fputs(text.c_str(), stderr);
    std::fflush(stderr);
    _exit(4);
  });
}

std::optional<int> rank_patience() {
  const char* text = std::getenv("DIPTYCH_RANK_PATIENCE");
  if (text == nullptr) return 20;
  char* end = nullptr;
  const long seconds = std::strtol(text, &end, 10);
  if (end == text || *end != '\0' || seconds < 0 || seconds > 1000000) return std::nullopt;
  return static_cast<int>(seconds);
}

Watch::Watch(int patience, const char* (*phase)(), PassedSignals signals)
    : patience_(patience), phase_(phase), signals_(signals) {
  MPI_Comm_dup(MPI_COMM_WORLD, &beats_);
  MPI_Comm_rank(beats_, &rank_);
  MPI_Comm_size(beats_, &size_);
  const SignalsBlocked blocked;
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

Watch::~Watch() {
  MPI_Barrier(beats_);  // still watched: what comes after has a Countdown, and takes no time
  thread_.request_stop();
  thread_.join();
  MPI_Comm_free(&beats_);
}

void Watch::say(bool is_last) {
  int is_sent = 0;
  MPI_Test(&saying_, &is_sent, MPI_STATUS_IGNORE);
  if (is_sent == 0 && !is_last) return;
  MPI_Wait(&saying_, MPI_STATUS_IGNORE);
  said_ = {};
  said_.is_last = is_last;
  const char* phase = phase_();
  std::strncpy(said_.phase, phase == nullptr ? "nothing for others" : phase,
               sizeof said_.phase - 1);
  MPI_Isend(&said_, sizeof said_, MPI_BYTE, (rank_ + 1) % size_, beat_tag, beats_, &saying_);
}

void Watch::give_up() const {
  const int lost = (rank_ + size_ - 1) % size_;
  std::fprintf(
      stderr,
      "diptych: rank %d of %d has not been heard of for %d s, last in %s: it is stopped, or "
      "its machine is lost; the job ends here. Go on from the last checkpoint with run "
      "--restart latest. (DIPTYCH_RANK_PATIENCE sets the seconds, 0 waits for ever.)\n",
      lost, size_, patience_, heard_.phase[0] == '\0' ? "its start" : heard_.phase);
  std::fflush(stderr);
  const Countdown countdown(abort_seconds,
                            "");  // mpirun ends all where one ends without a farewell
  MPI_Abort(MPI_COMM_WORLD, 4);
  std::abort();
}

void Watch::listen() {
  MPI_Irecv(&beat_, sizeof beat_, MPI_BYTE, (rank_ + size_ - 1) % size_, beat_tag, beats_,
            &hearing_);
}

bool Watch::hear() {
  bool has_heard = false;
  while (!heard_.is_last) {
    int has_come = 0;
    MPI_Test(&hearing_, &has_come, MPI_STATUS_IGNORE);
    if (has_come == 0) break;
    has_heard = true;
    heard_ = beat_;
    if (!heard_.is_last) listen();
  }
  return has_heard;
}

/// Of another rank than 0.
void Watch::pass_signal() {
  int is_sent = 0;
  MPI_Test(&passing_, &is_sent, MPI_STATUS_IGNORE);
  if (is_sent == 0) return;
  signal_ = signals_.take();
  if (signal_ != 0) MPI_Isend(&signal_, 1, MPI_INT, 0, signal_tag, beats_, &passing_);
}

void Watch::await_signal() {
  MPI_Irecv(&signal_, 1, MPI_INT, MPI_ANY_SOURCE, signal_tag, beats_, &passing_);
}

/// Of rank 0.
void Watch::take_signals() {
  for (;;) {
    int has_come = 0;
    MPI_Status status;
    MPI_Test(&passing_, &has_come, &status);
    if (has_come == 0) return;
    signals_.obey(status.MPI_SOURCE, signal_);
    await_signal();
  }
}

/// Seconds are counted as rounds of this thread: where the whole job was stopped and goes on, none
/// has passed for anybody.
void Watch::run(const std::stop_token& stop) {
  std::mutex mutex;
  std::condition_variable_any woken;
  std::unique_lock lock(mutex);
  listen();
  if (rank_ == 0) await_signal();
  std::chrono::milliseconds silent{0};
  while (!heard_.is_last || !said_.is_last) {
    const bool is_ending = stop.stop_requested();
    if (!said_.is_last) say(is_ending);
    if (hear()) silent = {};
    if (rank_ == 0) {
      take_signals();
    } else if (!is_ending) {
      pass_signal();
    }
    const auto pause = is_ending ? no_pause : interval;
    if (is_ending) {
      std::this_thread::sleep_for(pause);
    } else {
      woken.wait_for(lock, stop, pause, [] { return false; });
    }
    silent += pause;
    if (!heard_.is_last && silent > std::chrono::seconds(patience_)) give_up();
  }
  MPI_Wait(&saying_, MPI_STATUS_IGNORE);
  if (rank_ == 0) MPI_Cancel(&passing_);
  MPI_Wait(&passing_, MPI_STATUS_IGNORE);
}

}  // namespace diptych::parallel
