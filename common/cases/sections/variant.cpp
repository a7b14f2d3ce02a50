#include "common/cases/variant.hpp"

#include "common/cases/sections/sections.hpp"

namespace diptych::cases {

namespace {

SectionKeys<VariantCase> variant_keys() {
  return SectionKeys<VariantCase>("variant")
      .key("name", &VariantCase::name,
           {"-", any,
            "What its column and its folder are called (sph-compact): letters, digits and . _ = + "
            "-; once for a method.",
            "\"compact\"", "required"})
      .key("method", &VariantCase::method,
           {"-",
            any,
            "Whose column it is, sph or fvm; by itself that of the keys that are set, and one of "
            "both where they are of neither.",
            "\"sph\"",
            "",
            "",
            {"sph", "fvm"}})
      .key("set", &VariantCase::set,
           as(KeyType::texts, {"-", any,
                               "Its settings, as of --set; those of sph and of fvm in variants of "
                               "their own.",
                               "[\"sph.kappa=0.75\"]", "required"}));
}

}  // namespace

SectionEntry variant_section() {
  const auto keys = variant_keys();
  return {{"variant", true,
           "A column beside both methods in `diptych compare`, `converge` and `study`, as `--with` "
           "gives one: the case with some settings changed. Other verbs leave it alone."},
          keys.keys(),
          [keys](Reading& reading, Case& setup) {
            for (const SectionValues& entry : reading.entries("variant")) {
              VariantCase variant = keys.read(entry);
              variant.where = entry.where();
              add_variant(std::move(variant), setup.variants);
            }
          }};
}

}  // namespace diptych::cases
