#pragma once
/// What one evaluation does with the internal variables (14): weights of every branch for the time
/// that has passed since the beginning of the step (notes 5.5).

#include "common/physics/maxwell_branch.hpp"
#include "common/physics/step_dissipation.hpp"
#include "common/physics/viscous_evolution.hpp"

#include <vector>

namespace diptych::scheme {

struct Relaxation {
  enum class Rule {
    frozen,  ///< A as stored
    linear,  ///< LIN between F_0 and F
    gauss    ///< GEXP over the Hermite cubic of F_0, L_0, F, L
  };
  Rule rule = Rule::frozen;
  bool commit = false;  ///< store the result: end of the step
  double dt = 0;        ///< s, since the beginning of the step
  std::vector<physics::LinearRelaxation> linear_C, linear_G;
  std::vector<physics::GaussRelaxation> gauss_C, gauss_G;
  std::vector<physics::ExcessWeights> excess_C, excess_G;  ///< at the end of a step

  Relaxation() = default;
  Relaxation(Rule which,
             bool end_of_step,
             double elapsed,
             const std::vector<physics::MaxwellBranch>& branches)
      : rule(which), commit(end_of_step), dt(elapsed) {
    for (const auto& branch : branches) {
      linear_C.push_back(physics::linear_relaxation(dt / branch.tau_C));
      linear_G.push_back(physics::linear_relaxation(dt / branch.tau_G));
      if (commit) {
        excess_C.push_back(physics::excess_weights(dt / branch.tau_C));
        excess_G.push_back(physics::excess_weights(dt / branch.tau_G));
      }
      if (rule != Rule::gauss) continue;
      gauss_C.push_back(physics::gauss_relaxation(dt / branch.tau_C));
      gauss_G.push_back(physics::gauss_relaxation(dt / branch.tau_G));
    }
  }
};

}  // namespace diptych::scheme
