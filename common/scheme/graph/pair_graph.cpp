#include "common/scheme/graph/pair_graph.hpp"

#include "common/base/error.hpp"
#include "common/parallel/for_chunks.hpp"
#include "common/scheme/graph/classify_rows.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <fmt/format.h>
#include <limits>

namespace diptych::scheme {

namespace {

std::string node_text(const PairGraph& graph, std::int64_t a) {
  const Vec3& X = graph.X[a];
  return fmt::format("node {} at ({:.6g}, {:.6g}, {:.6g})", a, X[0], X[1], X[2]);
}

[[noreturn]] void refuse(const std::string& what) {
  throw base::InputError("pair graph: " + what);
}

template <class Array>
void free_array(Array& array) {
  Array().swap(array);
}

/// The larger of two figures; a figure that is not a number is the worst there is.
double worst(double a, double b) {
  return b > a || std::isnan(b) ? b : a;
}

void check_sizes(const PairGraph& graph) {
  const auto n = graph.X.size(), pairs = graph.neighbour.size();
  const auto check = [](const char* array, size_t size, size_t wanted) {
    if (size != wanted) refuse(fmt::format("{} has {} entries instead of {}", array, size, wanted));
  };
  if (graph.dimension != 2 && graph.dimension != 3) {
    refuse(fmt::format("dimension is {}; use 2 or 3", graph.dimension));
  }
  if (n == 0) refuse("it has no nodes; use a mesh with at least one cell");
  check("Omega", graph.Omega.size(), n);
  check("boundary_area", graph.boundary_area.size(), n);
  check("row", graph.row.size(), n + 1);
  check("reverse_place", graph.reverse_place.size(), pairs);
  check("C", graph.C.size(), pairs);
  if (graph.row.front() != 0 || graph.row.back() != graph.n_pairs()) {
    refuse(fmt::format("rows run from {} to {} instead of 0 to {}", graph.row.front(),
                       graph.row.back(), pairs));
  }
  for (size_t a = 0; a < n; ++a) {
    if (graph.row[a] > graph.row[a + 1]) {
      refuse(fmt::format("{} has a row of negative length", node_text(graph, a)));
    }
  }
}

void check_node(const PairGraph& graph, std::int64_t a) {
  if (!graph.X[a].allFinite()) refuse(fmt::format("node {} has no finite position", a));
  if (!(graph.Omega[a] > 0) || !std::isfinite(graph.Omega[a])) {
    refuse(fmt::format("{} has volume {:.3g}; volumes must be positive and finite",
                       node_text(graph, a), graph.Omega[a]));
  }
  if (!graph.boundary_area[a].allFinite()) {
    refuse(fmt::format("{} has no finite boundary area", node_text(graph, a)));
  }
}

void check_row(const PairGraph& graph, std::int64_t a) {
  for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p) {
    const std::int32_t b = graph.neighbour[p];
    if (b < 0 || b >= graph.n_nodes() || b == a) {
      refuse(
          fmt::format("{} has neighbour {} of {} nodes", node_text(graph, a), b, graph.n_nodes()));
    }
    if (p > graph.row[a] && graph.neighbour[p - 1] >= b) {
      refuse(fmt::format("the neighbours of {} are not in ascending order", node_text(graph, a)));
    }
    const std::int64_t r = graph.reverse(p);
    if (r < graph.row[b] || r >= graph.row[b + 1] || graph.neighbour[r] != a) {
      refuse(fmt::format("{} and {} are not a pair both ways", node_text(graph, a),
                         node_text(graph, b)));
    }
    if (!graph.C[p].allFinite()) {
      refuse(fmt::format("{} and {} have no finite C_ab; do they coincide?", node_text(graph, a),
                         node_text(graph, b)));
    }
  }
}

/// All of them, at once; of those that are refused the first is named.
void check_nodes(const PairGraph& graph, void (*check)(const PairGraph&, std::int64_t)) {
  std::vector<std::exception_ptr> refused(
      static_cast<size_t>(parallel::n_chunks_of(graph.n_nodes())));
  parallel::for_chunks(graph.n_nodes(),
                       [&](std::int64_t begin, std::int64_t end, std::int64_t chunk) {
                         try {
                           for (std::int64_t a = begin; a < end; ++a)
                             check(graph, a);
                         } catch (const base::InputError&) {
                           refused[chunk] = std::current_exception();
                         }
                       });
  for (const std::exception_ptr& error : refused)
    if (error) std::rethrow_exception(error);
}

void check_patch(const PairGraph& graph, const BoundaryPatch& patch) {
  if (patch.area.size() != patch.nodes.size()) {
    refuse(fmt::format("patch '{}' has {} areas for {} nodes", patch.name, patch.area.size(),
                       patch.nodes.size()));
  }
  for (size_t i = 0; i < patch.nodes.size(); ++i) {
    const std::int32_t a = patch.nodes[i];
    if (a < 0 || a >= graph.n_nodes() || (i > 0 && patch.nodes[i - 1] >= a)) {
      refuse(fmt::format("patch '{}': node {} is out of range or order", patch.name, a));
    }
    if (!patch.area[i].allFinite()) {
      refuse(fmt::format("patch '{}': {} has no finite area", patch.name, node_text(graph, a)));
    }
  }
}

/// |sum_b 1/2 (X_b - X_a) (x) C_ab / Omega_a - I|
double linear_error(const PairGraph& graph, std::int64_t a) {
  Mat3 gradient = Mat3::Zero();
  for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p)
    gradient += (graph.X[graph.neighbour[p]] - graph.X[a]) * graph.C[p].transpose();
  gradient *= 0.5 / graph.Omega[a];
  gradient.diagonal().head(graph.dimension).array() -= 1.0;
  return gradient.norm();
}

