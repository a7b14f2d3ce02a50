#include "common/scheme/volumes/cell_laplacian.hpp"

#include "common/algebra/four.hpp"
#include "common/algebra/lanes.hpp"
#include "common/parallel/for_chunks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace diptych::scheme {

using algebra::Four;
using algebra::Vec3;

namespace {

constexpr std::int64_t stride = 4;
constexpr int most_corners = 8;

/// A point of a quadrature over a reference cell: derivatives of its shape functions there.
struct ShapePoint {
  ShapePoint() { derivative.fill(Vec3::Zero()); }
  double weight = 0;
  std::array<Vec3, most_corners> derivative;  ///< of each corner, by reference coordinates
};

/// Simplices: the gradients of their linear functions are the same everywhere.
std::vector<ShapePoint> simplex_points(int dimension) {
  ShapePoint point;
  point.weight = dimension == 2 ? 1.0 / 2 : 1.0 / 6;
  for (int i = 0; i < dimension; ++i) {
    point.derivative[0][i] = -1;
    point.derivative[static_cast<size_t>(i) + 1][i] = 1;
  }
  return {point};
}

/// Corners of the squares and cubes [-1, 1]^Dim in the order of Gmsh.
constexpr std::array<std::array<double, 3>, 8> box_corner{{{-1, -1, -1},
                                                           {1, -1, -1},
                                                           {1, 1, -1},
                                                           {-1, 1, -1},
                                                           {-1, -1, 1},
                                                           {1, -1, 1},
                                                           {1, 1, 1},
                                                           {-1, 1, 1}}};

/// Two points of Gauss along each side, which is exact for the flux through a bilinear face.
std::vector<ShapePoint> box_points(int dimension) {
  const double g = 1 / std::sqrt(3.0);
  std::vector<ShapePoint> points;
  const int n = dimension == 2 ? 4 : 8;
  for (int q = 0; q < n; ++q) {
    ShapePoint point;
    point.weight = 1;
    for (int k = 0; k < n; ++k) {
      for (int i = 0; i < dimension; ++i) {
        double d = 1;
        for (int j = 0; j < dimension; ++j) {
          const double side = box_corner[k][j];
          d *= j == i ? 0.5 * side : 0.5 * (1 + side * g * box_corner[q][j]);
        }
        point.derivative[k][i] = d;
      }
    }
    points.push_back(point);
  }
  return points;
}

/// Three points in the triangle, two along the third direction.
std::vector<ShapePoint> prism_points() {
  const double g = 1 / std::sqrt(3.0);
  std::vector<ShapePoint> points;
  constexpr std::array<std::array<double, 2>, 3> middle{{{0.5, 0}, {0.5, 0.5}, {0, 0.5}}};
  for (const double z : {-g, g}) {
    for (const auto& [r, s] : middle) {
      ShapePoint point;
      point.weight = 1.0 / 6;
      const std::array<double, 3> N{1 - r - s, r, s};
      constexpr std::array<std::array<double, 2>, 3> dN{{{-1, -1}, {1, 0}, {0, 1}}};
      for (int k = 0; k < 6; ++k) {
        const double side = k < 3 ? -1 : 1, along = 0.5 * (1 + side * z);
        point.derivative[k] = {along * dN[k % 3][0], along * dN[k % 3][1], 0.5 * side * N[k % 3]};
      }
      points.push_back(point);
    }
  }
  return points;
}

const std::vector<ShapePoint>& points_of(int dimension, std::int64_t n_corners) {
  static const auto triangle = simplex_points(2), tetrahedron = simplex_points(3),
                    quadrilateral = box_points(2), hexahedron = box_points(3),
                    prism = prism_points();
  if (dimension == 2) return n_corners == 3 ? triangle : quadrilateral;
  return n_corners == 4 ? tetrahedron : n_corners == 6 ? prism : hexahedron;
}

using CellMatrix = std::array<std::array<double, most_corners>, most_corners>;

/// How much narrower than long a cell is, squared: of its mean Jacobian.
double squared_aspect(const algebra::Mat3& jacobian, int dimension, std::int64_t n_corners) {
  algebra::Mat3 regular = algebra::Mat3::Identity();  // reference cells are boxes
  if (dimension == 3 && n_corners == 6) {             // or right triangles times two
    regular(0, 1) = 0.5;
    regular(1, 1) = std::sqrt(0.75);
    regular(2, 2) = 0.5;
  }
  const algebra::Mat3 J = jacobian * regular.inverse();
  const Eigen::SelfAdjointEigenSolver<algebra::Mat3> squares(J.transpose() * J,
                                                             Eigen::EigenvaluesOnly);
  const auto& values = squares.eigenvalues();
  return values[0] / values[2];
}

/// k_ab of notes 3.11: -int grad N_a . grad N_b dV of the corners a, b of a cell. Of what is left
/// of it beside the mean gradients, which holds the modes in which a cell has none, cells that are
/// longer than they are wide count less: all of it would be too stiff in bending by the square of
/// that ratio.
void put_matrix_of_cell(std::span<const std::int32_t> corners,
                        const std::vector<Vec3>& X,
                        int dimension,
                        CellMatrix& matrix) {
  const auto n = corners.size();
  const auto& points = points_of(dimension, std::ssize(corners));
  for (auto& row : matrix)
    row.fill(0);
  std::array<Vec3, most_corners> mean;
  mean.fill(Vec3::Zero());
  algebra::Mat3 mean_jacobian = algebra::Mat3::Zero();
  double total = 0;
  for (const ShapePoint& point : points) {
    algebra::Mat3 jacobian = algebra::Mat3::Zero();
    for (size_t k = 0; k < n; ++k)
      jacobian += (X[corners[k]] - X[corners[0]]) * point.derivative[k].transpose();
    if (dimension == 2) jacobian(2, 2) = std::sqrt(jacobian.topLeftCorner<2, 2>().determinant());
    const algebra::Mat3 to_space = jacobian.inverse().transpose();
    const double volume =
        point.weight *
        (dimension == 2 ? jacobian.topLeftCorner<2, 2>().determinant() : jacobian.determinant());
    std::array<Vec3, most_corners> gradient;
    for (size_t k = 0; k < n; ++k) {
      gradient[k] = to_space * point.derivative[k];
      mean[k] += volume * gradient[k];
    }
    for (size_t a = 0; a < n; ++a) {
      for (size_t b = 0; b < n; ++b)
        matrix[a][b] -= volume * gradient[a].dot(gradient[b]);
    }
    mean_jacobian += jacobian / static_cast<double>(points.size());
    total += volume;
  }
  if (points.size() == 1) return;  // simplices have one gradient
  const double aspect = squared_aspect(mean_jacobian, dimension, std::ssize(corners));
  for (size_t a = 0; a < n; ++a) {
    for (size_t b = 0; b < n; ++b) {
      const double of_mean = -mean[a].dot(mean[b]) / total;
      matrix[a][b] = of_mean + aspect * (matrix[a][b] - of_mean);
    }
  }
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

/// force += s sum_b k_ab (from_b - from_a) of nodes [begin, end).
DIPTYCH_CLONES void add_rows(const Rows& rows,
                             const double* from,
                             double s,
                             std::int64_t begin,
                             std::int64_t end,
                             double* force) {
  for (std::int64_t a = begin; a < end; ++a) {
    const Four own = algebra::load_four(from + stride * a);
    Four sum{};
    for (std::int64_t k = rows.first[a]; k < rows.first[a + 1]; ++k)
      sum += rows.weight[k] * (algebra::load_four(from + stride * rows.neighbour[k]) - own);
    const Four total = algebra::load_four(force + stride * a) + s * sum;
    __builtin_memcpy(force + stride * a, &total, sizeof total);
  }
}

}  // namespace

CellLaplacian::CellLaplacian(const VolumeCells& cells, const std::vector<Vec3>& X, int dimension) {
  const auto n_nodes = static_cast<std::int64_t>(X.size());
  const Around around = cells_around(cells, n_nodes);
  const auto corners_of = [&](std::int64_t c) {
    return std::span(cells.corner)
        .subspan(static_cast<size_t>(cells.row[c]),
                 static_cast<size_t>(cells.row[c + 1] - cells.row[c]));
  };
  std::vector<std::vector<std::int32_t>> of_node(X.size());
  for_ranges(n_nodes, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t a = begin; a < end; ++a) {
      std::vector<std::int32_t>& row = of_node[a];
      for (std::int64_t k = around.row[a]; k < around.row[a + 1]; ++k) {
        const auto corners = corners_of(around.cell[k]);
        row.insert(row.end(), corners.begin(), corners.end());
      }
      std::sort(row.begin(), row.end());
      row.erase(std::unique(row.begin(), row.end()), row.end());
      std::erase(row, static_cast<std::int32_t>(a));
      row.shrink_to_fit();
    }
  });
  row_.assign(X.size() + 1, 0);
  for (std::int64_t a = 0; a < n_nodes; ++a)
    row_[a + 1] = row_[a] + std::ssize(of_node[a]);
  neighbour_.resize(static_cast<size_t>(row_[n_nodes]));
  weight_.resize(neighbour_.size());
  for_ranges(n_nodes, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t a = begin; a < end; ++a)
      std::copy(of_node[a].begin(), of_node[a].end(), neighbour_.begin() + row_[a]);
    CellMatrix matrix;
    for (const std::int32_t c : cells_of_range(around, begin, end)) {
      const auto corners = corners_of(c);
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
}

