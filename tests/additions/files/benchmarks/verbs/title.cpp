/// diptych title: the title of a case.

#include "benchmarks/verbs/case_arguments.hpp"
#include "benchmarks/verbs/table.hpp"

#include <memory>

namespace diptych::verbs {

Action declare_title(CommandLine& line) {
  const auto arguments = std::make_shared<CaseArguments>();
  arguments->declare(line);
  return [arguments] {
    print(arguments->read().title + "\n");
    return 0;
  };
}

}  // namespace diptych::verbs
