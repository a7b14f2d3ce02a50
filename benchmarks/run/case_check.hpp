#pragma once
/// What `diptych check` tells of a case without running it.

#include "common/cases/case.hpp"
#include "common/scheme/graph/pair_graph.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace diptych::harness {

struct CaseCheck {
  std::int64_t nodes = 0, cells = 0, pairs = 0, steps = 0;
  std::int64_t bytes = 0;           ///< arrays of the solver
  std::int64_t running_bytes = 0;   ///< resident set once the solver stands
  std::int64_t building_bytes = 0;  ///< largest resident set until then
  double estimated_bytes = 0;       ///< of that, from the case alone
  double setup_seconds = 0;         ///< until the solver stood
  double seconds = 0;               ///< of all steps, as the first ones went; without output
  double dt = 0;                    ///< s, of the first step
  scheme::GraphQuality quality;
  std::string operators;             ///< see CaseGraph
  std::vector<std::string> notices;  ///< see CaseGraph
};

/// Builds mesh, graph and solver, and makes two steps at least.
/// @param timing  for how long steps are made, for their mean time  [s]
CaseCheck check_case(const cases::Case& setup,
                     const std::string& method,
                     int level,
                     double timing = 0.5);

}  // namespace diptych::harness
