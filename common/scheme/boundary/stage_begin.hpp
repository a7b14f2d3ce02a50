#pragma once
/// Where a node was when a stage of a Runge-Kutta step began, from what the stage has made of it.

#include "common/scheme/body/body.hpp"
#include "common/scheme/body/stage_combination.hpp"
#include "common/scheme/boundary/node_vector.hpp"

namespace diptych::scheme {

struct StageBegin {
  Vec3 v;  ///< m/s
  Vec3 u;  ///< m
};

/// @pre the stage has updated u and v by the forces of its beginning, which still stand in body.T,
///      and nothing has changed v since in the directions of v that are read
template <int Dim>
DIPTYCH_INLINE StageBegin
stage_begin(const Body<Dim>& body, std::int32_t a, double Omega, const StageCombination& stage) {
  const auto before = [&](const Vec3& now, const BlockField& begin_of_step, const Vec3& rate) {
    const Vec3 old = stage.alpha == 0 ? Vec3(Vec3::Zero()) : vector_at<Dim>(begin_of_step, a);
    return Vec3((now - stage.alpha * old) / stage.beta - stage.dt * rate);
  };
  const Vec3 acceleration = vector_at<Dim>(body.T, a) / (body.options.rho_R * Omega);
  const Vec3 v = before(vector_at<Dim>(body.v, a), body.v_0, acceleration);
  return {v, before(vector_at<Dim>(body.u, a), body.u_0, v)};
}

}  // namespace diptych::scheme
