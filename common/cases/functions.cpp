#include "common/cases/functions.hpp"

#include "common/base/error.hpp"
#include "common/base/registry.hpp"
#include "common/exact/uniaxial_wave.hpp"
#include "common/exact/zener_bar.hpp"
#include "common/functions/expression_function.hpp"
#include "common/functions/time_functions.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace diptych::cases {

namespace {

using Function = std::shared_ptr<const functions::TimeFunction>;

void check_branches(const SectionValues& section, size_t n_moduli, size_t n_times) {
  if (n_moduli == n_times) return;
  section.fail("branch_times", fmt::format("has {} entries and branch_moduli {}; give one time "
                                           "for each modulus",
                                           n_times, n_moduli));
}

Function read_zener_mode(const std::string& name, const SectionValues& section) {
  functions::ZenerModeParameters p;
  p.wave_number_squared = section.number("wave_number_squared");
  p.density = section.number("density");
  p.modulus = section.number("modulus");
  p.branch_moduli = section.numbers("branch_moduli");
  p.branch_times = section.numbers("branch_times");
  p.amplitude = section.number("amplitude");
  p.rate = section.number("rate");
  p.relaxed = section.flag("relaxed");
  check_branches(section, p.branch_moduli.size(), p.branch_times.size());
  return std::make_shared<functions::ZenerMode>(name, p);
}

Function read_zener_bar(const std::string& name, const SectionValues& section, bool is_slab) {
  exact::ZenerBarParameters p;
  p.is_slab = is_slab;
  if (is_slab) p.length = section.number("length");
  p.density = section.number("density");
  p.modulus = section.number("modulus");
  p.branch_moduli = section.numbers("branch_moduli");
  p.branch_times = section.numbers("branch_times");
  p.amplitude = section.number("amplitude");
  check_branches(section, p.branch_moduli.size(), p.branch_times.size());
  const auto signals = base::Registry<exact::Signal>("signal")
                           .add("step", exact::Signal::step)
                           .add("one-minus-cosine", exact::Signal::one_minus_cosine)
                           .add("sine", exact::Signal::sine);
  p.signal = signals.at(section.menu_name("signal"));
  if (p.signal != exact::Signal::step) {
    p.angular_frequency = section.number("angular_frequency");
  } else {
    section.refuse("angular_frequency", "has no effect on a step; remove it");
  }
  if (p.signal == exact::Signal::sine) {
    p.ramp_rate = section.number("ramp_rate");
  } else {
    section.refuse("ramp_rate", "is for signal = \"sine\"; remove it");
  }
  return std::make_shared<exact::ZenerBar>(name, p);
}

Function read_zener_slab(const std::string& name, const SectionValues& section) {
  return read_zener_bar(name, section, true);
}
Function read_zener_wave(const std::string& name, const SectionValues& section) {
  return read_zener_bar(name, section, false);
}

Function read_uniaxial_wave(const std::string& name, const SectionValues& section) {
  exact::UniaxialWaveParameters p;
  p.density = section.number("density");
  p.shear_modulus = section.number("shear_modulus");
  p.lame = section.number("lame");
  p.zeta_ratio = section.number("zeta_ratio");
  p.velocity = section.number("velocity");
  return std::make_shared<exact::UniaxialWave>(name, p);
}

Function read_expression(const std::string& name, const SectionValues& section) {
  return std::make_shared<functions::ExpressionFunction>(name, section.scalar_field("value"));
}

/// A type with the keys it knows, besides "type".
struct FunctionType {
  Function (*read)(const std::string& name, const SectionValues& section);
  std::vector<std::string> keys;
};

const base::Registry<FunctionType>& function_menu() {
  static const std::vector<std::string> bar{"density",           "modulus",   "branch_moduli",
                                            "branch_times",      "amplitude", "signal",
                                            "angular_frequency", "ramp_rate"};
  static const std::vector<std::string> slab = [] {
    std::vector<std::string> keys = bar;
    keys.push_back("length");
    return keys;
  }();
  static const auto menu =
      base::Registry<FunctionType>("functions.type")
          .add("expression", {read_expression, {"value"}})
          .add("zener_mode", {read_zener_mode,
                              {"wave_number_squared", "density", "modulus", "branch_moduli",
                               "branch_times", "amplitude", "rate", "relaxed"}})
          .add("zener_slab", {read_zener_slab, slab})
          .add("zener_wave", {read_zener_wave, bar})
          .add("uniaxial_wave", {read_uniaxial_wave,
                                 {"density", "shear_modulus", "lame", "zeta_ratio", "velocity"}});
  return menu;
}

}  // namespace

std::shared_ptr<const functions::TimeFunction> read_function(const std::string& name,
                                                             const SectionValues& section) {
  const std::string type = section.menu_name("type");
  const FunctionType& entry = function_menu().at(type);
  constexpr std::string_view family = "functions.*.";
  for (const Key& key : keys()) {
    if (key.path.rfind(family, 0) != 0) continue;
    const std::string last(key.path.substr(family.size()));
    const bool known = std::find(entry.keys.begin(), entry.keys.end(), last) != entry.keys.end();
    if (!known && last != "type")
      section.refuse(last, "is no key of type = \"" + type + "\"; remove it");
  }
  return entry.read(name, section);
}

}  // namespace diptych::cases
