#pragma once
/// Pair coefficients of a particle cloud: the corrected gradient of paper (19) (notes 3.1).

#include "common/scheme/graph/pair_graph.hpp"
#include "sph/kernels/kernel.hpp"

#include <vector>

namespace diptych::sph {

/// Fills graph.C with 2 Omega_a Omega_b K_a grad W_b(X_a), where
///   K_a = (sum_b Omega_b (X_b - X_a) (x) grad W_b(X_a))^-T and h_ab = (h_a + h_b)/2.
/// @param h [n_nodes] m
/// @throws base::InputError on a particle with fewer than d + 1 neighbours, or with all of them
///         in a plane (a line in 2-D): its number and place
void set_corrected_gradients(const Kernel& kernel,
                             const std::vector<double>& h,
                             scheme::PairGraph& graph);

}  // namespace diptych::sph
