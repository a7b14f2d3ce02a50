#pragma once
/// Volumes and areas of the nodes of an undistorted block whose lines have weights H of their own:
/// with the edges e_1, e_2, e_3 of a cell, M_1 = e_2 x e_3 and cyclic, V = e_1 . M_1, and i, j, k
/// the places of a node on its lines,
///   Omega = V H_i H_j H_k,  A_aN_a = -+ H_j H_k M_1 at the two ends of the lines, and cyclic.
/// A boundary group that covers a part of a side has, at its edge, the part of H of its faces:
/// exact where that is no nearer to the edge of the side than weights differ from one; else it is
/// refused. Source: notes 4.3. Tests: tests/graphs/sbp_graph_test.cpp,
/// tests/graphs/sph_sbp_test.cpp

#include "meshes/dual_measure.hpp"
#include "meshes/structured_block.hpp"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace diptych::meshes {

class BlockMeasure {
 public:
  /// @param H  [dimension][n_nodes of the direction] weights, in units of the spacing
  /// @throws base::InputError where the block is distorted
  BlockMeasure(const Mesh& mesh,
               StructuredBlock block,
               std::vector<std::vector<double>> H,
               BlockUse use);

  const StructuredBlock& block() const { return block_; }
  const Mat3& edges() const { return edges_; }  ///< of a cell, as columns  [m]
  double volume(std::int64_t a) const;          ///< m^d
  /// M_d times the weights of the other directions: pseudo-area of node a per unit of Q.
  Vec3 area(std::int64_t a, int d) const;
  /// M_d  [m^(d-1)]: what a unit vector along the lines of direction d becomes in pseudo-areas.
  Vec3 face(int d) const;
  Vec3 boundary_area(std::int64_t a) const;  ///< A_a N_a over all sides  [m^(d-1)]
  /// @throws base::InputError where a part of a side ends inside its boundary block
  PatchArea patch(const BoundaryGroup& group) const;
  /// The first group of the mesh of which patch() throws, for a message; empty: none.
  std::string unfit_group() const;

 private:
  /// One of the two ends of the lines of a direction.
  struct Side {
    int direction = 0;
    bool is_far = false;
  };

  /// Where a group ends inside a side, and what weights make of the way to there.
  struct GroupEnd {
    std::int32_t node = 0;  ///< along the lines
    double weights = 0;     ///< in spacings
  };

  Side side_of(const BoundaryFace& face) const;
  double n_faces_on_side(std::int32_t a, const Side& side) const;
  /// The first end of the group where the weights before it are not the spacings before it.
  std::optional<GroupEnd> unfit_end(const BoundaryGroup& group) const;
  double weights_before(int direction, std::int32_t node) const;

  const Mesh& mesh_;
  StructuredBlock block_;
  std::vector<std::vector<double>> H_;
  BlockUse use_;
  Mat3 edges_;
};

}  // namespace diptych::meshes
