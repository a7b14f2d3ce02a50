#include "common/base/error.hpp"
#include "common/base/text.hpp"
#include "common/cases/sections/sections.hpp"
#include "common/physics/moduli.hpp"

#include <array>
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
    const auto lame = physics::lame_from_young(section.number("youngs_modulus"),
                                               section.number("poissons_ratio"));
    material.shear_modulus = lame.mu;
    material.lame = lame.lambda;
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

/// The condition of physics/moduli.hpp, with the key that breaks it.
void check_polyconvex(const SectionValues& section, const MaterialCase& m) {
  const physics::LameConstants lame{m.shear_modulus, m.lame};
  if (physics::is_polyconvex(lame, m.zeta_ratio)) return;
  const double lambda_hat = physics::lambda_hat_of(lame, m.zeta_ratio);
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

void read_moduli(const SectionValues& section, MaterialCase& material) {
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
}

SectionKeys<MaterialCase> material_keys() {
  return SectionKeys<MaterialCase>("material")
      .key("model", &MaterialCase::model,
           as(KeyType::name,
              {"-", any,
               "Law at equilibrium: Mooney-Rivlin of the paper, its limit zeta = 0, or the "
               "isochoric-split neo-Hookean laws with pressure K (J - 1) and K/2 (J^2 - 1)/J.",
               "\"neo-hookean\""}))
      .key("density", &MaterialCase::density,
           {"kg/m^3", above(0), "Density rho_R of the undeformed body.", "1100", "required"})
      .key("youngs_modulus", KeyType::number,
           {"Pa", above(0), "Young's modulus E of small strains.", "17e6", "with poissons_ratio"})
      .key("poissons_ratio", KeyType::number,
           {"-", Range{-1, 0.5, false, false}, "Poisson's ratio nu of small strains.", "0.3",
            "with youngs_modulus",
            "the model is compressible: use at most 0.4999 for a nearly incompressible solid"})
      .key("shear_modulus", KeyType::number,
           {"Pa", above(0), "Shear modulus mu of small strains.", "6.54e6",
            "with lame or bulk_modulus"})
      .key("lame", KeyType::number,
           {"Pa", any, "First Lame constant lambda.", "9.81e6", "with shear_modulus"})
      .key("bulk_modulus", KeyType::number,
           {"Pa", above(0), "Bulk modulus K = lambda + 2 mu / 3.", "14.2e6", "with shear_modulus"})
      .key("zeta_ratio", KeyType::number,
           {"-", Range{0, 1, true, false},
            "zeta/(xi + zeta), the share of the area term; admissible below lambda/(2 mu), where "
            "lambda_hat = lambda - 4 zeta > 0 (polyconvexity, eq. 4).",
            "0.5", "required for mooney-rivlin"});
}

}  // namespace

SectionEntry material_section() {
  const auto keys = material_keys();
  return {{"material", false,
           "The solid; the elastic constants are one pair of youngs_modulus + poissons_ratio, "
           "shear_modulus + lame, or shear_modulus + bulk_modulus."},
          keys.keys(),
          [keys](Reading& reading, Case& setup) {
            const SectionValues section = reading.section("material");
            setup.material = keys.read(section);
            read_moduli(section, setup.material);
          }};
}

}  // namespace diptych::cases
