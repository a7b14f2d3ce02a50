#include "common/closure/cubic_part.hpp"

#include "common/algebra/field.hpp"
#include "common/algebra/four.hpp"
#include "common/algebra/monomials.hpp"
#include "common/parallel/for_each.hpp"

#include <algorithm>
#include <cmath>

namespace diptych::closure {

namespace {

using algebra::Four;
using Matrix = Eigen::MatrixXd;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Rows whose sums are one partial sum, whatever the number of threads.
constexpr std::int64_t piece_size = 4096;

/// Calls work(piece, first row, number of rows).
template <class Work>
void for_pieces(std::int64_t n_rows, const Work& work) {
  parallel::for_each((n_rows + piece_size - 1) / piece_size, [&](std::int64_t i) {
    work(i, i * piece_size, std::min<std::int64_t>(piece_size, n_rows - i * piece_size));
  });
}

/// A^T B over rows, summed in a fixed order. A product of Eigen's would be shared out to threads.
template <class Left, class Right>
Matrix transposed_product(const Left& A, const Right& B) {
  const std::int64_t n_rows = A.rows();
  std::vector<Matrix> parts(static_cast<size_t>((n_rows + piece_size - 1) / piece_size));
  for_pieces(n_rows, [&](std::int64_t i, std::int64_t first, std::int64_t n) {
    parts[i] = A.middleRows(first, n).transpose().lazyProduct(B.middleRows(first, n));
  });
  Matrix sum = parts.front();
  for (size_t i = 1; i < parts.size(); ++i)
    sum += parts[i];
  return sum;
}

constexpr int most_terms = 20;

struct Projection {
  Four value[most_terms];
};

/// part = B^T r over n rows
DIPTYCH_CLONES void project(
    const double* B, int n_terms, const Vec3* r, std::int64_t n, Four* part) {
  Four sum[most_terms]{};
  for (std::int64_t a = 0; a < n; ++a, B += n_terms) {
    const Four of_row = algebra::load_three(r[a]);
    for (int m = 0; m < n_terms; ++m)
      sum[m] += B[m] * of_row;
  }
  for (int m = 0; m < n_terms; ++m)
    part[m] = sum[m];
}

/// r -= B part over n rows
DIPTYCH_CLONES void subtract(
    const double* B, int n_terms, const Four* part, std::int64_t n, Vec3* r) {
  for (std::int64_t a = 0; a < n; ++a, B += n_terms) {
    Four of_row = algebra::load_three(r[a]);
    for (int m = 0; m < n_terms; ++m)
      of_row -= B[m] * part[m];
    algebra::store_three(r[a].data(), of_row);
  }
}

}  // namespace

CubicPart::CubicPart(const scheme::PairGraph& graph, const std::vector<double>& h)
    : dimension_(graph.dimension), n_terms_(algebra::n_monomials(graph.dimension, 3)) {
  Vec3 lower = graph.X[0], upper = graph.X[0];
  for (const Vec3& X : graph.X) {
    lower = lower.cwiseMin(X);
    upper = upper.cwiseMax(X);
  }
  const Vec3 middle = 0.5 * (lower + upper), size = 0.5 * (upper - lower);
  const auto n_rows = static_cast<std::int64_t>(graph.X.size()) * (1 + dimension_);
  basis_.resize(static_cast<size_t>(n_rows * n_terms_));
  Eigen::Map<RowMajor> B(basis_.data(), n_rows, n_terms_);
  for_each_node(graph.X.size(), [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t a = begin; a < end; ++a) {
      Vec3 X = Vec3::Zero();
      for (int i = 0; i < dimension_; ++i)
        X[i] = (graph.X[a][i] - middle[i]) / size[i];
      const std::int64_t row = a * (1 + dimension_);
      B.row(row) = algebra::monomials(X, dimension_, 3).transpose();
      const Matrix gradients = algebra::monomial_gradients(X, dimension_, 3);
      for (int i = 0; i < dimension_; ++i)
        B.row(row + 1 + i) = h[a] / (3 * size[i]) * gradients.col(i).transpose();
    }
  });
  // twice is enough for columns that are orthogonal to rounding; on few nodes some are dependent
  for (int round = 0; round < 2; ++round) {
    const Matrix gram = transposed_product(B, B);
    const Eigen::SelfAdjointEigenSolver<Matrix> solver(gram);
    const Eigen::VectorXd& eigenvalues = solver.eigenvalues();
    Eigen::VectorXd scale(n_terms_);
    for (int m = 0; m < n_terms_; ++m) {
      scale[m] =
          eigenvalues[m] > 1e-13 * eigenvalues[n_terms_ - 1] ? 1 / std::sqrt(eigenvalues[m]) : 0;
    }
    const Matrix turn = solver.eigenvectors() * scale.asDiagonal();
    for_pieces(n_rows, [&](std::int64_t, std::int64_t first, std::int64_t n) {
      const RowMajor piece = B.middleRows(first, n);
      B.middleRows(first, n) = piece.lazyProduct(turn);
    });
  }
}

void CubicPart::remove(Field& r) const {
  const auto n_rows = static_cast<std::int64_t>(r.size());
  algebra::AlignedArray<Projection> parts((n_rows + piece_size - 1) / piece_size);
  for_pieces(n_rows, [&](std::int64_t i, std::int64_t first, std::int64_t n) {
    project(basis_.data() + first * n_terms_, n_terms_, r.data() + first, n, parts[i].value);
  });
  for (std::int64_t i = 1; i < parts.size(); ++i) {
    for (int m = 0; m < n_terms_; ++m)
      parts[0].value[m] += parts[i].value[m];
  }
  for_pieces(n_rows, [&](std::int64_t, std::int64_t first, std::int64_t n) {
    subtract(basis_.data() + first * n_terms_, n_terms_, parts[0].value, n, r.data() + first);
  });
}

}  // namespace diptych::closure
