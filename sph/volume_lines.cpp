#include "sph/volume_lines.hpp"

#include "common/closure/sbp_operator.hpp"

namespace diptych::sph {

scheme::VolumeLines volume_lines(const meshes::BlockMeasure& measure) {
  const meshes::StructuredBlock& block = measure.block();
  scheme::VolumeLines lines;
  for (int d = 0; d < block.dimension; ++d) {
    const int n = block.n_nodes[d];
    const closure::SbpOperator along(closure::gregory_table(n), n);
    scheme::LineDerivative derivative;
    for (int i = 0; i < n; ++i) {
      derivative.row.emplace_back();
      for (const closure::SbpOperator::Entry& entry : along.row(i))
        derivative.row.back().push_back({entry.node, entry.Q});
      derivative.H.push_back(along.H(i));
    }
    lines.along.push_back(std::move(derivative));
  }
  lines.place = block.place;
  lines.node = block.node;
  lines.cell = measure.edges().col(0).dot(measure.face(0));
  return lines;
}

}  // namespace diptych::sph
