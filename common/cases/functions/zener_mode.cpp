#include "common/cases/functions/function_type.hpp"
#include "common/functions/time_functions.hpp"

namespace diptych::cases {

namespace {

using Parameters = functions::ZenerModeParameters;

SectionKeys<Parameters> keys_of_mode() {
  return SectionKeys<Parameters>("functions.*")
      .key("wave_number_squared", &Parameters::wave_number_squared,
           {"1/m^2", above(0), "Square k2 of the wave number |k| of the mode.", "\"3*pi^2/4\"",
            "with zener_mode"})
      .key("density", &Parameters::density,
           {"kg/m^3", above(0), "Density rho.", "1100", "required but with expression"})
      .key("modulus", &Parameters::modulus,
           {"Pa", above(0),
            "Equilibrium modulus M of the mode: lambda + 2 mu for a pressure wave, mu for a shear "
            "wave.",
            "22.885e6", "with zener_*"})
      .key("branch_moduli", &Parameters::branch_moduli,
           {"Pa", above(0),
            "Moduli M_a of the branches: 4 xi^a and 8 zeta^a (pressure), 2 xi^a and 2 zeta^a "
            "(shear).",
            "[3.269e6, 6.538e6]"})
      .key("branch_times", &Parameters::branch_times,
           {"s", above(0), "Relaxation times tau_a, as many as branch_moduli.", "[2e-3, 1e-3]"})
      .key("amplitude", &Parameters::amplitude,
           {"-, Pa, m/s", any,
            "q at t = 0 (zener_mode), or size of the signal: stress (zener_slab), velocity "
            "(zener_wave).",
            "5e-4"})
      .key("rate", &Parameters::rate, {"1/s", any, "Rate of q at t = 0.", "0"})
      .key("relaxed", &Parameters::relaxed,
           {"-", any, "Branches start at q_a = q (true) or at q_a = 0 (false).", "true"});
}

}  // namespace

FunctionType zener_mode() {
  return function_type(
      "zener_mode gives NAME (amplitude q), NAME_dot, NAME_ddot and NAME_1 ... NAME_n (branch "
      "strains q_a) of rho q'' + k2 [M q + sum M_a (q - q_a)] = 0, q_a' = (q - q_a)/tau_a.",
      keys_of_mode(),
      [](const std::string& name, const SectionValues& section, const Parameters& p) {
        check_branches(section, p.branch_moduli.size(), p.branch_times.size());
        return std::make_shared<functions::ZenerMode>(name, p);
      });
}

}  // namespace diptych::cases
