#include "benchmarks/run/unseen_fields.hpp"

#include "common/base/error.hpp"
#include "common/functions/placed_values.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <random>

namespace diptych::harness {

namespace {

using algebra::Vec3;

/// Places in cells, each with the weights of the cell's nodes there.
struct Places {
  std::vector<Vec3> X;
  std::vector<std::int64_t> cell;
  std::vector<std::array<double, 8>> weights;
};

/// In every cell of small meshes, in evenly spread ones of large meshes.
Places places_in(const meshes::Mesh& mesh) {
  constexpr std::int64_t n_places = 100000;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> part(0, 1);
  Places places;
  for (std::int64_t k = 0; k < n_places; ++k) {
    const std::int64_t c = k * mesh.n_cells() / n_places;
    const auto nodes = mesh.cell(c);
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
    places.cell.push_back(c);
    places.weights.push_back(weights);
  }
  return places;
}

/// By which part of themselves values within cells differ from those of nodes.
double unseen_part(const functions::VectorExpression& field,
                   const meshes::Mesh& mesh,
                   const Places& places,
                   double t) {
  const std::vector<Vec3> nodes = functions::vectors_at(field, mesh.nodes, t);
  const std::vector<Vec3> within = functions::vectors_at(field, places.X, t);
  double all = 0, unseen = 0;
  for (size_t k = 0; k < within.size(); ++k) {
    Vec3 seen = Vec3::Zero();
    const auto corners = mesh.cell(places.cell[k]);
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
  std::optional<Places> places;
  const auto look = [&](const functions::VectorExpression& field, const char* name) {
    if (!field.depends_on_position()) return;
    if (!places) places = places_in(mesh);
    double part = 0;
    for (const double instant : {0.0, 0.11, 0.31, 0.73, 1.0}) {
      if (instant > 0 && !field.depends_on_time()) break;
      try {
        part = std::max(part, unseen_part(field, mesh, *places, instant * setup.time.end));
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
  look(setup.body_force, "load.body_force");
  if (!setup.initial.motion) look(setup.initial.velocity, "initial.velocity");
}

}  // namespace diptych::harness
