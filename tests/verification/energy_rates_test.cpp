/// The semi-discrete energy balance (notes 6) at one instant of a random body that carries
/// every type of boundary condition and a body force at once:
///   dK/dt + dW/dt = power of loads + power of constraints - D_num - D_visc.
/// The left side is worked out here from the accelerations and, by differentiation of the energy
/// density along the rates (18b-d), (14), without any stress of the code; the right side is what
/// the audit sums. An instant stands for every stage: the state is arbitrary.

#include "common/algebra/dual.hpp"
#include "common/parallel/for_chunks.hpp"
#include "common/physics/materials/mooney_rivlin.hpp"
#include "common/scheme/boundary/applied_boundary.hpp"
#include "common/scheme/sweeps/compiled_material.hpp"
#include "common/scheme/sweeps/face_correction.hpp"
#include "common/scheme/sweeps/momentum.hpp"
#include "tests/common/scheme/scenes.hpp"

#include <gtest/gtest.h>

#include <random>

extern template class diptych::scheme::CompiledMaterial<diptych::physics::MooneyRivlin>;

namespace diptych {
namespace {

using algebra::Lanes;
using algebra::n_lanes;
using algebra::SymmetricTensor;
using algebra::Tensor;
using algebra::Vec3;
using Dual = algebra::Dual<Lanes, 1>;
using Material = physics::MooneyRivlin;

const Vec3 rate_of_velocity(3, -2, 1);  // m/s^2, of the prescribed velocity

Dual dual(const Lanes& value, const Lanes& rate) {
  Dual d;
  d.v = value;
  d.d[0] = rate;
  return d;
}
Tensor<Dual> dual(const Tensor<Lanes>& value, const Tensor<Lanes>& rate) {
  Tensor<Dual> T;
  for (int k = 0; k < 9; ++k)
    T(k / 3, k % 3) = dual(value(k / 3, k % 3), rate(k / 3, k % 3));
  return T;
}
SymmetricTensor<Dual> dual(const SymmetricTensor<Lanes>& value,
                           const SymmetricTensor<Lanes>& rate) {
  SymmetricTensor<Dual> T;
  for (int k = 0; k < 6; ++k)
    T.s[k] = dual(value.s[k], rate.s[k]);
  return T;
}

template <int Dim>
class LoadedBody {
 public:
  LoadedBody(const std::string& method, int n_branches, double kappa_f)
      : graph_(tests::graph_of(method, mesh())),
        material_(model_of(n_branches)),
        body_(graph_, options_of(n_branches, kappa_f)),
        kappa_f_(kappa_f),
        chunks_(static_cast<size_t>(parallel::n_chunks_of(body_.n_blocks))),
        boundary_(graph_, conditions(), body_force, true) {
    fill();
    evaluate();
  }

  double largest = 0;  ///< of all terms, W
  double residual() {
    const scheme::LoadRates loads = boundary_.add_loads(body_, 0);
    const double constraints = boundary_.power_against_forces(body_);
    const double terms[] = {kinetic_rate(),
                            strain_rate(),
                            -loads.power,
                            -constraints,
                            parallel::sum_in_order(numerical_),
                            viscous_power()};
    double sum = 0;
    for (const double& term : terms) {
      EXPECT_TRUE(term != 0 || (material_.branches().empty() && &term == &terms[5]));
      sum += term;
      largest = std::max(largest, std::abs(term));
    }
    return sum;
  }

 private:
  static scheme::Model<Material> model_of(int n_branches) {
    scheme::Model<Material> model{{1.3e6, 0.7e6, 4e6}, 1100, {}};
    for (int k = 0; k < n_branches; ++k)
      model.branches.push_back({0.9e6, 2e-3 * (k + 1), 0.4e6, 1e-3});
    return model;
  }
  static scheme::BodyOptions options_of(int n_branches, double kappa_f) {
    scheme::BodyOptions options;
    options.rho_R = 1100;
    options.n_branches = n_branches;
    options.has_G = true;
    options.face_correction = kappa_f != 0;
    return options;
  }
  static meshes::Mesh mesh() {
    using meshes::CellType;
    return meshes::box(Dim == 3 ? CellType::hexahedron : CellType::quadrilateral, Vec3::Zero(),
                       Dim == 3 ? Vec3(1, 1, 1) : Vec3(1, 1, 0), {5, 4, 3});
  }
  static Vec3 in_space(Vec3 x) {
    if (Dim == 2) x[2] = 0;
    return x;
  }
  static Vec3 body_force(const Vec3& X, double t) {
    return in_space(Vec3(2e5 * X[1], 1e5 * std::cos(X[0] + t), 3e5));
  }
  static Vec3 velocity(const Vec3&, double t) {
    return in_space(Vec3(0.3, 0.7, -0.2) + t * rate_of_velocity);
  }

