#include "benchmarks/run/memory_estimate.hpp"

#include "benchmarks/run/backends.hpp"
#include "benchmarks/run/case_mesh.hpp"
#include "benchmarks/run/memory.hpp"
#include "benchmarks/run/strong_pressure.hpp"
#include "common/base/error.hpp"
#include "common/cases/reader.hpp"
#include "common/closure/sbp_operator.hpp"
#include "common/run/solver.hpp"
#include "meshes/gmsh.hpp"
#include "sph/kernels/kernel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace diptych::harness {

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double most_nodes = std::numeric_limits<std::int32_t>::max();

/// Bytes of the largest resident set above that of the bare program, fitted to `diptych check` on
/// cubes of 10^4 to 3 10^5 nodes: the graph, or the state of the solver that comes in its place,
/// whichever is more, beside the geometry that the solver keeps.
struct Costs {
  double node, branch, pair, stored_pair;
};
/// node, branch: the state; pair: a row of the graph; stored_pair: geometry of rows of their own.
constexpr Costs in_double{1220, 220, 29, 90}, in_single{750, 100, 29, 57};
constexpr double graph_node = 900;
constexpr double of_plane = 0.64;        ///< of the nodes of 3-D
constexpr double of_mixed = 48;          ///< stored pair
constexpr double exact_impedance = 200;  ///< a node
constexpr double frames = 128;           ///< a node, of the objective reconstruction
constexpr double moments = 96;           ///< a node, of the symmetric reconstruction
constexpr double hourglass = 460;        ///< a node, of what holds displacements unseen by F
constexpr double node_of_lines = 720;    ///< the graph of a box, with slopes along its lines
constexpr double lattice_pair = 16;      ///< a row of SPH there, whose C_ab stand once
constexpr double cell_bytes = 30;
constexpr double volume_corner = 70;      ///< of a cell that carries pressure
constexpr double volume_node = 60;        ///< of a node of such
constexpr double shear_pair = 12;         ///< of nodes of a cell that carries shear
constexpr double volume_line_node = 400;  ///< of a node whose lines carry pressure
constexpr double class_pair = 650;        ///< of rows that stand for many
constexpr double solve_node = 740;        ///< while operators of any nodes are made to sum by parts
constexpr double solve_pair = 8;

struct Lattice {
  int dimension = 3;
  std::array<double, 3> cells{1, 1, 1};
  std::array<double, 3> spacing{0, 0, 0};

  double nodes() const { return product(1); }
  double n_cells() const { return product(0); }
  double product(double more) const {
    double result = 1;
    for (int i = 0; i < dimension; ++i)
      result *= cells[i] + more;
    return result;
  }
};

Lattice lattice_of(const cases::MeshCase& mesh, int level) {
  Lattice lattice;
  lattice.dimension = cases::dimension_of(mesh);
  for (int i = 0; i < lattice.dimension; ++i) {
    lattice.cells[i] = std::ldexp(mesh.cells[i], level);
    lattice.spacing[i] = (mesh.upper[i] - mesh.lower[i]) / lattice.cells[i];
  }
  return lattice;
}

bool is_simplex(const std::string& element) {
  return element == "tetrahedron" || element == "triangle";
}

bool is_lattice(const cases::MeshCase& mesh) {
  return mesh.file.empty() && mesh.perturbation == 0 && !is_simplex(mesh.element);
}

double simplices_of_cell(const cases::MeshCase& mesh) {
  if (!is_simplex(mesh.element)) return 1;
  return cases::dimension_of(mesh) == 3 ? 6 : 2;
}

double corners_of_cell(const cases::MeshCase& mesh) {
  const int d = cases::dimension_of(mesh);
  return is_simplex(mesh.element) ? d + 1 : std::ldexp(1, d);
}

/// Of a node inside, those that share a cell with it.
double neighbours_by_cells(const cases::MeshCase& mesh) {
  const bool in_space = cases::dimension_of(mesh) == 3;
  if (is_simplex(mesh.element)) return in_space ? 14 : 6;
  return in_space ? 26 : 8;
}

