#pragma once
/// Largest stable time step (notes 2.1), from the graph and the wave speeds:
///   dt = cfl / rate,  rate = max_a sum_b |C_ab| c_ab / (2 Omega_a),  c_ab = max(c_p,a, c_p,b),
/// the Gershgorin bound of the dissipation operator, h/c on a line of nodes. The face correction
/// raises the largest frequency and so shortens it (frequency_factor); what the dissipation allows
/// is in the default cfl (run/default_cfl.hpp). Relaxation does not enter (notes 5). Tests:
/// tests/verification/time_step_test.cpp

#include "common/scheme/body/body.hpp"
#include "common/scheme/graph/pair_graph.hpp"

#include <vector>

namespace diptych::scheme {

/// Which speeds the rate is made of.
enum class Speeds {
  exact,      ///< of the current state with all branches, pair by pair
  bound,      ///< the largest of the current state for all pairs: never a larger step than exact
  linearised  ///< of the undeformed, virgin body: unsafe where the body stiffens
};

struct TimeStepRule {
  Speeds speeds = Speeds::exact;
  double cfl = 1;
  double frequency_factor = 1;  ///< of the face correction

  /// Allowed dt times rate.
  double limit() const { return cfl / frequency_factor; }
};

/// [n_nodes] sum_b |C_ab| / (2 Omega_a)  [1/m]: rate per unit of speed.
std::vector<double> geometric_rates(const PairGraph& graph);

/// The largest of them.
double geometric_rate(const PairGraph& graph);

/// Largest c_p of the nodes of blocks [begin, end), from their records  [m/s].
template <int Dim>
double largest_speed(const Body<Dim>& body, std::int64_t begin, std::int64_t end) {
  const std::int64_t last =
      end * algebra::n_lanes < body.n_owned ? end * algebra::n_lanes : body.n_owned;
  double largest = 0;
  for (std::int64_t a = begin * algebra::n_lanes; a < last; ++a) {
    const double z_p = body.records.at(a, NodeRecord<Dim>::z_p);
    largest = z_p > largest || z_p != z_p ? z_p : largest;
  }
  return largest / body.options.rho_R;
}

}  // namespace diptych::scheme
