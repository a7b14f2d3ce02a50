/// diptych explain: what a key of a case file means.

#include "benchmarks/run/menus.hpp"
#include "benchmarks/verbs/case_arguments.hpp"
#include "benchmarks/verbs/table.hpp"
#include "common/cases/keys.hpp"

#include <memory>

namespace diptych::verbs {

Action declare_explain(CommandLine& line) {
  const auto key = std::make_shared<std::string>();
  line.word("key", *key, "such as mesh.cells; 'all' prints the reference page");
  return [key] {
    print(*key == "all" ? cases::reference_page(harness::menus())
                        : cases::explain(*key, harness::menus()));
    return 0;
  };
}

}  // namespace diptych::verbs
