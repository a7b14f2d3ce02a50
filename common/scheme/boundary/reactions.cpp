/// What constraints and walls exert, from the force field.

#include "common/parallel/reduction.hpp"
#include "common/scheme/boundary/applied_boundary.hpp"
#include "common/scheme/boundary/node_vector.hpp"

#include <algorithm>

namespace diptych::scheme {

template <int Dim>
double AppliedBoundary::power_against_forces(const Body<Dim>& body) const {
  if (!has_velocities_) return 0;
  return parallel::sum_over<double>(body.part(), chunks_of_constrained_,
                                    [&](std::int64_t i, double& power) {
                                      const ConstrainedNode& c = constrained_[i];
                                      if (!c.velocity) return;
                                      const Vec3 v = vector_at<Dim>(body.v, c.node);
                                      power -= vector_at<Dim>(body.T, c.node).dot(v - c.keep * v);
                                    });
}

void AppliedBoundary::list_held_loads() {
  held_loads_.clear();
  std::vector<std::int64_t> chunks;
  for (size_t k = 0; k < constrained_.size(); ++k) {
    const std::int32_t slot = slot_of_node_[static_cast<size_t>(constrained_[k].node)];
    if (slot < 0) continue;
    held_loads_.push_back({static_cast<size_t>(slot), k});
    chunks.push_back(chunk_of_node(constrained_[k].node));
  }
  chunks_of_held_loads_ = parallel::ChunksOfList(chunks);
}

template <int Dim>
double AppliedBoundary::power_gain_of_loads(const Body<Dim>& body) const {
  if (loaded_nodes_.empty()) return 0;
  const double rho_R = body.options.rho_R;
  const auto all =
      parallel::sum_over<double>(body.part(), chunks_of_loaded_, [&](std::int64_t k, double& sum) {
        const std::int32_t a = loaded_nodes_[k];
        sum += forces_[k].dot(vector_at<Dim>(body.T, a)) / (rho_R * Omega_[a]);
      });
  const auto held = parallel::sum_over<double>(
      body.part(), chunks_of_held_loads_, [&](std::int64_t k, double& sum) {
        const HeldLoad& at = held_loads_[k];
        const ConstrainedNode& c = constrained_[at.constrained];
        const Vec3 T = vector_at<Dim>(body.T, c.node);
        sum += forces_[at.loaded].dot(T - c.keep * T) / (rho_R * c.Omega);
      });
  return all - held - walls_.power_gain_withheld(body, forces_, slot_of_node_);
}

template <int Dim>
double AppliedBoundary::squared_reactions(const Body<Dim>& body) const {
  return walls_.squared_forces(body) +
         parallel::sum_over<double>(
             body.part(), chunks_of_constrained_, [&](std::int64_t i, double& sum) {
               const ConstrainedNode& c = constrained_[i];
               const Vec3 T = vector_at<Dim>(body.T, c.node);
               sum += (T - c.keep * T).squaredNorm() / (body.options.rho_R * c.Omega);
             });
}

/// What keeps the velocity of a constrained node as prescribed, at a fraction of the step  [N]
template <int Dim>
Vec3 AppliedBoundary::force_on(const Body<Dim>& body, std::int64_t k, double fraction) const {
  const ConstrainedNode& c = constrained_[k];
  Vec3 force = -vector_at<Dim>(body.T, c.node);
  if (c.velocity && in_step_.step() > 0)
    force += body.options.rho_R * c.Omega * in_step_.rate(k, fraction);
  return force - c.keep * force;
}

template <int Dim>
Vec3 AppliedBoundary::reaction(const Body<Dim>& body,
                               const std::vector<std::int32_t>& nodes) const {
  const auto held = parallel::sum_over<VectorSum>(
      body.part(), chunks_of_constrained_, [&](std::int64_t k, VectorSum& sum) {
        const ConstrainedNode& c = constrained_[k];
        if (!std::binary_search(nodes.begin(), nodes.end(), c.node)) return;
        sum.value += force_on(body, k, 1);
      });
  return walls_.force(body, nodes) + held.value;
}

#define DIPTYCH_INSTANTIATE(Dim)                                                         \
  template double AppliedBoundary::power_against_forces(const Body<Dim>&) const;         \
  template Vec3 AppliedBoundary::force_on(const Body<Dim>&, std::int64_t, double) const; \
  template double AppliedBoundary::power_gain_of_loads(const Body<Dim>&) const;          \
  template double AppliedBoundary::squared_reactions(const Body<Dim>&) const;            \
  template Vec3 AppliedBoundary::reaction(const Body<Dim>&, const std::vector<std::int32_t>&) const;
DIPTYCH_INSTANTIATE(2)
DIPTYCH_INSTANTIATE(3)
#undef DIPTYCH_INSTANTIATE

}  // namespace diptych::scheme
