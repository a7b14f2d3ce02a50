#include "common/cases/sections/sections.hpp"

namespace diptych::cases {

SectionEntry output_section() {
  const auto keys =
      SectionKeys<OutputCase>("output")
          .key("frames", &OutputCase::frames,
               {"-", between(1, 1e6),
                "Instants of output after t = 0, evenly spaced, the last at the end.", "50"})
          .key("fields", &OutputCase::fields,
               {"-", any, "Write the fields, not only the history.", "false"});
  return plain_section({"output", false, "What is written."}, keys, &Case::output);
}

}  // namespace diptych::cases
