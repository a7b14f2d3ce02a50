#include "fvm/block_metrics.hpp"

#include "common/base/error.hpp"

#include <fmt/format.h>

namespace diptych::fvm {

using algebra::Vec3;

BlockMetrics::BlockMetrics(const meshes::Mesh& mesh, const meshes::LatticeBlock& block, int order)
    : block_(block), T_(static_cast<size_t>(block.n_places())) {
  for (int d = 0; d < block.dimension; ++d) {
    const int n = block.n_nodes[d];
    along_.push_back(block.is_closed[d]
                         ? closure::SbpOperator::closed(order, n)
                         : closure::SbpOperator(closure::widest_sbp_table(order, n), n));
  }
  for (std::int64_t p = 0; p < block.n_places(); ++p) {
    const Vec3& X = mesh.nodes[block.node[p]];
    auto& T = T_[static_cast<size_t>(p)];
    T.fill(Vec3::UnitZ());
    const auto place = block.place(p);
    for (int d = 0; d < block.dimension; ++d) {
      T[d].setZero();
      auto at = place;
      for (const closure::SbpOperator::Entry& entry : along(d).row(place[d])) {
        at[d] = entry.node;
        T[d] += entry.Q * (mesh.nodes[block.node[block.index(at)]] - X);
      }
      T[d] /= along(d).H(place[d]);
    }
    if (!(volume(p) > 0)) {
      throw base::InputError(fmt::format(
          "the lines of nodes through node {} at ({:.6g}, {:.6g}, {:.6g}) bend too much for "
          "fvm.stencil = \"sbp\": its volume would be {:.3g}; use a finer mesh or fvm.stencil = "
          "\"edge\"",
          block.node[p], X[0], X[1], X[2], volume(p)));
    }
  }
}

double BlockMetrics::volume(std::int64_t place) const {
  const auto& T = T_[static_cast<size_t>(place)];
  const auto at = block_.place(place);
  double Omega = T[0].dot(T[1].cross(T[2]));
  for (int d = 0; d < block_.dimension; ++d)
    Omega *= along(d).H(at[d]);
  return Omega;
}

Vec3 BlockMetrics::area(std::int64_t place, int d) const {
  const auto& T = T_[static_cast<size_t>(place)];
  const auto at = block_.place(place);
  Vec3 M = T[static_cast<size_t>((d + 1) % 3)].cross(T[static_cast<size_t>((d + 2) % 3)]);
  for (int t = 0; t < block_.dimension; ++t)
    if (t != d) M *= along(t).H(at[t]);
  return M;
}

}  // namespace diptych::fvm
