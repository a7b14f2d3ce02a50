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
  template double AppliedBoundary::squared_reactions(const Body<Dim>&) const;            \
  template Vec3 AppliedBoundary::reaction(const Body<Dim>&, const std::vector<std::int32_t>&) const;
DIPTYCH_INSTANTIATE(2)
DIPTYCH_INSTANTIATE(3)
#undef DIPTYCH_INSTANTIATE

}  // namespace diptych::scheme
