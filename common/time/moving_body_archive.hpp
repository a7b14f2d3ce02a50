#pragma once
/// All that later steps of a moving body read, kept in an archive and taken from it to the last
/// bit: unknowns, what neighbours read of them, forces, clock, audit, boundary, results of the last
/// sweeps. Fields of the beginning of a step are not among it: each step writes them before it
/// reads them. Test: tests/common/run/restart_test.cpp

#include "common/algebra/archive.hpp"
#include "common/time/moving_body.hpp"

namespace diptych::time {

/// Where it was loading, all ranks call Sweeps::remember_forces() next.
/// @pre where it is loading: the body is that of the same case on the same graph
/// @throws base::InputError where it is loading what does not fit
template <int Dim>
void archive(MovingBody<Dim>& moving, algebra::Archive& archive);

}  // namespace diptych::time
