#pragma once
/// What ranks say to each other, as the program needs it: parcels between pairs of ranks, one value
/// of each for all, one value of rank 0 for all. common/mpi makes it of MPI; with one rank there is
/// none. Every rank makes the same calls in the same order, from one thread. What fails in here
/// ends the job with a message that names the rank. Test: tests/ranks/ranks_test.cpp

#include <cstddef>
#include <cstdint>
#include <span>

namespace diptych::parallel {

/// Bytes that go to a rank or come from it.
struct Parcel {
  int rank = 0;
  std::byte* bytes = nullptr;
  std::int64_t n = 0;
};

/// What communication has cost a rank so far.
struct CommunicationCost {
  double seconds = 0;             ///< of the clock, in the calls below, waiting included
  std::int64_t parcel_bytes = 0;  ///< that parcels took to others
};

class Communicator {
 public:
  virtual ~Communicator() = default;
  virtual int rank() const = 0;
  virtual int size() const = 0;

  /// Begins to send and to receive; the memory stays as it is until finish_exchange().
  virtual void begin_exchange(std::span<const Parcel> sends, std::span<const Parcel> receives) = 0;
  virtual void finish_exchange() = 0;
  /// Gives all parts to all ranks.
  /// @param all    the parts of the ranks, one behind the other; mine stands there already
  /// @param bytes  [size] of each part
  virtual void all_gather(std::byte* all, std::span<const std::int64_t> bytes) = 0;
  /// Adds up what the ranks have in each of `sums`, and takes the largest of what they have in each
  /// of `largest`: all have the results.
  virtual void reduce(std::span<std::int64_t> sums, std::span<std::int64_t> largest) = 0;
  /// What rank 0 has there, for all.
  virtual void broadcast(std::byte* bytes, std::int64_t n) = 0;
  /// Returns once all ranks have come here. Who waits leaves its processor to others, and may be a
  /// millisecond late.
  virtual void meet() = 0;

  virtual CommunicationCost cost() const = 0;
  /// Ends the processes of all ranks with this exit code.
  [[noreturn]] virtual void abort(int exit_code) = 0;
};

template <class T>
std::byte* bytes_of(T* values) {
  return reinterpret_cast<std::byte*>(values);
}

}  // namespace diptych::parallel
