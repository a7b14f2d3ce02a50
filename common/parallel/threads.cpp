#include "common/base/error.hpp"
#include "common/parallel/for_chunks.hpp"
#include "common/parallel/processors.hpp"
#include "common/parallel/ranks.hpp"
#include "common/parallel/thread_count.hpp"

#include <omp.h>

#include <algorithm>
#include <exception>
#include <latch>
#include <string>
#include <thread>
#include <vector>

namespace diptych::parallel {

namespace {

/// What OMP_NUM_THREADS says, or else the processors: as it was before anything was set.
int initial_threads() {
  static const int n = omp_get_max_threads();
  return n;
}

/// OpenMP ends the program where it cannot make a thread, so that they are made once before; its
/// own follow at once, as long as there is room for them.
/// @throws base::EnvironmentError
void require_threads(int count) {
  static int made = 1;
  if (count <= made) return;
  std::vector<std::thread> threads;
  threads.reserve(static_cast<size_t>(count));
  std::latch all_are_there(1);
  std::string reason;
  try {
    while (static_cast<int>(threads.size()) < count - 1)
      threads.emplace_back([&] { all_are_there.wait(); });
  } catch (const std::exception& error) {
    reason = error.what();
  }
  all_are_there.count_down();
  for (std::thread& thread : threads)
    thread.join();
  if (!reason.empty()) {
    throw base::EnvironmentError(
        "this machine gives the program " + std::to_string(threads.size() + 1) + " of " +
        std::to_string(count) + " threads (" + reason +
        "); give fewer with --threads, or raise the limit (ulimit -u, ulimit -v, of a container)");
  }
  made = count;
}

}  // namespace

int thread_count(int asked) {
  const int limit = omp_get_thread_limit(), initial = initial_threads();
  if (asked < 0 || asked > most_threads) {
    throw base::InputError(std::to_string(asked) + " threads: give 0 (as many as there are " +
                           "processors) to " + std::to_string(most_threads));
  }
  if (asked > limit) {
    throw base::InputError(std::to_string(asked) +
                           " threads are more than OMP_THREAD_LIMIT allows; give at most " +
                           std::to_string(limit) + ", or 0");
  }
  const int available = std::max(1, available_processors() / ranks_that_share_processors());
  return asked > 0 ? asked : std::min({initial, limit, available, most_threads});
}

void set_threads(int n) {
  const int count = thread_count(n);
  require_threads(count);
  omp_set_dynamic(0);
  omp_set_num_threads(count);
  (void)running_threads();
}

int n_threads() {
  return omp_get_max_threads();
}

int running_threads() {
  int n = 1;
#pragma omp parallel
#pragma omp single
  n = omp_get_num_threads();
  return n;
}

}  // namespace diptych::parallel
