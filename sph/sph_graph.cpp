#include "sph/sph_graph.hpp"

#include "common/base/error.hpp"
#include "common/base/registry.hpp"
#include "common/closure/class_repair.hpp"
#include "common/closure/closure_repair.hpp"
#include "common/closure/summation_by_parts.hpp"
#include "common/parallel/for_chunks.hpp"
#include "common/scheme/graph/equal_widths.hpp"
#include "common/scheme/graph/mesh_edges.hpp"
#include "meshes/cell_shares.hpp"
#include "meshes/dual_measure.hpp"
#include "meshes/quadratic_measure.hpp"
#include "meshes/structured_block.hpp"
#include "sph/gaps.hpp"
#include "sph/kernel_correction.hpp"
#include "sph/neighbours.hpp"
#include "sph/reach.hpp"
#include "sph/sbp_graph.hpp"

#include <cmath>
#include <fmt/format.h>

namespace diptych::sph {

namespace {

constexpr double least_kappa = 0.5, greatest_kappa = 4;

enum class Gradient { automatic, corrected, sbp };

const base::Registry<Gradient>& gradients() {
  static const auto menu = base::Registry<Gradient>("gradient of sph")
                               .add("auto", Gradient::automatic)
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

void set_measure(meshes::DualMeasure measure, scheme::PairGraph& graph) {
  graph.Omega = std::move(measure.Omega);
  graph.boundary_area = std::move(measure.boundary_area);
  graph.patches.clear();
  for (meshes::PatchArea& patch : measure.patches) {
    graph.patches.push_back({std::move(patch.name), std::move(patch.nodes), std::move(patch.area),
                             std::move(patch.faces)});
  }
}

/// Of a change of C_ab: with the kernel the stable step stays nearly that without any repair.
double weight_of(const Kernel& kernel,
                 const std::vector<double>& h,
                 const scheme::PairGraph& graph,
                 std::int64_t a,
                 std::int64_t p) {
  const std::int32_t b = graph.neighbour[p];
  const double r = (graph.X[b] - graph.X[a]).norm(), h_ab = 0.5 * (h[a] + h[b]);
  return graph.Omega[a] * graph.Omega[b] * kernel.value(r, h_ab, graph.dimension) / h_ab;
}

/// [n_pairs]
std::vector<double> weights_of(const Kernel& kernel,
                               const std::vector<double>& h,
                               const scheme::PairGraph& graph) {
  std::vector<double> k(graph.neighbour.size());
  parallel::for_chunks(graph.n_nodes(), [&](std::int64_t begin, std::int64_t end, std::int64_t) {
    for (std::int64_t a = begin; a < end; ++a) {
      for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p)
        k[p] = weight_of(kernel, h, graph, a, p);
    }
  });
  return k;
}

/// Of a change to sum by parts: the root of the kernel, beside its value at the node. With the
/// kernel itself far neighbours hardly take part, which halves the stable step and takes half as
/// many iterations again, for errors within a third of each other (notes 4.5).  [n_pairs]
std::vector<double> wide_weights_of(const Kernel& kernel,
                                    const std::vector<double>& h,
                                    const scheme::PairGraph& graph) {
  std::vector<double> k(graph.neighbour.size());
  parallel::for_chunks(graph.n_nodes(), [&](std::int64_t begin, std::int64_t end, std::int64_t) {
    for (std::int64_t a = begin; a < end; ++a) {
      for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p) {
        const std::int32_t b = graph.neighbour[p];
        const double r = (graph.X[b] - graph.X[a]).norm(), h_ab = 0.5 * (h[a] + h[b]);
        const double part =
            kernel.value(r, h_ab, graph.dimension) / kernel.value(0, h_ab, graph.dimension);
        k[p] = graph.Omega[a] * graph.Omega[b] * std::sqrt(part) / h_ab;
      }
    }
  });
  return k;
}

/// Least change of the C_ab. On lattices equal rows stay equal.
void repair_closure(const Kernel& kernel, const std::vector<double>& h, scheme::PairGraph& graph) {
  const auto weight = [&](std::int64_t a, std::int64_t p) {
    return weight_of(kernel, h, graph, a, p);
  };
  if (closure::repair_closure_by_classes(graph, weight)) return;
  closure::repair_closure_pairs(graph, weights_of(kernel, h, graph));
}

/// Pairs with smoothing lengths h, whose rows are exact for linear fields.
scheme::PairGraph graph_within(const meshes::Mesh& mesh,
                               const Kernel& kernel,
                               meshes::DualMeasure measure,
                               const std::vector<double>& h) {
  scheme::PairGraph graph;
  graph.dimension = mesh.dimension;
  graph.X = mesh.nodes;
  set_measure(std::move(measure), graph);
  std::vector<double> radius(h);
  for (double& r : radius)
    r *= kernel.support;
  Rows rows = find_neighbours(graph.X, radius);
  if (!meshes::is_undistorted_block(mesh)) drop_pairs_across_gaps(mesh, rows);
  graph.row = std::move(rows.row);
  graph.neighbour = std::move(rows.neighbour);
  link_reverse_pairs(graph);
  set_corrected_gradients(kernel, h, graph);
  return graph;
}

/// Supports of `rows` and of what is around them by a tenth. Of rows and their neighbours alone,
/// rows beside them become stiff: steps on frusta of hexahedra were a fourth of what they are.
void widen(const std::vector<std::int32_t>& rows,
           const scheme::PairGraph& graph,
           std::vector<double>& h) {
  constexpr int n_rings = 2;
  std::vector<char> is_wider(h.size(), 0);
  for (const std::int32_t a : rows)
    is_wider[a] = 1;
  for (int ring = 0; ring < n_rings; ++ring) {
    const std::vector<char> inner = is_wider;
    for (size_t a = 0; a < h.size(); ++a) {
      if (inner[a] == 0) continue;
      for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p)
        is_wider[graph.neighbour[p]] = 1;
    }
  }
  for (size_t a = 0; a < h.size(); ++a) {
    if (is_wider[a] != 0) h[a] *= 1.1;
  }
}

