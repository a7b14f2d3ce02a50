#pragma once
/// What a frame of run.hdf.series shows of a state. Test: tests/command_line/verbs_test.cpp

#include "common/io/field_writer.hpp"
#include "common/run/solver.hpp"

#include <cstdint>
#include <vector>

namespace diptych::harness {

/// Displacement, velocity, F, P, J and pressure at every node.
/// @param order  [node] its number in the user's mesh, which frames keep
std::vector<io::NodeField> frame_fields(const run::Snapshot& state,
                                        const std::vector<std::int32_t>& order);

}  // namespace diptych::harness
