#pragma once
/// Areas of the nodes on the sides of curved blocks that are on the boundary of the mesh,
/// -+ H_t M_d at the two ends of the lines of direction d (block_metrics.hpp). They close the body,
///   sum_a A_aN_a = 0,  sum_a X_a (x) A_aN_a = sum_a Omega_a I,
/// by themselves where the metrics do; else each share s becomes s + |s| [c + G (X - X_c)], least
/// c and G, which are of the order of the metrics (notes 4.6).
/// Test: tests/graphs/sbp_blocks_test.cpp

#include "common/scheme/graph/pair_graph.hpp"
#include "fvm/block_metrics.hpp"
#include "meshes/cell_walls.hpp"

#include <map>
#include <vector>

namespace diptych::fvm {

class BlockSides {
 public:
  explicit BlockSides(const meshes::Mesh& mesh);

  /// The sides of a block.
  void add(const BlockMetrics& metrics);
  /// Balances what was added and hands boundary_area and patches to the graph, whose volumes are
  /// known.
  void finish(scheme::PairGraph& graph);

 private:
  struct Share {
    std::int32_t node;
    const std::vector<int>* groups;
    algebra::Vec3 area;
  };

  const std::vector<int>* groups_of(const meshes::LatticeBlock& block, int d, bool is_far) const;
  void balance(double volume);

  const meshes::Mesh& mesh_;
  std::map<meshes::FaceKey, std::vector<int>> groups_;
  std::vector<Share> shares_;
};

}  // namespace diptych::fvm