/// Of second order: areas must be those of cells, whose pressure acts on them.
meshes::Quadrature quadrature_of(const meshes::Mesh& mesh) {
  return meshes::areas_are_of_cells(mesh, meshes::Quadrature::vertex) ? meshes::Quadrature::vertex
                                                                      : meshes::Quadrature::exact;
}

/// Of a support over the distance of nodes, kappa 1.2: less is no matter of the cells.
constexpr double usual_radius = 2.4;

/// A graph, and how much of the cells its supports hardly see.
struct ReachingGraph {
  scheme::PairGraph graph;
  double far_edges = 0;  ///< share of the edges
};

/// By round supports, wider where operators that sum by parts take it.
ReachingGraph round_graph_of(const meshes::Mesh& mesh, const Options& options, bool sums_by_parts) {
  constexpr int most_times = 6;
  const Kernel kernel = kernels().at(options.kernel);
  const meshes::DualMeasure by_vertices = meshes::dual_measure(mesh, meshes::Quadrature::vertex);
  std::vector<double> h = smoothing_lengths(mesh, by_vertices.Omega, options.kappa);
  std::vector<double> radius(h);
  for (double& r : radius)
    r *= std::max(usual_radius / options.kappa, kernel.support);
  const double far_edges = share_of_far_edges(mesh, radius);
  scheme::PairGraph graph;
  if (sums_by_parts) {
    const meshes::DualMeasure by_quadratics = meshes::quadratic_measure(mesh);
    graph = closure::summing_by_parts(
        by_vertices.Omega, most_times,
        [&] {
          scheme::PairGraph pairs = graph_within(mesh, kernel, by_quadratics, h);
          std::vector<double> k = wide_weights_of(kernel, h, pairs);
          return closure::WeightedGraph{std::move(pairs), std::move(k)};
        },
        [&](const auto& rows, const scheme::PairGraph& pairs) { widen(rows, pairs, h); });
    scheme::set_edges(mesh, graph);
  } else {
    const meshes::Quadrature quadrature = quadrature_of(mesh);
    graph = graph_within(mesh, kernel, meshes::dual_measure(mesh, quadrature), h);
    if (options.closure) repair_closure(kernel, h, graph);
    auto cells = meshes::cell_shares(mesh, quadrature);
    graph.cells = {std::move(cells.row), std::move(cells.corner), std::move(cells.share)};
  }
  validate(graph);
  require_joined(mesh, graph);
  return {std::move(graph), far_edges};
}

