#include "common/run/energy_units.hpp"

#include "common/scheme/boundary/boundary_condition.hpp"
#include "common/scheme/graph/centroid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace diptych::run {

namespace {

constexpr double n_steps = 1e4;  // each of which rounds once, this way or that

/// No velocity is prescribed, and no wall stops it.
bool has_no_support(const cases::Case& setup) {
  return std::all_of(
      setup.boundaries.begin(), setup.boundaries.end(), [](const cases::BoundaryCase& boundary) {
        return scheme::boundary_menu().at(boundary.type).acts == scheme::BoundaryKind::Acts::load;
      });
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

EnergyUnits EnergyBasis::at(const scheme::Balance& initial) const {
  EnergyUnits units{rounding};
  if (free_mass == 0) return units;
  units.carried = 0.5 * initial.linear_momentum.squaredNorm() / free_mass;
  units.rounding = std::max(rounding, std::sqrt(n_steps) * eps * units.carried);
  return units;
}

EnergyBasis energy_basis(const cases::Case& setup, const scheme::PairGraph& graph, double speed) {
  constexpr double eps = std::numeric_limits<double>::epsilon();
  // H and J are rounded in every step, apart from F: 3 to 10 eps after 500 steps, as their root
  const double of_strain = setup.scheme.unknowns == "F" ? eps : std::sqrt(n_steps) * eps;
  const double mass = setup.material.density * volume_of(graph);
  const bool is_single = setup.scheme.precision == "single";
  return {of_strain * mass * speed * speed, has_no_support(setup) ? mass : 0,
          is_single ? std::numeric_limits<float>::epsilon() : eps};
}

MomentumUnits momentum_units(const cases::Case& setup,
                             const scheme::PairGraph& graph,
                             const EnergyUnits& energies) {
  const scheme::Vec3 centroid = scheme::centroid_of(graph);
  double reach = 0;
  for (const scheme::Vec3& X : graph.X)
    reach = std::max(reach, (X - centroid).norm());
  const double mass = setup.material.density * volume_of(graph);
  const double momentum = std::sqrt(2 * mass * energies.rounding);
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
