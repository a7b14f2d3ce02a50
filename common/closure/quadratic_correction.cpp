#include "common/closure/quadratic_correction.hpp"

#include "common/closure/pair_correction.hpp"
#include "common/closure/quadratic_passes.hpp"

#include <Eigen/Dense>

#include <cmath>

namespace diptych::closure {

namespace {

/// Reciprocal condition number of a row's moments below which its neighbours do not span the
/// quadratics.
constexpr double least_condition = 1e-9;

using Matrix = Eigen::MatrixXd;  // of a size known at run time only: quicker to compile by minutes

/// Zero where the moments cannot be inverted.
Matrix inverse_of(const Matrix& moments) {
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(moments);
  const Eigen::VectorXd& eigenvalues = solver.eigenvalues();
  if (!(eigenvalues[0] > least_condition * eigenvalues[eigenvalues.size() - 1]))
    return Matrix::Zero(moments.rows(), moments.cols());
  return solver.eigenvectors() * eigenvalues.cwiseInverse().asDiagonal() *
         solver.eigenvectors().transpose();
}

template <class Square, class Terms>
Terms product(const Square& inverse, const Terms& q) {
  Terms sum = Terms::Zero();
  for (int m = 0; m < sum.size(); ++m)
    sum += q[m] * inverse.col(m);
  return sum;
}

}  // namespace

std::vector<double> spacings(const scheme::PairGraph& graph) {
  std::vector<double> h(graph.Omega.size());
  for (size_t a = 0; a < h.size(); ++a)
    h[a] = std::pow(graph.Omega[a], 1.0 / graph.dimension);
  return h;
}

template <int D>
auto QuadraticCorrection<D>::terms(const Vec3& X) -> Terms {
  Terms q;
  fill_terms<D>(X.data(), q.data());
  return q;
}

template <int D>
QuadraticCorrection<D>::QuadraticCorrection(const scheme::PairGraph& graph,
                                            const std::vector<double>& k)
    : graph_(graph),
      k_(k),
      h_(spacings(graph)),
      reach_(graph.X.size()),
      inverse_(graph.X.size()),
      first_moment_(graph.X.size()),
      blocks_(graph.X.size()),
      jumps_(graph.n_nodes()),
      fits_(graph.n_nodes()),
      closure_(graph.n_nodes()) {
  for_each_node(inverse_.size(), [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t a = begin; a < end; ++a) {
      Square moments = Square::Zero();
      double sum = 0, square = 0;
      for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p) {
        sum += k[p];
        square += k[p] * (graph.X[graph.neighbour[p]] - graph.X[a]).squaredNorm();
      }
      reach_[a] = std::sqrt(square / sum);
      for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p) {
        const Terms q = terms((graph.X[graph.neighbour[p]] - graph.X[a]) / reach_[a]);
        for (int m = 0; m < n_terms; ++m)
          moments.col(m) += k[p] * q[m] * q;
      }
      inverse_[a] = inverse_of(moments);
      first_moment_[a].setZero();
      for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p)
        first_moment_[a] += k[p] * terms(graph.X[graph.neighbour[p]] - graph.X[a]);
      for (int i = 0; i < D; ++i)
        jumps_[a].value[i][3] = fits_[a].value[i][3] = graph.X[a][i];
    }
  });
  for (std::int32_t a = 0; a < graph.n_nodes(); ++a) {
    if (inverse_[a].isZero(0)) undetermined_.push_back(a);
  }
  if (!undetermined_.empty()) return;
  set_blocks();
  set_smooth();
}

