#include "sph/sph_graph.hpp"

#include "common/base/error.hpp"
#include "common/base/registry.hpp"
#include "common/closure/class_repair.hpp"
#include "common/closure/closure_repair.hpp"
#include "common/parallel/for_chunks.hpp"
#include "meshes/cell_shares.hpp"
#include "meshes/dual_measure.hpp"
#include "sph/kernel_correction.hpp"
#include "sph/neighbours.hpp"
#include "sph/sbp_graph.hpp"

#include <cmath>
#include <fmt/format.h>

namespace diptych::sph {

namespace {

constexpr double least_kappa = 0.5, greatest_kappa = 4;

enum class Gradient { corrected, sbp };

const base::Registry<Gradient>& gradients() {
  static const auto menu = base::Registry<Gradient>("gradient of sph")
                               .add("corrected", Gradient::corrected)
                               .add("sbp", Gradient::sbp);
  return menu;
}

/// h_a = kappa (Omega_a / part of the full angle that the body fills at a)^(1/d): a particle on the
/// boundary has the smoothing length of those inside.
std::vector<double> smoothing_lengths(const meshes::Mesh& mesh,
                                      const std::vector<double>& Omega,
                                      double kappa) {
  std::vector<double> h = meshes::filled_angle(mesh);
  for (size_t a = 0; a < h.size(); ++a) {
    h[a] = kappa * std::pow(Omega[a] / h[a], 1.0 / mesh.dimension);
  }
  return h;
}

/// Least change of the C_ab, weighted with the kernel: the stable step stays that of the kernel
/// without any repair. On lattices equal rows stay equal.
void repair_closure(const Kernel& kernel, const std::vector<double>& h, scheme::PairGraph& graph) {
  const auto weight = [&](std::int64_t a, std::int64_t p) {
    const std::int32_t b = graph.neighbour[p];
    const double r = (graph.X[b] - graph.X[a]).norm(), h_ab = 0.5 * (h[a] + h[b]);
    return graph.Omega[a] * graph.Omega[b] * kernel.value(r, h_ab, graph.dimension) / h_ab;
  };
  if (closure::repair_closure_by_classes(graph, weight)) return;
  std::vector<double> k(graph.neighbour.size());
  parallel::for_chunks(graph.n_nodes(), [&](std::int64_t begin, std::int64_t end, std::int64_t) {
    for (std::int64_t a = begin; a < end; ++a) {
      for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p)
        k[p] = weight(a, p);
    }
  });
  closure::repair_closure_pairs(graph, k);
}

}  // namespace

const std::vector<std::string>& gradient_names() {
  return gradients().names();
}

scheme::PairGraph build_graph(const meshes::Mesh& mesh, const Options& options) {
  const Kernel kernel = kernels().at(options.kernel);
  if (!(options.kappa >= least_kappa && options.kappa <= greatest_kappa)) {
    throw base::InputError(
        fmt::format("kappa = {:.6g} is out of range; use {} to {} (1.2 is usual)", options.kappa,
                    least_kappa, greatest_kappa));
  }
  if (gradients().at(options.gradient) == Gradient::sbp)
    return sbp_graph(mesh, kernel, options.kappa);
  meshes::DualMeasure measure = meshes::dual_measure(mesh, meshes::Quadrature::vertex);
  scheme::PairGraph graph;
  graph.dimension = mesh.dimension;
  graph.X = mesh.nodes;
  graph.Omega = std::move(measure.Omega);
  graph.boundary_area = std::move(measure.boundary_area);
  for (meshes::PatchArea& patch : measure.patches) {
    graph.patches.push_back({std::move(patch.name), std::move(patch.nodes), std::move(patch.area),
                             std::move(patch.faces)});
  }
  const std::vector<double> h = smoothing_lengths(mesh, graph.Omega, options.kappa);
  std::vector<double> radius(h);
  for (double& r : radius)
    r *= kernel.support;
  Rows rows = find_neighbours(graph.X, radius);
  graph.row = std::move(rows.row);
  graph.neighbour = std::move(rows.neighbour);
  link_reverse_pairs(graph);
  set_corrected_gradients(kernel, h, graph);
  if (options.closure) repair_closure(kernel, h, graph);
  if (meshes::areas_are_of_cells(mesh, meshes::Quadrature::vertex)) {
    auto cells = meshes::cell_shares(mesh, meshes::Quadrature::vertex);
    graph.cells = {std::move(cells.row), std::move(cells.corner), std::move(cells.share)};
  }
  validate(graph);
  return graph;
}

Operators operators_of(const meshes::Mesh& mesh, const Options& options) {
  if (gradients().at(options.gradient) != Gradient::sbp) return {};
  return {sbp_text(options.kappa), sbp_notices(mesh)};
}

}  // namespace diptych::sph
