#include "common/run/energy_units.hpp"

#include "common/run/boundary_group.hpp"
#include "common/scheme/boundary/boundary_condition.hpp"
#include "common/scheme/graph/centroid.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace diptych::run {

using algebra::Mat3;
using algebra::Vec3;

namespace {

constexpr double n_steps = 1e4;  // each of which rounds once, this way or that

/// Projector on the directions that neither walls nor conditions without velocities of their own
/// hold at any node.
Mat3 free_directions(const cases::Case& setup, const scheme::PairGraph& graph) {
  Mat3 held = Mat3::Zero();
  for (const cases::BoundaryCase& boundary : setup.boundaries) {
    const scheme::BoundaryKind& kind = scheme::boundary_menu().at(boundary.type);
    const bool moves = kind.takes == scheme::BoundaryKind::Takes::vector;
    if (kind.acts == scheme::BoundaryKind::Acts::load || moves) continue;
    scheme::BoundaryValues values;
    values.point = boundary.point;
    values.normal = boundary.normal;
    const auto condition = kind.make(values);
    if (const auto wall = condition->wall()) held += wall->normal * wall->normal.transpose();
    for (const std::string& group : boundary.groups) {
      for (const auto& node :
           condition->constraints(graph, boundary_group(graph, group, boundary.where))) {
        for (const Vec3& direction : node.directions)
          held += direction * direction.transpose();
      }
    }
  }
  const Eigen::SelfAdjointEigenSolver<Mat3> found(held);
  Mat3 free = Mat3::Zero();
  for (int k = 0; k < 3; ++k) {
    const Vec3 direction = found.eigenvectors().col(k);
    if (found.eigenvalues()[k] <= 1e-9 * found.eigenvalues()[2])
      free += direction * direction.transpose();
  }
  return free;
}

/// Components of velocities are prescribed.
bool is_held(const cases::Case& setup) {
  using enum scheme::BoundaryKind::Acts;
  return std::any_of(setup.boundaries.begin(), setup.boundaries.end(), [](const auto& boundary) {
    const auto acts = scheme::boundary_menu().at(boundary.type).acts;
    return acts == constrain || acts == hold;
  });
}

double volume_of(const scheme::PairGraph& graph) {
  return std::accumulate(graph.Omega.begin(), graph.Omega.end(), 0.0);
}

}  // namespace

EnergyUnits energy_units(const cases::Case& setup, const scheme::PairGraph& graph, double speed) {
  constexpr double eps = std::numeric_limits<double>::epsilon();
  const bool is_single = setup.scheme.precision == "single";
  const double of_state = is_single ? std::numeric_limits<float>::epsilon() : eps;
  // H and J are rounded in every step, apart from F: 3 to 10 eps after 500 steps, as their root; in
  // single precision up to 0.2 eps (spinning-cube at 0.1 to 10 rad/s)
  const double of_rounds = is_single ? 10 : std::sqrt(n_steps);
  const double of_strain = setup.scheme.unknowns == "F" ? of_state : of_rounds * of_state;
  const double mass = setup.material.density * volume_of(graph);
  return {of_strain * mass * speed * speed,
          {free_directions(setup, graph), mass},
          std::sqrt(n_steps) * of_state};
}

MomentumUnits momentum_units(const cases::Case& setup,
                             const scheme::PairGraph& graph,
                             double energy) {
  const scheme::Vec3 centroid = scheme::centroid_of(graph);
  double reach = 0;
  for (const scheme::Vec3& X : graph.X)
    reach = std::max(reach, (X - centroid).norm());
  const double mass = setup.material.density * volume_of(graph);
  const double momentum = std::sqrt(2 * mass * energy);
  return {momentum, momentum * reach};
}

double inertia_if_held(const cases::Case& setup, const scheme::PairGraph& graph) {
  if (!is_held(setup)) return 0;
  const scheme::Vec3 centroid = scheme::centroid_of(graph);
  double sum = 0;
  for (size_t a = 0; a < graph.X.size(); ++a)
    sum += graph.Omega[a] * (graph.X[a] - centroid).squaredNorm();
  return setup.material.density * sum;
}

}  // namespace diptych::run
