#include "common/scheme/sweep_graph.hpp"

#include "common/scheme/row_classes.hpp"

#include <algorithm>

namespace diptych::scheme {

using algebra::n_lanes;

namespace {

std::int64_t chunks_of(std::int64_t n_pairs) {
  return (n_pairs + n_lanes - 1) / n_lanes;
}

template <int Dim>
void set_nodes(const PairGraph& graph, SweepGraph<Dim>& sweep) {
  for (std::int64_t a = 0; a < sweep.n_nodes; ++a) {
    sweep.Omega[a] = graph.Omega[a];
    sweep.inverse_Omega[a] = 1 / graph.Omega[a];
    for (int i = 0; i < Dim; ++i)
      sweep.X[a * vector_stride<Dim> + i] = graph.X[a][i];
  }
}

/// Rows of chunks with the neighbours in the order of the classes.
template <int Dim>
void set_rows(const PairGraph& graph, const RowClasses& classes, SweepGraph<Dim>& sweep) {
  const std::int64_t n = sweep.n_blocks * n_lanes;
  for (std::int64_t a = 0; a < n; ++a) {
    sweep.row[a + 1] =
        sweep.row[a] + (a < sweep.n_nodes ? chunks_of(graph.row[a + 1] - graph.row[a]) : 0);
  }
  sweep.neighbours = algebra::AlignedArray<Neighbours>(sweep.row[n]);
  for (std::int64_t a = 0; a < sweep.n_nodes; ++a) {
    std::int32_t* node = sweep.neighbours[sweep.row[a]].node;
    std::fill(node, node + (sweep.row[a + 1] - sweep.row[a]) * n_lanes,
              static_cast<std::int32_t>(a));
    for (std::int64_t k = graph.row[a]; k < graph.row[a + 1]; ++k)
      node[k - graph.row[a]] = graph.neighbour[classes.order[k]];
  }
}

/// Geometry of one class, from the row of its representative, into the chunks from `first` on.
template <int Dim>
void set_class(const PairGraph& graph,
               const RowClasses& classes,
               std::int64_t a,
               std::int64_t first,
               SweepGraph<Dim>& sweep) {
  for (std::int64_t k = graph.row[a]; k < graph.row[a + 1]; ++k) {
    const std::int64_t position = k - graph.row[a], chunk = first + position / n_lanes;
    const int lane = static_cast<int>(position % n_lanes);
    const Vec3& C_ab = classes.C[classes.order[k]];
    const Vec3& C_ba = classes.C[graph.reverse[classes.order[k]]];
    const Vec3 S_ab = 0.5 * (C_ab - C_ba);
    for (int i = 0; i < Dim; ++i) {
      sweep.strain[chunk].C_ab[i][lane] = C_ab[i];
      sweep.force[chunk].C_ba[i][lane] = C_ba[i];
      sweep.face[chunk].S_ab[i][lane] = static_cast<float>(S_ab[i]);
    }
    sweep.face[chunk].area[lane] = static_cast<float>(S_ab.norm());
  }
}

template <int Dim>
void set_geometry(const PairGraph& graph, const RowClasses& classes, SweepGraph<Dim>& sweep) {
  std::vector<std::int64_t> first(classes.representative.size() + 1, 0);
  for (size_t c = 0; c + 1 < first.size(); ++c) {
    const std::int32_t a = classes.representative[c];
    first[c + 1] = first[c] + chunks_of(graph.row[a + 1] - graph.row[a]);
  }
  sweep.strain = algebra::AlignedArray<StrainGeometry<Dim>>(first.back());
  sweep.force = algebra::AlignedArray<ForceGeometry<Dim>>(first.back());
  sweep.face = algebra::AlignedArray<FaceGeometry<Dim>>(first.back());
  for (size_t c = 0; c + 1 < first.size(); ++c)
    set_class(graph, classes, classes.representative[c], first[c], sweep);
  for (std::int64_t a = 0; a < sweep.n_nodes; ++a) {
    sweep.first[a] = first[classes.of_row[a]];
    for (std::int64_t k = graph.row[a]; k < graph.row[a + 1]; ++k) {
      for (int i = 0; i < Dim; ++i)
        sweep.C_sum.at(a, i) += classes.C[classes.order[k]][i];
    }
  }
}

}  // namespace

template <int Dim>
SweepGraph<Dim>::SweepGraph(const PairGraph& graph)
    : n_nodes(graph.n_nodes()),
      n_blocks(algebra::n_blocks_of(graph.n_nodes())),
      n_pairs(graph.n_pairs()),
      row(n_blocks * n_lanes + 1),
      first(n_blocks * n_lanes),
      X(n_blocks * n_lanes * vector_stride<Dim> + 4),  // gathers read four doubles of every row
      inverse_Omega(n_blocks * n_lanes),
      Omega(n_blocks * n_lanes),
      C_sum(graph.n_nodes(), Dim) {
  const RowClasses classes = classify_rows(graph);
  set_nodes(graph, *this);
  set_rows(graph, classes, *this);
  set_geometry(graph, classes, *this);
}

template <int Dim>
std::int64_t SweepGraph<Dim>::bytes() const {
  return row.bytes() + neighbours.bytes() + first.bytes() + strain.bytes() + force.bytes() +
         face.bytes() + X.bytes() + inverse_Omega.bytes() + Omega.bytes() + C_sum.bytes();
}

template struct SweepGraph<2>;
template struct SweepGraph<3>;

}  // namespace diptych::scheme
