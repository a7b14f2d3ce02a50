#include "common/scheme/volumes/cell_volumes.hpp"

#include "common/algebra/gather.hpp"
#include "common/algebra/versions.hpp"
#include "common/base/error.hpp"
#include "common/parallel/for_chunks.hpp"
#include "common/scheme/body/material_model.hpp"
#include "common/scheme/volumes/cell_shapes.hpp"

#include <cmath>
#include <limits>

namespace diptych::scheme {

using algebra::InstructionSet;
using algebra::n_lanes;

namespace {

/// Length of a row of positions: one gather.
constexpr int stride = 4;

/// What a sweep over the cells of a group reads and writes.
struct CellSweep {
  const std::int32_t* corner;
  const double* share;     ///< null: equal ones
  const double* x;         ///< [n_nodes][4]
  const double* rate;      ///< [n_nodes][4] or null
  const double* pressure;  ///< [n_nodes]; of the sweep of forces
  double* out;             ///< volumes or forces of the slots of the group
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
      for (int k = 0; k < n; ++k) {
        algebra::store(sweep.out + (b * n + k) * n_lanes, share_of<n>(sweep, b, k) * volume);
      }
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
      Lanes q{};
#pragma GCC unroll 8
      for (int k = 0; k < n; ++k) {
        const std::int32_t* c = sweep.corner + (b * n + k) * n_lanes;
        const double* p = sweep.pressure;
        q += share_of<n>(sweep, b, k) *
             Lanes{p[c[0]], p[c[1]], p[c[2]], p[c[3]], p[c[4]], p[c[5]], p[c[6]], p[c[7]]};
      }
#pragma GCC unroll 8
      for (int k = 0; k < n; ++k) {
        double* out = sweep.out + (b * n + k) * n_lanes * Dim;
        for (int i = 0; i < Dim; ++i)
          algebra::store(out + i * n_lanes, -q * gradient.x[k][i]);
      }
    }
  }
};

template <template <int, int> class Kernel, int Dim, int n>
void sweep_cells(const CellSweep& sweep, std::int64_t n_blocks) {
  const auto run = algebra::version_here<
      algebra::Versions<Kernel<Dim, n>, const CellSweep&, std::int64_t, std::int64_t>>();
  parallel::for_chunks(n_blocks, [&](std::int64_t begin, std::int64_t end, std::int64_t) {
    run(sweep, begin, end);
  });
}

template <template <int, int> class Kernel, int Dim>
void sweep_group(const CellSweep& sweep, const CellGroup& group) {
  if constexpr (Dim == 2) {
    if (group.n_corners == 3) return sweep_cells<Kernel, 2, 3>(sweep, group.n_blocks);
    return sweep_cells<Kernel, 2, 4>(sweep, group.n_blocks);
  } else {
    if (group.n_corners == 4) return sweep_cells<Kernel, 3, 4>(sweep, group.n_blocks);
    if (group.n_corners == 6) return sweep_cells<Kernel, 3, 6>(sweep, group.n_blocks);
    return sweep_cells<Kernel, 3, 8>(sweep, group.n_blocks);
  }
}

CellSweep sweep_of(const CellGroup& group) {
  return {group.corner.data(), group.share.size() > 0 ? group.share.data() : nullptr,
          nullptr, nullptr, nullptr, nullptr};
}

