#pragma once
/// Closure repair of graphs with few kinds of rows, such as SPH on a lattice: rows that are equal
/// stay equal, so that sweeps keep their geometry once (row_classes.hpp) and it stays in the cache.
///
/// All rows of a class get the same change; nodes whose neighbours are of the same classes have the
/// same condition of closure. So there are unknowns per class of rows c and pair k of it,
/// conditions per kind of node e, however many nodes:
///   least sum |dC_ck|^2 / k_ck  with  sum_k X_ck (x) dC_ck = 0  and
///   1/2 sum_b (dC_ab - dC_ba) = -gap_e for a node a of each kind e.
/// Where every row is a class of its own this is the repair by pairs of closure_repair.hpp.
/// Rows of classes that occur inside, at nodes without a gap, are left as they are: the repair
/// stays near the boundary, while the repair by pairs spreads a smooth change over the body, of
/// first order in the spacing (swinging cube with face correction, kappa 1.2, 1/16 to 1/32: order
/// of u 1.0 by pairs, 2.8 by classes).
///
/// With z_ck = 1/2 (sum of y_e over the nodes a that have the pair - sum of y_e over the nodes b at
/// its other end), dC_ck = k_ck (z_ck - X_ck . M_c^+ sum_k k_ck X_ck (x) z_ck), M_c the second
/// moments: a dense system S y = -gap with as many unknowns as kinds of nodes.
/// Test: tests/graphs/closure_repair_test.cpp

#include "common/closure/closure_repair.hpp"

#include <functional>

namespace diptych::closure {

/// k_ab > 0 of pair p of node a. Asked for one row of each class only.
using PairWeight = std::function<double(std::int64_t a, std::int64_t p)>;

/// Leaves the graph as it is, up to rounding, where its rows are of too many classes, or cannot
/// close it this way.
/// @return whether the graph is closed to within the limit now
/// @pre   rows and reverse pairs are linked
bool repair_closure_by_classes(scheme::PairGraph& graph,
                               const PairWeight& k,
                               const RepairLimits& limits = {});

}  // namespace diptych::closure
