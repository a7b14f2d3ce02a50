#include "common/run/largest_rates.hpp"

#include "common/parallel/for_chunks.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace diptych::run {

namespace {

using algebra::Vec3;
using scheme::PairGraph;
template <class T>
using Field = std::vector<T>;

constexpr int n_iterations = 16;

template <class Work>
void for_nodes(const PairGraph& graph, const Work& work) {
  parallel::for_chunks(graph.n_nodes(), [&](std::int64_t begin, std::int64_t end, std::int64_t) {
    for (std::int64_t a = begin; a < end; ++a)
      work(a);
  });
}

double dot(double u, double v) {
  return u * v;
}
double dot(const Vec3& u, const Vec3& v) {
  return u.dot(v);
}

template <class T>
double product(const PairGraph& graph, const Field<T>& u, const Field<T>& v) {
  std::vector<double> parts(parallel::n_chunks_of(graph.n_nodes()));
  parallel::for_chunks(graph.n_nodes(),
                       [&](std::int64_t begin, std::int64_t end, std::int64_t chunk) {
                         for (std::int64_t a = begin; a < end; ++a)
                           parts[chunk] += graph.Omega[a] * dot(u[a], v[a]);
                       });
  return parallel::sum_in_order(parts);
}

/// Numbers in [-1, 1), the same at every call.
class Noise {
 public:
  void fill(double& x) {
    state_ = state_ * 6364136223846793005U + 1442695040888963407U;
    x = static_cast<double>(state_ >> 11) * 0x1p-52 - 1;
  }
  void fill(Vec3& x) {
    for (int i = 0; i < 3; ++i)
      fill(x[i]);
  }

 private:
  std::uint64_t state_ = 1;
};

/// Largest eigenvalue of the symmetric tridiagonal matrix with this diagonal and the squares of
/// that beside it, by bisection on the signs of its Sturm sequence.
double largest_eigenvalue(const std::vector<double>& diagonal, const std::vector<double>& beside2) {
  double below = 0, above = 0;
  for (size_t i = 0; i < diagonal.size(); ++i) {
    const double left = i > 0 ? std::sqrt(beside2[i - 1]) : 0;
    const double right = i < beside2.size() ? std::sqrt(beside2[i]) : 0;
    above = std::max(above, diagonal[i] + left + right);
  }
  const auto passes_all = [&](double x) {
    double q = 1;
    for (size_t i = 0; i < diagonal.size(); ++i) {
      q = diagonal[i] - x - (i > 0 ? beside2[i - 1] / q : 0);
      if (q >= 0) return false;
    }
    return true;
  };
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (below + above);
    (passes_all(middle) ? above : below) = middle;
  }
  return above;
}

/// Largest eigenvalue of a symmetric, positive operator by the Lanczos recurrence.
template <class T>
double lanczos(const PairGraph& graph,
               const std::function<void(const Field<T>& in, Field<T>& out)>& apply) {
  Field<T> before(graph.n_nodes()), now(graph.n_nodes()), next(graph.n_nodes());
  Noise noise;
  for (T& x : now) {
    noise.fill(x);
  }
  std::vector<double> diagonal, beside2;
  const double first_length = std::sqrt(product(graph, now, now));
  double beta = 0;
  for_nodes(graph, [&](std::int64_t a) {
    now[a] /= first_length;
    before[a] = 0 * now[a];
  });
  while (true) {
    apply(now, next);
    diagonal.push_back(product(graph, now, next));
    for_nodes(graph,
              [&](std::int64_t a) { next[a] -= diagonal.back() * now[a] + beta * before[a]; });
    beta = std::sqrt(product(graph, next, next));
    // an invariant subspace: the rest is rounding
    if (diagonal.size() == n_iterations || !(beta > 1e-10 * diagonal.front())) break;
    beside2.push_back(beta * beta);
    for_nodes(graph, [&](std::int64_t a) {
      before[a] = now[a];
      now[a] = next[a] / beta;
    });
  }
  return largest_eigenvalue(diagonal, beside2);
}

/// g <- gradient of u.
void gradient(const PairGraph& graph, const Field<double>& u, Field<Vec3>& g) {
  for_nodes(graph, [&](std::int64_t a) {
    Vec3 sum = Vec3::Zero();
    for (std::int64_t k = graph.row[a]; k < graph.row[a + 1]; ++k)
      sum += (u[graph.neighbour[k]] - u[a]) * graph.C[k];
    g[a] = sum / (2 * graph.Omega[a]);
  });
}

/// f <- adjoint of the gradient, of p.
void adjoint(const PairGraph& graph, const Field<Vec3>& p, Field<double>& f) {
  for_nodes(graph, [&](std::int64_t a) {
    double sum = 0;
    for (std::int64_t k = graph.row[a]; k < graph.row[a + 1]; ++k)
      sum += p[graph.neighbour[k]].dot(graph.C[graph.reverse[k]]) - p[a].dot(graph.C[k]);
    f[a] = sum / (2 * graph.Omega[a]);
  });
}

/// corrected <- q + kappa_f/Omega_a sum_b [(q_a - q_b) X_ab] S_ab, or with X and S exchanged.
template <bool of_stress>
void correct(const PairGraph& graph, double kappa_f, const Field<Vec3>& q, Field<Vec3>& corrected) {
  for_nodes(graph, [&](std::int64_t a) {
    Vec3 sum = Vec3::Zero();
    for (std::int64_t k = graph.row[a]; k < graph.row[a + 1]; ++k) {
      const std::int32_t b = graph.neighbour[k];
      const Vec3 S = 0.5 * (graph.C[k] - graph.C[graph.reverse[k]]), X = graph.X[b] - graph.X[a];
      const Vec3 jump = q[a] - q[b];
      if constexpr (of_stress) {
        sum += jump.dot(S) * X;
      } else {
        sum += jump.dot(X) * S;
      }
    }
    corrected[a] = q[a] + kappa_f / graph.Omega[a] * sum;
  });
}

}  // namespace

double largest_dissipation(const PairGraph& graph, double shear_ratio) {
  return lanczos<Vec3>(graph, [&](const Field<Vec3>& v, Field<Vec3>& out) {
    for_nodes(graph, [&](std::int64_t a) {
      Vec3 sum = Vec3::Zero();
      for (std::int64_t k = graph.row[a]; k < graph.row[a + 1]; ++k) {
        const Vec3 S = graph.C[k] - graph.C[graph.reverse[k]];  // twice S_ab
        const double area = S.norm();
        if (area == 0) continue;
        const Vec3 jump = v[a] - v[graph.neighbour[k]];
        sum += area * shear_ratio * jump + (1 - shear_ratio) / area * S.dot(jump) * S;
      }
      out[a] = sum / (4 * graph.Omega[a]);
    });
  });
}

double largest_frequency(const PairGraph& graph, double kappa_f) {
  Field<Vec3> g(graph.n_nodes()), corrected(graph.n_nodes());
  return std::sqrt(lanczos<double>(graph, [&](const Field<double>& u, Field<double>& out) {
    gradient(graph, u, g);
    if (kappa_f != 0) {
      correct<false>(graph, kappa_f, g, corrected);
      correct<true>(graph, kappa_f, corrected, g);
    }
    adjoint(graph, g, out);
  }));
}

}  // namespace diptych::run
