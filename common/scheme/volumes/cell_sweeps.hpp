#pragma once
/// Sweeps over cells and over the cells of nodes, eight at a time: part of cell_volumes.cpp.

#include "common/algebra/gather.hpp"
#include "common/algebra/versions.hpp"
#include "common/parallel/for_chunks.hpp"
#include "common/scheme/body/body.hpp"
#include "common/scheme/volumes/cell_shapes.hpp"

namespace diptych::scheme {

using algebra::InstructionSet;
using algebra::n_lanes;

/// Length of a row of positions and forces: one gather.
constexpr int stride = 4;

/// What a sweep over the cells of a group reads and writes.
struct CellSweep {
  const std::int32_t* corner;
  const double* share;   ///< null: equal ones
  const double* x;       ///< [n_nodes][4]
  const double* rate;    ///< [n_nodes][4] or null
  const double* nodal;   ///< [n_nodes]: pressures of the sweep of forces, what is smoothed
  const double* weight;  ///< [n_blocks][8] of the cells: CellGroup::weight
  double* out;           ///< of the cells of the group, or [n_nodes][4] forces
};

/// Rows of x at the corners of block b, from the first corner of each cell.
template <InstructionSet isa, int Dim, int n>
DIPTYCH_INLINE void corners_of(const CellSweep& sweep,
                               const double* rows,
                               std::int64_t b,
                               CellCorners<Dim, n>& cell) {
  Lanes first[stride];
#pragma GCC unroll 8
  for (int k = 0; k < n; ++k) {
    const std::int32_t* corner = sweep.corner + (b * n + k) * n_lanes;
    const double* row[n_lanes];
    for (int l = 0; l < n_lanes; ++l)
      row[l] = rows + static_cast<std::int64_t>(stride) * corner[l];
    Lanes x[stride];
    algebra::gather_four<isa>(row, 0, x);
#pragma GCC unroll 3
    for (int i = 0; i < Dim; ++i) {
      if (k == 0) first[i] = x[i];
      cell.x[k][i] = x[i] - first[i];
    }
  }
}

template <int n>
DIPTYCH_INLINE Lanes share_of(const CellSweep& sweep, std::int64_t b, int k) {
  if (sweep.share == nullptr) return Lanes{} + 1.0 / n;
  return algebra::load(sweep.share + (b * n + k) * n_lanes);
}

template <int Dim, int n>
struct VolumeKernel {
  template <InstructionSet isa>
  DIPTYCH_INLINE static void run(const CellSweep& sweep, std::int64_t begin, std::int64_t end) {
    for (std::int64_t b = begin; b < end; ++b) {
      CellCorners<Dim, n> cell;
      corners_of<isa>(sweep, sweep.x, b, cell);
      Lanes volume{};
      if (sweep.rate == nullptr) {
        volume = cell_volume(cell, static_cast<CellGradient<Dim, n>*>(nullptr));
      } else {
        CellGradient<Dim, n> gradient{};
        cell_volume(cell, &gradient);
        CellCorners<Dim, n> rate;
        corners_of<isa>(sweep, sweep.rate, b, rate);
        for (int k = 0; k < n; ++k) {
          for (int i = 0; i < Dim; ++i)
            volume += gradient.x[k][i] * rate.x[k][i];
        }
      }
      algebra::store(sweep.out + b * n_lanes, volume);
    }
  }
};

/// Mean of nodal values over the corners of eight cells, by their shares.
template <int n>
DIPTYCH_INLINE Lanes mean_of(const CellSweep& sweep, std::int64_t b) {
  Lanes mean{};
#pragma GCC unroll 8
  for (int k = 0; k < n; ++k) {
    const std::int32_t* c = sweep.corner + (b * n + k) * n_lanes;
    const double* p = sweep.nodal;
    mean += share_of<n>(sweep, b, k) *
            Lanes{p[c[0]], p[c[1]], p[c[2]], p[c[3]], p[c[4]], p[c[5]], p[c[6]], p[c[7]]};
  }
  return mean;
}

/// Means of nodal values over cells, times their weights.
template <int Dim, int n>
struct MeanKernel {
  template <InstructionSet isa>
  DIPTYCH_INLINE static void run(const CellSweep& sweep, std::int64_t begin, std::int64_t end) {
    for (std::int64_t b = begin; b < end; ++b) {
      const Lanes mean = mean_of<n>(sweep, b) * algebra::load(sweep.weight + b * n_lanes);
      algebra::store(sweep.out + b * n_lanes, mean);
    }
  }
};

template <int Dim, int n>
struct ForceKernel {
  template <InstructionSet isa>
  DIPTYCH_INLINE static void run(const CellSweep& sweep, std::int64_t begin, std::int64_t end) {
    for (std::int64_t b = begin; b < end; ++b) {
      CellCorners<Dim, n> cell;
      corners_of<isa>(sweep, sweep.x, b, cell);
      CellGradient<Dim, n> gradient{};
      cell_volume(cell, &gradient);
      const Lanes q = mean_of<n>(sweep, b);
#pragma GCC unroll 8
      for (int k = 0; k < n; ++k) {
        Lanes force[stride] = {};
        for (int i = 0; i < Dim; ++i)
          force[i] = -q * gradient.x[k][i];
        double rows[n_lanes * stride];
        algebra::scatter_four(force, rows, stride);
        const std::int32_t* corner = sweep.corner + (b * n + k) * n_lanes;
#pragma GCC unroll 8
        for (int l = 0; l < n_lanes; ++l) {  // one by one: cells of a block share nodes
          double* to = sweep.out + static_cast<std::int64_t>(stride) * corner[l];
          algebra::HalfLanes sum = algebra::load_quad(to);
          sum += algebra::load_quad(rows + l * stride);
          __builtin_memcpy(to, &sum, sizeof sum);
        }
      }
    }
  }
};

/// Sum over the cells around the nodes of block b of share times value.
DIPTYCH_INLINE Lanes sum_of_cells(const CellsOfNodes& around, const double* value, std::int64_t b) {
  const auto value_at = [&](std::int64_t k) DIPTYCH_INLINE_LAMBDA {
    const std::int32_t* c = around.cell.data() + k * n_lanes;
    return Lanes{value[c[0]], value[c[1]], value[c[2]], value[c[3]],
                 value[c[4]], value[c[5]], value[c[6]], value[c[7]]};
  };
  Lanes sum{};
  if (around.share.size() == 0) {
    for (std::int64_t k = around.first[b]; k < around.first[b + 1]; ++k)
      sum += value_at(k);
    return around.equal_share * sum;
  }
  for (std::int64_t k = around.first[b]; k < around.first[b + 1]; ++k)
    sum += algebra::load(around.share.data() + k * n_lanes) * value_at(k);
  return sum;
}

/// V_a / V_a(X) of blocks of nodes.
struct RatioKernel {
  template <InstructionSet>
  DIPTYCH_INLINE static void run(const CellsOfNodes& around,
                                 const double* of_cells,
                                 const double* inverse_V_0,
                                 double* ratio,
                                 std::int64_t begin,
                                 std::int64_t end) {
    for (std::int64_t b = begin; b < end; ++b) {
      const Lanes sum = sum_of_cells(around, of_cells, b);
      algebra::store(ratio + b * n_lanes, sum * algebra::load(inverse_V_0 + b * n_lanes));
    }
  }
};

/// values += sum over cells of weight share (value - mean of the cell) / V_a(X), blocks of nodes.
struct SharpenKernel {
  template <InstructionSet>
  DIPTYCH_INLINE static void run(const CellsOfNodes& around,
                                 const double* of_cells,
                                 const double* inverse_V_0,
                                 double* values,
                                 std::int64_t begin,
                                 std::int64_t end) {
    for (std::int64_t b = begin; b < end; ++b) {
      const Lanes means = sum_of_cells(around, of_cells, b);
      const Lanes value = algebra::load(values + b * n_lanes);
      const Lanes weight = algebra::load(around.weight.data() + b * n_lanes);
      algebra::store(values + b * n_lanes,
                     value + algebra::load(inverse_V_0 + b * n_lanes) * (weight * value - means));
    }
  }
};

template <class Kernel>
void sweep_nodes(const parallel::Part& part,
                 const CellsOfNodes& around,
                 const double* of_cells,
                 const double* inverse_V_0,
                 double* values) {
  const auto run = algebra::version_here<
      algebra::Versions<Kernel, const CellsOfNodes&, const double*, const double*, double*,
                        std::int64_t, std::int64_t>>();
  parallel::for_chunks(part, around.first.size() - 1,
                       [&](std::int64_t begin, std::int64_t end, std::int64_t) {
                         run(around, of_cells, inverse_V_0, values, begin, end);
                       });
}

using CellFunction = void (*)(const CellSweep&, std::int64_t begin, std::int64_t end);

template <template <int, int> class Kernel, int Dim, int n>
CellFunction function_here() {
  return algebra::version_here<
      algebra::Versions<Kernel<Dim, n>, const CellSweep&, std::int64_t, std::int64_t>>();
}

template <template <int, int> class Kernel, int Dim>
CellFunction function_of(const CellGroup& group) {
  if constexpr (Dim == 2) {
    return group.n_corners == 3 ? function_here<Kernel, 2, 3>() : function_here<Kernel, 2, 4>();
  } else {
    return group.n_corners == 4   ? function_here<Kernel, 3, 4>()
           : group.n_corners == 6 ? function_here<Kernel, 3, 6>()
                                  : function_here<Kernel, 3, 8>();
  }
}

/// Over all blocks of cells, each by itself.
/// @param work  of this rank; null: all
template <template <int, int> class Kernel, int Dim>
void sweep_group(const CellSweep& sweep, const CellGroup& group, const CellWork* work) {
  const CellFunction run = function_of<Kernel, Dim>(group);
  if (work != nullptr) {
    parallel::for_shares(std::ssize(work->segments), [&](std::int64_t s) {
      for (const parallel::NodeRange& blocks : work->segments[s])
        run(sweep, blocks.begin, blocks.end);
    });
    return;
  }
  parallel::for_chunks(group.n_blocks, [&](std::int64_t begin, std::int64_t end, std::int64_t) {
    run(sweep, begin, end);
  });
}

}  // namespace diptych::scheme
