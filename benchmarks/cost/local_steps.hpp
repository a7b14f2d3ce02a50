#pragma once
/// `diptych study CASE --local-steps`: what steps of powers of two, each node's by its own bound,
/// would save of a body, before anything is built for them.
///
/// A node may take steps of 1/rate_a, with its part rate_a = sum_b |C_ab| c / (2 Omega_a) of the
/// bound that the largest of all nodes sets for the whole body (notes 2.1; the speed c is that of
/// the undeformed body, the same everywhere). Its level is the largest k for which 2^k of the
/// smallest steps fit, lowered until the levels of neighbours differ by no more than one. A pair is
/// worked whenever either of its nodes steps, and then for both, so that momentum is conserved. The
/// ideal speed-up is that of the pairs, where the sweeps spend their time:
///   n_pairs / sum over pairs of 2^-min(k_a, k_b).
/// What it leaves out makes a real one smaller: sweeps over parts of a body, values of slow nodes
/// in between, steps that end together. Test: tests/harness/local_steps_test.cpp

#include "common/scheme/graph/pair_graph.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace diptych::harness {

struct LocalSteps {
  std::string variant, method;
  std::int64_t nodes = 0;
  double rate_ratio = 0;       ///< largest over smallest rate of a node
  std::vector<double> shares;  ///< [level] of the nodes
  double of_pairs = 1;         ///< ideal speed-up
  double of_nodes = 1;         ///< of work in proportion to nodes: n_nodes / sum of 2^-k
};

/// @param most_levels  that are told apart, >= 1: with 1 all nodes take the smallest step
LocalSteps local_steps(const scheme::PairGraph& graph, int most_levels);

/// Table for the terminal, at most 100 columns: the shares of the first levels, the rest together.
std::string local_steps_table(const std::vector<LocalSteps>& rows);
std::string local_steps_csv(const std::vector<LocalSteps>& rows);

}  // namespace diptych::harness
