/// diptych list: the shipped cases.

#include "benchmarks/harness/case_list.hpp"
#include "benchmarks/verbs/case_arguments.hpp"
#include "benchmarks/verbs/table.hpp"

#include <fmt/format.h>

namespace diptych::verbs {

Action declare_list(CommandLine&) {
  return [] {
    for (const auto& [name, title] : harness::shipped_cases())
      print(fmt::format("{:<32} {}\n", name, title));
    return 0;
  };
}

}  // namespace diptych::verbs