/// Directed pairs that share an edge, or a cell where `all`.
double finite_volume_pairs(const Lattice& lattice, const std::string& element, bool all) {
  const auto& n = lattice.cells;
  const int d = lattice.dimension;
  double around = 1;  // nodes of the 3^d around each, itself included
  for (int i = 0; i < d; ++i)
    around *= 3 * n[i] + 1;
  if (all && !is_simplex(element)) return around - lattice.nodes();
  double edges = 0, diagonals = 0;
  for (int i = 0; i < d; ++i) {
    edges += lattice.nodes() * n[i] / (n[i] + 1);
    for (int j = 0; j < i; ++j)
      diagonals += lattice.nodes() * n[i] * n[j] / ((n[i] + 1) * (n[j] + 1));
  }
  if (is_simplex(element)) edges += diagonals + (d == 3 ? lattice.n_cells() : 0);
  return 2 * edges;
}

/// Directed pairs of operators that sum by parts along the lines of a box.
double pairs_of_lines(const Lattice& lattice, int order) {
  double pairs = 0;
  for (int i = 0; i < lattice.dimension; ++i) {
    const int n = static_cast<int>(lattice.cells[i]) + 1;
    const closure::SbpOperator line(closure::widest_sbp_table(order, n), n);
    double of_line = 0;
    for (int k = 0; k < n; ++k)
      of_line += static_cast<double>(line.row(k).size());
    pairs += of_line * lattice.nodes() / n;
  }
  return pairs;
}

/// Neighbours of a node of a large mesh within two rings of edges.
double two_rings(const std::string& element, int dimension) {
  if (is_simplex(element)) return dimension == 3 ? 64 : 18;
  return dimension == 3 ? 24 : 12;
}

/// Directed pairs of finite volumes that sum by parts on nodes that are no lattice. Nodes at sides
/// of hexahedra reach a ring further, and their neighbours reach them.
double pairs_of_rings(const Lattice& lattice, const std::string& element) {
  const double rings = lattice.nodes() * two_rings(element, lattice.dimension);
  if (is_simplex(element)) return rings;
  return rings + (lattice.nodes() - lattice.product(-1)) * (lattice.dimension == 3 ? 59 : 18.5);
}

/// Finite volumes that sum by parts along the lines of a box, asked for or chosen.
bool sums_along_lines(const cases::Case& setup) {
  if (setup.fvm.stencil == "sbp") return true;
  return setup.fvm.stencil == "auto" && setup.scheme.face_correction == 0 && is_lattice(setup.mesh);
}

/// Nodes that a row of finite volumes reaches along a line.
double reach_of(const cases::Case& setup) {
  return sums_along_lines(setup) ? setup.fvm.order / 2 : 1;
}

/// Of the support of the kernel, in spacings of a cube of the same volume.
double support_radius(const cases::SphCase& sph) {
  return sph::kernels().at(sph.kernel).support * sph.kappa;
}

/// Whether operators sum by parts on nodes that are no lattice (notes 4.5).
bool sums_anywhere(const cases::Case& setup, const std::string& method) {
  if (is_lattice(setup.mesh)) return false;
  const bool is_sph = method == "sph";
  const std::string& asked = is_sph ? setup.sph.gradient : setup.fvm.stencil;
  if (asked != "auto") return asked == "sbp";
  const bool is_open = setup.scheme.face_correction == 0 && setup.scheme.volumes != "cells" &&
                       !may_press_strongly(setup);
  return is_open && (is_sph ? setup.sph.closure && support_radius(setup.sph) > 2 &&
                                  support_radius(setup.sph) <= 4
                            : setup.fvm.order > 2);
}

/// Nodes in a ball of so many spacings, without its middle.
double nodes_in_ball(double radius, int dimension) {
  const double volume =
      dimension == 3 ? 4.0 / 3 * pi * radius * radius * radius : pi * radius * radius;
  return volume - 1;
}

/// What the support of a particle far from the boundary holds.
struct Support {
  double reach = 0;  ///< m
  double neighbours = 0;
  bool is_touched = false;  ///< a lattice vector is as long as it: rounding decides, node by node
};

