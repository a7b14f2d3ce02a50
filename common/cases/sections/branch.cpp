#include "common/base/error.hpp"
#include "common/cases/sections/sections.hpp"

#include <string>

namespace diptych::cases {

namespace {

/// beta and tau of one kind: both or none.
bool read_pair(const SectionValues& branch, const std::string& kind, double& beta, double& tau) {
  const std::string beta_name = "beta_" + kind, tau_name = "tau_" + kind;
  if (!branch.has(beta_name) && !branch.has(tau_name)) return false;
  beta = branch.number(beta_name);
  tau = branch.number(tau_name);
  return true;
}

BranchCase read_branch(const SectionValues& section, double zeta_ratio) {
  BranchCase branch;
  const bool has_C = read_pair(section, "C", branch.beta_C, branch.tau_C);
  const bool has_G = read_pair(section, "G", branch.beta_G, branch.tau_G);
  if (!has_C && !has_G) {
    throw base::InputError(functions::prefix(section.where()) +
                           "this material.branch is empty; give beta_C + tau_C, beta_G + tau_G, "
                           "or both");
  }
  if (has_G && zeta_ratio == 0) {
    section.fail("beta_G",
                 "has no effect: zeta = 0 in this material (zeta^a = beta_G zeta); take "
                 "mooney-rivlin with zeta_ratio > 0, or beta_C");
  }
  return branch;
}

}  // namespace

SectionEntry branch_section() {
  const auto number = [](const char* unit, const char* need, const char* meaning,
                         const char* example) {
    return KeyText{unit, above(0), meaning, example, need};
  };
  const auto keys =
      SectionKeys<BranchCase>("material.branch")
          .key("beta_C", KeyType::number, number("-", "with tau_C", "xi^a / xi.", "0.5"))
          .key("tau_C", KeyType::number,
               number("s", "with beta_C", "Relaxation time of C_v^-1.", "2e-3"))
          .key("beta_G", KeyType::number,
               number("-", "with tau_G, where zeta > 0", "zeta^a / zeta.", "0.5"))
          .key("tau_G", KeyType::number,
               number("s", "with beta_G", "Relaxation time of G_v^-1.", "1e-3"));
  return {{"material.branch", true,
           "A Maxwell branch: xi^a = beta_C xi relaxing with tau_C, zeta^a = beta_G zeta relaxing "
           "with tau_G; at least one of the two."},
          keys.keys(),
          [](Reading& reading, Case& setup) {
            for (const SectionValues& entry : reading.entries("material.branch"))
              setup.material.branches.push_back(read_branch(entry, setup.material.zeta_ratio));
          }};
}

}  // namespace diptych::cases