/// Preconditioners of what is smooth. Jumps t_ab of (s, grad s / 3) are a multiple of the monomials
/// of degree 4, those of (0, s e_i) X_i times those of degree 2; row a leaves of either what it
/// does not fit.
template <int D>
void QuadraticCorrection<D>::set_smooth() {
  using Fourth = SplineLevels<quartic>;
  using Second = SplineLevels<quadratic>;
  cubics_ = std::make_unique<Fourth>(graph_, [&](std::int64_t a, auto& left, auto& whole) {
    add_moments<Fourth>(
        fitted_row(a), a, [](const Vec3&) { return 1.0; }, left, whole);
  });
  cubics_->set_slopes(graph_, h_);
  cubics_->scale_to([this](const Field& y, Field& S_y) { apply_S(y, S_y); });
  gradients_ = std::make_unique<Second>(graph_, [&](std::int64_t a, auto& left, auto& whole) {
    const FittedRow row = fitted_row(a);
    for (int i = 0; i < D; ++i)
      add_moments<Second>(
          row, a, [i](const Vec3& X) { return X[i]; }, left, whole);
  });
  of_gradient_.resize(h_.size());
  sum_of_gradient_.resize(h_.size());
  Field all(h_.size() * n_conditions, Vec3::Zero()), S_all(all.size());
  // S does the same to each component of a vector: each of them stands for another direction
  gradients_->scale_to([&](const Field& y, Field& S_y) {
    for (size_t a = 0; a < h_.size(); ++a) {
      for (int c = 0; c < 3; ++c)
        all[a * n_conditions + 1 + c % D][c] = h_[a] * y[a][c];
    }
    apply_S(all, S_all);
    for (size_t a = 0; a < h_.size(); ++a) {
      for (int c = 0; c < 3; ++c)
        S_y[a][c] = h_[a] * S_all[a * n_conditions + 1 + c % D][c];
    }
  });
}

template <int D>
FittedRow QuadraticCorrection<D>::fitted_row(std::int64_t a) const {
  FittedRow row{k_.data() + graph_.row[a], {}, n_terms, inverse_[a].data()};
  row.q.resize(static_cast<size_t>(graph_.row[a + 1] - graph_.row[a]) * n_terms);
  double* q = row.q.data();
  for (std::int64_t p = graph_.row[a]; p < graph_.row[a + 1]; ++p, q += n_terms) {
    const Vec3 X = (graph_.X[graph_.neighbour[p]] - graph_.X[a]) / reach_[a];
    fill_terms<D>(X.data(), q);
  }
  return row;
}

/// Adds T_a of spline_levels.hpp with jumps factor(X) times its monomials.
template <int D>
template <class Levels, class Factor>
void QuadraticCorrection<D>::add_moments(const FittedRow& row,
                                         std::int64_t a,
                                         const Factor& factor,
                                         typename Levels::Moments& left,
                                         typename Levels::Terms& whole) const {
  constexpr int N = Levels::n_terms <= 8 ? 8 : 16;
  const std::int64_t first = graph_.row[a], n = graph_.row[a + 1] - first;
  std::vector<double> m(static_cast<size_t>(n * N));
  for (std::int64_t p = 0; p < n; ++p) {
    const Vec3 X = graph_.X[graph_.neighbour[first + p]] - graph_.X[a];
    Levels::Terms::Map(m.data() + p * N) = factor(X) * Levels::monomials(X);
  }
  Eigen::Matrix<double, N, N> of_row;  // lower part, column by column
  double sums[N];
  fitted_moments<N>(row, m, of_row.data(), sums);
  whole += Levels::Terms::Map(sums);
  const Eigen::Matrix<double, N, N> all = of_row.template selfadjointView<Eigen::Lower>();
  left += all.template topLeftCorner<Levels::n_terms, Levels::n_terms>();
}

/// Of S, from what a multiplier of node a does to its own row and, one pair each, to those of its
/// neighbours.
template <int D>
void QuadraticCorrection<D>::set_blocks() {
  for_each_node(blocks_.size(), [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t a = begin; a < end; ++a) {
      Block block = Block::Zero();
      Terms moment = Terms::Zero();
      for (std::int64_t p = graph_.row[a]; p < graph_.row[a + 1]; ++p) {
        const std::int32_t b = graph_.neighbour[p];
        const Vec3 X = graph_.X[b] - graph_.X[a];
        moment += 0.5 * k_[p] * terms(X / reach_[a]);
        block(0, 0) += 0.25 * k_[p];
        Eigen::Matrix<double, n_conditions, 1> of_neighbour;
        of_neighbour[0] = -0.5;
        of_neighbour.template tail<D>() = -0.5 / h_[a] * X.head<D>();
        const Terms q = terms(-X / reach_[b]);
        const double left = k_[p] * (1 - k_[p] * q.dot(product(inverse_[b], q)));
        for (int i = 0; i < n_conditions; ++i)
          block.col(i) += left * of_neighbour[i] * of_neighbour;
      }
      block(0, 0) -= moment.dot(product(inverse_[a], moment));
      blocks_[a] = Matrix(block).completeOrthogonalDecomposition().pseudoInverse();
    }
  });
}