/// |-1/2 sum_b (C_ab - C_ba) - A_a N_a| / h_a^(d-1)
double closure_error(const PairGraph& graph, std::int64_t a) {
  Vec3 closure = Vec3::Zero();
  for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p)
    closure -= 0.5 * (graph.C[p] - graph.C[graph.reverse(p)]);
  const double d = graph.dimension;
  return (closure - graph.boundary_area[a]).norm() / std::pow(graph.Omega[a], (d - 1) / d);
}

/// Sweeps in single precision square areas, and slivers are much smaller than the largest.
void check_range(const PairGraph& graph) {
  constexpr double least = 1e-13, most = 1e13;
  double largest = 0;
  graph.C.for_each_alike([&](const Vec3& C) { largest = std::max(largest, C.norm()); });
  if (largest > least && largest < most) return;
  refuse(fmt::format(
      "faces of {:.3g} m^{} are out of the range of scheme.precision = \"single\" ({:g} "
      "to {:g}): use \"mixed\" or \"double\", or other units of length",
      largest, graph.dimension - 1, least, most));
}

}  // namespace

GraphQuality quality(const PairGraph& graph) {
  struct Worst {
    double linear_exactness = 0, closure = 0;
    std::int64_t neighbours = std::numeric_limits<std::int64_t>::max();
  };
  std::vector<Worst> parts(static_cast<size_t>(parallel::n_chunks_of(graph.n_nodes())));
  parallel::for_chunks(
      graph.n_nodes(), [&](std::int64_t begin, std::int64_t end, std::int64_t chunk) {
        Worst& part = parts[chunk];
        for (std::int64_t a = begin; a < end; ++a) {
          part.linear_exactness = worst(part.linear_exactness, linear_error(graph, a));
          part.closure = worst(part.closure, closure_error(graph, a));
          part.neighbours = std::min(part.neighbours, graph.row[a + 1] - graph.row[a]);
        }
      });
  Worst all;
  for (const Worst& part : parts) {
    all.linear_exactness = worst(all.linear_exactness, part.linear_exactness);
    all.closure = worst(all.closure, part.closure);
    all.neighbours = std::min(all.neighbours, part.neighbours);
  }
  GraphQuality result;
  result.linear_exactness = all.linear_exactness;
  result.closure = all.closure;
  result.mean_neighbours =
      static_cast<double>(graph.n_pairs()) / static_cast<double>(graph.n_nodes());
  result.least_neighbours = static_cast<int>(all.neighbours);
  return result;
}

void validate(const PairGraph& graph) {
  check_sizes(graph);
  check_nodes(graph, check_node);
  check_nodes(graph, check_row);
  for (const BoundaryPatch& patch : graph.patches)
    check_patch(graph, patch);
}

void set_precision(PairGraph& graph, Precision precision) {
  graph.precision = precision;
  if (precision == Precision::full) return;
  if (precision == Precision::single) check_range(graph);
  const RowClasses classes = classes_of(graph);  // rows of a class must not round apart
  for (std::int64_t a = 0; a < graph.n_nodes(); ++a) {
    for (std::int64_t k = graph.row[a]; k < graph.row[a + 1]; ++k)
      graph.C.put_as(k, shared_place(graph, classes, a, k));
  }
  graph.C.change_alike([](Vec3& C) {
    for (double& component : C)  // Eigen 3.4 leaves rounding out of C.cast<float>().cast<double>()
      component = static_cast<float>(component);
  });
}

Mat3 metric_of_lines(const Mat3& edges) {
  constexpr double just_above = 1 + 1e-6;
  return edges.inverse() / just_above;
}

void release_pairs(PairGraph& graph) {
  graph.slopes = {};
  free_array(graph.row);
  free_array(graph.neighbour);
  free_array(graph.reverse_place);
  graph.C = {};
  free_array(graph.boundary_area);
  graph.classes = {};
}

void release_volumes(PairGraph& graph) {
  graph.cells = {};
  free_array(graph.edges);
  graph.lines = {};
}

void link_reverse_pairs(PairGraph& graph) {
  // Rows are ascending, so the rows that name b come by in the order of b's own row.
  std::vector<std::int64_t> next(graph.row.begin(), graph.row.end() - 1);
  graph.reverse_place.assign(graph.neighbour.size(), -1);
  for (std::int64_t a = 0; a < graph.n_nodes(); ++a) {
    for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p) {
      const std::int32_t b = graph.neighbour[p];
      if (b < 0 || b >= graph.n_nodes()) {
        refuse(fmt::format("{} has neighbour {} of {} nodes", node_text(graph, a), b,
                           graph.n_nodes()));
      }
      const std::int64_t r = next[b]++;
      if (r >= graph.row[b + 1] || graph.neighbour[r] != a) {
        refuse(fmt::format("{} and {} are not a pair both ways", node_text(graph, a),
                           node_text(graph, b)));
      }
      graph.reverse_place[p] = static_cast<std::int32_t>(r - graph.row[b]);
    }
  }
}

}  // namespace diptych::scheme
