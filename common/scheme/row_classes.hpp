#pragma once
/// Rows of a pair graph that are translates of each other: their pairs have the same X_b - X_a and
/// the same C_ab up to rounding. One row stands for all of a class, so that sweeps can keep one
/// copy of the geometry for all of them. On a box of hexahedra finite volumes have 27 classes,
/// whatever the number of nodes; on a disordered graph every row is a class of its own. Test:
/// tests/common/scheme/row_classes_test.cpp

#include "common/scheme/equal_groups.hpp"
#include "common/scheme/pair_graph.hpp"

namespace diptych::scheme {

struct RowClasses {
  EqualGroups rows;  ///< of nodes
  /// Pairs of a row have a common order, ascending in X_b - X_a (third component first): the same
  /// in all rows of a class and for every numbering of the nodes. Both are [n_pairs], places in the
  /// row, or empty where all rows stand in that order, as those of lattices do.
  std::vector<std::int32_t> order;  ///< of the common order: where the pair stands
  std::vector<std::int32_t> place;  ///< of the pair: where it comes in the common order

  /// Pair k of node a in the common order.
  std::int64_t pair(const PairGraph& graph, std::int64_t a, std::int64_t k) const {
    const std::int64_t first = graph.row[a];
    return first + (order.empty() ? k : order[first + k]);
  }
  /// Where pair p of node a comes in the common order.
  std::int64_t place_of(const PairGraph& graph, std::int64_t a, std::int64_t p) const {
    return place.empty() ? p - graph.row[a] : place[p];
  }
  /// C_ab of pair p of node a with the bits of the representative: what sweeps use on both sides of
  /// a pair, so that strain rates and forces stay exactly dual.
  const Vec3& C(const PairGraph& graph, std::int64_t a, std::int64_t p) const {
    return graph.C[pair(graph, rows.representative[rows.of[a]], place_of(graph, a, p))];
  }
};

/// @pre rows and reverse pairs are linked
RowClasses classify_rows(const PairGraph& graph);

/// Nodes whose rows are of the same class and, in the common order, those of their neighbours too.
/// @param numbering  the neighbours are also as far away in the numbering
EqualGroups group_by_neighbours(const PairGraph& graph, const RowClasses& classes, bool numbering);

}  // namespace diptych::scheme
