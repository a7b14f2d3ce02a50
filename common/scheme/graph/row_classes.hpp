#pragma once
/// Rows of a pair graph that are translates of each other: their pairs have the same X_b - X_a and
/// the same C_ab up to rounding. One row stands for all of a class, so that sweeps can keep one
/// copy of the geometry for all of them. On a box of hexahedra finite volumes have 27 classes,
/// whatever the number of nodes; on a disordered graph every row is a class of its own.

#include "common/scheme/graph/equal_groups.hpp"

namespace diptych::scheme {

struct RowClasses {
  EqualGroups rows;  ///< of nodes
  /// Pairs of a row have a common order, ascending in X_b - X_a (third component first): the same
  /// in all rows of a class and for every numbering of the nodes. Both are [n_pairs], places in the
  /// row, or empty where all rows stand in that order, as those of lattices do.
  std::vector<std::int32_t> order;  ///< of the common order: where the pair stands
  std::vector<std::int32_t> place;  ///< of the pair: where it comes in the common order

  /// Pair k in the common order of the row that begins at `first`.
  std::int64_t pair(std::int64_t first, std::int64_t k) const {
    return first + (order.empty() ? k : order[first + k]);
  }
  /// Where pair p of that row comes in the common order.
  std::int64_t place_of(std::int64_t first, std::int64_t p) const {
    return place.empty() ? p - first : place[p];
  }
};

}  // namespace diptych::scheme
