#include "common/scheme/volumes/cell_volumes.hpp"

#include "common/algebra/face_areas.hpp"
#include "common/base/error.hpp"
#include "common/scheme/body/material_model.hpp"
#include "common/scheme/boundary/node_vector.hpp"
#include "common/scheme/ranks/division.hpp"
#include "common/scheme/volumes/cell_sweeps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace diptych::scheme {

namespace {

/// Part of what the means smooth that is taken back, so that nothing is left along a line of nodes.
/// There V_a/V_a(X) is a central difference, 1 - theta^2/6 of J, and the mean of means S is
/// 1 - theta^2/4 of bricks and quadrilaterals, 5/24 of six tetrahedra to a brick, 2/9 of triangles,
/// prisms between.
double taken_back(int dimension, int n_corners) {
  if (dimension == 2) return n_corners == 3 ? 3.0 / 4 : 2.0 / 3;
  return n_corners == 4 ? 4.0 / 5 : n_corners == 6 ? 0.7 : 2.0 / 3;
}

CellSweep sweep_of(const CellGroup& group) {
  return {group.corner.data(),
          group.share.size() > 0 ? group.share.data() : nullptr,
          nullptr,
          nullptr,
          nullptr,
          group.weight.data(),
          nullptr};
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
  group.weight = algebra::AlignedArray<double>(group.n_blocks * n_lanes);
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

/// work(first, last, chunk) of the nodes of each chunk of a rank.
template <int Dim, class Work>
void for_nodes(const Body<Dim>& body, const Work& work) {
  parallel::for_chunks(body.part(), body.n_blocks,
                       [&](std::int64_t begin, std::int64_t end, std::int64_t chunk) {
                         work(begin * n_lanes, std::min(end * n_lanes, body.n_owned), chunk);
                       });
}

/// Of group g; null where it is all of it.
template <int Dim>
const CellWork* work_in(const Body<Dim>* body, size_t g) {
  return body != nullptr && body->division ? &body->division->cells[g] : nullptr;
}

}  // namespace

template <int Dim>
std::vector<CellWork> CellVolumes<Dim>::work_of(const parallel::Part& part,
                                                std::vector<char>& read) const {
  std::vector<CellWork> work(groups_.size());
  for (size_t g = 0; g < groups_.size(); ++g) {
    const CellGroup& group = groups_[g];
    const std::int64_t length = group.n_corners * n_lanes;
    const auto is_mine = [&](std::int64_t block) {
      const std::int32_t* first = group.corner.data() + block * length;
      return std::any_of(first, first + length, [&](std::int32_t a) {
        return part.owns(a / (parallel::chunk_size * n_lanes));
      });
    };
    for (std::int64_t s = 0; s < n_segments_; ++s) {
      const std::int64_t begin = group.segment[s];
      auto ranges = parallel::ranges_of(group.segment[s + 1] - begin,
                                        [&](std::int64_t b) { return is_mine(begin + b); });
      for (parallel::NodeRange& blocks : ranges) {
        blocks = {begin + blocks.begin, begin + blocks.end};
        for (std::int64_t k = blocks.begin * length; k < blocks.end * length; ++k)
          read[group.corner[k]] = 1;
      }
      work[g].segments.push_back(std::move(ranges));
    }
  }
  return work;
}

template <int Dim>
CellVolumes<Dim>::CellVolumes(const VolumeCells& cells,
                              const std::vector<algebra::Vec3>& X,
                              bool with_shear)
    : Base(static_cast<std::int64_t>(X.size())) {
  const std::int64_t length = segment_length(cells);
  n_segments_ = (n_nodes() + length - 1) / length;
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
  of_cells_ = Array(n_cells_ + n_lanes);
  pressure_ = Array(V_0_.size());
  inverse_V_0_ = Array(V_0_.size());
  for (std::int64_t a = 0; a < n_nodes(); ++a) {
    for (int i = 0; i < Dim; ++i)
      x_[a * stride + i] = X[a][i];
  }
  put_volumes(nullptr, x_, nullptr, of_cells_);
  for (std::int64_t a = 0; a < n_nodes(); ++a)
    inverse_V_0_[a] = 1;
  put_ratios(parallel::Part(), of_cells_, V_0_);
  for (CellGroup& group : groups_) {
    for (std::int64_t i = 0; i < group.n_blocks * n_lanes; ++i) {
      group.weight[i] = taken_back(Dim, group.n_corners) * of_cells_[group.first_cell + i];
      of_cells_[group.first_cell + i] = group.weight[i];
    }
  }
  around_.weight = Array(pressure_.size());
  put_ratios(parallel::Part(), of_cells_, around_.weight);
  for (std::int64_t a = 0; a < n_nodes(); ++a)
    inverse_V_0_[a] = 1 / V_0_[a];
  if (with_shear) laplacian_ = CellLaplacian(cells, X, Dim, x_);
}

template <int Dim>
void CellVolumes<Dim>::list_cells_of_nodes(const VolumeCells& cells,
                                           const std::vector<std::int64_t>& place) {
  struct Corner {
    std::int64_t cell;
    double share;
  };
  std::vector<std::vector<Corner>> around(static_cast<size_t>(n_nodes()));
  for (const CellGroup& group : groups_) {
    for (std::int64_t c = 0; c < cells.n_cells(); ++c) {
      if (cells.row[c + 1] - cells.row[c] != group.n_corners) continue;
      for (std::int64_t k = cells.row[c]; k < cells.row[c + 1]; ++k)
        around[cells.corner[k]].push_back({group.first_cell + place[c], cells.share[k]});
    }
  }
  const std::int64_t n_blocks = algebra::n_blocks_of(n_nodes());
  const auto corners_of = [&](std::int64_t a) -> const std::vector<Corner>& {
    static const std::vector<Corner> none;
    return a < n_nodes() ? around[a] : none;
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
  for (std::int64_t a = 0; a < n_nodes(); ++a) {
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
                     around_.cell.bytes() + around_.share.bytes() + around_.weight.bytes() +
                     laplacian_.bytes();
  for (const CellGroup& group : groups_)
    sum += group.corner.bytes() + group.share.bytes() + group.weight.bytes();
  return sum;
}

template <int Dim>
void CellVolumes<Dim>::put_volumes(const Body<Dim>* body,
                                   const Array& x,
                                   const double* rate,
                                   Array& volume) const {
  for (size_t g = 0; g < groups_.size(); ++g) {
    const CellGroup& group = groups_[g];
    CellSweep sweep = sweep_of(group);
    sweep.x = x.data();
    sweep.rate = rate;
    sweep.out = volume.data() + group.first_cell;
    sweep_group<VolumeKernel, Dim>(sweep, group, work_in(body, g));
  }
}

template <int Dim>
void CellVolumes<Dim>::put_ratios(const parallel::Part& part,
                                  const Array& volume,
                                  Array& ratio) const {
  sweep_nodes<RatioKernel>(part, around_, volume.data(), inverse_V_0_.data(), ratio.data());
}

template <int Dim>
void CellVolumes<Dim>::sharpen(const Body<Dim>& body, Array& values, Array& of_cells) const {
  exchange(body, values, 1);
  for (size_t g = 0; g < groups_.size(); ++g) {
    const CellGroup& group = groups_[g];
    CellSweep sweep = sweep_of(group);
    sweep.nodal = values.data();
    sweep.out = of_cells.data() + group.first_cell;
    sweep_group<MeanKernel, Dim>(sweep, group, work_in(&body, g));
  }
  sweep_nodes<SharpenKernel>(body.part(), around_, of_cells.data(), inverse_V_0_.data(),
                             values.data());
}

template <int Dim>
void CellVolumes<Dim>::evaluate(const Body<Dim>& body, const MaterialModel& material) {
  put_positions(body, x_);
  put_volumes(&body, x_, nullptr, of_cells_);
  put_ratios(body.part(), of_cells_, pressure_);
  sharpen(body, pressure_, of_cells_);
  parallel::for_chunks(
      body.part(), body.n_blocks, [&](std::int64_t begin, std::int64_t end, std::int64_t) {
        const std::int64_t first = begin * n_lanes, last = std::min(end * n_lanes, n_nodes());
        material.put_volumetric_stresses(&pressure_[first], last - first);
      });
  sharpen(body, pressure_, of_cells_);
  put_forces(body);
  if (const double s = body.options.cell_shear; s != 0) {
    for_nodes(body, [&](auto begin, auto end, auto) {
      laplacian_.add_forces(x_, s, begin, end, force_);
    });
  }
}

template <int Dim>
void CellVolumes<Dim>::add_shear_energies(const Body<Dim>& body, std::vector<double>& sums) const {
  const double s = body.options.cell_shear;
  if (s == 0) return;
  Array x(x_.size());
  put_positions(body, x);
  for_nodes(body, [&](auto begin, auto end, auto chunk) {
    sums[chunk] += laplacian_.energy(x, s, begin, end);
  });
}

template <int Dim>
void CellVolumes<Dim>::evaluate_linear(const Body<Dim>& body, double modulus, double shear) {
  put_positions(body, x_);
  Array rate(x_.size());
  for (std::int64_t a = 0; a < n_nodes(); ++a) {
    for (int i = 0; i < Dim; ++i)
      rate[a * stride + i] = body.v.at(a, i);
  }
  put_volumes(&body, x_, rate.data(), of_cells_);
  put_ratios(body.part(), of_cells_, pressure_);
  sharpen(body, pressure_, of_cells_);
  for (std::int64_t a = 0; a < n_nodes(); ++a)
    pressure_[a] *= modulus;
  sharpen(body, pressure_, of_cells_);
  put_forces(body);
  if (shear != 0) {
    for_nodes(body, [&](auto begin, auto end, auto) {
      laplacian_.add_linear_forces(rate, shear, begin, end, force_);
    });
  }
}

template <int Dim>
void CellVolumes<Dim>::clear_forces(const Body<Dim>& body) {
  parallel::for_chunks(
      body.part(), body.n_blocks, [&](std::int64_t begin, std::int64_t end, std::int64_t) {
        constexpr std::int64_t row = n_lanes * stride;
        std::fill(&force_[begin * row], &force_[begin * row] + (end - begin) * row, 0.0);
      });
  if (!body.division) return;
  for (const parallel::NodeRange& nodes : body.division->corners.received())
    std::fill(&force_[nodes.begin * stride],
              &force_[nodes.begin * stride] + (nodes.end - nodes.begin) * stride, 0.0);
}

template <int Dim>
void CellVolumes<Dim>::put_forces(const Body<Dim>& body) {
  exchange(body, pressure_, 1);
  clear_forces(body);
  for (size_t g = 0; g < groups_.size(); ++g) {
    const CellGroup& group = groups_[g];
    const CellWork* work = work_in(&body, g);
    CellSweep sweep = sweep_of(group);
    sweep.x = x_.data();
    sweep.nodal = pressure_.data();
    sweep.out = force_.data();
    const CellFunction run = function_of<ForceKernel, Dim>(group);
    for (const std::int64_t parity : {0, 1}) {
      parallel::for_shares((n_segments_ + 1 - parity) / 2, [&](std::int64_t i) {
        const std::int64_t s = 2 * i + parity;
        if (work == nullptr) {
          run(sweep, group.segment[s], group.segment[s + 1]);
          return;
        }
        for (const parallel::NodeRange& blocks : work->segments[s])
          run(sweep, blocks.begin, blocks.end);
      });
    }
  }
}

template <int Dim>
std::vector<double> CellVolumes<Dim>::ratios(const Body<Dim>& body) const {
  Array x(x_.size()), volume(n_cells_ + n_lanes), J(pressure_.size());
  put_positions(body, x);
  put_volumes(&body, x, nullptr, volume);
  put_ratios(body.part(), volume, J);
  sharpen(body, J, volume);
  return {J.data(), J.data() + n_nodes()};
}

template <int Dim>
std::vector<algebra::Vec3> CellVolumes<Dim>::deformed_areas(const Body<Dim>& body,
                                                            const BoundaryPatch& patch) {
  std::vector<Vec3> area(patch.nodes.size(), Vec3::Zero());
  std::vector<Vec3> x_of;  // of all nodes: faces have nodes of several ranks
  std::vector<std::int32_t> chunk_of;
  for (const std::int32_t a : patch.nodes) {
    Vec3 x = body.X[a];
    for (int i = 0; i < Dim; ++i)
      x[i] += body.u.at(a, i);
    x_of.push_back(x);
    chunk_of.push_back(static_cast<std::int32_t>(chunk_of_node(a)));
  }
  body.part().complete(x_of, chunk_of);
  for (const auto& face : patch.faces) {
    std::array<Vec3, 4> x;
    std::array<std::ptrdiff_t, 4> at;
    int n = 0;
    for (; n < 4 && face[n] >= 0; ++n) {
      at[n] =
          std::lower_bound(patch.nodes.begin(), patch.nodes.end(), face[n]) - patch.nodes.begin();
      x[n] = x_of[at[n]];
    }
    const auto shares = algebra::face_area_shares(x, n);
    for (int i = 0; i < n; ++i)
      area[at[i]] += shares[i];
  }
  return area;
}

template class CellVolumes<2>;
template class CellVolumes<3>;

}  // namespace diptych::scheme
