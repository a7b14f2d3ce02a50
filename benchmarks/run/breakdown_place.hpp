#pragma once
/// Where a run broke down, from the state that the solver stopped in.
/// Test: tests/command_line/breakdown_test.cpp

#include "common/base/error.hpp"
#include "common/io/run_record.hpp"
#include "common/run/solver.hpp"

#include <cstdint>
#include <vector>

namespace diptych::harness {

/// Message, time, step, node and place of a breakdown: the node is that of the message, or else,
/// where a guard has stopped the run, the first one that is not finite, or that of least J.
/// @param step   that it broke down in, or after which a guard stopped it
/// @param order  [node] its number in the user's mesh, which the message has as well
io::RunFailure failure_of(const base::BreakdownError& error,
                          const run::Solver& solver,
                          const scheme::PairGraph& graph,
                          std::int64_t step,
                          const std::vector<std::int32_t>& order);

}  // namespace diptych::harness
