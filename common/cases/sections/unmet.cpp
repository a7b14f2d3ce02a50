#include "common/base/text.hpp"
#include "common/cases/sections/sections.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace diptych::cases {

namespace {

SectionKeys<UnmetCase> unmet_keys() {
  return SectionKeys<UnmetCase>("expect.unmet")
      .key("method", &UnmetCase::method,
           one_of({"sph", "fvm"}, "Who does not meet them.", "\"sph\"", "required"))
      .key("variant", &UnmetCase::variant,
           {"-", any, "The entry of expect.variants; empty: the case as it stands.",
            "\"sph.kappa=0.75\""})
      .key("figure", &UnmetCase::figure,
           {"-", any,
            "The figure of expect.holds that is not met, where all others are; empty: whichever "
            "are not.",
            "\"numerical share\""})
      .key("stops", &UnmetCase::stops,
           {"-", any,
            "Until they are met the run is stopped (code 3) with this text in its message; empty: "
            "it comes to its end, and a bound does not hold.",
            "\"cells are inside out\""})
      .key("by_step", &UnmetCase::by_step,
           {"-", at_least(0), "The last step by which it is stopped; 0: any.", "1000"})
      .key("because", &UnmetCase::because,
           {"-", any, "The measured cause, which the regression shows.",
            "\"bulk pressure on nodal J\"", "required"});
}

void check_variant(const SectionValues& section, const Case& setup, const UnmetCase& unmet) {
  const std::vector<std::string>& variants = setup.expect.variants;
  if (unmet.variant.empty()) return;
  if (std::find(variants.begin(), variants.end(), unmet.variant) != variants.end()) return;
  section.fail("variant", fmt::format("= '{}' is none of expect.variants{}", unmet.variant,
                                      base::suggestion(unmet.variant, variants)));
}

}  // namespace

SectionEntry unmet_section() {
  const auto keys = unmet_keys();
  return {{"expect.unmet", true,
           "What today's program does not meet, and how it ends instead. The regression shows it "
           "as known, with its cause, and fails where it ends otherwise, or where the pass numbers "
           "are met: then the entry is to be removed."},
          keys.keys(),
          [keys](Reading& reading, Case& setup) {
            for (const SectionValues& entry : reading.entries("expect.unmet")) {
              UnmetCase unmet = keys.read(entry);
              unmet.where = entry.where();
              check_variant(entry, setup, unmet);
              if (!unmet.stops.empty())
                entry.refuse("figure", "has no effect with stops; remove it");
              if (unmet.stops.empty())
                entry.refuse("by_step", "has no effect without stops; remove it");
              setup.expect.unmet.push_back(unmet);
            }
          }};
}

}  // namespace diptych::cases
