#pragma once
/// Pseudo-areas of SPH on a lattice that sum by parts: the least change of SPH's own
/// C_ab = 2 Omega_a Omega_b grad W_ab, weighted with Omega_a Omega_b W_ab, such that
///   rows are exact for quadratics,      sum_b 1/2 q(X_b - X_a) C_ab = Omega_a grad q(0),
///   the adjoint for linear stresses,    1/2 sum_b (s_a C_ab - s_b C_ba) = Omega_a grad s - A_aN_a
///   s_a.
/// Constant s is the closure of notes 3.3. In lattice coordinates, in which all lattices are alike,
/// C_ab depends on the offset X_b - X_a and on how far a is from the sides that both nodes are near
/// to: within `layers` nodes of a side rows are of their own, elsewhere they are those of the
/// inside. On lines with fewer than 2 layers nodes every place has rows of its own, those of one
/// half the mirror images of the other's. Volumes and areas are products of the weights 3/8, 7/6,
/// 23/24, 1, ... of a line (Gregory), which are exact for cubics.
///
/// The conditions can be met with rows of a bounded layer only where the rows inside are exact for
/// cubics, too: the sum over all nodes of Omega_a times the error of grad x^3 is the difference of
/// two sums over the boundary, whatever the number of nodes. So the rows inside are changed first,
/// then those of sides, edges and corners in one system.
/// Source: notes 4.4. Test: tests/graphs/sph_sbp_test.cpp

#include "common/algebra/vectors.hpp"
#include "sph/kernels/kernel.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace diptych::sph {

using algebra::Vec3;
using LatticeOffset = std::array<int, 3>;

/// Nodes beside a side whose rows are of their own.
constexpr int lattice_layers = 3;

/// Weight of node i of a line of n nodes, in spacings.
double lattice_weight(int i, int n);

/// First components of the C_ab of one lattice, in units of the spacing.
class LatticeRows {
 public:
  /// @param n  nodes along the directions; 1 along the third in the plane
  /// @throws base::InputError where the support or the lattice is too small for the conditions
  LatticeRows(const Kernel& kernel,
              double kappa,
              const std::vector<LatticeOffset>& offsets,
              const std::array<int, 3>& n);

  /// @param node  counted from the near ends of long lines; node + offset is on the lattice, the
  ///              offset among `offsets`
  double C(const LatticeOffset& node, const LatticeOffset& offset) const;

 private:
  friend class LatticeConditions;

  /// Where a component is kept: rows inside and in the middle of a short line are mirror images of
  /// themselves, those beyond that middle of others.
  struct Slot {
    size_t at = 0;
    double sign = 1;  ///< 0: it is zero by that symmetry
  };
  bool is_long(int d) const;
  /// Of places along a direction: the inside of long lines the last; half of a short line.
  int n_kinds(int d) const;
  bool is_own_mirror_image(const LatticeOffset& kind, int d) const;
  std::vector<LatticeOffset> kinds() const;
  /// Places that are common to both ends of a pair: below the sides that both are near to, else the
  /// inside. @param node  of a long line: below its near side
  LatticeOffset common_kind(const LatticeOffset& node, const LatticeOffset& offset) const;
  bool is_inside(const LatticeOffset& kind) const;
  double weight_at(int d, int place) const;
  /// @param place  a kind, or beyond the middle of a short line
  Slot slot(const LatticeOffset& place, const LatticeOffset& offset) const;
  size_t first_of(const LatticeOffset& kind) const;
  void number_offsets();
  size_t place_in_table(const LatticeOffset& offset) const;
  void set_inside(const Kernel& kernel, double kappa);

  std::vector<LatticeOffset> offsets_;
  int reach_ = 0;             ///< largest component of an offset
  std::vector<int> numbers_;  ///< of the offsets in the cube of this reach; else how many there are
  std::array<int, 3> n_;
  std::vector<double> weight_;  ///< [kinds][offsets] of a change
  std::vector<double> C_;       ///< [kinds][offsets]
};

class LatticeOperator {
 public:
  /// @param kappa  smoothing length over spacing
  /// @throws base::InputError where the support or the lattice is too small for the conditions
  LatticeOperator(const Kernel& kernel, double kappa, const std::array<int, 3>& n);

  /// Those within the support, without zero: the neighbours of every node, where they exist.
  const std::vector<LatticeOffset>& offsets() const { return offsets_; }
  /// C_ab in units of the spacing. @pre both nodes are on the lattice
  Vec3 C(const LatticeOffset& place, const LatticeOffset& offset) const;

 private:
  std::vector<LatticeOffset> offsets_;
  std::array<int, 3> n_;
  std::vector<LatticeRows> rows_;        ///< with direction d in place of the first
  std::array<int, 3> rows_of_{0, 0, 0};  ///< of direction d, among rows_
};

}  // namespace diptych::sph
