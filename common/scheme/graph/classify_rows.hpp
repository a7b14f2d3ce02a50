#pragma once
/// Finding the rows of a pair graph that are translates of each other (row_classes.hpp).
/// Test: tests/common/scheme/row_classes_test.cpp

#include "common/scheme/graph/pair_graph.hpp"

namespace diptych::scheme {

/// @pre rows and reverse pairs are linked
RowClasses classify_rows(const PairGraph& graph);

/// For a factory, at its end: fills graph.classes if rows stand in their common order.
void set_classes(PairGraph& graph);
/// The same where they are known to stand in it.
/// @param alike  groups of rows that are known to be equal
void set_classes(PairGraph& graph, const EqualGroups& alike);

/// Those of the factory, or found now.
RowClasses classes_of(const PairGraph& graph);

/// The pair of the representative that stands for pair p of node a.
inline std::int64_t shared_place(const PairGraph& graph,
                                 const RowClasses& classes,
                                 std::int64_t a,
                                 std::int64_t p) {
  const std::int64_t k = classes.place_of(graph.row[a], p);
  return classes.pair(graph.row[classes.rows.representative[classes.rows.of[a]]], k);
}

/// C_ab of pair p of node a with the bits of the representative: what sweeps use on both sides of a
/// pair, so that strain rates and forces stay exactly dual.
inline const Vec3& shared_C(const PairGraph& graph,
                            const RowClasses& classes,
                            std::int64_t a,
                            std::int64_t p) {
  return graph.C[shared_place(graph, classes, a, p)];
}

/// Nodes whose rows are of the same class and, in the common order, those of their neighbours too.
/// @param numbering  the neighbours are also as far away in the numbering
EqualGroups group_by_neighbours(const PairGraph& graph, const RowClasses& classes, bool numbering);

}  // namespace diptych::scheme
