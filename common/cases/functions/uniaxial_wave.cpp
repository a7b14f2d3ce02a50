#include "common/exact/uniaxial_wave.hpp"

#include "common/cases/functions/function_type.hpp"

namespace diptych::cases {

namespace {

using Parameters = exact::UniaxialWaveParameters;

SectionKeys<Parameters> keys_of_wave() {
  return SectionKeys<Parameters>("functions.*")
      .bind("density", &Parameters::density)
      .key("shear_modulus", &Parameters::shear_modulus,
           {"Pa", above(0), "Shear modulus mu.", "6.54e6", "with uniaxial_wave"})
      .key("lame", &Parameters::lame,
           {"Pa", above(0), "First Lame constant lambda.", "9.81e6", "with uniaxial_wave"})
      .key("zeta_ratio", &Parameters::zeta_ratio,
           {"-", Range{0, 1, true, false}, "zeta/(xi + zeta) of the Mooney-Rivlin solid.", "0.5"})
      .key("velocity", &Parameters::velocity,
           {"m/s", any, "Velocity of the body before x = 0 is held; not 0.", "-10",
            "with uniaxial_wave"});
}

}  // namespace

FunctionType uniaxial_wave() {
  return function_type(
      "uniaxial_wave gives NAME (displacement), NAME_v, NAME_f, NAME_P, NAME_f_wall, NAME_P_wall, "
      "NAME_speed of the elastic half space x >= 0 in uniaxial strain that moves at a velocity and "
      "is held at x = 0: a shock where it is negative, else a fan.",
      keys_of_wave(), [](const std::string& name, const SectionValues&, const Parameters& p) {
        return std::make_shared<exact::UniaxialWave>(name, p);
      });
}

}  // namespace diptych::cases
