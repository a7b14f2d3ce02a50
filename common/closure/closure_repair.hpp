#pragma once
/// Closure repair: the least change of the C_ab after which
///   -1/2 sum_b (C_ab - C_ba) = A_a N_a                                   (notes 3.3)
/// holds at every node, while every row stays exact for linear fields. Serves both factories.
///
/// The least weighted change sum |dC_ab|^2 / k_ab of all with the row condition
/// sum_b (X_b - X_a) (x) dC_ab = 0 is
///   dC_ab = 1/2 k_ab [lambda_b - lambda_a - (grad lambda)_a (X_b - X_a)],
/// with grad lambda the k-weighted linear fit over the row of a. lambda solves S y = r with
/// S = B K P B^T symmetric positive semi-definite by
/// conjugate gradients from zero. The null space of S holds all affine fields: a solution exists
/// only where sum_a A_aN_a = 0 and sum_a X_a (x) A_aN_a = sum_a Omega_a I (exact dual measure).
/// Test: tests/graphs/closure_repair_test.cpp.

#include "common/scheme/graph/pair_graph.hpp"

#include <vector>

namespace diptych::closure {

/// What a repair did. Closure is that of quality(): relative to Omega_a^((d-1)/d), greatest.
struct ClosureRepair {
  double before = 0;
  double after = 0;
  int iterations = 0;  ///< conjugate gradient steps in all
};

struct RepairLimits {
  double closure = 2e-13;  ///< stop below this; where it cannot be reached, `after` says so
  int iterations = 3000;
};

/// @param k [n_pairs] weights > 0, k_ab = k_ba
/// @pre   rows and reverse pairs are linked; every row spans the space
ClosureRepair repair_closure_pairs(scheme::PairGraph& graph,
                                   const std::vector<double>& k,
                                   const RepairLimits& limits = {});

}  // namespace diptych::closure
