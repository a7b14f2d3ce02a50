/// The face correction: exact for linear fields, adjoint of its stress side, momentum and torque.

#include "common/scheme/sweeps/face_correction.hpp"

#include "tests/common/scheme/scenes.hpp"

#include <gtest/gtest.h>

#include <random>

namespace diptych {
namespace {

using algebra::Mat3;
using algebra::Vec3;

const std::string corrected_cube =
    tests::spinning_cube + std::string("[scheme]\nface_correction = \"1/6\"\n");

constexpr scheme::Arrangement both[] = {scheme::Arrangement::rows, scheme::Arrangement::runs};

class FaceCorrection : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Both, FaceCorrection, testing::Values("sph", "fvm"));

/// kappa_f = 1. One instruction set is enough: sweeps_test.cpp compares them.
/// @return Omega_a times the change
std::vector<Mat3> correction(const scheme::SweepGraph<3>& pairs,
                             scheme::Side side,
                             const std::vector<Mat3>& tensors) {
  constexpr auto isa = scheme::InstructionSet::baseline;
  algebra::NodeTable table(pairs.n_nodes, 9, scheme::tensor_stride<3>, pairs.shape);
  const auto n = static_cast<std::int64_t>(tensors.size());
  for (std::int64_t a = 0; a < n; ++a) {
    for (int k = 0; k < 9; ++k)
      table.set(a, k, tensors[a](k / 3, k % 3));
  }
  std::vector<Mat3> result(tensors.size());
  for (std::int64_t b = 0; b < pairs.n_blocks; ++b) {
    algebra::Lanes corrected[9];
    if (side == scheme::Side::rates) {
      scheme::corrected_block<isa, scheme::Side::rates>(pairs, table, 1, b, corrected);
    } else {
      scheme::corrected_block<isa, scheme::Side::stress>(pairs, table, 1, b, corrected);
    }
    for (std::int64_t a = b * 8; a < std::min(n, b * 8 + 8); ++a) {
      for (int k = 0; k < 9; ++k) {
        result[a](k / 3, k % 3) = pairs.Omega[a] * (corrected[k][a % 8] - tensors[a](k / 3, k % 3));
      }
    }
  }
  return result;
}

TEST_P(FaceCorrection, StressSideIsTheTransposeOfTheRateSide) {
  const auto graph = tests::graph_of(
      GetParam(),
      meshes::box(meshes::CellType::hexahedron, Vec3::Zero(), Vec3(1, 2, 1), {4, 5, 3}));
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<Mat3> L(graph.X.size()), P(graph.X.size());
  for (size_t a = 0; a < L.size(); ++a) {
    for (int k = 0; k < 9; ++k) {
      L[a](k / 3, k % 3) = uniform(random);
      P[a](k / 3, k % 3) = uniform(random);
    }
  }
  for (const scheme::Arrangement arrangement : both) {
    const scheme::SweepGraph<3> pairs(graph, arrangement);
    const auto BL = correction(pairs, scheme::Side::rates, L);
    const auto BP = correction(pairs, scheme::Side::stress, P);
    double left = 0, right = 0, size = 0;
    for (size_t a = 0; a < L.size(); ++a) {
      left += P[a].cwiseProduct(BL[a]).sum();
      right += BP[a].cwiseProduct(L[a]).sum();
      size += P[a].norm() * BL[a].norm();
    }
    EXPECT_GT(size, 0);
    EXPECT_NEAR(left, right, 1e-13 * size);  // sums of some thousand products
  }
}

TEST(FrequencyFactor, IsTheMaximumOfTheSymbol) {
  EXPECT_EQ(scheme::frequency_factor(0), 1);
  for (const double kappa_f : {0.01, 0.125, 1.0 / 6, 0.25}) {
    double most = 0;
    for (double theta = 0; theta < 3.1416; theta += 1e-4) {
      most = std::max(most, std::sin(theta) * (1 + 2 * kappa_f * (1 - std::cos(theta))));
    }
    EXPECT_NEAR(scheme::frequency_factor(kappa_f), most, 1e-8);
  }
}

TEST_P(FaceCorrection, LeavesLinearFieldsAlone) {
  const auto graph = tests::graph_of(
      GetParam(), meshes::box(meshes::CellType::hexahedron, Vec3::Zero(), Vec3::Ones(), {4, 4, 4}));
  const std::vector<Mat3> uniform(graph.X.size(), Mat3::Random());
  for (const scheme::Arrangement arrangement : both) {
    const scheme::SweepGraph<3> pairs(graph, arrangement);
    for (const Mat3& change : correction(pairs, scheme::Side::rates, uniform))
      EXPECT_EQ(change.norm(), 0);
  }
}

TEST_P(FaceCorrection, KeepsMomentumEnergyBudgetAndTorque) {
  tests::Scene scene = tests::scene_of(GetParam(), corrected_cube,
                                       {"scheme.dissipation=0", "time.integrator=\"ssp-rk3\""});
  const scheme::Balance start = scene.solver->balance();
  const auto residual = [&](int n) {
    tests::Scene body = tests::scene_of(GetParam(), corrected_cube, {"scheme.dissipation=0"});
    for (int k = 1; k <= n; ++k)
      body.solver->step(1e-3 * k / n);
    const auto now = body.solver->balance();
    EXPECT_LE((now.linear_momentum - start.linear_momentum).norm(), 1e-13 * start.momentum_scale);
    // without D_ab only the integrator breaks angular momentum
    return std::pair{std::abs(now.kinetic + now.strain - start.kinetic - start.strain +
                              body.solver->audit().viscous_dissipation) /
                         start.kinetic,
                     (now.angular_momentum - start.angular_momentum).norm() / start.angular_scale};
  };
  const auto coarse = residual(24), fine = residual(48);
  EXPECT_GE(std::log2(coarse.first / fine.first), 2.7);
  EXPECT_GE(std::log2(coarse.second / fine.second), 2.7);
  EXPECT_LE(fine.second, 1e-5);
}

}  // namespace
}  // namespace diptych
