#pragma once
/// The lines of a lattice whose volumes and boundary areas are those of SPH that sums by parts
/// (sbp_graph.hpp): derivatives with Gregory's weights. Source: notes 3.10. Test:
/// tests/graphs/sph_sbp_test.cpp

#include "common/scheme/graph/volume_lines.hpp"
#include "meshes/block_measure.hpp"

namespace diptych::sph {

scheme::VolumeLines volume_lines(const meshes::BlockMeasure& measure);

}  // namespace diptych::sph