std::int64_t CellLaplacian::bytes() const {
  const auto of = [](const auto& v) {
    return static_cast<std::int64_t>(v.size() * sizeof(v.front()));
  };
  return of(row_) + of(neighbour_) + of(weight_);
}

void CellLaplacian::add_forces(
    const Array& x, double s, std::int64_t begin, std::int64_t end, Array& force) const {
  add_rows({row_.data(), neighbour_.data(), weight_.data()}, x.data(), s, begin, end, force.data());
}

double CellLaplacian::energy(const Array& x,
                             const std::vector<Vec3>& X,
                             double s,
                             std::int64_t begin,
                             std::int64_t end) const {
  double sum = 0;
  for (std::int64_t a = begin; a < end; ++a) {
    const double* own = x.data() + a * stride;
    for (std::int64_t k = row_[a]; k < row_[a + 1]; ++k) {
      const std::int64_t b = neighbour_[k];
      const double* other = x.data() + b * stride;
      double change = 0;  // of |x_b - x_a|^2
      for (int i = 0; i < 3; ++i) {
        const double x_ab = other[i] - own[i], X_ab = X[b][i] - X[a][i];
        change += (x_ab - X_ab) * (x_ab + X_ab);
      }
      sum += weight_[k] * change;
    }
  }
  return 0.25 * s * sum;
}

}  // namespace diptych::scheme
