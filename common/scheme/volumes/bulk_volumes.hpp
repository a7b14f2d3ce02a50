#pragma once
/// Volumes of nodes whose energy sum_a V_a(X) U(J_a) carries the bulk pressure in place of that of
/// the J that nodes evolve (notes 3.9, 3.10). J_a is a function of the positions alone, and the
/// forces are the derivatives of that energy, so momentum, angular momentum and energy are kept by
/// construction. Here: what all such volumes share. Test: tests/common/scheme/volumes_test.cpp

#include "common/algebra/field.hpp"
#include "common/algebra/vectors.hpp"
#include "common/parallel/halo.hpp"
#include "common/scheme/graph/pair_graph.hpp"

#include <cstdint>
#include <memory>
#include <vector>

namespace diptych::scheme {

/// What carries the bulk pressure: J of the nodes; volumes of cells; volumes by derivatives along
/// lines of nodes; or what is safe (safe_volumes).
enum class Volumes { automatic, nodes, cells, lines };

/// What is safe for bulk pressure: J of the nodes where the derivatives of a graph commute, else
/// volumes of lines, else of cells, else nothing: nodes. A graph of a scene in which little presses
/// comes without lines and cells that would not err less.
Volumes safe_volumes(const PairGraph& graph);

class MaterialModel;
template <int Dim>
struct Body;

/// Blocks of cells of a group that a rank works: those around its nodes, segment by segment.
struct CellWork {
  std::vector<std::vector<parallel::NodeRange>> segments;  ///< [n_segments] ranges of blocks
};

template <int Dim>
class BulkVolumes {
 public:
  virtual ~BulkVolumes() = default;

  virtual std::int64_t bytes() const = 0;
  /// Volume of node a in the reference state  [m^Dim]
  double reference(std::int64_t a) const { return V_0_[a]; }

  /// What a rank works, by group of cells.
  /// @param read  [n_nodes] set to 1 where the work of this rank reads a node
  virtual std::vector<CellWork> work_of(const parallel::Part& part,
                                        std::vector<char>& read) const = 0;

  /// Forces of the pressure U'(J_a) of the material for the displacements as they stand, and those
  /// of what cells carry of the shear (BodyOptions::cell_shear).
  virtual void evaluate(const Body<Dim>& body, const MaterialModel& material) = 0;

  /// The same linearised: forces of modulus (dV_a/V_a), dV_a the change of volume with the body's
  /// velocities in the place of a change of displacement, and those of the modulus `shear` by
  /// gradients of cells [both moduli in the same unit]. For the frequencies of set-up.
  virtual void evaluate_linear(const Body<Dim>& body, double modulus, double shear) = 0;

  /// Forces of what was evaluated last to body.T.
  void add_forces(Body<Dim>& body) const;

  /// Power of what was evaluated last with the velocities as they are now  [W]
  double power(const Body<Dim>& body) const;

  /// What cells carry of the shear energy: by chunks of nodes, added to `sums`  [J]
  virtual void add_shear_energies(const Body<Dim>&, std::vector<double>&) const {}

  /// J of the nodes by these volumes, among ranks of the own ones  [n_nodes]
  virtual std::vector<double> ratios(const Body<Dim>& body) const = 0;

  /// Shares of a patch's nodes in its deformed area, as a uniform pressure of these volumes
  /// balances it; among ranks of the own ones.  [patch.nodes] m^(Dim-1)
  virtual std::vector<algebra::Vec3> deformed_areas(const Body<Dim>& body,
                                                    const BoundaryPatch& patch) = 0;

 protected:
  using Array = algebra::AlignedArray<double>;
  /// Length of a row of positions: one gather.
  static constexpr int stride = 4;

  explicit BulkVolumes(std::int64_t n_nodes);
  std::int64_t n_nodes() const { return n_nodes_; }
  /// Positions of the deformed body, and of other ranks' nodes what this one reads.
  void put_positions(const Body<Dim>& body, Array& x) const;
  /// What neighbours of its nodes have in rows of n numbers, from their ranks.
  void exchange(const Body<Dim>& body, Array& values, int n) const;
  Array V_0_;    ///< [n_nodes, padded] m^Dim
  Array x_;      ///< [n_nodes, padded][4] m, deformed positions
  Array force_;  ///< [n_nodes, padded][4] N

 private:
  std::int64_t n_nodes_ = 0;
};

/// Of a graph; null where nodes carry the pressure.
/// @param with_shear  cells carry a part of the shear, too (notes 3.11)
/// @pre volumes is resolved, and the graph has what it takes
template <int Dim>
std::unique_ptr<BulkVolumes<Dim>> make_bulk_volumes(const PairGraph& graph,
                                                    Volumes volumes,
                                                    bool with_shear);

extern template class BulkVolumes<2>;
extern template class BulkVolumes<3>;

}  // namespace diptych::scheme