  /// Every type on a face of its own.
  std::vector<std::pair<std::string, std::string>> types() const {
    if (Dim == 2) {
      return {{"x_min", "velocity"},
              {"x_max", "pressure"},
              {"y_min", "symmetry"},
              {"y_max", "traction"}};
    }
    return {{"x_min", "velocity"}, {"x_max", "traction"},      {"y_min", "symmetry"},
            {"y_max", "pressure"}, {"z_min", "skew-symmetry"}, {"z_max", "fixed"}};
  }
  std::vector<scheme::PlacedCondition> conditions() const {
    std::vector<scheme::PlacedCondition> placed;
    for (const auto& [group, type] : types()) {
      scheme::BoundaryValues values;
      values.depends_on_time = true;
      values.scalar = [](const Vec3& X, double) { return 4e5 * (1 + X[0]); };
      values.vector =
          type == "velocity" ? scheme::VectorFunction(velocity) : [](const Vec3& X, double) {
            return in_space(Vec3(2e5, -3e5 * X[1], 1e5));
          };
      for (const auto& patch : graph_.patches) {
        if (patch.name != group) continue;
        placed.push_back({scheme::boundary_menu().at(type).make(values), &patch});
      }
    }
    return placed;
  }
  /// Conditions at a node: which components are prescribed, and whether they move.
  std::array<int, 3> prescribed(const Vec3& X) const {
    std::array<int, 3> how{0, 0, 0};  // 0 free, 1 held, 2 moved
    if (Dim == 3) {
      if (X[1] == 0) how[1] = 1;
      if (X[2] == 0) how[0] = how[1] = 1;
      if (X[2] == 1) how = {1, 1, 1};
    } else if (X[1] == 0) {
      how[1] = 1;
    }
    if (X[0] == 0) how = {2, 2, 2};
    return how;
  }

  void fill() {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const auto lanes = [&](double size) {
      Lanes r{};
      for (int l = 0; l < n_lanes; ++l)
        r[l] = size * uniform(random);
      return r;
    };
    using Layout = algebra::Layout<Dim>;
    for (std::int64_t b = 0; b < body_.n_blocks; ++b) {
      Tensor<Lanes> F{};
      for (int k = 0; k < 9; ++k)
        F(k / 3, k % 3) = lanes(0.2) + (k % 4 == 0 ? 1.0 : 0.0);
      algebra::put_tensor<Dim>(body_.F, b, 0, F, 1);
      const auto X = physics::deformation_of(algebra::get_tensor<Dim>(body_.F, b, 0, 1));
      scheme::put_H(body_, b, X.H);
      body_.J.put(b, 0, X.J - 1.0);
      for (int i = 0; i < Dim; ++i)
        body_.v.put(b, i, lanes(1));
      for (int k = 0; k < body_.options.n_branches; ++k) {
        auto A = algebra::symmetric_identity<Lanes>(), S = A;
        for (int i = 0; i < 6; ++i) {
          A.s[i] += lanes(0.2);
          S.s[i] += lanes(0.2);
        }
        algebra::put_A<Dim>(body_.A, b, k * Layout::n_A, A);
        algebra::put_S<Dim>(body_.S, b, k * Layout::n_S, S);
      }
    }
  }

  void evaluate() {
    const auto blocks = body_.n_blocks;
    boundary_.begin_step(0, 1e-3);
    boundary_.constrain(body_, 0.0);
    const auto face = scheme::face_correction_sweeps<Dim>();
    if (kappa_f_ != 0) face.gradients(body_, 0, blocks);
    scheme::evaluate_strain_rates<Dim>(
        {body_, material_, {}, kappa_f_, nullptr, 0, viscous_.data(), least_J_.data()});
    if (kappa_f_ != 0) face.stresses(body_, kappa_f_, 0, blocks);
    scheme::sum_forces<Dim>({body_, 1, false, numerical_.data(), rate_.data(), limited_.data()},
                            scheme::momentum_function<Dim>({}, true));
  }

