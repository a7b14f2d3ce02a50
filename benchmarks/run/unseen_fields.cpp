#include "benchmarks/run/unseen_fields.hpp"

#include "common/base/error.hpp"
#include "common/functions/placed_values.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <random>
#include <span>
#include <string>

namespace diptych::harness {

namespace {

using algebra::Vec3;

/// Places in cells or faces, each with its corners and their weights there.
struct Places {
  std::vector<Vec3> X;
  std::vector<std::span<const std::int32_t>> corners;
  std::vector<std::array<double, 8>> weights;
};

/// In every one of few, in evenly spread ones of many.
/// @param corners_of  of one of them, spans that stay valid
template <class Corners>
Places places_in(const meshes::Mesh& mesh, std::int64_t n, const Corners& corners_of) {
  constexpr std::int64_t n_places = 100000;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> part(0, 1);
  Places places;
  for (std::int64_t k = 0; n > 0 && k < n_places; ++k) {
    const std::span<const std::int32_t> nodes = corners_of(k * n / n_places);
    std::array<double, 8> weights{};
    double sum = 0;
    for (size_t i = 0; i < nodes.size(); ++i) {
      // logarithms alone would keep to the middle of cells of eight corners
      weights[i] = std::pow(-std::log1p(-part(random)), 2);
      sum += weights[i];
    }
    Vec3 X = Vec3::Zero();
    for (size_t i = 0; i < nodes.size(); ++i) {
      weights[i] /= sum;
      X += weights[i] * mesh.nodes[static_cast<size_t>(nodes[i])];
    }
    places.X.push_back(X);
    places.corners.push_back(nodes);
    places.weights.push_back(weights);
  }
  return places;
}

Places places_in_cells(const meshes::Mesh& mesh) {
  return places_in(mesh, mesh.n_cells(), [&](std::int64_t c) { return mesh.cell(c); });
}

Places places_on_faces(const meshes::Mesh& mesh, const meshes::BoundaryGroup& group) {
  return places_in(mesh, std::ssize(group.faces), [&](std::int64_t k) {
    const meshes::BoundaryFace& face =
        mesh.boundary_faces[static_cast<size_t>(group.faces[static_cast<size_t>(k)])];
    return std::span(face.nodes).first(static_cast<size_t>(face.n_nodes));
  });
}

/// By which part of themselves values within cells or faces differ from those of nodes.
double unseen_part(const functions::VectorExpression& field,
                   const meshes::Mesh& mesh,
                   const Places& places,
                   double t) {
  const std::vector<Vec3> nodes = functions::vectors_at(field, mesh.nodes, t);
  const std::vector<Vec3> within = functions::vectors_at(field, places.X, t);
  double all = 0, unseen = 0;
  for (size_t k = 0; k < within.size(); ++k) {
    Vec3 seen = Vec3::Zero();
    const auto corners = places.corners[k];
    for (size_t i = 0; i < corners.size(); ++i)
      seen += places.weights[k][i] * nodes[static_cast<size_t>(corners[i])];
    all += std::max(within[k].norm(), seen.norm());
    unseen += (within[k] - seen).norm();
  }
  return all > 0 ? unseen / all : 0;
}

}  // namespace

void note_unseen_fields(const cases::Case& setup,
                        const meshes::Mesh& mesh,
                        std::vector<std::string>& notices) {
  constexpr double most = 0.3;
  const auto look = [&](const functions::VectorExpression& field, const std::string& name,
                        const auto& places) {
    double part = 0;
    for (const double instant : {0.0, 0.11, 0.31, 0.73, 1.0}) {
      if (instant > 0 && !field.depends_on_time()) break;
      try {
        part = std::max(part, unseen_part(field, mesh, places, instant * setup.time.end));
      } catch (const base::InputError&) {
        return;  // no value between some nodes, which nothing asks for
      }
    }
    if (part <= most) return;
    notices.push_back(fmt::format(
        "{}: between the nodes it differs by {:.0f} % from what they see of it, so that the body "
        "gets more or less than is meant; refine the mesh, or spread it over some cells",
        name, 100 * part));
  };
  const bool has_initial = !setup.initial.motion && setup.initial.velocity.depends_on_position();
  if (setup.body_force.depends_on_position() || has_initial) {
    const Places places = places_in_cells(mesh);
    if (setup.body_force.depends_on_position()) look(setup.body_force, "load.body_force", places);
    if (has_initial) look(setup.initial.velocity, "initial.velocity", places);
  }
  for (const cases::BoundaryCase& boundary : setup.boundaries) {
    // tractions and pressures are integrated (scheme/boundary/resolved_load)
    if (boundary.type != "velocity" || !boundary.value.depends_on_position()) continue;
    for (const meshes::BoundaryGroup& group : mesh.boundary_groups) {
      if (std::find(boundary.groups.begin(), boundary.groups.end(), group.name) !=
          boundary.groups.end())
        look(boundary.value, fmt::format("velocity of the group {}", group.name),
             places_on_faces(mesh, group));
    }
  }
}

}  // namespace diptych::harness
