#pragma once
/// The cells between the nodes of a graph, whose deformed volumes may carry the bulk pressure in
/// place of the J of nodes (notes 3.9).

#include <cstdint>
#include <vector>

namespace diptych::scheme {

/// Cells with the corner order of Gmsh; how many corners a cell has says what it is: 3 a triangle,
/// 4 a quadrilateral (2-D) or a tetrahedron, 6 a prism, 8 a hexahedron.
struct VolumeCells {
  std::vector<std::int64_t> row;     ///< [n_cells + 1] into corner and share
  std::vector<std::int32_t> corner;  ///< nodes, cell after cell
  std::vector<double> share;  ///< of the cell's volume that is each corner's; their sum is one

  bool empty() const { return corner.empty(); }
  std::int64_t n_cells() const {
    return row.empty() ? 0 : static_cast<std::int64_t>(row.size()) - 1;
  }
};

}  // namespace diptych::scheme