  /// sum m v . a with the accelerations that constraints leave; what prescribed velocities give is
  /// booked by whole steps (tests/common/scheme/prescribed_velocity_test.cpp).
  double kinetic_rate() const {
    double power = 0;
    for (std::int64_t a = 0; a < graph_.n_nodes(); ++a) {
      const auto how = prescribed(graph_.X[a]);
      const double mass = material_.rho_R() * graph_.Omega[a];
      for (int i = 0; i < Dim; ++i) {
        const double acceleration = how[i] == 0 ? body_.T.at(a, i) / mass : 0;
        power += mass * body_.v.at(a, i) * acceleration;
      }
    }
    return power;
  }

  /// sum Omega D_int (12).
  double viscous_power() const {
    double power = 0;
    for (std::int64_t b = 0; b < body_.n_blocks; ++b) {
      const auto now = physics::right_tensors(scheme::load_deformation(body_, b).F);
      Lanes D{};
      for (int k = 0; k < body_.options.n_branches; ++k) {
        D += physics::branch_dissipation<true>(material_.branches()[k],
                                               scheme::stored_branch<Dim, true>(body_, b, k), now);
      }
      power += algebra::lane_sum(algebra::load(body_.graph.Omega.data() + b * n_lanes) * D);
    }
    return power;
  }

  /// sum Omega dW/dt along dF/dt = L, dH/dt = F x L, dJ/dt = H : L, and (14).
  double strain_rate() const {
    using Layout = algebra::Layout<Dim>;
    double power = 0;
    for (std::int64_t b = 0; b < body_.n_blocks; ++b) {
      const auto X = scheme::load_deformation(body_, b);
      const Tensor<Lanes> L = scheme::velocity_gradient(body_, b);
      const physics::Deformation<Dual> moving{dual(X.F, L), dual(X.H, algebra::cross(X.F, L)),
                                              dual(X.J, algebra::contract(X.H, L))};
      Dual W = material_.model().material.energy(moving);
      for (int k = 0; k < body_.options.n_branches; ++k) {
        const auto& branch = material_.branches()[k];
        const auto A = algebra::get_A<Dim>(body_.A, b, k * Layout::n_A);
        const auto S = algebra::get_S<Dim>(body_.S, b, k * Layout::n_S);
        const physics::BranchState<Dual> relaxing{
            dual(A, (1 / branch.tau_C) * (physics::inverse_C(X) + (-1.0) * A)),
            dual(S, (1 / branch.tau_G) * (physics::inverse_G(X) + (-1.0) * S))};
        W += physics::branch_energy<true>(branch, relaxing, moving);
      }
      power += algebra::lane_sum(algebra::load(body_.graph.Omega.data() + b * n_lanes) * W.d[0]);
    }
    return power;
  }

  scheme::PairGraph graph_;
  scheme::CompiledMaterial<Material> material_;
  scheme::Body<Dim> body_;
  double kappa_f_;
  size_t chunks_;
  std::vector<double> viscous_ = std::vector<double>(chunks_), least_J_ = viscous_,
                      numerical_ = viscous_, rate_ = viscous_, limited_ = viscous_;
  scheme::AppliedBoundary boundary_;
};

class EnergyRates : public testing::TestWithParam<std::tuple<std::string, int, double>> {};
INSTANTIATE_TEST_SUITE_P(All,
                         EnergyRates,
                         testing::Combine(testing::Values("sph", "fvm"),
                                          testing::Values(0, 1, 3),
                                          testing::Values(0, 0.125, 1.0 / 6)));

// sums of about 1e4 products of random numbers: rounding near 1e-14 of the largest
TEST_P(EnergyRates, CloseInSpace) {
  const auto& [method, n_branches, kappa_f] = GetParam();
  LoadedBody<3> body(method, n_branches, kappa_f);
  const double residual = body.residual();
  EXPECT_LE(std::abs(residual), 1e-12 * body.largest) << residual / body.largest;
}

TEST_P(EnergyRates, CloseInThePlane) {
  const auto& [method, n_branches, kappa_f] = GetParam();
  LoadedBody<2> body(method, n_branches, kappa_f);
  const double residual = body.residual();
  EXPECT_LE(std::abs(residual), 1e-12 * body.largest) << residual / body.largest;
}

}  // namespace
}  // namespace diptych