/// On any nodes; supports are ellipsoids where cells are long.
ReachingGraph graph_of(const meshes::Mesh& mesh, const Options& options, bool sums_by_parts) {
  double far_edges = 0;
  scheme::PairGraph graph = scheme::on_equal_widths(mesh, [&](const meshes::Mesh& equal_widths) {
    ReachingGraph of_these = round_graph_of(equal_widths, options, sums_by_parts);
    far_edges = of_these.far_edges;
    return std::move(of_these.graph);
  });
  if (!sums_by_parts && scheme::has_long_cells(mesh))  // to the bits of finite volumes
    set_measure(meshes::dual_measure(mesh, quadrature_of(mesh)), graph);
  return {std::move(graph), far_edges};
}

std::vector<std::string> notices_of(const ReachingGraph& made) {
  constexpr double many = 0.1;
  if (made.far_edges <= many) return {};
  return {fmt::format(
      "{:.2g} of the edges of cells are spanned by no more than the tail of the kernel: cells are "
      "long in directions that turn over the body, and SPH errs by several percent across them; "
      "make them about as wide as long, or raise sph.kappa",
      made.far_edges)};
}

scheme::Operators sbp_on(const meshes::Mesh& mesh, const Options& options) {
  if (meshes::is_undistorted_block(mesh)) {
    return {sbp_graph(mesh, kernels().at(options.kernel), options.kappa), sbp_text(options.kappa),
            sbp_notices(mesh)};
  }
  ReachingGraph made = graph_of(mesh, options, true);
  std::vector<std::string> notices = notices_of(made);
  return {std::move(made.graph),
          fmt::format("sbp: order 2 on {} nodes, kappa {:.4g}", mesh.n_nodes(), options.kappa),
          std::move(notices), true};
}

scheme::Operators corrected_on(const meshes::Mesh& mesh,
                               const Options& options,
                               std::string text,
                               std::vector<std::string> notices = {}) {
  ReachingGraph made = graph_of(mesh, options, false);
  for (std::string& notice : notices_of(made))
    notices.push_back(std::move(notice));
  scheme::Operators operators{std::move(made.graph), std::move(text), std::move(notices)};
  operators.errs_less_with_cells = true;
  return operators;
}

scheme::Operators corrected_because(const meshes::Mesh& mesh,
                                    const Options& options,
                                    const std::string& because,
                                    std::vector<std::string> notices = {}) {
  return corrected_on(mesh, options, fmt::format("corrected gradient: {}", because),
                      std::move(notices));
}

/// What gradient = "auto" comes to.
scheme::Operators chosen_on(const meshes::Mesh& mesh, const Options& options) {
  if (!options.second_order_because.empty())
    return corrected_because(mesh, options, options.second_order_because);
  if (!options.closure) return corrected_because(mesh, options, "closure = false");
  const Kernel kernel = kernels().at(options.kernel);
  if (const std::string because = unsure_because(mesh, kernel, options.kappa); !because.empty())
    return corrected_because(mesh, options, because);
  if (!options.strong_pressure_because.empty() && !meshes::is_undistorted_block(mesh))
    return corrected_because(mesh, options, options.strong_pressure_because);
  try {
    return sbp_on(mesh, options);
  } catch (const base::InputError& refusal) {
    return corrected_because(
        mesh, options, "sbp does not go with these nodes",
        {fmt::format("corrected gradient, since {}. Where few cells are across "
                     "bodies then bend tens of percent too little or too far; compare levels",
                     refusal.what())});
  }
}

}  // namespace

const std::vector<std::string>& gradient_names() {
  return gradients().names();
}

scheme::Operators operators_on(const meshes::Mesh& mesh, const Options& options) {
  if (!(options.kappa >= least_kappa && options.kappa <= greatest_kappa)) {
    throw base::InputError(
        fmt::format("kappa = {:.6g} is out of range; use {} to {} (1.2 is usual; corners of boxes "
                    "take 0.708, with quintic-spline 0.5)",
                    options.kappa, least_kappa, greatest_kappa));
  }
  switch (gradients().at(options.gradient)) {
    case Gradient::automatic:
      return chosen_on(mesh, options);
    case Gradient::corrected:
      return corrected_on(mesh, options, "");
    case Gradient::sbp:
      if (meshes::is_undistorted_block(mesh)) return sbp_on(mesh, options);
      try {
        return sbp_on(mesh, options);
      } catch (const base::InputError& refusal) {
        throw base::InputError(fmt::format(
            "sph.gradient = \"sbp\" does not go with these nodes: {}, or use \"corrected\"",
            refusal.what()));
      }
  }
  __builtin_unreachable();
}

scheme::PairGraph build_graph(const meshes::Mesh& mesh, const Options& options) {
  return operators_on(mesh, options).graph;
}

}  // namespace diptych::sph
