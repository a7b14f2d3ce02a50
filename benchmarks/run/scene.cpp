#include "benchmarks/run/scene.hpp"

#include "benchmarks/run/memory_estimate.hpp"
#include "benchmarks/run/unseen_fields.hpp"
#include "common/cases/reader.hpp"
#include "common/run/step_ends.hpp"
#include "common/scheme/boundary/boundary_condition.hpp"
#include "meshes/cavities.hpp"
#include "meshes/curved_groups.hpp"
#include "meshes/parts.hpp"
#include "meshes/united_groups.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <utility>

namespace diptych::harness {

namespace {

/// Of a file: where a cell is missing the mesh is that of a hollow body.
void note_cavities(const meshes::Mesh& mesh, std::vector<std::string>& notices) {
  for (const meshes::Cavity& cavity : meshes::cavities_of(mesh)) {
    if (cavity.is_grouped) continue;
    notices.push_back(fmt::format(
        "mesh: a cavity of {:.3g} {} inside the body, {} faces around ({:.6g}, {:.6g}, {:.6g}) m: "
        "cells are missing there, unless it is meant (a boundary group on it says so)",
        cavity.volume, mesh.dimension == 2 ? "m^2" : "m^3", cavity.n_faces, cavity.centre[0],
        cavity.centre[1], cavity.centre[2]));
  }
}

/// Of a file, whose parts may be meant to be one body.
void note_parts(const meshes::Mesh& mesh, std::vector<std::string>& notices) {
  const std::int64_t n = meshes::n_parts(mesh);
  if (n == 1) return;
  notices.push_back(fmt::format(
      "mesh: {} parts that share no node: each moves by itself, and they pass through each other",
      n));
}

/// What keeps the normals of the undeformed body cannot guide one that slides along a curve.
void note_curved_symmetries(const cases::Case& setup,
                            const meshes::Mesh& mesh,
                            std::vector<std::string>& notices) {
  constexpr double rounding = 0.1;  // degrees
  for (const cases::BoundaryCase& boundary : setup.boundaries) {
    if (boundary.type != "symmetry") continue;
    for (const meshes::BoundaryGroup& group : mesh.boundary_groups) {
      const auto& names = boundary.groups;
      if (std::find(names.begin(), names.end(), group.name) == names.end()) continue;
      const double bend = meshes::largest_bend(mesh, group);
      if (bend < rounding) continue;
      notices.push_back(fmt::format(
          "boundary: group '{}' of type symmetry is curved (faces turn by up to {:.2g} degrees): "
          "its "
          "nodes keep the normals of the undeformed body, so one that slides along it leaves it",
          group.name, bend));
    }
  }
}

/// What loads and areas of probes take each face of once.
void unite_overlapping_groups(const cases::Case& setup, meshes::Mesh& mesh) {
  for (const cases::BoundaryCase& boundary : setup.boundaries)
    meshes::unite_overlapping(boundary.groups, mesh);
  for (const cases::ProbeCase& probe : setup.probes)
    meshes::unite_overlapping(probe.groups, mesh);
}

/// A probe of a force that nothing exerts.
void note_idle_reactions(const cases::Case& setup,
                         const meshes::Mesh& mesh,
                         std::vector<std::string>& notices) {
  const auto for_nodes = [&](const std::vector<std::string>& names, const auto& use) {
    for (const meshes::BoundaryGroup& group : mesh.boundary_groups) {
      if (std::find(names.begin(), names.end(), group.name) == names.end()) continue;
      for (const std::int32_t f : group.faces) {
        const meshes::BoundaryFace& face = mesh.boundary_faces[static_cast<size_t>(f)];
        std::for_each_n(face.nodes.begin(), face.n_nodes, use);
      }
    }
  };
  std::vector<char> is_held(mesh.nodes.size(), 0);
  for (const cases::BoundaryCase& boundary : setup.boundaries) {
    if (scheme::boundary_menu().at(boundary.type).acts != scheme::BoundaryKind::Acts::load)
      for_nodes(boundary.groups, [&](std::int32_t a) { is_held[static_cast<size_t>(a)] = 1; });
  }
  for (const cases::ProbeCase& probe : setup.probes) {
    if (probe.kind != "reaction") continue;
    bool is_idle = true;
    for_nodes(probe.groups,
              [&](std::int32_t a) { is_idle &= is_held[static_cast<size_t>(a)] == 0; });
    if (!is_idle) continue;
    notices.push_back(
        fmt::format("probe '{}': no support or wall holds a node of {}, so that its reaction is "
                    "zero throughout",
                    probe.name, fmt::join(probe.groups, ", ")));
  }
}

/// A single cell shears where it should bend.
void note_single_cells(const cases::Case& setup, int level, std::vector<std::string>& notices) {
  if (!setup.mesh.file.empty() || level > 0) return;
  const auto is_free = [&](const std::string& side) {
    return std::none_of(setup.boundaries.begin(), setup.boundaries.end(),
                        [&](const cases::BoundaryCase& boundary) {
                          return scheme::boundary_menu().at(boundary.type).acts !=
                                     scheme::BoundaryKind::Acts::load &&
                                 std::find(boundary.groups.begin(), boundary.groups.end(), side) !=
                                     boundary.groups.end();
                        });
  };
  for (int i = 0; i < cases::dimension_of(setup.mesh); ++i) {
    const std::string axis(1, "xyz"[i]);
    if (setup.mesh.cells[static_cast<size_t>(i)] != 1 || !is_free(axis + "_min") ||
        !is_free(axis + "_max"))
      continue;
    notices.push_back(fmt::format(
        "mesh: one cell along {}, whose sides are free: a body of one cell across bends several "
        "times as stiffly as it should, of long cells more than ten times; give two or more, of "
        "triangles four",
        axis));
  }
}

/// What "auto" comes to where the mesh says so, which the solver does not know.
std::string reconstruction_for(const cases::Case& setup, const scheme::Operators& operators) {
  return operators.loses_sign && takes_symmetric_jumps(setup.scheme) ? "symmetric" : "";
}

cases::Case resolved(cases::Case setup, const std::string& reconstruction) {
  if (!reconstruction.empty()) setup.scheme.reconstruction = reconstruction;
  return setup;
}

}  // namespace

CaseGraph graph_of(const cases::Case& setup,
                   const std::string& method,
                   int level,
                   const PartMade& made) {
  CaseGraph scene;
  require_memory(setup, {method}, {level});
  scene.mesh = mesh_of(setup, level);
  unite_overlapping_groups(setup, scene.mesh.mesh);
  require_memory(setup, method, level, scene.mesh.mesh);
  if (made) made(ScenePart::mesh, scene);
  scheme::Operators operators = method_menu().at(method)(scene.mesh.mesh, setup);
  scene.reconstruction = reconstruction_for(setup, operators);
  scene.graph = std::move(operators.graph);
  scene.operators = std::move(operators.text);
  if (!scene.reconstruction.empty())
    scene.operators += fmt::format("; {} reconstruction", scene.reconstruction);
  scene.notices = std::move(operators.notices);
  if (!setup.mesh.file.empty()) {
    note_cavities(scene.mesh.mesh, scene.notices);
    note_parts(scene.mesh.mesh, scene.notices);
  }
  note_curved_symmetries(setup, scene.mesh.mesh, scene.notices);
  note_unseen_fields(setup, scene.mesh.mesh, scene.notices);
  note_single_cells(setup, level, scene.notices);
  note_idle_reactions(setup, scene.mesh.mesh, scene.notices);
  if (made) made(ScenePart::graph, scene);
  return scene;
}

Scene::Scene(const cases::Case& setup,
             const std::string& method,
             int level,
             GraphPairs pairs,
             const PartMade& made)
    : CaseGraph(graph_of(setup, method, level, made)),
      solver(pairs == GraphPairs::released
                 ? run::make_solver_of_pairs(resolved(setup, reconstruction), graph)
                 : run::make_solver(resolved(setup, reconstruction), graph)) {
  // refuses what is too fast, while none runs
  (void)run::step_ends(setup, solver->undeformed_step(), solver->telling_places());
  if (made) made(ScenePart::solver, *this);
}

}  // namespace diptych::harness
