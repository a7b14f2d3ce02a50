#include "common/scheme/volumes/cell_laplacian.hpp"

#include "common/algebra/four.hpp"
#include "common/algebra/lanes.hpp"
#include "common/parallel/for_chunks.hpp"
#include "meshes/shape_integrals.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace diptych::scheme {

using algebra::Four;
using algebra::Vec3;

namespace {

constexpr std::int64_t stride = 4;

const meshes::ReferenceCell& reference_of(int dimension, std::int64_t n_corners) {
  using enum meshes::CellType;
  if (dimension == 2) return meshes::reference_cell(n_corners == 3 ? triangle : quadrilateral);
  return meshes::reference_cell(n_corners == 4 ? tetrahedron : n_corners == 6 ? prism : hexahedron);
}

using CellMatrix = std::array<std::array<double, meshes::max_cell_nodes>, meshes::max_cell_nodes>;

using Gradients = std::array<Vec3, meshes::max_cell_nodes>;

/// use(volume, gradients of the shape functions) at the points of a rule.
template <class Use>
void for_points(std::span<const std::int32_t> corners,
                const std::vector<Vec3>& X,
                const meshes::ReferenceCell& cell,
                const std::vector<meshes::QuadraturePoint>& rule,
                const Use& use) {
  Gradients gradient;
  for (const meshes::QuadraturePoint& point : rule) {
    const algebra::Mat3 jacobian = meshes::jacobian(cell, point, corners, X);
    const algebra::Mat3 to_space = jacobian.inverse().transpose();
    for (size_t k = 0; k < corners.size(); ++k)
      gradient[k] = to_space * point.dN[k];
    use(point.weight * jacobian.determinant(), gradient);
  }
}

/// Volume and mean gradients by a rule.
double put_mean(std::span<const std::int32_t> corners,
                const std::vector<Vec3>& X,
                const meshes::ReferenceCell& cell,
                const std::vector<meshes::QuadraturePoint>& rule,
                Gradients& mean) {
  double total = 0;
  mean.fill(Vec3::Zero());
  for_points(corners, X, cell, rule, [&](double volume, const Gradients& gradient) {
    total += volume;
    for (size_t k = 0; k < corners.size(); ++k)
      mean[k] += volume * gradient[k];
  });
  for (Vec3& g : mean)
    g /= total;
  return total;
}

/// matrix -= volume a_k . a_q of all corners k, q.
void subtract_products(double volume, const Gradients& a, size_t n, CellMatrix& matrix) {
  for (size_t k = 0; k < n; ++k) {
    for (size_t q = 0; q < n; ++q)
      matrix[k][q] -= volume * a[k].dot(a[q]);
  }
}

/// k_ab of notes 3.11 of the corners a, b of a cell: of the mean gradients, which are exact so that
/// neighbours close, and, by the vertex rule, of what gradients differ from their mean.
void put_matrix_of_cell(std::span<const std::int32_t> corners,
                        const std::vector<Vec3>& X,
                        int dimension,
                        CellMatrix& matrix) {
  const meshes::ReferenceCell& cell = reference_of(dimension, std::ssize(corners));
  const auto n = corners.size();
  for (auto& row : matrix)
    row.fill(0);
  Gradients mean;
  const double volume = put_mean(corners, X, cell, cell.exact, mean);
  subtract_products(volume, mean, n, matrix);
  if (cell.exact.size() == 1) return;  // simplices have one gradient
  put_mean(corners, X, cell, cell.vertex, mean);
  for_points(corners, X, cell, cell.vertex, [&](double part, Gradients gradient) {
    for (size_t k = 0; k < n; ++k)
      gradient[k] -= mean[k];
    subtract_products(part, gradient, n, matrix);
  });
}

std::span<const std::int32_t> corners_of(const VolumeCells& cells, std::int64_t c) {
  return std::span(cells.corner)
      .subspan(static_cast<size_t>(cells.row[c]),
               static_cast<size_t>(cells.row[c + 1] - cells.row[c]));
}

/// The cells around each node, ascending.
struct Around {
  std::vector<std::int64_t> row;
  std::vector<std::int32_t> cell;
};

Around cells_around(const VolumeCells& cells, std::int64_t n_nodes) {
  Around around;
  around.row.assign(static_cast<size_t>(n_nodes) + 1, 0);
  for (const std::int32_t a : cells.corner)
    ++around.row[a + 1];
  for (std::int64_t a = 0; a < n_nodes; ++a)
    around.row[a + 1] += around.row[a];
  around.cell.resize(cells.corner.size());
  std::vector<std::int64_t> next(around.row.begin(), around.row.end() - 1);
  for (std::int64_t c = 0; c < cells.n_cells(); ++c) {
    for (std::int64_t k = cells.row[c]; k < cells.row[c + 1]; ++k)
      around.cell[next[cells.corner[k]]++] = static_cast<std::int32_t>(c);
  }
  return around;
}

/// work(begin, end) of ranges of nodes that are long beside what the cells at their ends reach.
template <class Work>
void for_ranges(std::int64_t n_nodes, const Work& work) {
  constexpr std::int64_t length = 8192;
  parallel::for_shares((n_nodes + length - 1) / length, [&](std::int64_t i) {
    work(i * length, std::min(n_nodes, (i + 1) * length));
  });
}

/// Those of a range, ascending.
std::vector<std::int32_t> cells_of_range(const Around& around,
                                         std::int64_t begin,
                                         std::int64_t end) {
  std::vector<std::int32_t> cells(around.cell.begin() + around.row[begin],
                                  around.cell.begin() + around.row[end]);
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return cells;
}

/// What a sweep over the rows reads of them.
struct Rows {
  const std::int64_t* first;
  const std::int32_t* neighbour;
  const double* weight;
};

/// force += s sum_b k_ab (u_b - u_a) of nodes [begin, end): what a gives to b it takes from b, to
/// the last bit.  @param u_of  displacement of a node
template <class Displacement>
DIPTYCH_INLINE void add_rows_of(const Rows& rows,
                                const Displacement& u_of,
                                double s,
                                std::int64_t begin,
                                std::int64_t end,
                                double* force) {
  for (std::int64_t a = begin; a < end; ++a) {
    const Four own = u_of(a);
    Four sum{};
    for (std::int64_t k = rows.first[a]; k < rows.first[a + 1]; ++k)
      sum += rows.weight[k] * (u_of(rows.neighbour[k]) - own);
    const Four total = algebra::load_four(force + stride * a) + s * sum;
    __builtin_memcpy(force + stride * a, &total, sizeof total);
  }
}

/// Of displacements u, or, with reference positions, of u - X.
DIPTYCH_CLONES void add_rows(const Rows& rows,
                             const double* u,
                             const double* X,
                             double s,
                             std::int64_t begin,
                             std::int64_t end,
                             double* force) {
  const auto given = [u](std::int64_t a)
                         DIPTYCH_INLINE_LAMBDA { return algebra::load_four(u + stride * a); };
  const auto between = [u, X](std::int64_t a) DIPTYCH_INLINE_LAMBDA {
    return algebra::load_four(u + stride * a) - algebra::load_four(X + stride * a);
  };
  if (X == nullptr) {
    add_rows_of(rows, given, s, begin, end, force);
  } else {
    add_rows_of(rows, between, s, begin, end, force);
  }
}

}  // namespace

