#pragma once
/// How many threads a run has: as many as were asked for, or what the environment and the machine
/// leave it. Test: tests/common/parallel/threads_test.cpp

namespace diptych::parallel {

/// Nobody has more; what asks for more is a slip of the keyboard. More than there are processors
/// are allowed: the result is the same, only later.
inline constexpr int most_threads = 1024;

/// The count to use: `asked`, or where that is 0 the least of OMP_NUM_THREADS, OMP_THREAD_LIMIT and
/// the processors that the process may keep busy, of which ranks on one machine have a share each.
/// @throws base::InputError where `asked` is negative, more than most_threads or more than
///         OMP_THREAD_LIMIT
int thread_count(int asked);

/// Threads that a parallel loop has now, counted in one.
int running_threads();

}  // namespace diptych::parallel
