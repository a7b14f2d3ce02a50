#include "common/scheme/volumes/line_volumes.hpp"

#include "common/algebra/gather.hpp"
#include "common/algebra/versions.hpp"
#include "common/scheme/body/material_model.hpp"
#include "common/scheme/ranks/division.hpp"

#include <algorithm>

namespace diptych::scheme {

using algebra::InstructionSet;
using algebra::Lanes;
using algebra::n_lanes;

namespace {

constexpr int quad = 4;  ///< numbers of a row

/// Pointers to the rows of eight nodes.
struct RowsOfEight {
  const double* row[n_lanes];
  /// Consecutive ones.
  RowsOfEight(const double* rows, std::int64_t first) {
    for (int l = 0; l < n_lanes; ++l)
      row[l] = rows + (first + l) * quad;
  }
  RowsOfEight(const double* rows, const std::int32_t* node) {
    for (int l = 0; l < n_lanes; ++l)
      row[l] = rows + static_cast<std::int64_t>(quad) * node[l];
  }
};

/// Derivative of rows of four along the lines of block b, times H: sum Q_ab (v_b +- v_a).
/// @param own  v_a, with the sign that it takes
template <InstructionSet isa>
DIPTYCH_INLINE void sum_along(const LineRows& lines,
                              const double* rows,
                              std::int64_t b,
                              const Lanes (&own)[quad],
                              Lanes (&sum)[quad]) {
  for (std::int64_t k = lines.first[b]; k < lines.first[b + 1]; ++k) {
    const Lanes Q = algebra::load(lines.Q.data() + k * n_lanes);
    Lanes v[quad];
    algebra::gather_four<isa>(RowsOfEight(rows, lines.neighbour.data() + k * n_lanes).row, 0, v);
#pragma GCC unroll 3
    for (int i = 0; i < quad - 1; ++i)
      sum[i] += Q * (v[i] + own[i]);
  }
}

/// D_d of rows of four at block b.
template <InstructionSet isa, int Dim>
DIPTYCH_INLINE void derivatives(const std::array<LineRows, Dim>& lines,
                                const double* rows,
                                std::int64_t b,
                                Lanes (&D)[Dim][quad]) {
  Lanes own[quad];
  algebra::gather_four<isa>(RowsOfEight(rows, b * n_lanes).row, 0, own);
#pragma GCC unroll 3
  for (int i = 0; i < quad - 1; ++i)
    own[i] = -own[i];
#pragma GCC unroll 3
  for (int d = 0; d < Dim; ++d) {
    sum_along<isa>(lines[d], rows, b, own, D[d]);
    const Lanes inverse_H = algebra::load(lines[d].inverse_H.data() + b * n_lanes);
#pragma GCC unroll 3
    for (int i = 0; i < Dim; ++i)
      D[d][i] *= inverse_H;
  }
}

/// n_d of the tangents G_d.
template <class Number>
DIPTYCH_INLINE void normals(const Number (&G)[3][quad], Number (&n)[3][quad]) {
#pragma GCC unroll 3
  for (int d = 0; d < 3; ++d) {
    const auto &g = G[(d + 1) % 3], &h = G[(d + 2) % 3];
    n[d][0] = g[1] * h[2] - g[2] * h[1];
    n[d][1] = g[2] * h[0] - g[0] * h[2];
    n[d][2] = g[0] * h[1] - g[1] * h[0];
  }
}
template <class Number>
DIPTYCH_INLINE void normals(const Number (&G)[2][quad], Number (&n)[2][quad]) {
  n[0][0] = G[1][1];
  n[0][1] = -G[1][0];
  n[1][0] = -G[0][1];
  n[1][1] = G[0][0];
}

/// What the sweep for J reads and writes.
template <int Dim>
struct TangentSweep {
  const std::array<LineRows, Dim>& lines;
  const double *x, *rate;
  double inverse_cell;
  double* J;
  std::array<double*, Dim> normal;
};

template <int Dim>
struct TangentKernel {
  template <InstructionSet isa>
  DIPTYCH_INLINE static void run(const TangentSweep<Dim>& sweep,
                                 std::int64_t begin,
                                 std::int64_t end) {
    for (std::int64_t b = begin; b < end; ++b) {
      Lanes G[Dim][quad] = {}, n[Dim][quad] = {}, J{};
      derivatives<isa, Dim>(sweep.lines, sweep.x, b, G);
      normals(G, n);
      if (sweep.rate == nullptr) {
#pragma GCC unroll 3
        for (int i = 0; i < Dim; ++i)
          J += G[0][i] * n[0][i];
      } else {
        Lanes R[Dim][quad] = {};
        derivatives<isa, Dim>(sweep.lines, sweep.rate, b, R);
        for (int d = 0; d < Dim; ++d) {
          for (int i = 0; i < Dim; ++i)
            J += R[d][i] * n[d][i];
        }
      }
      algebra::store(sweep.J + b * n_lanes, sweep.inverse_cell * J);
      if (sweep.normal[0] == nullptr) continue;
#pragma GCC unroll 3
      for (int d = 0; d < Dim; ++d)
        algebra::scatter_four(n[d], sweep.normal[d] + b * n_lanes * quad, quad);
    }
  }
};

/// Forces of block b of pi^d.
template <int Dim>
struct LineForceKernel {
  template <InstructionSet isa>
  DIPTYCH_INLINE static void run(const std::array<LineRows, Dim>& lines,
                                 const std::array<const double*, Dim>& pi,
                                 double* force,
                                 std::int64_t begin,
                                 std::int64_t end) {
    for (std::int64_t b = begin; b < end; ++b) {
      Lanes total[quad] = {};
#pragma GCC unroll 3
      for (int d = 0; d < Dim; ++d) {
        Lanes own[quad], sum[quad] = {};
        algebra::gather_four<isa>(RowsOfEight(pi[d], b * n_lanes).row, 0, own);
        sum_along<isa>(lines[d], pi[d], b, own, sum);
        const Lanes across = algebra::load(lines[d].across.data() + b * n_lanes);
#pragma GCC unroll 3
        for (int i = 0; i < Dim; ++i)
          total[i] += across * sum[i];
      }
      algebra::scatter_four(total, force + b * n_lanes * quad, quad);
    }
  }
};

/// Of direction d. Places beyond the entries of a node, and nodes beyond the last, count nothing.
LineRows rows_of(const VolumeLines& lines, int d) {
  const LineDerivative& along = lines.along[d];
  const auto n_nodes = static_cast<std::int64_t>(lines.place.size());
  const std::int64_t n_blocks = algebra::n_blocks_of(n_nodes), padded = n_blocks * n_lanes;
  const auto row_of = [&](std::int64_t a) -> const std::vector<LineDerivative::Entry>& {
    static const std::vector<LineDerivative::Entry> none;
    return a < n_nodes ? along.row[lines.place[a][d]] : none;
  };
  LineRows rows;
  rows.first = algebra::AlignedArray<std::int64_t>(n_blocks + 1);
  for (std::int64_t b = 0; b < n_blocks; ++b) {
    size_t most = 0;
    for (std::int64_t a = b * n_lanes; a < (b + 1) * n_lanes; ++a)
      most = std::max(most, row_of(a).size());
    rows.first[b + 1] = rows.first[b] + static_cast<std::int64_t>(most);
  }
  rows.neighbour = algebra::AlignedArray<std::int32_t>(rows.first[n_blocks] * n_lanes);
  rows.Q = algebra::AlignedArray<double>(rows.neighbour.size());
  rows.inverse_H = algebra::AlignedArray<double>(padded);
  rows.across = algebra::AlignedArray<double>(padded);
  parallel::for_chunks(n_blocks, [&](std::int64_t begin, std::int64_t end, std::int64_t) {
    for (std::int64_t a = begin * n_lanes; a < end * n_lanes; ++a) {
      std::int64_t at = rows.first[a / n_lanes] * n_lanes + a % n_lanes;
      const std::int64_t behind = rows.first[a / n_lanes + 1] * n_lanes;
      for (const LineDerivative::Entry& entry : row_of(a)) {
        auto place = lines.place[a];
        place[d] = entry.place;
        rows.neighbour[at] = lines.node_at(place);
        rows.Q[at] = entry.Q;
        at += n_lanes;
      }
      for (; at < behind; at += n_lanes)
        rows.neighbour[at] = static_cast<std::int32_t>(std::min(a, n_nodes - 1));
      if (a >= n_nodes) continue;
      rows.inverse_H[a] = 1 / along.H[lines.place[a][d]];
      rows.across[a] = 1;
      for (int e = 0; e < static_cast<int>(lines.along.size()); ++e)
        rows.across[a] *= e == d ? 1 : lines.along[e].H[lines.place[a][e]];
    }
  });
  return rows;
}

}  // namespace

template <int Dim>
LineVolumes<Dim>::LineVolumes(const PairGraph& graph)
    : Base(graph.n_nodes()), inverse_cell_(1 / graph.lines.cell), pressure_(V_0_.size()) {
  for (int d = 0; d < Dim; ++d) {
    rows_[d] = rows_of(graph.lines, d);
    normal_[d] = Array(x_.size());
  }
  for (std::int64_t a = 0; a < n_nodes(); ++a) {
    V_0_[a] = graph.Omega[a];
    for (int i = 0; i < Dim; ++i)
      x_[a * stride + i] = graph.X[a][i];
  }
  inverse_cofactors_ = cofactors_at(0).inverse();  // the same at all nodes
}

template <int Dim>
std::int64_t LineVolumes<Dim>::bytes() const {
  std::int64_t sum = V_0_.bytes() + x_.bytes() + force_.bytes() + pressure_.bytes();
  for (int d = 0; d < Dim; ++d) {
    const LineRows& rows = rows_[d];
    sum += normal_[d].bytes() + rows.first.bytes() + rows.neighbour.bytes() + rows.Q.bytes() +
           rows.inverse_H.bytes() + rows.across.bytes();
  }
  return sum;
}

template <int Dim>
std::vector<CellWork> LineVolumes<Dim>::work_of(const parallel::Part& part,
                                                std::vector<char>& read) const {
  const std::int64_t n_blocks = algebra::n_blocks_of(n_nodes());
  parallel::for_chunks(part, n_blocks, [&](std::int64_t begin, std::int64_t end, std::int64_t) {
    for (const LineRows& rows : rows_) {
      for (std::int64_t k = rows.first[begin] * n_lanes; k < rows.first[end] * n_lanes; ++k) {
        // several threads may set the same node
        __atomic_store_n(&read[static_cast<size_t>(rows.neighbour[k])], 1, __ATOMIC_RELAXED);
      }
    }
  });
  return {};
}

template <int Dim>
void LineVolumes<Dim>::put_tangents(const parallel::Part& part,
                                    const Array& x,
                                    const double* rate,
                                    Array& J,
                                    std::array<Array, Dim>* normal) const {
  TangentSweep<Dim> sweep{rows_, x.data(), rate, inverse_cell_, J.data(), {}};
  for (int d = 0; d < Dim; ++d)
    sweep.normal[d] = normal == nullptr ? nullptr : (*normal)[d].data();
  const auto run =
      algebra::version_here<algebra::Versions<TangentKernel<Dim>, const TangentSweep<Dim>&,
                                              std::int64_t, std::int64_t>>();
  parallel::for_chunks(
      part, algebra::n_blocks_of(n_nodes()),
      [&](std::int64_t begin, std::int64_t end, std::int64_t) { run(sweep, begin, end); });
}

template <int Dim>
void LineVolumes<Dim>::evaluate(const Body<Dim>& body, const MaterialModel& material) {
  put_positions(body, x_);
  put_tangents(body.part(), x_, nullptr, pressure_, &normal_);
  parallel::for_chunks(
      body.part(), body.n_blocks, [&](std::int64_t begin, std::int64_t end, std::int64_t) {
        const std::int64_t first = begin * n_lanes, last = std::min(end * n_lanes, n_nodes());
        material.put_volumetric_stresses(&pressure_[first], last - first);
      });
  sum_forces(body);
}

template <int Dim>
void LineVolumes<Dim>::evaluate_linear(const Body<Dim>& body, double modulus, double) {
  put_positions(body, x_);
  Array rate(x_.size());
  for (std::int64_t a = 0; a < n_nodes(); ++a) {
    for (int i = 0; i < Dim; ++i)
      rate[a * stride + i] = body.v.at(a, i);
  }
  put_tangents(body.part(), x_, rate.data(), pressure_, &normal_);
  for (std::int64_t a = 0; a < n_nodes(); ++a)
    pressure_[a] *= modulus;
  sum_forces(body);
}

template <int Dim>
void LineVolumes<Dim>::sum_forces(const Body<Dim>& body) {
  const auto for_own = [&](const auto& work) {
    parallel::for_chunks(body.part(), body.n_blocks, work);
  };
  for_own([&](std::int64_t begin, std::int64_t end, std::int64_t) {
    for (Array& normal : normal_) {
      for (std::int64_t a = begin * n_lanes; a < end * n_lanes; ++a) {
        for (int i = 0; i < stride; ++i)
          normal[a * stride + i] *= pressure_[a];
      }
    }
  });
  std::array<const double*, Dim> pi;
  for (int d = 0; d < Dim; ++d) {
    exchange(body, normal_[d], stride);
    pi[d] = normal_[d].data();
  }
  const auto run = algebra::version_here<algebra::Versions<
      LineForceKernel<Dim>, const std::array<LineRows, Dim>&, const std::array<const double*, Dim>&,
      double*, std::int64_t, std::int64_t>>();
  for_own([&](std::int64_t begin, std::int64_t end, std::int64_t) {
    run(rows_, pi, force_.data(), begin, end);
  });
}

template <int Dim>
std::vector<double> LineVolumes<Dim>::ratios(const Body<Dim>& body) const {
  Array x(x_.size()), J(pressure_.size());
  put_positions(body, x);
  put_tangents(body.part(), x, nullptr, J, nullptr);
  return {J.data(), J.data() + n_nodes()};
}

template <int Dim>
algebra::Mat3 LineVolumes<Dim>::cofactors_at(std::int64_t a) const {
  double G[Dim][quad] = {}, n[Dim][quad] = {};
  for (int d = 0; d < Dim; ++d) {
    const LineRows& rows = rows_[d];
    const std::int64_t b = a / n_lanes, lane = a % n_lanes;
    for (std::int64_t k = rows.first[b]; k < rows.first[b + 1]; ++k) {
      const std::int64_t other = rows.neighbour[k * n_lanes + lane];
      for (int i = 0; i < Dim; ++i)
        G[d][i] += rows.Q[k * n_lanes + lane] * rows.inverse_H[a] *
                   (x_[other * stride + i] - x_[a * stride + i]);
    }
  }
  normals(G, n);
  algebra::Mat3 columns = algebra::Mat3::Identity();
  for (int d = 0; d < Dim; ++d) {
    for (int i = 0; i < Dim; ++i)
      columns(i, d) = n[d][i];
  }
  return columns;
}

template <int Dim>
std::vector<algebra::Vec3> LineVolumes<Dim>::deformed_areas(const Body<Dim>& body,
                                                            const BoundaryPatch& patch) {
  put_positions(body, x_);
  std::vector<algebra::Vec3> area;
  for (size_t k = 0; k < patch.nodes.size(); ++k)
    area.emplace_back(cofactors_at(patch.nodes[k]) * (inverse_cofactors_ * patch.area[k]));
  return area;
}

template class LineVolumes<2>;
template class LineVolumes<3>;

}  // namespace diptych::scheme
