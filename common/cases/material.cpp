#include "common/cases/material.hpp"

#include "common/base/error.hpp"
#include "common/base/text.hpp"

#include <fmt/format.h>

namespace diptych::cases {

namespace {

constexpr std::array<const char*, 5> constant_names{"youngs_modulus", "poissons_ratio",
                                                    "shear_modulus", "lame", "bulk_modulus"};

/// Sets mu and lambda from the one pair that is given.
void read_constants(const SectionValues& section, MaterialCase& material) {
  std::vector<std::string> given;
  for (const char* name : constant_names) {
    if (section.has(name)) given.emplace_back(name);
  }
  const auto is_pair = [&](const char* a, const char* b) {
    return given.size() == 2 && section.has(a) && section.has(b);
  };
  if (is_pair("youngs_modulus", "poissons_ratio")) {
    const double E = section.number("youngs_modulus"), nu = section.number("poissons_ratio");
    material.shear_modulus = E / (2 * (1 + nu));
    material.lame = E * nu / ((1 + nu) * (1 - 2 * nu));
  } else if (is_pair("shear_modulus", "lame")) {
    material.shear_modulus = section.number("shear_modulus");
    material.lame = section.number("lame");
  } else if (is_pair("shear_modulus", "bulk_modulus")) {
    material.shear_modulus = section.number("shear_modulus");
    material.lame = section.number("bulk_modulus") - 2 * material.shear_modulus / 3;
  } else {
    throw base::InputError(fmt::format(
        "{}material takes one pair of constants (youngs_modulus + poissons_ratio, shear_modulus + "
        "lame, or shear_modulus + bulk_modulus); found: {}",
        functions::prefix(section.where()), given.empty() ? "none" : base::joined(given)));
  }
}

double poissons_ratio(const MaterialCase& m) {
  return m.lame / (2 * (m.lame + m.shear_modulus));
}

/// lambda_hat = lambda - 4 zeta > 0, zeta = ratio mu / 2 (mu = 2 (xi + zeta)); beyond rounding.
void check_polyconvex(const SectionValues& section, const MaterialCase& m) {
  const double lambda_hat = m.lame - 2 * m.zeta_ratio * m.shear_modulus;
  if (m.lame > 0 && lambda_hat > 1e-12 * m.lame) return;
  if (m.lame <= 0) {
    throw base::InputError(fmt::format(
        "{}material: lambda = {:.6g} Pa (nu = {:.6g}), so lambda_hat = lambda - 4 zeta > 0 "
        "(polyconvexity, eq. 4) cannot hold; use a Poisson's ratio above 0 or an isochoric model",
        functions::prefix(section.where(section.has("lame") ? "lame" : "poissons_ratio")), m.lame,
        poissons_ratio(m)));
  }
  section.fail(
      "zeta_ratio",
      fmt::format("= {} gives lambda_hat = lambda - 4 zeta = {:.6g} Pa <= 0 for nu = "
                  "{:.6g} (polyconvexity, eq. 4); use less than {:.6g}",
                  m.zeta_ratio, lambda_hat, poissons_ratio(m), m.lame / (2 * m.shear_modulus)));
}

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

MaterialCase read_material(const SectionValues& section,
                           const std::vector<SectionValues>& branches) {
  MaterialCase material;
  material.model = section.menu_name("model");
  material.density = section.number("density");
  read_constants(section, material);
  if (material.model == "mooney-rivlin") {
    material.zeta_ratio = section.number("zeta_ratio");
  } else {
    section.refuse("zeta_ratio", fmt::format("has no effect on {}; remove it or take "
                                             "mooney-rivlin",
                                             material.model));
  }
  const bool is_isochoric = material.model.find("isochoric") != std::string::npos;
  const double bulk = material.lame + 2 * material.shear_modulus / 3;
  if (!is_isochoric) check_polyconvex(section, material);
  if (is_isochoric && !(bulk > 0)) {
    section.fail("lame", fmt::format("= {:.6g} Pa gives a bulk modulus lambda + 2 mu/3 = {:.6g} Pa "
                                     "<= 0; use more than {:.6g}",
                                     material.lame, bulk, -2 * material.shear_modulus / 3));
  }
  for (const SectionValues& branch : branches)
    material.branches.push_back(read_branch(branch, material.zeta_ratio));
  return material;
}

}  // namespace diptych::cases
