#pragma once
/// Ranks watch each other: each says once a second to the next one that it lives, and in which
/// phase it is. A process that is stopped, a machine that has gone: the next one hears nothing
/// more, says of whom, and ends the job; else all would wait for ever. Beats are sent by a thread
/// of their own, however long a phase takes, which takes signals of other ranks to rank 0 too. The
/// end of MPI itself has a Countdown; a process that is stopped after that, in the milliseconds of
/// its exit, holds mpirun until it is continued, with nothing left to do. Test: tests/ranks

#include "common/parallel/ranks.hpp"

#include <mpi.h>

#include <optional>
#include <string>
#include <thread>

namespace diptych::parallel {

/// Seconds without a word after which a rank is given up: DIPTYCH_RANK_PATIENCE, 20 where it is not
/// set; 0: never. Nothing where it is no number of seconds.
std::optional<int> rank_patience();

/// Ends this process with code 4 and a message where what follows takes longer than so many
/// seconds: calls of MPI that wait for others and that no Watch sees any more. Seconds are counted
/// as rounds, as those of Watch.
class Countdown {
 public:
  Countdown(int seconds, std::string message);

 private:
  std::jthread thread_;  ///< stopped and joined by its destructor
};

class Watch {
 public:
  /// @param phase    what this rank does, or null; called by the thread that watches
  /// @param signals  called by it too
  /// @pre MPI_THREAD_MULTIPLE; several ranks
  Watch(int patience, const char* (*phase)(), PassedSignals signals);
  /// Waits until all ranks are here, and for the last word of the one before. @pre all ranks end
  /// their watches
  ~Watch();
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

 private:
  struct Beat {
    char phase[48] = {};
    bool is_last = false;
  };
  void run(const std::stop_token& stop);
  void say(bool is_last);
  void listen();
  bool hear();  ///< whether there was a word
  void pass_signal();
  void await_signal();
  void take_signals();
  [[noreturn]] void give_up() const;

  int patience_;
  const char* (*phase_)();
  PassedSignals signals_;
  MPI_Comm beats_ = MPI_COMM_NULL;  ///< apart from what the program sends
  int rank_ = 0, size_ = 1;
  Beat heard_, beat_, said_;
  MPI_Request saying_ = MPI_REQUEST_NULL, hearing_ = MPI_REQUEST_NULL;
  int signal_ = 0;                          ///< on its way to rank 0
  MPI_Request passing_ = MPI_REQUEST_NULL;  ///< of it; on rank 0 from whoever has one
  std::jthread thread_;
};

}  // namespace diptych::parallel
