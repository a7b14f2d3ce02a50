#include "benchmarks/study/refinement.hpp"

#include "common/base/error.hpp"

#include <fmt/format.h>

namespace diptych::harness {

void require_refined(const cases::Case& setup,
                     const io::RunSummary& coarse,
                     const io::RunSummary& fine) {
  if (coarse.nodes != fine.nodes || coarse.level == fine.level) return;
  throw base::InputError(fmt::format(
      "{}: level {} has as many nodes as level {}, {}: no refinement, from which neither orders "
      "nor "
      "error bars follow. A level halves mesh.size, which a .geo file gets as h: let the sizes of "
      "'{}' follow it (DefineConstant[h = {:g}]; Mesh.MeshSizeMin = h; Mesh.MeshSizeMax = h; and "
      "none set again)",
      setup.file, fine.level, coarse.level, fine.nodes, setup.mesh.file, setup.mesh.size));
}

}  // namespace diptych::harness
