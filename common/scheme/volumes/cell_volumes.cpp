#include "common/scheme/volumes/cell_volumes.hpp"

#include "common/algebra/gather.hpp"
#include "common/algebra/versions.hpp"
#include "common/base/error.hpp"
#include "common/parallel/for_chunks.hpp"
#include "common/scheme/body/material_model.hpp"
#include "common/scheme/volumes/cell_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace diptych::scheme {

using algebra::InstructionSet;
using algebra::n_lanes;

namespace {

/// Part of what the means smooth that is taken back. With the face correction's argument, on a line
/// of nodes V_a/V_a(X) is a central difference, J (1 - theta^2/6), and S is 1 - theta^2/4 (bricks) or
/// 1 - 5 theta^2/24 (six tetrahedra to a brick); across, bricks smooth by 1 - theta^2/4 too. 4/5
/// leaves +0.03 and -0.05 theta^2 of bricks, and nothing along the axes of tetrahedra.
constexpr double alpha = 0.8;

/// Length of a row of positions: one gather.
constexpr int stride = 4;

/// What a sweep over the cells of a group reads and writes.
struct CellSweep {
  const std::int32_t* corner;
  const double* share;     ///< null: equal ones
  const double* x;         ///< [n_nodes][4]
  const double* rate;      ///< [n_nodes][4] or null
  const double* nodal;     ///< [n_nodes]: pressures of the sweep of forces, what is smoothed
  const double* volume;    ///< [n_blocks][8] undeformed
  double* out;             ///< of the cells of the group, or [n_nodes][4] forces
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

/// Means of nodal values over cells, times their volumes.
template <int Dim, int n>
struct MeanKernel {
  template <InstructionSet isa>
  DIPTYCH_INLINE static void run(const CellSweep& sweep, std::int64_t begin, std::int64_t end) {
    for (std::int64_t b = begin; b < end; ++b) {
      const Lanes mean = mean_of<n>(sweep, b) * algebra::load(sweep.volume + b * n_lanes);
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

/// values += alpha (values - S values) of blocks of nodes.
struct SharpenKernel {
  template <InstructionSet>
  DIPTYCH_INLINE static void run(const CellsOfNodes& around,
                                 const double* of_cells,
                                 const double* inverse_V_0,
                                 double* values,
                                 std::int64_t begin,
                                 std::int64_t end) {
    for (std::int64_t b = begin; b < end; ++b) {
      const Lanes mean = sum_of_cells(around, of_cells, b) * algebra::load(inverse_V_0 + b * n_lanes);
      const Lanes value = algebra::load(values + b * n_lanes);
      algebra::store(values + b * n_lanes, value + alpha * (value - mean));
    }
  }
};

template <class Kernel>
void sweep_nodes(const CellsOfNodes& around,
                 const double* of_cells,
                 const double* inverse_V_0,
                 double* values) {
  const auto run = algebra::version_here<
      algebra::Versions<Kernel, const CellsOfNodes&, const double*, const double*, double*,
                        std::int64_t, std::int64_t>>();
  parallel::for_chunks(around.first.size() - 1,
                       [&](std::int64_t begin, std::int64_t end, std::int64_t) {
                         run(around, of_cells, inverse_V_0, values, begin, end);
                       });
}

/// Rows of forces of blocks of nodes, added to T and emptied.
template <int Dim>
struct AddRowsKernel {
  template <InstructionSet isa>
  DIPTYCH_INLINE static void run(double* rows,
                                 Body<Dim>& body,
                                 std::int64_t begin,
                                 std::int64_t end) {
    for (std::int64_t b = begin; b < end; ++b) {
      double* row[n_lanes];
      for (int l = 0; l < n_lanes; ++l)
        row[l] = rows + (b * n_lanes + l) * stride;
      Lanes sum[stride];
      algebra::gather_four<isa>(row, 0, sum);
#pragma GCC unroll 3
      for (int i = 0; i < Dim; ++i)
        body.T.put(b, i, body.T.get(b, i) + sum[i]);
      __builtin_memset(row[0], 0, sizeof(double) * n_lanes * stride);
    }
  }
};

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
template <template <int, int> class Kernel, int Dim>
void sweep_group(const CellSweep& sweep, const CellGroup& group) {
  const CellFunction run = function_of<Kernel, Dim>(group);
  parallel::for_chunks(group.n_blocks, [&](std::int64_t begin, std::int64_t end, std::int64_t) {
    run(sweep, begin, end);
  });
}

CellSweep sweep_of(const CellGroup& group) {
  return {group.corner.data(), group.share.size() > 0 ? group.share.data() : nullptr,
          nullptr, nullptr, nullptr, group.volume.data(), nullptr};
}

/// Nodes of a segment: no cell spans more, and whole blocks.
std::int64_t segment_length(const VolumeCells& cells) {
  std::int64_t span = 0;
  for (std::int64_t c = 0; c < cells.n_cells(); ++c) {
    const auto [low, high] = std::minmax_element(cells.corner.begin() + cells.row[c],
                                                 cells.corner.begin() + cells.row[c + 1]);
    span = std::max<std::int64_t>(span, *high - *low);
  }
  const std::int64_t least = 64 * n_lanes;  // shorter ones would be all ends
  return (std::max(span, least) + n_lanes - 1) / n_lanes * n_lanes;
}

/// Cells of n corners, segment by segment in their order. Lanes that are left over at the end of a
/// segment hold a cell that is its first node alone, without volume.
/// @param place  [n_cells] of each cell of this group among its lanes
CellGroup group_of(const VolumeCells& cells,
                   int n,
                   std::int64_t length,
                   std::int64_t n_segments,
                   std::vector<std::int64_t>& place) {
  std::vector<std::vector<std::int64_t>> members(static_cast<size_t>(n_segments));
  bool equal = true;
  for (std::int64_t c = 0; c < cells.n_cells(); ++c) {
    if (cells.row[c + 1] - cells.row[c] != n) continue;
    const auto corner = cells.corner.begin() + cells.row[c];
    members[*std::min_element(corner, corner + n) / length].push_back(c);
    for (std::int64_t k = cells.row[c]; k < cells.row[c + 1]; ++k)
      equal = equal && std::abs(n * cells.share[k] - 1) < 1e-14;
  }
  CellGroup group;
  group.n_corners = n;
  group.segment.push_back(0);
  for (const auto& segment : members) {
    group.n_blocks += algebra::n_blocks_of(static_cast<std::int64_t>(segment.size()));
    group.segment.push_back(group.n_blocks);
  }
  group.corner = algebra::AlignedArray<std::int32_t>(group.n_blocks * n * n_lanes);
  group.volume = algebra::AlignedArray<double>(group.n_blocks * n_lanes);
  if (!equal) group.share = algebra::AlignedArray<double>(group.n_blocks * n * n_lanes);
  for (std::int64_t s = 0; s < n_segments; ++s) {
    for (std::int64_t at = group.segment[s] * n * n_lanes; at < group.segment[s + 1] * n * n_lanes;
         ++at)
      group.corner[at] = static_cast<std::int32_t>(s * length);
    std::int64_t lane = group.segment[s] * n_lanes;
    for (const std::int64_t c : members[s]) {
      for (int k = 0; k < n; ++k) {
        const std::int64_t at = (lane / n_lanes * n + k) * n_lanes + lane % n_lanes;
        group.corner[at] = cells.corner[cells.row[c] + k];
        if (!equal) group.share[at] = cells.share[cells.row[c] + k];
      }
      place[c] = lane++;
    }
  }
  return group;
}

}  // namespace

template <int Dim>
CellVolumes<Dim>::CellVolumes(const VolumeCells& cells, const std::vector<algebra::Vec3>& X)
    : n_nodes_(static_cast<std::int64_t>(X.size())) {
  const std::int64_t length = segment_length(cells);
  n_segments_ = (n_nodes_ + length - 1) / length;
  std::vector<std::int64_t> place(static_cast<size_t>(cells.n_cells()));
  for (const int n : {3, 4, 6, 8}) {
    CellGroup group = group_of(cells, n, length, n_segments_, place);
    if (group.n_blocks == 0) continue;
    group.first_cell = n_cells_;
    n_cells_ += group.n_blocks * n_lanes;
    groups_.push_back(std::move(group));
  }
  if (n_cells_ > std::numeric_limits<std::int32_t>::max()) {
    throw base::InputError(
        "the mesh has more cells than the volumes of cells can count; use scheme.volumes = "
        "\"nodes\", or a coarser mesh");
  }
  list_cells_of_nodes(cells, place);
  x_ = Array(n_nodes_ * stride);
  of_cells_ = Array(n_cells_ + n_lanes);
  pressure_ = Array(algebra::n_blocks_of(n_nodes_) * n_lanes);
  force_ = Array(pressure_.size() * stride);
  V_0_ = Array(pressure_.size());
  inverse_V_0_ = Array(pressure_.size());
  for (std::int64_t a = 0; a < n_nodes_; ++a) {
    for (int i = 0; i < Dim; ++i)
      x_[a * stride + i] = X[a][i];
  }
  put_volumes(x_, nullptr, of_cells_);
  for (CellGroup& group : groups_) {
    for (std::int64_t i = 0; i < group.n_blocks * n_lanes; ++i)
      group.volume[i] = of_cells_[group.first_cell + i];
  }
  for (std::int64_t a = 0; a < n_nodes_; ++a)
    inverse_V_0_[a] = 1;
  put_ratios(of_cells_, V_0_);
  for (std::int64_t a = 0; a < n_nodes_; ++a)
    inverse_V_0_[a] = 1 / V_0_[a];
}

template <int Dim>
void CellVolumes<Dim>::list_cells_of_nodes(const VolumeCells& cells,
                                           const std::vector<std::int64_t>& place) {
  struct Corner {
    std::int64_t cell;
    double share;
  };
  std::vector<std::vector<Corner>> around(static_cast<size_t>(n_nodes_));
  for (const CellGroup& group : groups_) {
    for (std::int64_t c = 0; c < cells.n_cells(); ++c) {
      if (cells.row[c + 1] - cells.row[c] != group.n_corners) continue;
      for (std::int64_t k = cells.row[c]; k < cells.row[c + 1]; ++k)
        around[cells.corner[k]].push_back({group.first_cell + place[c], cells.share[k]});
    }
  }
  const std::int64_t n_blocks = algebra::n_blocks_of(n_nodes_);
  const auto corners_of = [&](std::int64_t a) -> const std::vector<Corner>& {
    static const std::vector<Corner> none;
    return a < n_nodes_ ? around[a] : none;
  };
  around_.first = algebra::AlignedArray<std::int64_t>(n_blocks + 1);
  for (std::int64_t b = 0; b < n_blocks; ++b) {
    size_t most = 0;
    for (std::int64_t a = b * n_lanes; a < (b + 1) * n_lanes; ++a)
      most = std::max(most, corners_of(a).size());
    around_.first[b + 1] = around_.first[b] + static_cast<std::int64_t>(most);
  }
  const std::int64_t n = around_.first[n_blocks] * n_lanes;
  const bool equal = groups_.size() == 1 && groups_[0].share.size() == 0;
  around_.cell = algebra::AlignedArray<std::int32_t>(n);
  around_.share = algebra::AlignedArray<double>(equal ? 0 : n);
  around_.equal_share = equal ? 1.0 / groups_[0].n_corners : 0;
  for (std::int64_t k = 0; k < n; ++k)
    around_.cell[k] = static_cast<std::int32_t>(n_cells_);
  for (std::int64_t a = 0; a < n_nodes_; ++a) {
    std::int64_t k = around_.first[a / n_lanes] * n_lanes + a % n_lanes;
    for (const Corner& corner : around[a]) {
      around_.cell[k] = static_cast<std::int32_t>(corner.cell);
      if (!equal) around_.share[k] = corner.share;
      k += n_lanes;
    }
  }
}

template <int Dim>
std::int64_t CellVolumes<Dim>::bytes() const {
  std::int64_t sum = V_0_.bytes() + inverse_V_0_.bytes() + x_.bytes() + of_cells_.bytes() +
                     pressure_.bytes() + force_.bytes() + around_.first.bytes() +
                     around_.cell.bytes() + around_.share.bytes();
  for (const CellGroup& group : groups_)
    sum += group.corner.bytes() + group.share.bytes() + group.volume.bytes();
  return sum;
}

template <int Dim>
void CellVolumes<Dim>::put_positions(const Body<Dim>& body, Array& x) const {
  parallel::for_chunks(body.n_blocks, [&](std::int64_t begin, std::int64_t end, std::int64_t) {
    const std::int64_t last = std::min(end * n_lanes, n_nodes_);
    for (std::int64_t a = begin * n_lanes; a < last; ++a) {
      for (int i = 0; i < Dim; ++i)
        x[a * stride + i] = body.X[a][i] + body.u.at(a, i);
    }
  });
}

template <int Dim>
void CellVolumes<Dim>::put_volumes(const Array& x, const double* rate, Array& volume) const {
  for (const CellGroup& group : groups_) {
    CellSweep sweep = sweep_of(group);
    sweep.x = x.data();
    sweep.rate = rate;
    sweep.out = volume.data() + group.first_cell;
    sweep_group<VolumeKernel, Dim>(sweep, group);
  }
}

template <int Dim>
void CellVolumes<Dim>::put_ratios(const Array& volume, Array& ratio) const {
  sweep_nodes<RatioKernel>(around_, volume.data(), inverse_V_0_.data(), ratio.data());
}

template <int Dim>
void CellVolumes<Dim>::sharpen(Array& values, Array& of_cells) const {
  for (const CellGroup& group : groups_) {
    CellSweep sweep = sweep_of(group);
    sweep.nodal = values.data();
    sweep.out = of_cells.data() + group.first_cell;
    sweep_group<MeanKernel, Dim>(sweep, group);
  }
  sweep_nodes<SharpenKernel>(around_, of_cells.data(), inverse_V_0_.data(), values.data());
}

template <int Dim>
void CellVolumes<Dim>::add_forces(Body<Dim>& body, const MaterialModel& material) {
  put_positions(body, x_);
  put_volumes(x_, nullptr, of_cells_);
  put_ratios(of_cells_, pressure_);
  sharpen(pressure_, of_cells_);
  parallel::for_chunks(body.n_blocks, [&](std::int64_t begin, std::int64_t end, std::int64_t) {
    const std::int64_t first = begin * n_lanes, last = std::min(end * n_lanes, n_nodes_);
    material.put_volumetric_stresses(&pressure_[first], last - first);
  });
  sharpen(pressure_, of_cells_);
  sum_forces(body);
}

template <int Dim>
void CellVolumes<Dim>::add_linear_forces(Body<Dim>& body, double modulus) {
  put_positions(body, x_);
  Array rate(n_nodes_ * stride);
  for (std::int64_t a = 0; a < n_nodes_; ++a) {
    for (int i = 0; i < Dim; ++i)
      rate[a * stride + i] = body.v.at(a, i);
  }
  put_volumes(x_, rate.data(), of_cells_);
  put_ratios(of_cells_, pressure_);
  sharpen(pressure_, of_cells_);
  for (std::int64_t a = 0; a < n_nodes_; ++a)
    pressure_[a] *= modulus;
  sharpen(pressure_, of_cells_);
  sum_forces(body);
}

template <int Dim>
void CellVolumes<Dim>::sum_forces(Body<Dim>& body) {
  for (const CellGroup& group : groups_) {
    CellSweep sweep = sweep_of(group);
    sweep.x = x_.data();
    sweep.nodal = pressure_.data();
    sweep.out = force_.data();
    const CellFunction run = function_of<ForceKernel, Dim>(group);
    for (const std::int64_t parity : {0, 1}) {
      parallel::for_shares((n_segments_ + 1 - parity) / 2, [&](std::int64_t i) {
        const std::int64_t s = 2 * i + parity;
        run(sweep, group.segment[s], group.segment[s + 1]);
      });
    }
  }
  const auto add = algebra::version_here<
      algebra::Versions<AddRowsKernel<Dim>, double*, Body<Dim>&, std::int64_t, std::int64_t>>();
  parallel::for_chunks(body.n_blocks, [&](std::int64_t begin, std::int64_t end, std::int64_t) {
    add(force_.data(), body, begin, end);
  });
}

template <int Dim>
std::vector<double> CellVolumes<Dim>::ratios(const Body<Dim>& body) const {
  Array x(n_nodes_ * stride), volume(n_cells_ + n_lanes), J(pressure_.size());
  put_positions(body, x);
  put_volumes(x, nullptr, volume);
  put_ratios(volume, J);
  sharpen(J, volume);
  return {J.data(), J.data() + n_nodes_};
}

template class CellVolumes<2>;
template class CellVolumes<3>;

}  // namespace diptych::scheme