/// Cells of n corners, in their order. Lanes of the last block that are left over hold a cell that
/// is one node, without volume and without share.
CellGroup group_of(const VolumeCells& cells, int n, std::int64_t first_slot) {
  std::vector<std::int64_t> members;
  bool equal = true;
  for (std::int64_t c = 0; c < cells.n_cells(); ++c) {
    if (cells.row[c + 1] - cells.row[c] != n) continue;
    members.push_back(c);
    for (std::int64_t k = cells.row[c]; k < cells.row[c + 1]; ++k)
      equal = equal && std::abs(n * cells.share[k] - 1) < 1e-14;
  }
  CellGroup group;
  group.n_corners = n;
  group.n_blocks = algebra::n_blocks_of(static_cast<std::int64_t>(members.size()));
  group.first_slot = first_slot;
  group.corner = algebra::AlignedArray<std::int32_t>(group.n_blocks * n * n_lanes);
  if (!equal) group.share = algebra::AlignedArray<double>(group.n_blocks * n * n_lanes);
  for (size_t i = 0; i < members.size(); ++i) {
    for (int k = 0; k < n; ++k) {
      const std::int64_t slot = static_cast<std::int64_t>(i / n_lanes * n + k) * n_lanes +
                                static_cast<std::int64_t>(i % n_lanes);
      group.corner[slot] = cells.corner[cells.row[members[i]] + k];
      if (!equal) group.share[slot] = cells.share[cells.row[members[i]] + k];
    }
  }
  return group;
}

}  // namespace

template <int Dim>
CellVolumes<Dim>::CellVolumes(const VolumeCells& cells, const std::vector<algebra::Vec3>& X)
    : n_nodes_(static_cast<std::int64_t>(X.size())) {
  for (const int n : {3, 4, 6, 8}) {
    CellGroup group = group_of(cells, n, n_slots_);
    if (group.n_blocks == 0) continue;
    n_slots_ += group.n_blocks * n * n_lanes;
    groups_.push_back(std::move(group));
  }
  if (n_slots_ > std::numeric_limits<std::int32_t>::max()) {
    throw base::InputError("the mesh has more cells than the volumes of cells can count; use "
                           "scheme.volumes = \"nodes\", or a coarser mesh");
  }
  const auto for_slots = [&](const auto& use) {
    for (const CellGroup& group : groups_) {
      std::int64_t left = 0;  // cells of this group
      for (std::int64_t c = 0; c < cells.n_cells(); ++c)
        left += cells.row[c + 1] - cells.row[c] == group.n_corners;
      for (std::int64_t i = 0; i < left; ++i) {
        for (int k = 0; k < group.n_corners; ++k) {
          const std::int64_t slot =
              (i / n_lanes * group.n_corners + k) * n_lanes + i % n_lanes;
          use(group.corner[slot], group.first_slot + slot);
        }
      }
    }
  };
  row_.assign(static_cast<size_t>(n_nodes_) + 1, 0);
  for_slots([&](std::int32_t a, std::int64_t) { ++row_[a + 1]; });
  for (std::int64_t a = 0; a < n_nodes_; ++a)
    row_[a + 1] += row_[a];
  slot_.resize(static_cast<size_t>(row_.back()));
  std::vector<std::int64_t> next(row_.begin(), row_.end() - 1);
  for_slots([&](std::int32_t a, std::int64_t slot) {
    slot_[next[a]++] = static_cast<std::int32_t>(slot);
  });
  x_ = Array(n_nodes_ * stride);
  volume_ = Array(n_slots_);
  pressure_ = Array(algebra::n_blocks_of(n_nodes_) * n_lanes);
  force_ = Array(n_slots_ * Dim);
  for (std::int64_t a = 0; a < n_nodes_; ++a) {
    for (int i = 0; i < Dim; ++i)
      x_[a * stride + i] = X[a][i];
  }
  put_volumes(x_, nullptr, volume_);
  V_0_ = Array(n_nodes_);
  for (std::int64_t a = 0; a < n_nodes_; ++a)
    V_0_[a] = sum_at(a, volume_);
}

template <int Dim>
std::int64_t CellVolumes<Dim>::bytes() const {
  std::int64_t sum = V_0_.bytes() + x_.bytes() + volume_.bytes() + pressure_.bytes() +
                     force_.bytes() +
                     static_cast<std::int64_t>(row_.size() * sizeof row_[0] +
                                               slot_.size() * sizeof slot_[0]);
  for (const CellGroup& group : groups_)
    sum += group.corner.bytes() + group.share.bytes();
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
    sweep.out = volume.data() + group.first_slot;
    sweep_group<VolumeKernel, Dim>(sweep, group);
  }
}

