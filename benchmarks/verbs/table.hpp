#pragma once
/// The verbs of the program. A verb is a file NAME.cpp of this folder that defines declare_NAME,
/// and a line in verbs.def.

#include "benchmarks/verbs/command_line.hpp"

namespace diptych::verbs {

#define DIPTYCH_VERB(name, help) Action declare_##name(CommandLine& line);
#include "benchmarks/verbs/verbs.def"
#undef DIPTYCH_VERB

/// All verbs, in the order in which help shows them.
inline const std::vector<Verb>& verb_table() {
#define DIPTYCH_VERB(name, help) {#name, help, declare_##name},
  static const std::vector<Verb> table{
#include "benchmarks/verbs/verbs.def"
  };
#undef DIPTYCH_VERB
  return table;
}

}  // namespace diptych::verbs
