#pragma once
/// How far a pair graph is from closure, for its repairs (closure_repair.hpp).

#include "common/closure/conjugate_gradients.hpp"
#include "common/scheme/graph/pair_graph.hpp"

namespace diptych::closure {

/// What is missing: A_aN_a + 1/2 sum_b (C_ab - C_ba)  [n_nodes]
Field closure_gap(const scheme::PairGraph& graph);

/// The same of the nodes whose rows, or those of whose neighbours, have changed.
void update_closure_gap(const scheme::PairGraph& graph,
                        const std::vector<char>& changed,
                        Field& gap);

/// 1 / Omega_a^((d-1)/d), the unit of a node's closure.
std::vector<double> area_units(const scheme::PairGraph& graph);

}  // namespace diptych::closure