template <int Dim>
double CellVolumes<Dim>::sum_at(std::int64_t a, const Array& volume) const {
  double sum = 0;
  for (std::int64_t k = row_[a]; k < row_[a + 1]; ++k)
    sum += volume[slot_[k]];
  return sum;
}

template <int Dim>
void CellVolumes<Dim>::add_forces(Body<Dim>& body, const MaterialModel& material) {
  put_positions(body, x_);
  put_volumes(x_, nullptr, volume_);
  parallel::for_chunks(body.n_blocks, [&](std::int64_t begin, std::int64_t end, std::int64_t) {
    const std::int64_t first = begin * n_lanes, last = std::min(end * n_lanes, n_nodes_);
    for (std::int64_t a = first; a < last; ++a)
      pressure_[a] = sum_at(a, volume_) / V_0_[a];
    material.put_volumetric_stresses(&pressure_[first], last - first);
  });
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
  put_volumes(x_, rate.data(), volume_);
  for (std::int64_t a = 0; a < n_nodes_; ++a)
    pressure_[a] = modulus * sum_at(a, volume_) / V_0_[a];
  sum_forces(body);
}

template <int Dim>
void CellVolumes<Dim>::sum_forces(Body<Dim>& body) {
  for (const CellGroup& group : groups_) {
    CellSweep sweep = sweep_of(group);
    sweep.x = x_.data();
    sweep.pressure = pressure_.data();
    sweep.out = force_.data() + group.first_slot * Dim;
    sweep_group<ForceKernel, Dim>(sweep, group);
  }
  parallel::for_chunks(body.n_blocks, [&](std::int64_t begin, std::int64_t end, std::int64_t) {
    const std::int64_t last = std::min(end * n_lanes, n_nodes_);
    for (std::int64_t a = begin * n_lanes; a < last; ++a) {
      double sum[Dim] = {};
      for (std::int64_t k = row_[a]; k < row_[a + 1]; ++k) {
        const double* force = &force_[slot_[k] / n_lanes * n_lanes * Dim + slot_[k] % n_lanes];
        for (int i = 0; i < Dim; ++i)
          sum[i] += force[i * n_lanes];
      }
      for (int i = 0; i < Dim; ++i)
        body.T.add(a, i, sum[i]);
    }
  });
}

template <int Dim>
double CellVolumes<Dim>::power(const Body<Dim>& body) const {
  std::vector<double> parts(parallel::n_chunks_of(body.n_blocks));
  parallel::for_chunks(body.n_blocks, [&](std::int64_t begin, std::int64_t end, std::int64_t c) {
    const std::int64_t last = std::min(end * n_lanes, n_nodes_);
    for (std::int64_t a = begin * n_lanes; a < last; ++a) {
      for (std::int64_t k = row_[a]; k < row_[a + 1]; ++k) {
        const double* force = &force_[slot_[k] / n_lanes * n_lanes * Dim + slot_[k] % n_lanes];
        for (int i = 0; i < Dim; ++i)
          parts[c] += body.v.at(a, i) * force[i * n_lanes];
      }
    }
  });
  return parallel::sum_in_order(parts);
}

template <int Dim>
std::vector<double> CellVolumes<Dim>::ratios(const Body<Dim>& body) const {
  Array x(n_nodes_ * stride), volume(n_slots_);
  put_positions(body, x);
  put_volumes(x, nullptr, volume);
  std::vector<double> J(static_cast<size_t>(n_nodes_));
  for (std::int64_t a = 0; a < n_nodes_; ++a)
    J[a] = sum_at(a, volume) / V_0_[a];
  return J;
}

template class CellVolumes<2>;
template class CellVolumes<3>;

}  // namespace diptych::scheme
