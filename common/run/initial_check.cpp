#include "common/run/initial_check.hpp"

#include "common/base/error.hpp"
#include "common/functions/placed_values.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <vector>

namespace diptych::run {

using algebra::Mat3;
using algebra::Vec3;

namespace {

constexpr std::int64_t most_places = 50'000;
constexpr double tolerance = 1e-3;  ///< of the largest F - I
constexpr double share = 1e-3;      ///< of the distance of nodes: step of a difference quotient
constexpr double rounding = 1e-14;  ///< of places and displacements

/// Where F and u are compared.
struct Places {
  std::vector<Vec3> X;       ///< m
  std::vector<double> step;  ///< m
};

Places places_of(const scheme::PairGraph& graph) {
  Places places;
  const std::int64_t n = graph.n_nodes(), stride = (n + most_places - 1) / most_places;
  for (std::int64_t a = 0; a < n; a += stride) {
    Vec3 sum = graph.X[a];
    double least = std::numeric_limits<double>::infinity();
    for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p) {
      const Vec3& X_b = graph.X[graph.neighbour[p]];
      sum += X_b;
      least = std::min(least, (X_b - graph.X[a]).norm());
    }
    const std::int64_t n_around = graph.row[a + 1] - graph.row[a];
    if (n_around == 0) continue;
    places.X.push_back(sum / static_cast<double>(n_around + 1));
    places.step.push_back(share * least);
  }
  return places;
}

std::vector<Vec3> displacements_beside(const functions::VectorExpression& u,
                                       const Places& places,
                                       int direction,
                                       double sign) {
  std::vector<Vec3> X = places.X;
  for (size_t k = 0; k < X.size(); ++k)
    X[k][direction] += sign * places.step[k];
  return functions::vectors_at(u, X, 0);
}

std::string text_of(const Vec3& v, int dimension) {
  return dimension == 2 ? fmt::format("({:.6g}, {:.6g})", v[0], v[1])
                        : fmt::format("({:.6g}, {:.6g}, {:.6g})", v[0], v[1], v[2]);
}

}  // namespace

void check_initial_deformation(const cases::Case& setup, const scheme::PairGraph& graph) {
  const cases::InitialCase& initial = setup.initial;
  if (!initial.deformation_gradient) return;
  const int dimension = graph.dimension;
  const Places places = places_of(graph);
  const std::vector<Mat3> F = functions::tensors_at(*initial.deformation_gradient, places.X, 0);
  const std::vector<Vec3> u = functions::vectors_at(initial.displacement, places.X, 0);
  double largest = 0;
  for (const Mat3& of_place : F)
    largest = std::max(largest, (of_place - Mat3::Identity()).norm());
  for (int j = 0; j < dimension; ++j) {
    const auto ahead = displacements_beside(initial.displacement, places, j, 1);
    const auto behind = displacements_beside(initial.displacement, places, j, -1);
    for (size_t k = 0; k < places.X.size(); ++k) {
      const double step = places.step[k], size = places.X[k].norm() + u[k].norm();
      const double most = tolerance * largest + rounding * size / step;
      const Vec3 given = F[k].col(j), central = Vec3::Unit(j) + (ahead[k] - behind[k]) / (2 * step);
      const auto agrees = [&](const Vec3& column) { return (given - column).norm() <= most; };
      if (agrees(central) || agrees(Vec3::Unit(j) + (ahead[k] - u[k]) / step) ||
          agrees(Vec3::Unit(j) + (u[k] - behind[k]) / step))
        continue;
      throw base::InputError(fmt::format(
          "{}: initial.deformation_gradient is not that of initial.displacement{}: at {} m its "
          "column {} is {}, while X + displacement has the derivative {} along {}; correct one of "
          "the two, or leave deformation_gradient out (F is then the discrete gradient of the "
          "displacement)",
          setup.file, initial.displacement.is_zero() ? ", which is 0" : "",
          text_of(places.X[k], dimension), j + 1, text_of(given, dimension),
          text_of(central, dimension), "xyz"[j]));
    }
  }
}

}  // namespace diptych::run