CellLaplacian::CellLaplacian(const VolumeCells& cells,
                             const std::vector<Vec3>& X,
                             int dimension,
                             const Array& x) {
  const auto n_nodes = static_cast<std::int64_t>(X.size());
  const Around around = cells_around(cells, n_nodes);
  const auto put_neighbours = [&](std::int64_t a, std::vector<std::int32_t>& row) {
    row.clear();
    for (std::int64_t k = around.row[a]; k < around.row[a + 1]; ++k) {
      const auto corners = corners_of(cells, around.cell[k]);
      row.insert(row.end(), corners.begin(), corners.end());
    }
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
    std::erase(row, static_cast<std::int32_t>(a));
  };
  row_.assign(X.size() + 1, 0);
  for_ranges(n_nodes, [&](std::int64_t begin, std::int64_t end) {
    std::vector<std::int32_t> row;
    for (std::int64_t a = begin; a < end; ++a) {
      put_neighbours(a, row);
      row_[a + 1] = std::ssize(row);
    }
  });
  for (std::int64_t a = 0; a < n_nodes; ++a)
    row_[a + 1] += row_[a];
  neighbour_.resize(static_cast<size_t>(row_[n_nodes]));
  weight_.resize(neighbour_.size());
  for_ranges(n_nodes, [&](std::int64_t begin, std::int64_t end) {
    std::vector<std::int32_t> row;
    for (std::int64_t a = begin; a < end; ++a) {
      put_neighbours(a, row);
      std::copy(row.begin(), row.end(), neighbour_.begin() + row_[a]);
    }
    CellMatrix matrix;
    for (const std::int32_t c : cells_of_range(around, begin, end)) {
      const auto corners = corners_of(cells, c);
      put_matrix_of_cell(corners, X, dimension, matrix);
      for (size_t k = 0; k < corners.size(); ++k) {
        const std::int32_t a = corners[k];
        if (a < begin || a >= end) continue;
        const auto first = neighbour_.begin() + row_[a], last = neighbour_.begin() + row_[a + 1];
        for (size_t q = 0; q < corners.size(); ++q) {
          if (q != k)
            weight_[std::lower_bound(first, last, corners[q]) - neighbour_.begin()] += matrix[k][q];
        }
      }
    }
  });
  at_rest_ = Array(x.size());
  std::copy_n(x.data(), x.size(), at_rest_.data());
}

std::int64_t CellLaplacian::bytes() const {
  const auto of = [](const auto& v) {
    return static_cast<std::int64_t>(v.size() * sizeof(v.front()));
  };
  return of(row_) + of(neighbour_) + of(weight_) + at_rest_.bytes();
}

void CellLaplacian::add_linear_forces(
    const Array& u, double s, std::int64_t begin, std::int64_t end, Array& force) const {
  add_rows({row_.data(), neighbour_.data(), weight_.data()}, u.data(), nullptr, s, begin, end,
           force.data());
}

void CellLaplacian::add_forces(
    const Array& x, double s, std::int64_t begin, std::int64_t end, Array& force) const {
  add_rows({row_.data(), neighbour_.data(), weight_.data()}, x.data(), at_rest_.data(), s, begin,
           end, force.data());
}

double CellLaplacian::energy(const Array& x, double s, std::int64_t begin, std::int64_t end) const {
  double sum = 0;
  for (std::int64_t a = begin; a < end; ++a) {
    const double* own = x.data() + a * stride;
    const double* own_at_rest = at_rest_.data() + a * stride;
    for (std::int64_t k = row_[a]; k < row_[a + 1]; ++k) {
      const std::int64_t b = neighbour_[k];
      const double* other = x.data() + b * stride;
      const double* other_at_rest = at_rest_.data() + b * stride;
      double u_u = 0;
      for (int i = 0; i < 3; ++i) {
        const double u = other[i] - own[i] - (other_at_rest[i] - own_at_rest[i]);
        u_u += u * u;
      }
      sum += weight_[k] * u_u;
    }
  }
  return 0.25 * s * sum;
}

}  // namespace diptych::scheme
