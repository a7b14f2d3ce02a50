#include "common/cases/bound.hpp"
#include "common/cases/sections/sections.hpp"

namespace diptych::cases {

namespace {

SectionKeys<ExpectCase> expect_keys() {
  return SectionKeys<ExpectCase>("expect")
      .key("holds", KeyType::texts,
           with_default({"-", any,
                         "Bounds beyond those: figures of the run (\"energy residual\", \"least "
                         "J\", \"kinetic growth\", \"tip, greatest\", ...; a wrong name lists "
                         "them) with <= or >= and a number or an expression of parameters.",
                         "[\"tip, final <= 1.05*tip_of_beam\"]", "none"}))
      .key("variants", &ExpectCase::variants,
           as(KeyType::texts,
              {"-", any,
               "Overrides, each of them a further run of both methods, or of one where it is a "
               "key of sph or fvm.",
               "[\"sph.kappa=0.75\"]"}))
      .key("stops", &ExpectCase::stops,
           {"-", any,
            "The run is to be stopped (code 3) with this text in its message, in place of all "
            "bounds.",
            "\"energy budget does not close\""})
      .key("by_step", &ExpectCase::by_step,
           {"-", at_least(0), "The last step by which it is stopped; 0: any.", "100"});
}

}  // namespace

SectionEntry expect_section() {
  const auto keys = expect_keys();
  return {{"expect", false,
           "The pass numbers of a case, which the regression asks of every run on level 0 with "
           "and without a baseline: it comes to its end, the energy residual is at most 1e-2, no "
           "cell is inside out at any output, and the bounds below hold. A run on any level whose "
           "pass numbers do not hold has the status \"unmet\" and code 5."},
          keys.keys(),
          [keys](Reading& reading, Case& setup) {
            if (reading.table("expect") == nullptr) return;
            const SectionValues section = reading.section("expect");
            setup.expect = keys.read(section);
            setup.expect.is_given = true;
            if (setup.expect.stops.empty())
              section.refuse("by_step", "has no effect without expect.stops; remove it");
            else
              section.refuse("holds", "has no effect on a run that is to be stopped; remove it");
            if (!section.has("holds")) return;
            for (const std::string& text : section.texts("holds"))
              setup.expect.holds.push_back(
                  bound_from_text(text, reading.vocabulary.parameters, section.where("holds")));
          }};
}

}  // namespace diptych::cases
