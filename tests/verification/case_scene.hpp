#pragma once
/// A shipped case on one method, stepped by hand: fixed steps for orders in time, where the mesh
/// and with it the error in space stay the same.

#include "benchmarks/run/case_list.hpp"
#include "common/parallel/for_chunks.hpp"
#include "tests/common/scheme/scenes.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace diptych::tests {

/// Lets a test choose its own steps.
inline const std::string any_step = "time.cfl=10";

/// One thread: these scenes have a few dozen nodes.
inline Scene scene_of_case(const std::string& method,
                           const std::string& name,
                           const std::vector<std::string>& overrides,
                           int level = 0) {
  parallel::set_threads(1);
  return {method, cases::read_case(harness::find_case(name), overrides), level};
}

/// n equal steps from 0 to end.
inline void make_steps(run::Solver& solver, double end, int n) {
  for (int k = 1; k <= n; ++k)
    solver.step(end * k / n);
}

/// key="text" for the overrides of a case.
inline std::string text_of(const std::string& key, const std::string& text) {
  return key + "=\"" + text + "\"";
}

/// Relative L2 distance of velocities or of deformations, the larger of both.
inline double distance(const scheme::Snapshot& a, const scheme::Snapshot& b) {
  double v = 0, v_scale = 0, F = 0, F_scale = 0;
  for (size_t k = 0; k < b.v.size(); ++k) {
    v += (a.v[k] - b.v[k]).squaredNorm();
    v_scale += b.v[k].squaredNorm();
    F += (a.F[k] - b.F[k]).squaredNorm();
    F_scale += (b.F[k] - run::Mat3::Identity()).squaredNorm();
  }
  return std::max(std::sqrt(v / v_scale), std::sqrt(F / F_scale));
}

/// Least eigenvalue of all internal variables C_v^-1, G_v^-1.
inline double least_internal_eigenvalue(const scheme::Snapshot& state) {
  double least = 1e300;
  for (const auto* field : {&state.A, &state.S}) {
    for (const auto& branch : *field) {
      for (const auto& M : branch) {
        const Eigen::SelfAdjointEigenSolver<run::Mat3> spectrum(M, Eigen::EigenvaluesOnly);
        least = std::min(least, spectrum.eigenvalues()[0]);
      }
    }
  }
  return least;
}

}  // namespace diptych::tests
