#pragma once
/// A lattice of nodes along whose lines derivatives sum by parts, whose volumes of nodes may carry
/// the bulk pressure in place of the J of nodes (notes 3.10).

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace diptych::scheme {

/// The derivative along a line, in units of its spacing:
///   (D v)_i = sum_j Q_ij (v_j - v_i) / H_i,   Q_ji = -Q_ij for i != j.
struct LineDerivative {
  struct Entry {
    int place;
    double Q;
  };
  std::vector<std::vector<Entry>> row;  ///< [places of the line] without the diagonal
  std::vector<double> H;                ///< [places of the line]
};

struct VolumeLines {
  std::vector<LineDerivative> along;               ///< [dimension]
  std::vector<std::array<std::int32_t, 3>> place;  ///< [n_nodes] on the lines of each direction
  std::vector<std::int32_t> node;  ///< [places of the lattice] first direction fastest
  double cell = 0;                 ///< volume of a cell of the lattice  [m^d]

  bool empty() const { return along.empty(); }
  std::int32_t node_at(const std::array<std::int32_t, 3>& at) const {
    std::int64_t index = 0;
    for (std::size_t d = along.size(); d-- > 0;)
      index = index * static_cast<std::int64_t>(along[d].H.size()) + at[d];
    return node[static_cast<std::size_t>(index)];
  }
};

}  // namespace diptych::scheme
