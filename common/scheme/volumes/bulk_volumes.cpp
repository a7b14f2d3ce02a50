#include "common/scheme/volumes/bulk_volumes.hpp"

#include "common/algebra/gather.hpp"
#include "common/algebra/versions.hpp"
#include "common/parallel/reduction.hpp"
#include "common/scheme/ranks/division.hpp"
#include "common/scheme/volumes/cell_volumes.hpp"
#include "common/scheme/volumes/line_volumes.hpp"

#include <algorithm>

namespace diptych::scheme {

using algebra::InstructionSet;
using algebra::Lanes;
using algebra::n_lanes;

namespace {

/// Rows of forces of blocks of nodes, added to T.
template <int Dim>
struct AddRowsKernel {
  template <InstructionSet isa>
  DIPTYCH_INLINE static void run(const double* rows,
                                 Body<Dim>& body,
                                 std::int64_t begin,
                                 std::int64_t end) {
    constexpr int stride = 4;
    for (std::int64_t b = begin; b < end; ++b) {
      const double* row[n_lanes];
      for (int l = 0; l < n_lanes; ++l)
        row[l] = rows + (b * n_lanes + l) * stride;
      Lanes sum[stride];
      algebra::gather_four<isa>(row, 0, sum);
#pragma GCC unroll 3
      for (int i = 0; i < Dim; ++i)
        body.T.put(b, i, body.T.get(b, i) + sum[i]);
    }
  }
};

}  // namespace

Volumes safe_volumes(const PairGraph& graph) {
  if (graph.commutes) return Volumes::nodes;
  if (!graph.lines.empty()) return Volumes::lines;
  return graph.cells.empty() ? Volumes::nodes : Volumes::cells;
}

template <int Dim>
BulkVolumes<Dim>::BulkVolumes(std::int64_t n_nodes)
    : V_0_(algebra::n_blocks_of(n_nodes) * n_lanes),
      x_(V_0_.size() * stride),
      force_(V_0_.size() * stride),
      n_nodes_(n_nodes) {}

template <int Dim>
void BulkVolumes<Dim>::put_positions(const Body<Dim>& body, Array& x) const {
  parallel::for_chunks(body.part(), body.n_blocks,
                       [&](std::int64_t begin, std::int64_t end, std::int64_t) {
                         const std::int64_t last = std::min(end * n_lanes, n_nodes_);
                         for (std::int64_t a = begin * n_lanes; a < last; ++a) {
                           for (int i = 0; i < Dim; ++i)
                             x[a * stride + i] = body.X[a][i] + body.u.at(a, i);
                         }
                       });
  exchange(body, x, stride);
}

template <int Dim>
void BulkVolumes<Dim>::exchange(const Body<Dim>& body, Array& values, int n) const {
  if (!body.division) return;
  body.division->corners.exchange([&](std::int64_t begin, std::int64_t end, const auto& use) {
    algebra::use_bytes(values.data() + begin * n, (end - begin) * n, use);
  });
}

template <int Dim>
void BulkVolumes<Dim>::add_forces(Body<Dim>& body) const {
  const auto add =
      algebra::version_here<algebra::Versions<AddRowsKernel<Dim>, const double*, Body<Dim>&,
                                              std::int64_t, std::int64_t>>();
  parallel::for_chunks(body.part(), body.n_blocks,
                       [&](std::int64_t begin, std::int64_t end, std::int64_t) {
                         add(force_.data(), body, begin, end);
                       });
}

template <int Dim>
double BulkVolumes<Dim>::power(const Body<Dim>& body) const {
  std::vector<double> parts(parallel::n_chunks_of(body.n_blocks));
  parallel::for_chunks(body.part(), body.n_blocks,
                       [&](std::int64_t begin, std::int64_t end, std::int64_t c) {
                         const std::int64_t last = std::min(end * n_lanes, n_nodes_);
                         for (std::int64_t a = begin * n_lanes; a < last; ++a) {
                           for (int i = 0; i < Dim; ++i)
                             parts[c] += body.v.at(a, i) * force_[a * stride + i];
                         }
                       });
  return parallel::sum_of_chunks(body.part(), parts);
}

template <int Dim>
std::unique_ptr<BulkVolumes<Dim>> make_bulk_volumes(const PairGraph& graph,
                                                    Volumes volumes,
                                                    bool with_shear) {
  if (volumes == Volumes::cells)
    return std::make_unique<CellVolumes<Dim>>(graph.cells, graph.X, with_shear);
  if (volumes == Volumes::lines) return std::make_unique<LineVolumes<Dim>>(graph);
  return nullptr;
}

template std::unique_ptr<BulkVolumes<2>> make_bulk_volumes(const PairGraph&, Volumes, bool);
template std::unique_ptr<BulkVolumes<3>> make_bulk_volumes(const PairGraph&, Volumes, bool);
template class BulkVolumes<2>;
template class BulkVolumes<3>;

}  // namespace diptych::scheme
