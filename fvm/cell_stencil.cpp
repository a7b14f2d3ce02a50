#include "fvm/cell_stencil.hpp"

#include "meshes/incidence.hpp"

#include <algorithm>
#include <array>

namespace diptych::fvm {

using algebra::Mat3;
using algebra::Vec3;
using meshes::Quadrature;
using meshes::ReferenceCell;

namespace {

/// Which nodes of a cell are coupled to which.
using Coupling = std::array<std::array<bool, meshes::max_cell_nodes>, meshes::max_cell_nodes>;

Coupling coupling(const ReferenceCell& cell, Quadrature quadrature) {
  Coupling coupled{};
  for (const meshes::QuadraturePoint& point : cell.rule(quadrature)) {
    for (int a = 0; a < cell.n_nodes; ++a) {
      for (int b = 0; b < cell.n_nodes; ++b) {
        if (a != b && point.N[a] != 0 && !point.dN[b].isZero(0)) coupled[a][b] = true;
      }
    }
  }
  return coupled;
}

std::array<Coupling, 5> couplings(Quadrature quadrature) {
  std::array<Coupling, 5> table;
  for (int type = 0; type < 5; ++type) {
    table[type] = coupling(meshes::reference_cell(static_cast<meshes::CellType>(type)), quadrature);
  }
  return table;
}

}  // namespace

void find_pairs(const meshes::Mesh& mesh, Quadrature quadrature, scheme::PairGraph& graph) {
  const std::array<Coupling, 5> coupled = couplings(quadrature);
  const meshes::Incidence around = meshes::cells_around_nodes(mesh);
  graph.row.assign(1, 0);
  graph.neighbour.clear();
  std::vector<std::int32_t> found;
  for (std::int64_t a = 0; a < mesh.n_nodes(); ++a) {
    found.clear();
    for (std::int64_t s = around.first[a]; s < around.first[a + 1]; ++s) {
      const auto nodes = mesh.cell(around.cell[s]);
      const auto& mine = coupled[static_cast<size_t>(mesh.cell_types[around.cell[s]])];
      for (size_t i = 0; i < nodes.size(); ++i) {
        if (mine[around.place[s]][i]) found.push_back(nodes[i]);
      }
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    graph.neighbour.insert(graph.neighbour.end(), found.begin(), found.end());
    graph.row.push_back(graph.n_pairs());
  }
}

std::vector<double> add_cells(const meshes::Mesh& mesh,
                              Quadrature quadrature,
                              scheme::PairGraph& graph) {
  std::vector<Vec3> C(graph.neighbour.size(), Vec3::Zero());
  std::vector<double> volume(static_cast<size_t>(mesh.n_nodes()), 0.0);
  const auto pair = [&](std::int32_t a, std::int32_t b) {
    const auto begin = graph.neighbour.begin();
    return std::lower_bound(begin + graph.row[a], begin + graph.row[a + 1], b) - begin;
  };
  for (std::int64_t c = 0; c < mesh.n_cells(); ++c) {
    const ReferenceCell& cell = meshes::reference_cell(mesh.cell_types[c]);
    const auto nodes = mesh.cell(c);
    std::array<std::array<Vec3, meshes::max_cell_nodes>, meshes::max_cell_nodes> local;
    for (int a = 0; a < cell.n_nodes; ++a)
      local[a].fill(Vec3::Zero());
    for (const meshes::QuadraturePoint& point : cell.rule(quadrature)) {
      const Mat3 J = meshes::jacobian(cell, point, nodes, mesh.nodes);
      const Mat3 cof = point.weight * meshes::cofactor(J);
      const double weight = cof.col(0).dot(J.col(0));
      std::array<Vec3, meshes::max_cell_nodes> gradient;  // w_q grad N_b
      for (int b = 0; b < cell.n_nodes; ++b)
        gradient[b] = cof * point.dN[b];
      for (int a = 0; a < cell.n_nodes; ++a) {
        if (point.N[a] == 0) continue;
        volume[nodes[a]] += weight * point.N[a];
        for (int b = 0; b < cell.n_nodes; ++b)
          local[a][b] += 2 * point.N[a] * gradient[b];
      }
    }
    for (int a = 0; a < cell.n_nodes; ++a) {
      for (int b = 0; b < cell.n_nodes; ++b) {
        if (a == b || local[a][b].isZero(0)) continue;
        C[pair(nodes[a], nodes[b])] += local[a][b];
      }
    }
  }
  graph.C = algebra::SharedVectors(std::move(C));
  return volume;
}

}  // namespace diptych::fvm
