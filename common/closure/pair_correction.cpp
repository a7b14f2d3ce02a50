#include "common/closure/pair_correction.hpp"

#include "common/algebra/four.hpp"

namespace diptych::closure {

namespace {

using algebra::Four;
using algebra::load_four;
using algebra::load_three;
using algebra::store_three;
using Record = PairCorrection::Record;

/// What the passes stream.
struct Rows {
  const std::int64_t* row;
  const std::int32_t* neighbour;
  const double* k;
  const Mat3* inverse;
};

/// grad lambda of nodes [begin, end): the k-weighted linear fit over each row.
DIPTYCH_CLONES void fit_rows(const Rows& rows,
                             Record* nodes,
                             std::int64_t begin,
                             std::int64_t end) {
  for (std::int64_t a = begin; a < end; ++a) {
    Record& node = nodes[a];
    const Four lambda = load_four(node.value[0]);
    const double X = node.value[0][3], Y = node.value[1][3], Z = node.value[2][3];
    Four m[3]{};
    for (std::int64_t p = rows.row[a]; p < rows.row[a + 1]; ++p) {
      const Record& b = nodes[rows.neighbour[p]];
      const Four jump = rows.k[p] * (load_four(b.value[0]) - lambda);
      m[0] += jump * (b.value[0][3] - X);
      m[1] += jump * (b.value[1][3] - Y);
      m[2] += jump * (b.value[2][3] - Z);
    }
    const double* inverse = rows.inverse[a].data();  // symmetric
    for (int j = 0; j < 3; ++j) {
      const double* column = inverse + 3 * j;
      store_three(node.value[1 + j], m[0] * column[0] + m[1] * column[1] + m[2] * column[2]);
    }
  }
}

DIPTYCH_CLONES void apply_rows(
    const Rows& rows, const Record* nodes, Vec3* out, std::int64_t begin, std::int64_t end) {
  for (std::int64_t a = begin; a < end; ++a) {
    const Record& node = nodes[a];
    const Four lambda = load_four(node.value[0]);
    const Four slope[3]{load_four(node.value[1]), load_four(node.value[2]),
                        load_four(node.value[3])};
    const double X = node.value[0][3], Y = node.value[1][3], Z = node.value[2][3];
    Four sum{};
    for (std::int64_t p = rows.row[a]; p < rows.row[a + 1]; ++p) {
      const Record& b = nodes[rows.neighbour[p]];
      const Four jump = 2 * (load_four(b.value[0]) - lambda);
      const Four linear = (slope[0] + load_four(b.value[1])) * (b.value[0][3] - X) +
                          (slope[1] + load_four(b.value[2])) * (b.value[1][3] - Y) +
                          (slope[2] + load_four(b.value[3])) * (b.value[2][3] - Z);
      sum += rows.k[p] * (jump - linear);
    }
    store_three(out[a].data(), -0.25 * sum);
  }
}

/// How far a quadratic is from linear on a row (spline_levels.hpp).
void row_moments(const scheme::PairGraph& graph,
                 const std::vector<double>& k,
                 const Mat3& inverse,
                 std::int64_t a,
                 SplineLevels<quadratic>::Moments& left,
                 SplineLevels<quadratic>::Terms& whole) {
  using Levels = SplineLevels<quadratic>;
  Eigen::Matrix<double, 3, Levels::n_terms> mixed =
      Eigen::Matrix<double, 3, Levels::n_terms>::Zero();
  for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p) {
    const Vec3 X = graph.X[graph.neighbour[p]] - graph.X[a];
    const Levels::Terms m = Levels::monomials(X);
    left += (0.25 * k[p]) * m * m.transpose();
    mixed += (0.5 * k[p]) * X * m.transpose();
  }
  whole += left.diagonal();
  left -= mixed.transpose() * inverse * mixed;
}

}  // namespace

std::vector<Mat3> inverse_second_moments(const scheme::PairGraph& graph,
                                         const std::vector<double>& k) {
  std::vector<Mat3> inverse(graph.X.size());
  for_each_node(inverse.size(), [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t a = begin; a < end; ++a) {
      Mat3 M = Mat3::Zero();
      for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p) {
        const Vec3 X_ab = graph.X[graph.neighbour[p]] - graph.X[a];
        M += k[p] * X_ab * X_ab.transpose();
      }
      if (graph.dimension == 2) M(2, 2) = M.trace();
      inverse[a] = M.inverse();
    }
  });
  return inverse;
}

Vec3 first_moment(const scheme::PairGraph& graph, const std::vector<double>& k, std::int64_t a) {
  Vec3 m = Vec3::Zero();
  for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p) {
    m += k[p] * (graph.X[graph.neighbour[p]] - graph.X[a]);
  }
  return m;
}

PairCorrection::PairCorrection(const scheme::PairGraph& graph, const std::vector<double>& k)
    : graph_(graph),
      k_(k),
      inverse_(inverse_second_moments(graph, k)),
      diagonal_(graph.X.size(), 0.0),
      records_(graph.n_nodes()),
      smooth_(graph, [&](std::int64_t a, auto& left, auto& whole) {
        row_moments(graph, k, inverse_[a], a, left, whole);
      }) {
  for_each_node(diagonal_.size(), [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t a = begin; a < end; ++a) {
      const Vec3 m = inverse_[a] * first_moment(graph, k, a);
      for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p) {
        const Vec3 X_ab = graph.X[graph.neighbour[p]] - graph.X[a];
        const double fitted = k[p] * X_ab.dot(inverse_[graph.neighbour[p]] * X_ab);
        diagonal_[a] += 0.25 * k[p] * (2 - X_ab.dot(m) - fitted);
      }
      for (int i = 0; i < 3; ++i)
        records_[a].value[i][3] = graph.X[a][i];
    }
  });
}

void PairCorrection::fit(const Field& lambda) {
  for_each_node(lambda.size(), [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t a = begin; a < end; ++a)
      store_three(records_[a].value[0], load_three(lambda[a]));
  });
  const Rows rows{graph_.row.data(), graph_.neighbour.data(), k_.data(), inverse_.data()};
  for_each_node(lambda.size(), [&](std::int64_t begin, std::int64_t end) {
    fit_rows(rows, records_.data(), begin, end);
  });
}

void PairCorrection::apply_S(const Field& lambda, Field& S_lambda) {
  fit(lambda);
  const Rows rows{graph_.row.data(), graph_.neighbour.data(), k_.data(), inverse_.data()};
  for_each_node(lambda.size(), [&](std::int64_t begin, std::int64_t end) {
    apply_rows(rows, records_.data(), S_lambda.data(), begin, end);
  });
}

void PairCorrection::precondition(const Field& r, Field& z) {
  for_each_node(r.size(), [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t a = begin; a < end; ++a)
      z[a] = diagonal_[a] > 0 ? Vec3(r[a] / diagonal_[a]) : Vec3(Vec3::Zero());
  });
  smooth_.add(r, z);
}

void PairCorrection::change(const Field& lambda, std::vector<Vec3>& C) {
  fit(lambda);
  const std::vector<Vec3>& X = graph_.X;
  for_each_node(lambda.size(), [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t a = begin; a < end; ++a) {
      Mat3 slope;
      for (int j = 0; j < 3; ++j)
        slope.col(j) = Vec3::Map(records_[a].value[1 + j]);
      for (std::int64_t p = graph_.row[a]; p < graph_.row[a + 1]; ++p) {
        const std::int32_t b = graph_.neighbour[p];
        C[p] += 0.5 * k_[p] * (lambda[b] - lambda[a] - slope * (X[b] - X[a]));
      }
    }
  });
}

}  // namespace diptych::closure
