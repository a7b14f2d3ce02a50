#pragma once
/// What this machine can do, measured: memory bandwidth (triad a = b + s c over arrays larger than
/// the last-level cache, 24 bytes counted per element in double) and the peak of fused
/// multiply-adds (independent chains in registers, with the instruction set that the sweeps use),
/// in double and float, with one thread (its processor time) and with all (time of the wall).
/// Speeds of the code are given as fractions of these, from the same run. Test:
/// tests/harness/machine_probes_test.cpp

#include <cstdint>
#include <string>

namespace diptych::probes {

/// Processor time of this thread, or, for work of several threads, time of the wall  [s]: on a
/// shared machine the former does not count what others take.
double seconds(int threads);

/// Of one precision and number of threads; the best of a few repetitions.
struct Peak {
  double bandwidth = 0;  ///< byte/s
  double flops = 0;      ///< flop/s, a multiply-add counts two
};

struct MachineProbes {
  int threads = 1;  ///< of the "all" figures
  Peak double_one, double_all, float_one, float_all;
  std::int64_t cache_bytes = 0;  ///< last-level cache as the system tells it, 0 if it does not
  std::int64_t array_bytes = 0;  ///< of each of the three arrays
  std::string instruction_set;   ///< baseline, AVX2, AVX-512
};

/// @param threads  of the "all" figures; 0: all processors
/// Takes about three seconds; uses at most a quarter of the free memory.
MachineProbes measure_machine(int threads);

/// Three lines for the terminal.
std::string probes_text(const MachineProbes& probes);

}  // namespace diptych::probes
