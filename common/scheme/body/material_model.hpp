#pragma once
/// The material of a body with its Maxwell branches and density, as everything but the inner loops
/// sees it: at one point, in double precision, and as functions compiled for blocks of eight nodes.
/// What is behind it is compiled once for each material (sweeps/compiled_material.hpp).

#include "common/physics/maxwell_branch.hpp"
#include "common/physics/viscous_evolution.hpp"
#include "common/scheme/body/body.hpp"
#include "common/scheme/budget/audit.hpp"

#include <vector>

namespace diptych::scheme {

class MaterialModel;
template <int Dim>
struct StrainRateSweep;
struct BlockTotals;

/// What is compiled of a material for one dimension.
template <int Dim>
struct BlockPhysics {
  /// The pointwise part of the strain-rate sweep for block b, dF/dt given.
  void (*evaluate)(const StrainRateSweep<Dim>& sweep,
                   std::int64_t b,
                   const algebra::Lanes (&L)[Dim * Dim],
                   BlockTotals& totals);
  /// Adds the energies of blocks [begin, end), and what their involutions lost.
  void (*add_energies)(const MaterialModel& model,
                       const Body<Dim>& body,
                       std::int64_t begin,
                       std::int64_t end,
                       Balance& sum);
};

using PointDeformation = physics::Deformation<double>;
using PointBranches = std::vector<physics::BranchState<double>>;  ///< A = C_v^-1, S = G_v^-1

class MaterialModel {
 public:
  virtual ~MaterialModel() = default;
  MaterialModel(const MaterialModel&) = delete;
  MaterialModel& operator=(const MaterialModel&) = delete;

  double rho_R() const { return rho_R_; }      ///< kg/m^3
  bool has_H() const { return has_H_; }        ///< W depends on H
  bool has_W_FJ() const { return has_W_FJ_; }  ///< F and J mix in W
  const std::vector<physics::MaxwellBranch>& branches() const { return branches_; }

  /// Energy of the material without branches  [Pa]
  virtual double energy(const PointDeformation& X) const = 0;
  /// Its derivatives.
  virtual physics::Response<double> response(const PointDeformation& X) const = 0;
  /// Its part that carries bulk pressure, U(J), with its derivatives  [Pa]
  virtual double volumetric_energy(double J) const = 0;
  virtual double volumetric_stress(double J) const = 0;
  virtual double volumetric_modulus() const = 0;  ///< U''(1)
  /// Replaces n values of J by U'(J).
  virtual void put_volumetric_stresses(double* J, std::int64_t n) const = 0;
  virtual BlockPhysics<2> in_plane() const = 0;
  virtual BlockPhysics<3> in_space() const = 0;

  /// With the branches in these states.
  double energy(const PointDeformation& X, const PointBranches& states) const;
  physics::Response<double> response(const PointDeformation& X, const PointBranches& states) const;
  /// First Piola-Kirchhoff stress (9)  [Pa]
  algebra::Tensor<double> stress(const PointDeformation& X, const PointBranches& states) const;
  /// Viscous dissipation (12)  [W/m^3]
  double dissipation(const PointDeformation& X, const PointBranches& states) const;
  /// Branches at A = S = I.
  PointBranches virgin() const;
  /// c_p of the undeformed, virgin body with all branches  [m/s]
  double undeformed_speed() const;

 protected:
  MaterialModel(double rho_R, std::vector<physics::MaxwellBranch> branches, bool H, bool W_FJ)
      : rho_R_(rho_R), branches_(std::move(branches)), has_H_(H), has_W_FJ_(W_FJ) {}

 private:
  double rho_R_;
  std::vector<physics::MaxwellBranch> branches_;
  bool has_H_, has_W_FJ_;
};

template <int Dim>
BlockPhysics<Dim> block_physics(const MaterialModel& model) {
  if constexpr (Dim == 2) {
    return model.in_plane();
  } else {
    return model.in_space();
  }
}

}  // namespace diptych::scheme
