#pragma once
/// Rows of a pair graph that are translates of each other: their pairs have the same X_b - X_a and
/// the same C_ab up to rounding. They get the same bits, so that sweeps can keep one copy of the
/// geometry for all of them. On a box of hexahedra finite volumes have 27 classes, whatever the
/// number of nodes; on a disordered graph every row is a class of its own.
/// Test: tests/common/scheme/row_classes_test.cpp

#include "common/scheme/equal_groups.hpp"
#include "common/scheme/pair_graph.hpp"

namespace diptych::scheme {

struct RowClasses {
  EqualGroups rows;  ///< of nodes
  /// [n_pairs] the pairs of each row in ascending order of X_b - X_a (third component first): the
  /// same order in all rows of a class, and for every numbering of the nodes.
  std::vector<std::int64_t> order;
  /// [n_pairs] C_ab with the bits of the representative: what sweeps use on both sides of a pair,
  /// so that strain rates and forces stay exactly dual.
  std::vector<Vec3> C;
};

/// @pre rows and reverse pairs are linked
RowClasses classify_rows(const PairGraph& graph);

}  // namespace diptych::scheme
