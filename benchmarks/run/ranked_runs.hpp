#pragma once
/// Runs among ranks. Rank 0 is the program that the user sees: it reads the command line, decides,
/// prints and writes. The other ranks make the scenes that it makes, from the text of the case, and
/// work their part of them. Test: tests/ranks

#include "benchmarks/run/run_case.hpp"
#include "benchmarks/run/scene.hpp"

namespace diptych::harness {

/// The scene of a run; where there are several ranks, on all of them, its solver divided.
/// Its graph has no pairs any more.
/// @param made  of this rank; may be empty
/// @throws as Scene does; base::Error where another rank could not make it
std::unique_ptr<Scene> scene_of_run(const cases::Case& setup,
                                    const RunOptions& options,
                                    const PartMade& made = {});

/// Memory of the rank that has most, before the first step; nothing where there is one.
void note_memory(const Scene& scene, io::RunSummary& summary);

/// What the ranks have done for the run; nothing where there is one.
void note_ranks(const Scene& scene, io::RunSummary& summary);

/// Whether this process is another rank than 0.
bool is_following();

/// Makes and works what rank 0 asks for, to its end. What this rank alone meets ends all.
/// @return 0
int follow_runs();

/// Of rank 0: at the end of its lifetime the others end too.
class LedRuns {
 public:
  LedRuns() = default;
  LedRuns(const LedRuns&) = delete;
  LedRuns& operator=(const LedRuns&) = delete;
  ~LedRuns();
};

}  // namespace diptych::harness
