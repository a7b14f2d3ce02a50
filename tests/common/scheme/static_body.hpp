#pragma once
/// Bodies at given displacements, whose forces and energies are held against each other: for tests
/// of volumes that carry the pressure, and of cells that carry shear.

#include "common/run/model_menu.hpp"
#include "common/scheme/budget/balance.hpp"
#include "common/scheme/sweeps/sweeps.hpp"
#include "fvm/fvm_graph.hpp"
#include "sph/sph_graph.hpp"
#include "tests/common/scheme/scenes.hpp"

#include <gtest/gtest.h>

#include <random>

namespace diptych::tests {

using algebra::Mat3;
using algebra::Vec3;
using Displacements = std::vector<Vec3>;

inline cases::MaterialCase rubber(double nu) {
  cases::MaterialCase m;
  m.density = 1000;
  m.shear_modulus = 1;
  m.lame = 2 * nu / (1 - 2 * nu);
  m.zeta_ratio = 0.5;
  return m;
}

using scheme::Volumes;

/// "sph lines" and "sph sbp" are SPH that sums by parts, the former with lines that carry the
/// pressure; "fvm sbp" are finite volumes that do.
inline scheme::PairGraph graph_for(const std::string& method, const meshes::Mesh& mesh) {
  if (method == "fvm sbp") return fvm::build_graph(mesh, {"sbp"});
  if (method != "sph lines" && method != "sph sbp") {
    cases::Case setup = tests::second_order();
    setup.scheme.volumes = "cells";
    return tests::graph_of(method, mesh, setup);
  }
  sph::Options options;
  options.gradient = "sbp";
  return sph::build_graph(mesh, options);
}

inline Volumes safe_for(const std::string& method) {
  return method == "sph lines" ? Volumes::lines : Volumes::cells;
}

/// Share of the shear modulus that gradients of cells carry by default, where they are.
inline double shear_for(Volumes volumes) {
  return volumes == Volumes::cells ? cases::SchemeCase().cell_shear * rubber(0).shear_modulus : 0;
}

/// A body at given displacements, without velocities.
template <int Dim>
class StaticBodyIn {
 public:
  StaticBodyIn(const meshes::Mesh& mesh, const std::string& method, double nu, Volumes volumes)
      : StaticBodyIn(mesh, method, nu, volumes, shear_for(volumes)) {}
  StaticBodyIn(const meshes::Mesh& mesh,
               const std::string& method,
               double nu,
               Volumes volumes,
               double cell_shear,
               double hourglass = 0)
      : graph(graph_for(method, mesh)),
        material(run::model_menu().at("mooney-rivlin").model(rubber(nu))),
        body(graph, options(*material, volumes, cell_shear, hourglass)),
        sweeps_(body, material, quiet(hourglass), 1) {}

  /// Internal forces  [N]
  Displacements forces(const Displacements& u) {
    put(u);
    sweeps_.sum_forces(body, false);
    Displacements T(u.size(), Vec3::Zero());
    for (size_t a = 0; a < u.size(); ++a) {
      for (int i = 0; i < Dim; ++i)
        T[a][i] = body.T.at(static_cast<std::int64_t>(a), i);
    }
    return T;
  }
  double energy(const Displacements& u) {
    put(u);
    return scheme::balance(*material, body).strain;
  }

  scheme::PairGraph graph;
  std::shared_ptr<const scheme::MaterialModel> material;
  scheme::Body<Dim> body;

