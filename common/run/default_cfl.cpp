#include "common/run/default_cfl.hpp"

#include "common/parallel/for_chunks.hpp"
#include "common/scheme/face_correction.hpp"
#include "common/scheme/limiters/limiter_menu.hpp"

#include <algorithm>
#include <cmath>

namespace diptych::run {

namespace {

/// c_s/c_p of the undeformed material with its branches at once (physics note 1.4).
double shear_ratio_of(const MaterialCase& m) {
  const double half = 0.5 * m.shear_modulus;
  const double zeta = m.zeta_ratio * half, xi = half - zeta;
  double shear = m.shear_modulus, pressure = m.lame + 2 * m.shear_modulus;
  for (const BranchCase& b : m.branches) {
    shear += 2 * (b.beta_C * xi + b.beta_G * zeta);
    pressure += 4 * b.beta_C * xi + 8 * b.beta_G * zeta;
  }
  return std::sqrt(shear / pressure);
}

/// |S_ab| / 2 of every directed pair.
std::vector<double> weights_of(const scheme::PairGraph& graph) {
  std::vector<double> weights(graph.C.size());
  for (size_t k = 0; k < weights.size(); ++k)
    weights[k] = 0.25 * (graph.C[k] - graph.C[graph.reverse[k]]).norm();
  return weights;
}

/// Largest eigenvalue of v_a -> sum_b w_ab (v_a - v_b) / Omega_a by the power method, from a vector
/// of alternating and random parts. Thirty iterations come within a few percent from below.
double largest_eigenvalue(const scheme::PairGraph& graph, const std::vector<double>& weights) {
  const std::int64_t n = graph.n_nodes();
  std::vector<double> v(n), next(n);
  std::uint64_t random = 1;
  for (double& x : v) {
    random = random * 6364136223846793005U + 1442695040888963407U;
    x = static_cast<double>(random >> 11) * 0x1p-52 - 1;
  }
  double largest = 0;
  for (int iteration = 0; iteration < 30; ++iteration) {
    parallel::for_chunks(n, [&](std::int64_t begin, std::int64_t end, std::int64_t) {
      for (std::int64_t a = begin; a < end; ++a) {
        double sum = 0;
        for (std::int64_t k = graph.row[a]; k < graph.row[a + 1]; ++k)
          sum += weights[k] * (v[a] - v[graph.neighbour[k]]);
        next[a] = sum / graph.Omega[a];
      }
    });
    double vv = 0, nn = 0;
    for (std::int64_t a = 0; a < n; ++a) {
      vv += graph.Omega[a] * v[a] * v[a];
      nn += graph.Omega[a] * next[a] * next[a];
    }
    if (vv == 0) return 0;
    largest = std::sqrt(nn / vv);  // of a symmetric operator this never passes the eigenvalue
    for (std::int64_t a = 0; a < n; ++a)
      v[a] = next[a] / largest;
  }
  return largest;
}

}  // namespace

double dissipation_share(const scheme::PairGraph& graph, double shear_ratio) {
  const std::vector<double> weights = weights_of(graph);
  double rate = 0, direction = 0;
  for (std::int64_t a = 0; a < graph.n_nodes(); ++a) {
    algebra::Mat3 Z = algebra::Mat3::Zero();
    double length = 0, area = 0;
    for (std::int64_t k = graph.row[a]; k < graph.row[a + 1]; ++k) {
      length += 0.5 * graph.C[k].norm();
      const double w = weights[k];
      if (w == 0) continue;
      const algebra::Vec3 N = (graph.C[k] - graph.C[graph.reverse[k]]).normalized();
      Z += w * (shear_ratio * algebra::Mat3::Identity() + (1 - shear_ratio) * N * N.transpose());
      area += w;
    }
    // of a symmetric matrix no eigenvalue exceeds its largest row sum
    const double row_sum = Z.cwiseAbs().rowwise().sum().maxCoeff();
    if (area > 0) direction = std::max(direction, std::min(1.0, row_sum / area));
    rate = std::max(rate, length / graph.Omega[a]);
  }
  return direction * largest_eigenvalue(graph, weights) / (2 * rate);
}

double real_extent(const time::Integrator& integrator) {
  if (integrator.is_leapfrog()) return 2;
  const auto amplification = [&](double z) {
    double u = 1;
    for (const time::SspStage& stage : integrator.stages)
      u = stage.alpha + stage.beta * (1 + z) * u;
    return std::abs(u);
  };
  double extent = 0;
  while (amplification(-(extent + 1e-3)) <= 1 + 1e-12)
    extent += 1e-3;
  return extent;
}

double default_cfl(const Case& setup,
                   const scheme::PairGraph& graph,
                   const time::Integrator& integrator) {
  constexpr double margin = 0.95;
  const double own = integrator.default_cfl;
  const double strength = setup.scheme.dissipation *
                          scheme::strength_of(scheme::limiter_menu().at(setup.scheme.limiter));
  // steps are cfl / (rate frequency_factor)
  const double limit = margin * 0.5 * real_extent(integrator) *
                       scheme::frequency_factor(setup.scheme.face_correction);
  if (own * strength <= limit) return own;  // whatever the share, which is at most one
  const double share = dissipation_share(graph, shear_ratio_of(setup.material));
  return std::min(own, limit / (strength * share));
}

}  // namespace diptych::run