/// @param touching_count  of a neighbour as far away as the support reaches, 0 to 1
Support support_of(const Lattice& lattice, double radius, double touching_count) {
  double volume = 1;
  for (int i = 0; i < lattice.dimension; ++i)
    volume *= lattice.spacing[i];
  Support support;
  support.reach = radius * std::pow(volume, 1.0 / lattice.dimension);
  std::array<int, 3> most{0, 0, 0};
  for (int i = 0; i < lattice.dimension; ++i) {
    const double n = support.reach / lattice.spacing[i];
    if (!(n < 40)) {  // of cells so slender a count says little, and would take long
      support.neighbours = nodes_in_ball(radius, lattice.dimension);
      return support;
    }
    most[i] = static_cast<int>(n) + 1;
  }
  for (int i = -most[0]; i <= most[0]; ++i) {
    for (int j = -most[1]; j <= most[1]; ++j) {
      for (int k = -most[2]; k <= most[2]; ++k) {
        const double length =
            std::hypot(i * lattice.spacing[0], j * lattice.spacing[1], k * lattice.spacing[2]);
        const bool touches = std::abs(length - support.reach) < 1e-9 * support.reach;
        support.is_touched |= touches;
        if (touches) support.neighbours += touching_count;
        if (!touches && length < support.reach) support.neighbours += 1;
      }
    }
  }
  support.neighbours -= 1;
  return support;
}

/// Whether all coordinates of the box are exact in binary: distances that are equal are then equal
/// in the last bit too.
bool is_exact(const cases::MeshCase& mesh, const Lattice& lattice) {
  const auto has_few_digits = [](double x) {
    const double scaled = std::ldexp(x, 24);
    return scaled == std::floor(scaled) && std::abs(scaled) < 1e12;
  };
  bool result = true;
  for (int i = 0; i < lattice.dimension; ++i)
    result = result && has_few_digits(lattice.spacing[i]) && has_few_digits(mesh.lower[i]);
  return result;
}

double particle_pairs(const Lattice& lattice, const Support& support) {
  double inside = 1;
  for (int i = 0; i < lattice.dimension; ++i) {
    // mean of a coordinate over a ball is 3/8 of its radius: so much of it lies outside the box
    const double reach = support.reach / lattice.spacing[i];
    inside *= std::max(0.3, 1 - 0.375 * reach / (lattice.cells[i] + 1));
  }
  return lattice.nodes() * std::min(inside * support.neighbours, lattice.nodes() - 1);
}

/// SPH that sums by parts on a box, asked for or chosen: supports in spacings of each line, rows of
/// their own within three nodes of a side.
bool sums_on_lattice(const cases::Case& setup) {
  const bool is_box = is_lattice(setup.mesh);
  if (setup.sph.gradient != "auto") return is_box && setup.sph.gradient == "sbp";
  return is_box && setup.scheme.face_correction == 0 && support_radius(setup.sph) > 2 &&
         support_radius(setup.sph) <= 4 && setup.scheme.volumes != "cells";
}