 private:
  static scheme::SweepOptions quiet(double hourglass) {
    scheme::SweepOptions options;
    options.dissipation_factor = 0;
    if (hourglass != 0) options.dissipation.reconstruction = scheme::Reconstruction::symmetric;
    return options;
  }
  static scheme::BodyOptions options(const scheme::MaterialModel& material,
                                     Volumes volumes,
                                     double cell_shear,
                                     double hourglass) {
    scheme::BodyOptions options;
    options.rho_R = material.rho_R();
    options.unknowns = scheme::Unknowns::F;
    options.volumes = volumes;
    options.cell_shear = cell_shear;
    options.hourglass = hourglass;
    options.has_moments = hourglass != 0;
    return options;
  }
  /// u, and F as its discrete gradient.
  void put(const Displacements& u) {
    const auto set = [&](auto& field, double factor) {
      for (size_t a = 0; a < u.size(); ++a) {
        for (int i = 0; i < Dim; ++i)
          field.set(static_cast<std::int64_t>(a), i, factor * u[a][i]);
      }
    };
    set(body.u, 1);
    set(body.v, 1);
    if (!body.in_runs()) {
      for (size_t a = 0; a < u.size(); ++a) {
        for (int i = 0; i < Dim; ++i)
          body.records.set(static_cast<std::int64_t>(a), scheme::NodeRecord<Dim>::v(false) + i,
                           u[a][i]);
      }
    }
    scheme::velocity_gradients(body, 0);
    for (std::int64_t a = 0; a < body.n_owned; ++a) {
      for (int k = 0; k < Dim * Dim; ++k)
        body.F.set(a, k, body.records.at(a, scheme::NodeRecord<Dim>::L + k));
    }
    set(body.v, 0);
    sweeps_.strain_rates(body, {}, nullptr, 0);
  }
  scheme::Sweeps<Dim> sweeps_;
};
using StaticBody = StaticBodyIn<3>;

using Cells = std::array<int, 3>;

inline meshes::Mesh block(meshes::CellType type, double moved, const Cells& cells = {4, 4, 4}) {
  meshes::Mesh mesh = meshes::box(type, Vec3::Zero(), Vec3::Ones(), cells);
  if (moved > 0) meshes::perturb_interior(mesh, moved, 3);
  return mesh;
}

inline Displacements affine(const scheme::PairGraph& graph, const Mat3& F) {
  Displacements u;
  for (const Vec3& X : graph.X)
    u.push_back(F * X - X);
  return u;
}

inline Displacements noisy(Displacements u, double size) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-size, size);
  for (Vec3& x : u)
    x += Vec3(uniform(random), uniform(random), uniform(random));
  return u;
}

inline Mat3 sheared() {
  Mat3 F;
  F << 0.9, 0.2, -0.1, 0.05, 1.1, 0.1, -0.15, 0.1, 0.8;
  return F;
}

struct Kind {
  meshes::CellType type;
  double moved;
  const char* method;
  Cells cells{4, 4, 4};
};
inline void PrintTo(const Kind& kind, std::ostream* out) {
  *out << kind.method << ", type " << static_cast<int>(kind.type) << ", moved " << kind.moved;
}
/// The force is the derivative of the energy: -dE = sum T . du for any small change.
template <int Dim>
void expect_derivative_of_energy(StaticBodyIn<Dim>& body,
                                 const Displacements& u,
                                 const Displacements& direction) {
  const auto T = body.forces(u);
  double expected = 0;
  for (size_t a = 0; a < u.size(); ++a)
    expected -= T[a].dot(direction[a]);
  const auto energy = [&](double step) {
    Displacements moved = u;
    for (size_t a = 0; a < u.size(); ++a)
      moved[a] += step * direction[a];
    return body.energy(moved);
  };
  const double h = 1e-5;
  const double slope = (8 * (energy(h) - energy(-h)) - (energy(2 * h) - energy(-2 * h))) / (12 * h);
  EXPECT_NEAR(slope, expected, 1e-8 * std::abs(expected));
}

enum class Support { rollers, none };

/// Least eigenvalue of the second variation of the energy over the nodal volumes, with the sides
/// between rollers or free, in units of mu/h^2. Motions of a free rigid body are not counted.
inline double least_stiffness(StaticBody& body, double J, Support support) {
  const Displacements u = affine(body.graph, std::cbrt(J) * Mat3::Identity());
  std::vector<std::pair<size_t, int>> moves;  // node, component
  const double spacing = 1 / (std::cbrt(static_cast<double>(u.size())) - 1);
  for (size_t a = 0; a < u.size(); ++a) {
    for (int i = 0; i < 3; ++i) {
      const bool on_side = std::abs(std::abs(body.graph.X[a][i] - 0.5) - 0.5) < 1e-9;
      if (support == Support::none || !on_side) moves.emplace_back(a, i);
    }
  }
  const auto n = static_cast<Eigen::Index>(moves.size());
  Eigen::MatrixXd K(n, n);
  const double step = 1e-6;
  for (Eigen::Index q = 0; q < n; ++q) {
    const auto [b, j] = moves[static_cast<size_t>(q)];
    Displacements plus = u, minus = u;
    plus[b][j] += step;
    minus[b][j] -= step;
    const auto up = body.forces(plus), down = body.forces(minus);
    for (Eigen::Index p = 0; p < n; ++p) {
      const auto [a, i] = moves[static_cast<size_t>(p)];
      K(p, q) = -(up[a][i] - down[a][i]) / (2 * step) /
                std::sqrt(body.graph.Omega[a] * body.graph.Omega[b]);
    }
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(0.5 * (K + K.transpose()));
  return solver.eigenvalues()[support == Support::none ? 6 : 0] * spacing * spacing;
}

}  // namespace diptych::tests
