#include "benchmarks/verbs/table.hpp"

namespace diptych::verbs {

const std::vector<Verb>& verb_table() {
#define DIPTYCH_VERB(name, help) {#name, help, declare_##name},
  static const std::vector<Verb> table{
#include "benchmarks/verbs/verbs.def"
  };
#undef DIPTYCH_VERB
  return table;
}

}  // namespace diptych::verbs
