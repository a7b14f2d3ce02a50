#include "benchmarks/run/mesh_notices.hpp"

#include "common/cases/reader.hpp"
#include "common/scheme/boundary/boundary_condition.hpp"
#include "meshes/cavities.hpp"
#include "meshes/curved_groups.hpp"
#include "meshes/parts.hpp"
#include "meshes/pinches.hpp"
#include "meshes/single_cells.hpp"

#include <algorithm>
#include <fmt/format.h>

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

/// Of a file: hinges, which transmit forces and no moments, and holes that open there.
void note_pinches(const meshes::Mesh& mesh, std::vector<std::string>& notices) {
  const std::vector<std::int32_t> nodes = meshes::pinched_nodes(mesh);
  if (nodes.empty()) return;
  const meshes::Vec3& X = mesh.nodes[static_cast<size_t>(nodes.front())];
  const std::string where =
      fmt::format("at {} {}, the first at ({:.6g}, {:.6g}, {:.6g}) m", nodes.size(),
                  nodes.size() == 1 ? "node" : "nodes", X[0], X[1], X[2]);
  const std::int64_t n = meshes::n_parts_by_faces(mesh), apart = meshes::n_parts(mesh);
  if (n > apart) {
    notices.push_back(fmt::format(
        "mesh: {} parts of cells hang together by less than a face, {}: they turn about it as "
        "about a hinge, with stresses there that no refinement bounds",
        n, where));
    return;
  }
  notices.push_back(fmt::format(
      "mesh: the surface of the body touches itself {}: around it cells hang together by less than "
      "a face, or are missing, unless it is meant",
      where));
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

/// Whether nothing but loads acts on a group.
bool is_free(const cases::Case& setup, const std::string& group) {
  return std::none_of(setup.boundaries.begin(), setup.boundaries.end(), [&](const auto& boundary) {
    return scheme::boundary_menu().at(boundary.type).acts != scheme::BoundaryKind::Acts::load &&
           std::find(boundary.groups.begin(), boundary.groups.end(), group) !=
               boundary.groups.end();
  });
}

constexpr const char* of_single_cells =
    "a body of one cell across bends several times as stiffly as it should, of long cells more "
    "than ten times; give two or more, of triangles four";

/// A single cell shears where it should bend.
void note_single_cells_of_box(const cases::Case& setup,
                              int level,
                              std::vector<std::string>& notices) {
  if (level > 0) return;
  for (int i = 0; i < cases::dimension_of(setup.mesh); ++i) {
    const std::string axis(1, "xyz"[i]);
    if (setup.mesh.cells[static_cast<size_t>(i)] != 1 || !is_free(setup, axis + "_min") ||
        !is_free(setup, axis + "_max"))
      continue;
    notices.push_back(
        fmt::format("mesh: one cell along {}, whose sides are free: {}", axis, of_single_cells));
  }
}

void note_single_cells(const cases::Case& setup,
                       const meshes::Mesh& mesh,
                       std::vector<std::string>& notices) {
  std::vector<char> is_held(mesh.boundary_faces.size(), 0);
  for (const meshes::BoundaryGroup& group : mesh.boundary_groups) {
    if (is_free(setup, group.name)) continue;
    for (const std::int32_t f : group.faces)
      is_held[static_cast<size_t>(f)] = 1;
  }
  const std::int64_t n = meshes::n_single_cells(mesh, is_held);
  if (n == 0) return;
  notices.push_back(
      fmt::format("mesh: {} of {} cells are alone between two opposite sides that are free: {}", n,
                  mesh.n_cells(), of_single_cells));
}

}  // namespace

void note_mesh(const cases::Case& setup,
               const meshes::Mesh& mesh,
               int level,
               std::vector<std::string>& notices) {
  if (setup.mesh.file.empty()) {
    note_single_cells_of_box(setup, level, notices);
  } else {
    note_cavities(mesh, notices);
    note_parts(mesh, notices);
    note_pinches(mesh, notices);
    note_single_cells(setup, mesh, notices);
  }
  note_curved_symmetries(setup, mesh, notices);
}

}  // namespace diptych::harness
