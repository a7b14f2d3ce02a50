#pragma once
/// The largest eigenvalue of operators on nodal fields that are symmetric and positive in the inner
/// product with the weights Omega_a, by the Lanczos recurrence. Test:
/// tests/common/run/default_cfl_test.cpp

#include "common/algebra/field.hpp"
#include "common/algebra/four.hpp"
#include "common/parallel/for_chunks.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace diptych::run::lanczos {

using algebra::Four;
using algebra::sum_three;
template <class T>
using Field = algebra::AlignedArray<T>;

inline constexpr int n_iterations = 16;

/// work(a) for all nodes, in parallel.
template <class Work>
void for_nodes(std::int64_t n_nodes, const Work& work) {
  parallel::for_chunks(n_nodes, [&](std::int64_t begin, std::int64_t end, std::int64_t) {
    for (std::int64_t a = begin; a < end; ++a)
      work(a);
  });
}

inline double dot(double u, double v) {
  return u * v;
}
inline double dot(const Four& u, const Four& v) {
  return sum_three(u * v);
}

template <class T>
double product(const Field<double>& Omega,
               std::int64_t n_nodes,
               const Field<T>& u,
               const Field<T>& v) {
  std::vector<double> parts(parallel::n_chunks_of(n_nodes));
  parallel::for_chunks(n_nodes, [&](std::int64_t begin, std::int64_t end, std::int64_t chunk) {
    for (std::int64_t a = begin; a < end; ++a)
      parts[chunk] += Omega[a] * dot(u[a], v[a]);
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
  void fill(Four& x) {
    for (int i = 0; i < 3; ++i) {
      double value = 0;
      fill(value);
      x[i] = value;
    }
  }

 private:
  std::uint64_t state_ = 1;
};

/// Largest eigenvalue of the symmetric tridiagonal matrix with this diagonal and the squares of
/// that beside it, by bisection on the signs of its Sturm sequence.
inline double largest_tridiagonal(const std::vector<double>& diagonal,
                                  const std::vector<double>& beside2) {
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
/// @param Omega  [n_nodes] or more: weights of the inner product
template <class T>
double largest_eigenvalue(const Field<double>& Omega,
                          std::int64_t n_nodes,
                          const std::function<void(const Field<T>& in, Field<T>& out)>& apply) {
  Field<T> before(n_nodes), now(n_nodes), next(n_nodes);
  Noise noise;
  for (std::int64_t a = 0; a < n_nodes; ++a)
    noise.fill(now[a]);
  std::vector<double> diagonal, beside2;
  const double first_length = std::sqrt(product(Omega, n_nodes, now, now));
  double beta = 0;
  for_nodes(n_nodes, [&](std::int64_t a) {
    now[a] /= first_length;
    before[a] = 0 * now[a];
  });
  while (true) {
    apply(now, next);
    diagonal.push_back(product(Omega, n_nodes, now, next));
    for_nodes(n_nodes,
              [&](std::int64_t a) { next[a] -= diagonal.back() * now[a] + beta * before[a]; });
    beta = std::sqrt(product(Omega, n_nodes, next, next));
    // an invariant subspace: the rest is rounding
    if (diagonal.size() == n_iterations || !(beta > 1e-10 * diagonal.front())) break;
    beside2.push_back(beta * beta);
    for_nodes(n_nodes, [&](std::int64_t a) {
      before[a] = now[a];
      now[a] = next[a] / beta;
    });
  }
  return largest_tridiagonal(diagonal, beside2);
}

}  // namespace diptych::run::lanczos
