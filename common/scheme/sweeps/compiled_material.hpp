#pragma once
/// The pointwise physics of one material, compiled for blocks of eight nodes: part of the
/// strain-rate sweep and of the energy budget. Included by the file of each material (run/models)
/// and by tests.

#include "common/algebra/positive_lanes.hpp"
#include "common/algebra/versions.hpp"
#include "common/physics/wave_speeds.hpp"
#include "common/scheme/body/material_model.hpp"
#include "common/scheme/body/model.hpp"
#include "common/scheme/body/pointwise.hpp"
#include "common/scheme/sweeps/pair_access.hpp"
#include "common/scheme/sweeps/strain_rates.hpp"
#include "common/scheme/sweeps/update.hpp"

namespace diptych::scheme {

/// Fills the records of block b, but for L, and for H where it is evolved, which are there.
template <int Dim>
DIPTYCH_INLINE void write_records(Body<Dim>& body,
                                  std::int64_t b,
                                  const Deformation<Lanes>& X,
                                  const Response<Lanes>& response,
                                  const Tensor<Lanes>& P) {
  using Record = NodeRecord<Dim>;
  const bool exact_impedance = body.options.exact_impedance;
  if (!body.in_runs()) {
    for (int i = 0; i < Dim; ++i)
      body.records.put(b, Record::v(exact_impedance) + i, body.v.get(b, i));
  }
  if (body.options.face_correction) {
    put_tensor<Dim>(body.stresses, b, 0, P);  // P' follows in a sweep of its own
  } else {
    put_tensor<Dim>(body.records, b, Record::P, P);
  }
  if (body.options.unknowns != Unknowns::FHJ) put_tensor<Dim>(body.records, b, Record::H, X.H, 1);
  if (!exact_impedance) return;
  put_tensor<Dim>(body.records, b, Record::F, X.F, 1);
  for (int k = 0; k < algebra::Layout<Dim>::n_A; ++k) {
    body.records.put(b, Record::A_tot + k, response.A_tot.s[algebra::order_of_A<Dim>[k]]);
  }
  for (int k = 0; k < algebra::Layout<Dim>::n_S; ++k) {
    body.records.put(b, Record::S_tot + k, response.S_tot.s[algebra::order_of_S<Dim>[k]]);
  }
  body.records.put(b, Record::W_JJ, response.W_JJ);
  body.records.put(b, Record::W_FJ, response.W_FJ);
}

/// v . T + Omega P : L of block b with the forces and stresses of the evaluation before.
template <int Dim>
DIPTYCH_INLINE double power_of_old_forces(const Body<Dim>& body,
                                          std::int64_t b,
                                          const Lanes (&L)[Dim * Dim]) {
  Tensor<Lanes> P = body.options.face_correction
                        ? get_tensor<Dim>(body.stresses, b, 0)
                        : get_tensor<Dim>(body.records, b, NodeRecord<Dim>::P);
  if (body.options.has_moments) {
    const Tensor<Lanes> N = get_tensor<Dim>(body.moments, b, 0);
    for (int k = 0; k < Dim * Dim; ++k)
      P(k / Dim, k % Dim) += N(k / Dim, k % Dim);
  }
  Lanes inner{}, outer{};
  for (int k = 0; k < Dim * Dim; ++k)
    inner += P(k / Dim, k % Dim) * L[k];
  for (int i = 0; i < Dim; ++i)
    outer += body.v.get(b, i) * body.T.get(b, i);
  return algebra::lane_sum(outer + algebra::load(body.graph.Omega.data() + b * n_lanes) * inner);
}

/// Keeps the lanes in which stored internal variables are symmetric positive definite.
DIPTYCH_INLINE void keep_positive_definite(const SymmetricTensor<Lanes>& A,
                                           algebra::PositiveLanes& sound) {
  const Lanes minor = A(0, 0) * A(1, 1) - A(0, 1) * A(0, 1);
  sound.keep(A(0, 0));
  sound.keep(minor);
  sound.keep(A(2, 2) * minor - A(1, 2) * (A(0, 0) * A(1, 2) - A(0, 1) * A(0, 2)) +
             A(0, 2) * (A(0, 1) * A(1, 2) - A(1, 1) * A(0, 2)));
}

/// Nodes of block b that the evaluation begins with as sound ones: J > 0 where it is evolved, the
/// internal variables positive definite.
template <int Dim, bool has_H>
DIPTYCH_INLINE algebra::PositiveLanes sound_before(const Body<Dim>& body, std::int64_t b) {
  algebra::PositiveLanes sound;
  if (body.options.unknowns != Unknowns::F) sound.keep(body.J.get(b, 0) + 1.0);
  for (int k = 0; k < body.options.n_branches; ++k) {
    const auto branch = stored_branch<Dim, has_H>(body, b, k);
    keep_positive_definite(branch.A, sound);
    if constexpr (has_H) keep_positive_definite(branch.S, sound);
  }
  return sound;
}

/// Leaves word of nodes that the evaluation did not begin with as sound ones: what they began with
/// is overwritten. J, or F where J follows from it, is no number there from now on.
template <int Dim>
void mark_bad(Body<Dim>& body, std::int64_t b, const algebra::PositiveLanes& sound) {
  BlockField& field = body.options.unknowns == Unknowns::F ? body.F : body.J;
  for (int lane = 0; lane < n_lanes; ++lane) {
    if (!sound.at(lane)) field.set(b * n_lanes + lane, 0, __builtin_nan(""));
  }
}

/// And ends with as sound ones: J > 0; dF/dt, P, what the step dissipated and, where it ends, u
/// finite. What is not a number in F, H or internal variables is none in P, velocities in dF/dt.
template <int Dim>
DIPTYCH_INLINE algebra::PositiveLanes sound_after(const StrainRateSweep<Dim>& sweep,
                                                  std::int64_t b,
                                                  const Lanes (&L)[Dim * Dim],
                                                  const Lanes& J,
                                                  const Tensor<Lanes>& P,
                                                  const Lanes& dissipation) {
  Lanes sum = dissipation;  // not finite where one of them is not
  for (int k = 0; k < Dim * Dim; ++k)
    sum += L[k] + P(k / Dim, k % Dim);
  if (sweep.drift != 0 || (sweep.stage != nullptr && sweep.stage->last)) {
    for (int i = 0; i < Dim; ++i)
      sum += sweep.body.u.get(b, i);
  }
  algebra::PositiveLanes sound;
  sound.keep(J + (sum - sum));  // J, or NaN
  return sound;
}

/// Of nodes alone: the last block is filled up.
template <int Dim>
DIPTYCH_INLINE void note_least_J(const Body<Dim>& body,
                                 std::int64_t b,
                                 const Lanes& J,
                                 BlockTotals& totals) {
  if (b + 1 < body.n_blocks) {
    totals.least_J = algebra::smaller(totals.least_J, J);
    return;
  }
  const auto is_node = algebra::load(body.graph.Omega.data() + b * n_lanes) != 0;
  totals.least_J = algebra::smaller(totals.least_J, is_node ? J : totals.least_J);
}

/// What the strain-rate sweep does with a block once its dF/dt is known: H and J (18c,d) with F,
/// relaxation (14), stress (9), wave speeds.
template <int Dim, class Material>
DIPTYCH_INLINE void evaluate_block(const Model<Material>& model,
                                   const StrainRateSweep<Dim>& sweep,
                                   std::int64_t b,
                                   const Lanes (&L)[Dim * Dim],
                                   BlockTotals& totals) {
  using Layout = algebra::Layout<Dim>;
  constexpr bool has_H = Material::has_H;
  Body<Dim>& body = sweep.body;
  if (body.in_runs()) {
    prefetch_to_write<NodeRecord<Dim>::n_isotropic>(body.records, b);
  }
  if (sweep.old_power != nullptr) totals.old_power += power_of_old_forces(body, b, L);
  const auto was_sound = sound_before<Dim, has_H>(body, b);
  if (sweep.stage != nullptr) update_deformation_of_block(body, *sweep.stage, b);
  put_velocity_gradient(body, b, L);
  if (sweep.drift != 0) drift_block(body, sweep.drift, b);
  const Deformation<Lanes> X = load_deformation(body, b);
  note_least_J(body, b, X.J, totals);
  const bool with_dissipation = sweep.relaxation.excess_C.size() > 0;
  Lanes dissipation{};
  Response<Lanes> response = response_of_block(
      model, body, sweep.relaxation, X, b,
      [&](int k, const BranchState<Lanes>& branch, const physics::RightTensors<Lanes>& now)
          DIPTYCH_INLINE_LAMBDA {
            if (!sweep.relaxation.commit) return;
            if (with_dissipation) {
              const auto paths = paths_of_step<Dim, has_H>(body, sweep.relaxation, now, b);
              dissipation += dissipation_of_step<Dim, has_H>(body, model.branches[k],
                                                             sweep.relaxation, paths, branch, b, k);
            }
            algebra::put_A<Dim>(body.A, b, k * Layout::n_A, branch.A);
            if constexpr (has_H) {
              algebra::put_S<Dim>(body.S, b, k * Layout::n_S, branch.S);
            }
          });
  if (body.bulk) response.Sigma_J -= model.material.volumetric_stress(X.J);
  Tensor<Lanes> P = physics::piola_stress<has_H>(response, X);
  if (const double s = body.options.cell_shear; s != 0) {
    for (int k = 0; k < Dim * Dim; ++k)
      P(k / Dim, k % Dim) -= s * (X.F(k / Dim, k % Dim) - (k / Dim == k % Dim ? 1.0 : 0.0));
  }
  if (__builtin_expect(!sound_after<Dim>(sweep, b, L, X.J, P, dissipation).all(), 0))
    totals.is_sound = false;
  if (__builtin_expect(!was_sound.all(), 0)) {
    totals.is_sound = false;
    mark_bad(body, b, was_sound);
  }
  write_records(body, b, X, response, P);
  const double rho_R = model.rho_R;
  const auto speeds = physics::speed_bounds(response, X, rho_R, has_H, Material::has_W_FJ);
  body.records.put(b, NodeRecord<Dim>::z_p, rho_R * speeds.c_p);
  body.records.put(b, NodeRecord<Dim>::z_s, rho_R * speeds.c_s);
  totals.viscous_dissipation +=
      algebra::lane_sum(dissipation * algebra::load(body.graph.Omega.data() + b * n_lanes));
}

/// Energies of blocks [begin, end), and how far the involutions H = cof F, J = det F have drifted.
template <int Dim, class Material>
DIPTYCH_CLONES void add_energies_of(const Model<Material>& model,
                                    const Body<Dim>& body,
                                    std::int64_t begin,
                                    std::int64_t end,
                                    Balance& sum) {
  Lanes least_J = Lanes{} + sum.least_J, drift_H{}, drift_J{};
  for (std::int64_t b = begin; b < end; ++b) {
    const Lanes Omega = algebra::load(body.graph.Omega.data() + b * n_lanes);
    const Deformation<Lanes> X = load_deformation(body, b);
    Lanes W = model.material.energy(X);
    if (body.bulk) W -= model.material.volumetric_energy(X.J);
    if (const double s = body.options.cell_shear; s != 0) {
      const Tensor<Lanes> grad_u = X.F - algebra::identity<Lanes>();
      W -= 0.5 * s * algebra::contract(grad_u, grad_u);
    }
    for (int k = 0; k < body.options.n_branches; ++k) {
      const auto branch = stored_branch<Dim, Material::has_H>(body, b, k);
      W += physics::branch_energy<Material::has_H>(model.branches[k], branch, X);
    }
    Lanes v_v{};
    for (int i = 0; i < Dim; ++i)
      v_v += body.v.get(b, i) * body.v.get(b, i);
    sum.kinetic += 0.5 * model.rho_R * algebra::lane_sum(Omega * v_v);
    sum.strain += algebra::lane_sum(Omega * W);
    const Deformation<Lanes> exact = physics::deformation_of(X.F);
    Lanes drift{};
    for (int k = 0; k < 9; ++k) {
      const Lanes of_H = X.H(k / 3, k % 3) - exact.H(k / 3, k % 3);
      drift = algebra::larger(drift, algebra::magnitude(of_H));
    }
    const auto is_node = Omega != 0;  // the rest is padding
    least_J = algebra::smaller(least_J, is_node ? X.J : least_J);
    drift_J = algebra::larger(drift_J, is_node ? algebra::magnitude(X.J - exact.J) : drift_J);
    drift_H = algebra::larger(drift_H, is_node ? drift : drift_H);
  }
  for (int l = 0; l < n_lanes; ++l) {
    sum.least_J = algebra::smaller(sum.least_J, least_J[l]);
    sum.involution_J = algebra::larger(sum.involution_J, drift_J[l]);
    sum.involution_H = algebra::larger(sum.involution_H, drift_H[l]);
  }
}

template <class Material>
class CompiledMaterial;

template <int Dim, class Material>
struct EvaluateKernel {
  template <InstructionSet isa>
  DIPTYCH_INLINE static void run(const StrainRateSweep<Dim>& sweep,
                                 std::int64_t b,
                                 const Lanes (&L)[Dim * Dim],
                                 BlockTotals& totals) {
    const auto& compiled = static_cast<const CompiledMaterial<Material>&>(sweep.material);
    evaluate_block(compiled.model(), sweep, b, L, totals);
  }
};
template <int Dim, class Material>
using EvaluateVersions = algebra::Versions<EvaluateKernel<Dim, Material>,
                                           const StrainRateSweep<Dim>&,
                                           std::int64_t,
                                           const Lanes (&)[Dim * Dim],
                                           BlockTotals&>;

template <class Material>
class CompiledMaterial final : public MaterialModel {
 public:
  explicit CompiledMaterial(Model<Material> model)
      : MaterialModel(model.rho_R, model.branches, Material::has_H, Material::has_W_FJ),
        model_(std::move(model)) {}

