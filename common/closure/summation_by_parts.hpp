#pragma once
/// Graphs that sum by parts, on any nodes: the least change of the C_ab, weighted with k_ab, such
/// that for all quadratics q and all linear stresses s
///   sum_b 1/2 q(X_b - X_a) C_ab      = Omega_a grad q(0)              rows
///   1/2 sum_b (s_a C_ab - s_b C_ba)  = Omega_a grad s - A_aN_a s_a    adjoint
/// Constant s is the closure of notes 3.3. Rows are met one by one; what is left are 1 + dimension
/// multipliers a node, the same system for the three components of the C_ab, which is solved by
/// preconditioned conjugate gradients. It has a solution only where volumes and areas agree about
/// cubics, as those of meshes::quadratic_measure do. In the end the closure alone is repaired to
/// rounding, and rows stay exact for linear fields to rounding.
/// Source: notes 4.5. Test: tests/graphs/summation_by_parts_test.cpp

#include "common/scheme/graph/pair_graph.hpp"

#include <cstdint>
#include <functional>
#include <vector>

namespace diptych::closure {

/// Part of Omega_a^((d-1)/d) by which an adjoint may miss its condition.
struct SummationLimits {
  double residual = 1e-4;
  int iterations = 1000;
};

/// What it took. Residuals are relative to Omega_a^((d-1)/d), greatest.
struct SummationByParts {
  double before = 0;
  double after = 0;
  int iterations = 0;
  std::vector<std::int32_t> undetermined;  ///< nodes whose neighbours determine no quadratic; where
                                           ///< there is one, nothing has been changed
  std::vector<std::int32_t> open;          ///< nodes whose adjoint misses its conditions in the end
};

/// @param k [n_pairs] weights > 0, k_ab = k_ba
/// @pre   rows and reverse pairs are linked; C holds what is to change least
/// @throws base::InputError where rows have too few neighbours, or the conditions are not met
SummationByParts make_sum_by_parts(scheme::PairGraph& graph,
                                   const std::vector<double>& k,
                                   const SummationLimits& limits = {});

/// Rows of derivatives or columns, of forces, that are out of proportion, V_a^(1/d)/Omega_a
/// 1/2 sum_b |C_ab| or the same of |C_ba| above 12, in the plane 10: those of lattices have 3 to 4,
/// of moved nodes and tetrahedra up to 10, while few neighbours that stand badly give hundreds, and
/// steps as much smaller; bodies whose columns have 14 are too stiff, too (notes 4.5).
/// @param V  [n_nodes] volumes of the nodes, shares of their cells
/// @return the nodes, the worst first
std::vector<std::int32_t> steep_rows(const scheme::PairGraph& graph, const std::vector<double>& V);

/// @throws base::InputError where there are steep rows, with the place of the worst
void require_no_steep_rows(const scheme::PairGraph& graph, const std::vector<double>& V);

/// A graph that is to change, and the weights of that.
struct WeightedGraph {
  scheme::PairGraph graph;
  std::vector<double> k;
};

/// Lets these rows reach further.
using Widen =
    std::function<void(const std::vector<std::int32_t>& rows, const scheme::PairGraph& graph)>;

/// A graph that sums by parts, with rows that reach further where neighbours do not determine a
/// quadratic, where the conditions are not met, or where rows or columns have 10 (in the plane 6),
/// as long as that lessens the largest: a few nodes of a body that stand badly are no reason for it
/// to do without, or to take several times the steps.
/// @param V           [n_nodes] volumes of the nodes, shares of their cells
/// @param most_times  that rows are widened
/// @throws base::InputError where conditions are not met then, or rows are steep
scheme::PairGraph summing_by_parts(const std::vector<double>& V,
                                   int most_times,
                                   const std::function<WeightedGraph()>& make,
                                   const Widen& widen);

}  // namespace diptych::closure