/// Bytes of a run on so many nodes, cells and pairs.
/// @param n_class_pairs  pairs of the rows that stand for all others; 0: every row for itself
/// @param has_lines      slopes along lines of nodes
double bytes_of(const cases::Case& setup,
                const std::string& method,
                const MemoryEstimate& size,
                double n_class_pairs,
                bool has_lines) {
  const cases::SchemeCase& scheme = setup.scheme;
  const bool has_moments = takes_symmetric_jumps(scheme) &&
                           (scheme.reconstruction == "symmetric" || sums_anywhere(setup, method));
  const Costs& costs = scheme.precision == "single" ? in_single : in_double;
  double node =
      costs.node + costs.branch * static_cast<double>(setup.material.branches.size()) +
      (scheme.impedance == "exact" ? exact_impedance : 0) +
      (scheme.reconstruction == "objective" ? frames
       : has_moments                        ? moments
                                            : 0) +
      (has_moments && scheme.hourglass != 0 && sums_anywhere(setup, method) ? hourglass : 0);
  const double plane = cases::dimension_of(setup.mesh) == 2 ? of_plane : 1;
  const double stored = scheme.precision == "mixed" ? of_mixed : costs.stored_pair;
  const bool commutes = method != "sph" && !is_simplex(setup.mesh.element) &&
                        setup.mesh.perturbation == 0 && setup.fvm.stencil != "integral";
  const bool on_lines = method == "sph" && sums_on_lattice(setup);
  const bool wants_volumes =
      may_press_strongly(setup) ||
      (on_lines ? holds_with_lines(setup.material) : is_nearly_incompressible(setup.material));
  const bool errs_less_with_cells =
      !is_lattice(setup.mesh) && scheme.face_correction == 0 &&
      (method == "sph" || setup.fvm.stencil == "integral" || is_simplex(setup.mesh.element));
  const bool has_volumes =
      scheme.volumes == "cells" || scheme.volumes == "lines" ||
      (scheme.volumes == "auto" && !commutes && !sums_anywhere(setup, method) &&
       (wants_volumes || errs_less_with_cells));
  const double corners = size.cells * corners_of_cell(setup.mesh);
  const double shear = scheme.cell_shear == 0 ? 0 : shear_pair * neighbours_by_cells(setup.mesh);
  const double volumes = !has_volumes ? 0
                         : on_lines   ? volume_line_node * size.nodes
                                    : volume_corner * corners + (volume_node + shear) * size.nodes;
  const double geometry = n_class_pairs > 0 ? class_pair * n_class_pairs : stored * size.pairs;
  const double solve =
      sums_anywhere(setup, method) ? solve_node * size.nodes + solve_pair * size.pairs : 0;
  const double graph = plane * (has_lines ? node_of_lines : graph_node) * size.nodes +
                       (on_lines ? lattice_pair : costs.pair) * size.pairs + solve;
  return std::max(graph, plane * node * size.nodes) + volumes + cell_bytes * size.cells + geometry;
}

/// Directed pairs within a support on a box.
double pairs_of_lattice(const Lattice& lattice, double radius) {
  const int reach = static_cast<int>(radius) + 1, height = lattice.dimension == 3 ? reach : 0;
  const auto places = [&](int d, int step) {
    return std::max(0.0, lattice.cells[d] + 1 - std::abs(step));
  };
  double pairs = -lattice.nodes();
  for (int k = -height; k <= height; ++k) {
    for (int j = -reach; j <= reach; ++j) {
      for (int i = -reach; i <= reach; ++i) {
        if (std::hypot(i, j, k) >= radius * (1 - 1e-12)) continue;
        pairs += places(0, i) * places(1, j) * (lattice.dimension == 3 ? places(2, k) : 1);
      }
    }
  }
  return pairs;
}

/// Rows of a lattice differ within this many nodes of the boundary: C_ab holds what corrects both
/// of its nodes, each of which sees its own support.
/// @param places  of a line whose rows differ
double classes_of(const Lattice& lattice, double places) {
  double classes = 1;
  for (int i = 0; i < lattice.dimension; ++i)
    classes *= std::min(lattice.cells[i] + 1, places);
  return classes;
}

[[noreturn]] void refuse(const cases::Case& setup,
                         const std::string& method,
                         int level,
                         const MemoryEstimate& asked,
                         const AvailableMemory& available) {
  throw base::EnvironmentError(fmt::format(
      "{} with {} at level {} asks for about {} of memory ({:.3g} nodes, {:.3g} pairs), of which "
      "{} are available {}; use a smaller --level or fewer mesh.cells{}",
      setup.name, method, level, bytes_text(asked.bytes), asked.nodes, asked.pairs,
      bytes_text(static_cast<double>(available.bytes)), available.limit,
      setup.scheme.precision == "double" ? ", or scheme.precision = \"single\"" : ""));
}

void require(const cases::Case& setup,
             const std::string& method,
             int level,
             const MemoryEstimate& asked) {
  if (asked.nodes > most_nodes) {
    throw base::InputError(fmt::format(
        "{} at level {} has {:.3g} nodes; they are counted in 32 bits, so the most is {:.3g}; use "
        "a smaller --level or fewer mesh.cells",
        setup.name, level, asked.nodes, most_nodes));
  }
  const AvailableMemory available = available_memory();
  if (asked.bytes > static_cast<double>(available.bytes))
    refuse(setup, method, level, asked, available);
  constexpr auto most_cells = static_cast<double>(meshes::most_cells);
  if (asked.cells > most_cells) {
    throw base::InputError(fmt::format(
        "{} at level {} has {:.3g} cells, the most is {:.3g}; use a smaller --level, fewer "
        "mesh.cells or hexahedra",
        setup.name, level, asked.cells, most_cells));
  }
}

}  // namespace