template <int D>
void QuadraticCorrection<D>::correct_rows(std::vector<Vec3>& C) const {
  for_each_node(h_.size(), [&](std::int64_t begin, std::int64_t end) {
    closure::correct_rows(rows(), jumps_.data(), graph_.Omega.data(), C.data(), begin, end);
  });
}

template <int D>
Field QuadraticCorrection<D>::gap(const std::vector<Vec3>& C) const {
  Field gap(h_.size() * n_conditions);
  for_each_node(h_.size(), [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t a = begin; a < end; ++a) {
      Vec3* r = &gap[static_cast<size_t>(a) * n_conditions];
      r[0] = -graph_.boundary_area[a];
      for (int i = 0; i < D; ++i)
        r[1 + i] = graph_.Omega[a] / h_[a] * Vec3::Unit(i);
      for (std::int64_t p = graph_.row[a]; p < graph_.row[a + 1]; ++p) {
        const Vec3 X = (graph_.X[graph_.neighbour[p]] - graph_.X[a]) / h_[a];
        const Vec3& back = C[graph_.reverse(p)];
        r[0] -= 0.5 * (C[p] - back);
        for (int i = 0; i < D; ++i)
          r[1 + i] += 0.5 * X[i] * back;
      }
    }
  });
  return gap;
}

template <int D>
auto QuadraticCorrection<D>::rows() const -> QuadraticRows<QuadraticCorrection> {
  return {graph_.row.data(), graph_.neighbour.data(), k_.data(), inverse_.data(),
          reach_.data(),     first_moment_.data(),    h_.data()};
}

template <int D>
void QuadraticCorrection<D>::fit(const Field& y) {
  for_each_node(h_.size(), [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t a = begin; a < end; ++a) {
      const Vec3* of_node = &y[static_cast<size_t>(a) * n_conditions];
      store_three(jumps_[a].value[0], 0.5 * load_three(of_node[0]));
      for (int i = 0; i < D; ++i)
        store_three(jumps_[a].value[1 + i], 0.5 / h_[a] * load_three(of_node[1 + i]));
    }
  });
  for_each_node(h_.size(), [&](std::int64_t begin, std::int64_t end) {
    fit_rows(rows(), jumps_.data(), fits_.data(), closure_.data(), begin, end);
  });
}

template <int D>
void QuadraticCorrection<D>::apply_S(const Field& y, Field& S_y) {
  fit(y);
  for_each_node(h_.size(), [&](std::int64_t begin, std::int64_t end) {
    apply_rows(rows(), jumps_.data(), fits_.data(), closure_.data(), S_y.data(), begin, end);
  });
}

template <int D>
void QuadraticCorrection<D>::precondition(const Field& r, Field& z) {
  for_each_node(h_.size(), [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t a = begin; a < end; ++a) {
      using Conditions = Eigen::Matrix<double, 3, n_conditions>;
      const size_t first = static_cast<size_t>(a) * n_conditions;
      Eigen::Map<Conditions>(z[first].data()) =
          Eigen::Map<const Conditions>(r[first].data()) * blocks_[a];
    }
  });
  cubics_->add(r, z);
  for (int i = 0; i < D; ++i) {
    for_each_node(h_.size(), [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t a = begin; a < end; ++a) {
        of_gradient_[a] = h_[a] * r[a * n_conditions + 1 + i];
        sum_of_gradient_[a].setZero();
      }
    });
    gradients_->add(of_gradient_, sum_of_gradient_);
    for_each_node(h_.size(), [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t a = begin; a < end; ++a)
        z[a * n_conditions + 1 + i] += h_[a] * sum_of_gradient_[a];
    });
  }
}

template <int D>
void QuadraticCorrection<D>::change(const Field& y, std::vector<Vec3>& C) {
  fit(y);
  for_each_node(h_.size(), [&](std::int64_t begin, std::int64_t end) {
    change_rows(rows(), jumps_.data(), fits_.data(), C.data(), begin, end);
  });
}

template class QuadraticCorrection<2>;
template class QuadraticCorrection<3>;

}  // namespace diptych::closure
