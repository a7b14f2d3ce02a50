#pragma once
/// What `diptych material` prints and writes of a path.

#include "benchmarks/material/material_path.hpp"
#include "common/cases/case.hpp"

#include <string>
#include <vector>

namespace diptych::harness {

/// What work, stored and dissipated energy of a path are out of balance by, as a share of the
/// largest of them: an error of steps, or of a stress that is no derivative of the energy.
double energy_residual(const std::vector<PathPoint>& points);

/// A dozen instants, the dynamic moduli of an oscillation, and the scan.
std::string path_table(const cases::Case& setup,
                       const MaterialPath& path,
                       const std::vector<PathPoint>& points,
                       const HyperbolicityScan& scan);

/// All instants: time, a, F, P, A and S of every branch, energy, dissipation, work.
std::string path_csv(const std::vector<PathPoint>& points);

/// Hysteresis loop, and stresses over time.
std::string path_svg(const cases::Case& setup,
                     const MaterialPath& path,
                     const std::vector<PathPoint>& points);

}  // namespace diptych::harness
