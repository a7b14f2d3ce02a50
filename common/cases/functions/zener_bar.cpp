/// zener_slab and zener_wave: one bar, loaded at its end or moved at its beginning.

#include "common/exact/zener_bar.hpp"

#include "common/cases/functions/function_type.hpp"

namespace diptych::cases {

namespace {

using Parameters = exact::ZenerBarParameters;
using exact::Signal;

/// @param is_slab  the slab has the entries of the keys of both
SectionKeys<Parameters> keys_of_bar(bool is_slab) {
  const KeyText length{"m", above(0), "Length of the slab.", "1", "with zener_slab"};
  const KeyText signal{
      "-", any,
      "Load: amplitude times 1, 1 - cos(omega t), or sin(omega t) (1 - exp(-ramp_rate t))^3.",
      "\"sine\""};
  const KeyText angular_frequency =
      optional({"1/s", above(0), "omega of the signal.", "200", "with an oscillating signal"});
  const KeyText ramp_rate =
      optional({"1/s", above(0), "How fast the signal comes up.", "100", "with signal = \"sine\""});
  SectionKeys<Parameters> keys("functions.*");
  keys.bind("density", &Parameters::density)
      .bind("modulus", &Parameters::modulus)
      .bind("branch_moduli", &Parameters::branch_moduli)
      .bind("branch_times", &Parameters::branch_times)
      .bind("amplitude", &Parameters::amplitude);
  if (is_slab) keys.key("length", &Parameters::length, length);
  return keys
      .choice("signal", &Parameters::signal,
              {{"step", Signal::step},
               {"one-minus-cosine", Signal::one_minus_cosine},
               {"sine", Signal::sine}},
              signal)
      .key("angular_frequency", &Parameters::angular_frequency, angular_frequency)
      .key("ramp_rate", &Parameters::ramp_rate, ramp_rate);
}

/// What the signal takes; the rest must not be there.
void check(const SectionValues& section, const Parameters& p) {
  check_branches(section, p.branch_moduli.size(), p.branch_times.size());
  if (p.signal == Signal::step) {
    section.refuse("angular_frequency", "has no effect on a step; remove it");
  } else {
    section.number("angular_frequency");
  }
  if (p.signal == Signal::sine) {
    section.number("ramp_rate");
  } else {
    section.refuse("ramp_rate", "is for signal = \"sine\"; remove it");
  }
}

FunctionType bar(const std::string& meaning, bool is_slab) {
  FunctionType type =
      function_type(meaning, keys_of_bar(is_slab),
                    [is_slab](const std::string& name, const SectionValues& section, Parameters p) {
                      p.is_slab = is_slab;
                      check(section, p);
                      return std::make_shared<exact::ZenerBar>(name, p);
                    });
  if (!is_slab) type.keys.clear();
  return type;
}

}  // namespace

FunctionType zener_slab() {
  return bar(
      "zener_slab and zener_wave give NAME (displacement), NAME_v, NAME_strain, NAME_stress of "
      "small waves along x in that solid, virgin and at rest at t = 0: in 0 <= x <= length held at "
      "x = 0 with the stress signal(t) at x = length, or in x >= 0 with the velocity signal(t) at "
      "x = 0; NAME_speed, NAME_attenuation of the steady wave.",
      true);
}

FunctionType zener_wave() {
  return bar("", false);
}

}  // namespace diptych::cases
