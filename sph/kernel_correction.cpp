#include "sph/kernel_correction.hpp"

#include "common/base/error.hpp"
#include "common/parallel/for_chunks.hpp"

#include <fmt/format.h>

namespace diptych::sph {

using algebra::Mat3;
using algebra::Vec3;

namespace {

/// Least eigenvalue of the neighbours' directions (mean of e (x) e, trace 1) that counts as a
/// direction; a lattice has 1/3, neighbours in a plane have 0.
constexpr double least_spread = 1e-6;

[[noreturn]] void refuse(const scheme::PairGraph& graph, std::int64_t a, const std::string& what) {
  const Vec3& X = graph.X[a];
  throw base::InputError(fmt::format(
      "particle {} at ({:.6g}, {:.6g}, {:.6g}) has {}; a corrected gradient needs at least {} that "
      "do not lie in a {}: raise sph.kappa (to 4 at most; triangles and tetrahedra want 0.8 or "
      "more), "
      "or, where cells are of different shapes, give them about equal sides, as supports go by "
      "their "
      "volume; finite volumes take flat cells",
      a, X[0], X[1], X[2], what, graph.dimension + 1, graph.dimension == 3 ? "plane" : "line"));
}

void check_neighbours(const scheme::PairGraph& graph, std::int64_t a) {
  const int d = graph.dimension;
  const std::int64_t begin = graph.row[a], end = graph.row[a + 1];
  if (end - begin <= d) refuse(graph, a, fmt::format("{} neighbours", end - begin));
  Mat3 spread = Mat3::Zero();
  for (std::int64_t p = begin; p < end; ++p) {
    const Vec3 X_ab = graph.X[graph.neighbour[p]] - graph.X[a];
    const double square = X_ab.squaredNorm();
    if (square == 0) {
      refuse(graph, a, fmt::format("particle {} at the same place", graph.neighbour[p]));
    }
    spread += X_ab / square * X_ab.transpose();
  }
  spread /= static_cast<double>(end - begin);
  if (d == 2) spread(2, 2) = 1;
  // the other two eigenvalues are below 1, so none is less than the determinant
  if (spread.determinant() >= least_spread) return;
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(spread, Eigen::EigenvaluesOnly);
  if (solver.eigenvalues()[0] < least_spread) {
    refuse(graph, a,
           fmt::format("{} neighbours in one {}", end - begin, d == 3 ? "plane" : "line"));
  }
}

template <class Work>
void for_particles(const scheme::PairGraph& graph, const Work& work) {
  parallel::for_chunks(graph.n_nodes(), [&](std::int64_t begin, std::int64_t end, std::int64_t) {
    for (std::int64_t a = begin; a < end; ++a)
      work(a);
  });
}

}  // namespace

void set_corrected_gradients(const Kernel& kernel,
                             const std::vector<double>& h,
                             scheme::PairGraph& graph) {
  const int d = graph.dimension;
  // before the parallel loop: the first particle that is refused is the one that is named
  for (std::int64_t a = 0; a < graph.n_nodes(); ++a)
    check_neighbours(graph, a);
  std::vector<Vec3> C(graph.neighbour.size());
  for_particles(graph, [&](std::int64_t a) {
    Mat3 moment = Mat3::Zero();
    for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p) {
      const std::int32_t b = graph.neighbour[p];
      const Vec3 X_ab = graph.X[b] - graph.X[a];
      const double r = X_ab.norm();
      C[p] = -(graph.Omega[b] * kernel.slope(r, 0.5 * (h[a] + h[b]), d) / r) * X_ab;
      moment += X_ab * C[p].transpose();
    }
    if (d == 2) moment(2, 2) = moment.trace();
    const Mat3 K = moment.inverse().transpose();
    for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p) {
      C[p] = 2 * graph.Omega[a] * (K * C[p]);
    }
  });
  graph.C = algebra::SharedVectors(std::move(C));
}

}  // namespace diptych::sph