std::string bytes_text(double bytes) {
  const char* const units[] = {"B", "kB", "MB", "GB", "TB", "PB"};
  int unit = 0;
  while (bytes >= 999.5 && unit < 5) {
    bytes /= 1000;
    ++unit;
  }
  return fmt::format("{:.3g} {}", bytes, units[unit]);
}

MemoryEstimate estimate_memory(const cases::Case& setup, const std::string& method, int level) {
  const Lattice lattice = lattice_of(setup.mesh, level);
  MemoryEstimate size;
  size.nodes = lattice.nodes();
  size.cells = lattice.n_cells() * simplices_of_cell(setup.mesh);
  const bool is_sph = method == "sph";
  const double radius = is_sph ? support_radius(setup.sph) : reach_of(setup);
  bool is_regular = setup.mesh.perturbation == 0 && !sums_anywhere(setup, method);
  if (is_sph) {
    const bool exact = is_exact(setup.mesh, lattice);  // else one half, by rounding
    const Support support = support_of(lattice, radius, exact ? 1 : 0.5);
    const bool sums = sums_on_lattice(setup);
    size.pairs = sums ? pairs_of_lattice(lattice, radius) : particle_pairs(lattice, support);
    is_regular = is_regular && (sums || !support.is_touched || exact);
  } else if (sums_anywhere(setup, method)) {
    size.pairs = pairs_of_rings(lattice, setup.mesh.element);
  } else if (sums_along_lines(setup)) {
    size.pairs = pairs_of_lines(lattice, setup.fvm.order);
  } else {
    size.pairs = finite_volume_pairs(lattice, setup.mesh.element, setup.fvm.stencil == "integral");
  }
  const double places = is_sph && sums_on_lattice(setup) ? 7 : 4 * std::floor(radius) + 1;
  const double n_class_pairs =
      is_regular ? classes_of(lattice, places) * size.pairs / size.nodes : 0;
  const bool has_lines = is_sph ? sums_on_lattice(setup) : sums_along_lines(setup);
  size.bytes = bytes_of(setup, method, size, n_class_pairs, has_lines);
  return size;
}

MemoryEstimate estimate_memory(const cases::Case& setup,
                               const std::string& method,
                               const meshes::Mesh& mesh) {
  MemoryEstimate size;
  size.nodes = static_cast<double>(mesh.n_nodes());
  size.cells = static_cast<double>(mesh.n_cells());
  const int d = mesh.dimension;
  if (method == "sph") {
    size.pairs = size.nodes * std::min(nodes_in_ball(support_radius(setup.sph), d), size.nodes);
  } else {
    // a node of a large mesh has so many edges, or so many nodes around it
    const bool all = setup.fvm.stencil == "integral" && !is_simplex(setup.mesh.element);
    const double of_simplices = d == 3 ? 14 : 6, of_boxes = d == 3 ? 6 : 4;
    const double around = all                              ? std::pow(3, d) - 1
                          : sums_anywhere(setup, method)   ? two_rings(setup.mesh.element, d)
                          : is_simplex(setup.mesh.element) ? of_simplices
                                                           : of_boxes * reach_of(setup);
    size.pairs = size.nodes * around;
  }
  size.bytes = bytes_of(setup, method, size, 0, false);
  return size;
}

void require_memory(const cases::Case& setup,
                    const std::vector<std::string>& methods,
                    const std::vector<int>& levels) {
  for (const int level : levels)
    check_level(level);
  if (!setup.mesh.file.empty()) return;
  for (const int level : levels) {
    for (const std::string& method : methods)
      require(setup, method, level, estimate_memory(setup, method, level));
  }
}

void require_memory(const cases::Case& setup,
                    const std::string& method,
                    int level,
                    const meshes::Mesh& mesh) {
  if (setup.mesh.file.empty()) return;
  require(setup, method, level, estimate_memory(setup, method, mesh));
}

}  // namespace diptych::harness