  using MaterialModel::energy;
  using MaterialModel::response;
  double energy(const PointDeformation& X) const override { return model_.material.energy(X); }
  physics::Response<double> response(const PointDeformation& X) const override {
    return model_.material.response(X);
  }
  double volumetric_energy(double J) const override { return model_.material.volumetric_energy(J); }
  double volumetric_stress(double J) const override { return model_.material.volumetric_stress(J); }
  double volumetric_modulus() const override { return model_.material.volumetric_modulus(); }
  void put_volumetric_stresses(double* J, std::int64_t n) const override {
    for (std::int64_t i = 0; i < n; ++i)
      J[i] = model_.material.volumetric_stress(J[i]);
  }
  BlockPhysics<2> in_plane() const override { return blocks<2>(); }
  BlockPhysics<3> in_space() const override { return blocks<3>(); }
  const Model<Material>& model() const { return model_; }

 private:
  template <int Dim>
  static BlockPhysics<Dim> blocks() {
    return {algebra::version_here<EvaluateVersions<Dim, Material>>(),
            [](const MaterialModel& model, const Body<Dim>& body, std::int64_t begin,
               std::int64_t end, Balance& sum) {
              const auto& compiled = static_cast<const CompiledMaterial&>(model);
              add_energies_of(compiled.model(), body, begin, end, sum);
            }};
  }
  Model<Material> model_;
};

}  // namespace diptych::scheme
