#include "benchmarks/probes/machine_probes.hpp"

#include "common/algebra/field.hpp"
#include "common/algebra/lanes.hpp"
#include "common/parallel/for_chunks.hpp"

#include <algorithm>
#include <ctime>
#include <fmt/format.h>
#include <fstream>
#include <unistd.h>
#include <vector>

namespace diptych::probes {

double seconds(int threads) {
  timespec t{};
  clock_gettime(threads == 1 ? CLOCK_THREAD_CPUTIME_ID : CLOCK_MONOTONIC, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

namespace {

using algebra::AlignedArray;
using algebra::InstructionSet;
template <class T, int bytes>
struct VectorOf {
  using type __attribute__((vector_size(bytes))) = T;
};

/// n multiply-adds on each of `chains` independent vectors, enough to hide the latency of one.
template <class T, int bytes, int chains>
DIPTYCH_INLINE T multiply_adds(std::int64_t n, T factor, T summand) {
  using Vector = typename VectorOf<T, bytes>::type;
  Vector x[chains];
  const Vector m = Vector{} + factor, s = Vector{} + summand;
  for (int k = 0; k < chains; ++k)
    x[k] = Vector{} + static_cast<T>(k);
  for (std::int64_t i = 0; i < n; ++i) {
#pragma GCC unroll 24
    for (int k = 0; k < chains; ++k)
      x[k] = x[k] * m + s;
  }
  Vector sum{};
  for (int k = 0; k < chains; ++k)
    sum += x[k];
  return sum[0];
}

// chains: as many as the registers of the instruction set hold besides m and s
template <class T>
T multiply_adds_baseline(std::int64_t n, T m, T s) {
  return multiply_adds<T, 16, 10>(n, m, s);
}
template <class T>
DIPTYCH_AVX2 T multiply_adds_avx2(std::int64_t n, T m, T s) {
  return multiply_adds<T, 32, 12>(n, m, s);
}
template <class T>
DIPTYCH_AVX512 T multiply_adds_avx512(std::int64_t n, T m, T s) {
  return multiply_adds<T, 64, 24>(n, m, s);
}

/// Flop of one iteration of the loop above.
template <class T>
double flop_per_iteration() {
  const double lanes = 1.0 / sizeof(T);
  switch (algebra::instruction_set()) {
    case InstructionSet::avx512:
      return 2 * 24 * 64 * lanes;
    case InstructionSet::avx2:
      return 2 * 12 * 32 * lanes;
    default:
      return 2 * 10 * 16 * lanes;
  }
}

template <class T>
auto multiply_adds_here() {
  switch (algebra::instruction_set()) {
    case InstructionSet::avx512:
      return multiply_adds_avx512<T>;
    case InstructionSet::avx2:
      return multiply_adds_avx2<T>;
    default:
      return multiply_adds_baseline<T>;
  }
}

template <class T>
double peak_flops(int threads) {
  const auto work = multiply_adds_here<T>();
  constexpr std::int64_t n = 2'000'000;
  double best = 0;
  volatile T sink = 0;
  for (int repetition = 0; repetition < 6; ++repetition) {
    const double start = seconds(threads);
#pragma omp parallel for schedule(static, 1) num_threads(threads)
    for (int thread = 0; thread < threads; ++thread) {
      const T result = work(n, static_cast<T>(0.999), static_cast<T>(1e-3));
#pragma omp critical
      sink = sink + result;
    }
    const double flop = flop_per_iteration<T>() * static_cast<double>(n) * threads;
    best = std::max(best, flop / (seconds(threads) - start));
  }
  return best;
}

template <class T>
DIPTYCH_CLONES void triad(T* a, const T* b, const T* c, T s, std::int64_t begin, std::int64_t end) {
  for (std::int64_t i = begin; i < end; ++i)
    a[i] = b[i] + s * c[i];
}

template <class T>
double bandwidth(AlignedArray<double>& a,
                 const AlignedArray<double>& b,
                 const AlignedArray<double>& c,
                 int threads) {
  const std::int64_t n = a.size() * static_cast<std::int64_t>(sizeof(double) / sizeof(T));
  double best = 0;
  for (int repetition = 0; repetition < 3; ++repetition) {
    const double start = seconds(threads);
#pragma omp parallel for schedule(static, 1) num_threads(threads)
    for (int k = 0; k < threads; ++k) {
      triad(reinterpret_cast<T*>(a.data()), reinterpret_cast<const T*>(b.data()),
            reinterpret_cast<const T*>(c.data()), static_cast<T>(0.5), n * k / threads,
            n * (k + 1) / threads);
    }
    best = std::max(best, 3.0 * sizeof(T) * static_cast<double>(n) / (seconds(threads) - start));
  }
  return best;
}

/// Size of the largest cache of processor 0; 0 where the system does not tell.
std::int64_t last_level_cache() {
  std::int64_t largest = 0;
  for (int index = 0; index < 8; ++index) {
    std::ifstream file(fmt::format("/sys/devices/system/cpu/cpu0/cache/index{}/size", index));
    std::int64_t size = 0;
    char unit = ' ';
    if (!(file >> size >> unit)) continue;
    largest = std::max(largest, size * (unit == 'K' ? 1024 : unit == 'M' ? 1024 * 1024 : 1));
  }
  return largest;
}

}  // namespace

MachineProbes measure_machine(int threads) {
  MachineProbes probes;
  const int before = parallel::n_threads();
  parallel::set_threads(threads);
  probes.threads = parallel::n_threads();
  parallel::set_threads(before);
  const auto isa = algebra::instruction_set();
  probes.instruction_set = isa == InstructionSet::avx512 ? "AVX-512"
                           : isa == InstructionSet::avx2 ? "AVX2"
                                                         : "baseline";
  probes.double_one.flops = peak_flops<double>(1);
  probes.double_all.flops = peak_flops<double>(probes.threads);
  probes.float_one.flops = peak_flops<float>(1);
  probes.float_all.flops = peak_flops<float>(probes.threads);
  probes.cache_bytes = last_level_cache();
  const std::int64_t free =
      static_cast<std::int64_t>(sysconf(_SC_AVPHYS_PAGES)) * sysconf(_SC_PAGESIZE);
  const std::int64_t wanted = std::max<std::int64_t>(64 << 20, probes.cache_bytes * 5 / 4);
  probes.array_bytes = std::min(wanted, free / 12) / 64 * 64;
  const std::int64_t n = probes.array_bytes / static_cast<std::int64_t>(sizeof(double));
  AlignedArray<double> a(n), b(n), c(n);
  probes.double_one.bandwidth = bandwidth<double>(a, b, c, 1);
  probes.double_all.bandwidth = bandwidth<double>(a, b, c, probes.threads);
  probes.float_one.bandwidth = bandwidth<float>(a, b, c, 1);
  probes.float_all.bandwidth = bandwidth<float>(a, b, c, probes.threads);
  return probes;
}

std::string probes_text(const MachineProbes& p) {
  const auto row = [](const std::string& name, double one, double all, const char* unit) {
    return fmt::format("  {:<28}{:>9.1f}{:>9.1f}  {}\n", name, 1e-9 * one, 1e-9 * all, unit);
  };
  const bool small = p.array_bytes < p.cache_bytes;
  return fmt::format("machine, this run ({}): {:>13}{:>9}\n", p.instruction_set, "1 thread",
                     fmt::format("all ({})", p.threads)) +
         row("multiply-add peak, double", p.double_one.flops, p.double_all.flops, "Gflop/s") +
         row("multiply-add peak, float", p.float_one.flops, p.float_all.flops, "Gflop/s") +
         row("triad, double", p.double_one.bandwidth, p.double_all.bandwidth, "GB/s") +
         row("triad, float", p.float_one.bandwidth, p.float_all.bandwidth, "GB/s") +
         fmt::format("  triad over three arrays of {} MiB; last-level cache {} MiB{}\n",
                     p.array_bytes >> 20, p.cache_bytes >> 20,
                     small ? ": TOO SMALL for memory, for want of free memory" : "");
}

}  // namespace diptych::probes
