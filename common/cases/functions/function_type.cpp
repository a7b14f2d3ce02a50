#include "common/cases/functions/function_type.hpp"

#include <fmt/format.h>

namespace diptych::cases {

const base::Registry<FunctionType>& function_menu() {
  static const auto menu = [] {
    base::Registry<FunctionType> all("functions.type");
#define DIPTYCH_FUNCTION(type) all.add(#type, type());
#include "common/cases/functions/functions.def"
#undef DIPTYCH_FUNCTION
    return all;
  }();
  return menu;
}

void check_branches(const SectionValues& section, size_t n_moduli, size_t n_times) {
  if (n_moduli == n_times) return;
  section.fail("branch_times", fmt::format("has {} entries and branch_moduli {}; give one time "
                                           "for each modulus",
                                           n_times, n_moduli));
}

}  // namespace diptych::cases
