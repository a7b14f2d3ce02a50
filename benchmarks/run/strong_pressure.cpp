#include "benchmarks/run/strong_pressure.hpp"

#include "common/base/error.hpp"
#include "common/cases/reader.hpp"
#include "common/functions/break_times.hpp"
#include "common/functions/placed_values.hpp"
#include "common/scheme/boundary/boundary_condition.hpp"
#include "common/scheme/graph/equal_widths.hpp"
#include "meshes/cell_shares.hpp"
#include "meshes/cell_widths.hpp"
#include "meshes/shape_integrals.hpp"
#include "meshes/structured_block.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <span>
#include <vector>

namespace diptych::harness {

namespace {

using functions::Expression;
using meshes::Vec3;

/// Bulk over shear modulus.
constexpr double least_bulk = 2.5;

/// Shear moduli of pressure that nodes bear with operators that sum by parts: moulds on nodes moved
/// by 20 and 30 % are stable under 1.5 and not under 2, at nu from 0.3 to 0.49 (notes 3.9).
constexpr double borne = 1.5;

/// Long cells bear less: of those twice, three and four times as long as wide pressures of 1.4, 1.4
/// and 0.5 shear moduli made moulds flow, not 0.74, 0.49 and 0.37.
double borne_on(const meshes::Mesh& mesh) {
  if (!scheme::has_long_cells_off_boxes(mesh)) return borne;
  return borne / meshes::aspect_of(meshes::mean_shape(mesh));
}

constexpr int n_intervals = 64;

/// Corners of faces with their outward unit normals.
struct Corners {
  std::vector<Vec3> X, normal;
};

Corners corners_of(const meshes::Mesh& mesh, const meshes::BoundaryGroup& group) {
  Corners corners;
  for (const std::int32_t f : group.faces) {
    const meshes::BoundaryFace& face = mesh.boundary_faces[f];
    const auto shares = meshes::face_area_shares(face, mesh.nodes, meshes::Quadrature::vertex);
    for (int k = 0; k < face.n_nodes; ++k) {
      corners.X.push_back(mesh.nodes[face.nodes[k]]);
      corners.normal.push_back(shares[k].normalized());
    }
  }
  return corners;
}

/// The expressions that load a boundary: a pressure, the components of a traction, or none.
std::vector<Expression> load_of(const cases::BoundaryCase& boundary) {
  if (!boundary.pressure.is_zero()) return {boundary.pressure};
  if (boundary.type != "traction" || boundary.value.is_zero()) return {};
  return {boundary.value.component.begin(), boundary.value.component.end()};
}

bool depends_on_position(const std::vector<Expression>& load) {
  return std::any_of(load.begin(), load.end(),
                     [](const Expression& e) { return e.depends_on_position(); });
}

/// Evenly, and where a load has its jumps and kinks, between these, and its largest size at a place
/// among many more instants: a pulse may be short beside the run.
std::vector<double> instants_of(const std::vector<Expression>& load, double end, const Vec3& X) {
  constexpr size_t most = 128;
  std::vector<double> instants =
      functions::instants_around(functions::break_times(load, 0, end), 0, 0.5, most);
  for (int i = 0; i <= n_intervals; ++i)
    instants.push_back(end * i / n_intervals);
  constexpr int many = 4096;
  const functions::PlacedExpressions placed(load, {&X, 1});
  double largest = 0, at = 0;
  for (int i = 0; i <= many; ++i) {
    double size = 0;
    try {
      for (const double value : placed.at(end * i / many))
        size += value * value;
    } catch (const base::Error&) {
      continue;
    }
    if (size > largest) largest = size, at = end * i / many;
  }
  instants.push_back(at);
  return instants;
}

/// Largest size(value, normal) of a load over the corners and the instants of a run. An instant at
/// which the load has no value is left out, of which a run that gets there tells.  [Pa]
template <class Size>
double largest_of(const std::vector<Expression>& load,
                  const Corners& corners,
                  double end,
                  const Size& size) {
  if (corners.X.empty()) return 0;
  const bool moves = depends_on_position(load);
  const bool changes = std::any_of(load.begin(), load.end(),
                                   [](const Expression& e) { return e.depends_on_time(); });
  const std::span<const Vec3> X(corners.X.data(), moves ? corners.X.size() : 1);
  const functions::PlacedExpressions placed(load, X);
  double largest = 0;
  for (const double t :
       changes ? instants_of(load, end, corners.X.front()) : std::vector<double>{0.0}) {
    std::vector<double> values;
    try {
      values = placed.at(t);
    } catch (const base::Error&) {
      continue;
    }
    for (size_t k = 0; k < corners.X.size(); ++k) {
      const double* value = &values[moves ? load.size() * k : 0];
      const Vec3& N = corners.normal[k];
      largest = std::max(
          largest,
          size(load.size() == 1 ? Vec3(-*value * N) : Vec3(value[0], value[1], value[2]), N));
    }
  }
  return largest;
}

/// With which it presses.
double largest_pressure(const std::vector<Expression>& load, const Corners& corners, double end) {
  return largest_of(load, corners, end, [](const Vec3& t, const Vec3& N) { return -N.dot(t); });
}

/// Of body forces, over the body as far as these places of it reach  [Pa]
double weight_of(const cases::Case& setup, const std::vector<Vec3>& places) {
  if (setup.body_force.is_zero()) return 0;
  Vec3 least = places.front(), most = least;
  for (const Vec3& X : places) {
    least = least.cwiseMin(X);
    most = most.cwiseMax(X);
  }
  const Corners everywhere{places, std::vector<Vec3>(places.size(), Vec3::Zero())};
  const auto& force = setup.body_force.component;
  return (most - least).norm() * largest_of({force.begin(), force.end()}, everywhere,
                                            setup.time.end,
                                            [](const Vec3& f, const Vec3&) { return f.norm(); });
}

bool holds_the_normal(const cases::BoundaryCase& boundary) {
  const scheme::BoundaryKind::Acts acts = scheme::boundary_menu().at(boundary.type).acts;
  return acts == scheme::BoundaryKind::Acts::hold || boundary.type == "symmetry";
}

/// Of the mesh; nothing where there is none of that name, of which the solver tells.
const meshes::BoundaryGroup* group_of(const meshes::Mesh& mesh, const std::string& name) {
  for (const meshes::BoundaryGroup& group : mesh.boundary_groups) {
    if (group.name == name) return &group;
  }
  return nullptr;
}

/// Of each face of the boundary, whether no support holds its normal.
std::vector<char> free_faces(const cases::Case& setup, const meshes::Mesh& mesh) {
  std::vector<char> is_free(mesh.boundary_faces.size(), 1);
  for (const cases::BoundaryCase& boundary : setup.boundaries) {
    if (!holds_the_normal(boundary)) continue;
    for (const std::string& name : boundary.groups) {
      const meshes::BoundaryGroup* group = group_of(mesh, name);
      if (group == nullptr) continue;
      for (const std::int32_t f : group->faces)
        is_free[f] = 0;
    }
  }
  return is_free;
}

bool is_held_on_all_sides(const cases::Case& setup, const meshes::Mesh& mesh) {
  const std::vector<char> is_free = free_faces(setup, mesh);
  return std::find(is_free.begin(), is_free.end(), 1) == is_free.end();
}

/// A body that lies in its supports as a liquid in a vessel, so that its weight is a pressure.
class Vessel {
 public:
  Vessel(const cases::Case& setup, const meshes::Mesh& mesh) : mesh_(mesh) {
    const std::vector<char> is_free = free_faces(setup, mesh);
    for (size_t f = 0; f < is_free.size(); ++f) {
      const Vec3 area = face_area(mesh.boundary_faces[f], mesh.nodes);
      (is_free[f] != 0 ? free_ : held_).push_back(area.normalized());
    }
  }

  /// Whether nothing is free but what faces against a force.
  bool holds(const Vec3& direction) const {
    constexpr double against = -0.5;  // cosine: 60 degrees
    return !held_.empty() && std::all_of(free_.begin(), free_.end(),
                                         [&](const Vec3& N) { return N.dot(direction) < against; });
  }

  /// Pressure at the lower end of a force that is so large in the mean: of what is held on all
  /// sides, half of it hangs on the upper one.  [Pa]
  double pressure(const Vec3& force) const {
    const Vec3 direction = force.normalized();
    double least = mesh_.nodes.front().dot(direction), most = least;
    for (const Vec3& X : mesh_.nodes) {
      least = std::min(least, X.dot(direction));
      most = std::max(most, X.dot(direction));
    }
    return (free_.empty() ? 0.5 : 1) * force.norm() * (most - least);
  }

 private:
  const meshes::Mesh& mesh_;
  std::vector<Vec3> free_, held_;  ///< unit normals
};

/// The largest pressure that body forces make of a body in a vessel, at the instants of a run, by
/// their mean over the nodes.  [Pa]
double pressure_of_weight(const cases::Case& setup, const meshes::Mesh& mesh) {
  if (setup.body_force.is_zero()) return 0;
  const Vessel vessel(setup, mesh);
  const auto& force = setup.body_force.component;
  const functions::PlacedExpressions placed({force.begin(), force.end()}, mesh.nodes);
  double largest = 0;
  for (int i = 0; i <= n_intervals; ++i) {
    std::vector<double> values;
    try {
      values = placed.at(setup.time.end * i / n_intervals);
    } catch (const base::Error&) {
      continue;
    }
    Vec3 mean = Vec3::Zero();
    for (size_t k = 0; k + 2 < values.size(); k += 3)
      mean += Vec3(values[k], values[k + 1], values[k + 2]);
    mean *= 3 / static_cast<double>(values.size());
    if (mean.norm() > 0 && vessel.holds(mean.normalized()))
      largest = std::max(largest, vessel.pressure(mean));
  }
  return largest;
}

double bulk_of(const cases::MaterialCase& material) {
  return material.lame + 2.0 / 3 * material.shear_modulus;
}

double volume_within(const meshes::Mesh& mesh, const std::vector<Vec3>& x) {
  double volume = 0;
  for (const meshes::BoundaryFace& face : mesh.boundary_faces) {
    const auto shares = meshes::face_area_shares(face, x, meshes::Quadrature::vertex);
    for (int k = 0; k < face.n_nodes; ++k)
      volume += shares[k].dot(x[static_cast<size_t>(face.nodes[k])]) / mesh.dimension;
  }
  return volume;
}

/// Nodes that a support moves, and how fast.
struct MovedSide {
  std::vector<std::int32_t> nodes;
  functions::PlacedExpressions velocity;
};

std::vector<MovedSide> moved_sides(const cases::Case& setup, const meshes::Mesh& mesh) {
  std::vector<MovedSide> sides;
  std::vector<char> is_moved(mesh.nodes.size(), 0);  // nodes of edges have one velocity
  for (const cases::BoundaryCase& boundary : setup.boundaries) {
    if (boundary.type != "velocity" || boundary.value.is_zero() || boundary.manufactured) continue;
    std::vector<std::int32_t> nodes;
    std::vector<Vec3> X;
    for (const std::string& name : boundary.groups) {
      const meshes::BoundaryGroup* group = group_of(mesh, name);
      if (group == nullptr) continue;
      for (const std::int32_t f : group->faces) {
        const meshes::BoundaryFace& face = mesh.boundary_faces[f];
        for (int k = 0; k < face.n_nodes; ++k) {
          const auto a = static_cast<size_t>(face.nodes[k]);
          if (is_moved[a] != 0) continue;
          is_moved[a] = 1;
          nodes.push_back(face.nodes[k]);
          X.push_back(mesh.nodes[a]);
        }
      }
    }
    const auto& velocity = boundary.value.component;
    sides.push_back(
        {std::move(nodes), functions::PlacedExpressions({velocity.begin(), velocity.end()}, X)});
  }
  return sides;
}

/// The least share of its volume that a body has when supports that hold all of its boundary have
/// moved it; what has no value, of which a run that gets there tells, moves nothing.
double least_volume(const cases::Case& setup, const meshes::Mesh& mesh) {
  const std::vector<MovedSide> sides = moved_sides(setup, mesh);
  if (sides.empty()) return 1;
  const double whole = volume_within(mesh, mesh.nodes), dt = setup.time.end / n_intervals;
  std::vector<Vec3> x = mesh.nodes;
  double least = 1;
  for (int i = 0; i < n_intervals; ++i) {
    for (const MovedSide& side : sides) {
      std::vector<double> v;
      try {
        v = side.velocity.at((i + 0.5) * dt);
      } catch (const base::Error&) {
        continue;
      }
      for (size_t k = 0; k < side.nodes.size(); ++k)
        x[static_cast<size_t>(side.nodes[k])] += dt * Vec3(v[3 * k], v[3 * k + 1], v[3 * k + 2]);
    }
    least = std::min(least, volume_within(mesh, x) / whole);
  }
  return least;
}

/// Of a body that is held on all sides.
std::string volume_because(const cases::Case& setup, const meshes::Mesh& mesh) {
  if (is_nearly_incompressible(setup.material)) {
    return "cells carry the pressure of this nearly incompressible body, which is held on all "
           "sides";
  }
  const double J = least_volume(setup, mesh), mu = setup.material.shear_modulus;
  // 7.9 shear moduli at J = 0.216 and nu = 0.3, where the pressure is 5.5
  if (J > 0 && bulk_of(setup.material) * (1 / J - 1) <= borne_on(mesh) * mu) return "";
  return fmt::format(
      "cells carry the pressure of this body, whose supports leave it {:.3g} of its "
      "volume",
      std::max(J, 0.0));
}

}  // namespace

bool is_nearly_incompressible(const cases::MaterialCase& material) {
  return bulk_of(material) > least_bulk * material.shear_modulus;
}

bool holds_with_lines(const cases::MaterialCase& material) {
  constexpr double least_of_areas = 0.25;  // of the shear modulus, as xi + zeta
  return is_nearly_incompressible(material) && material.zeta_ratio >= least_of_areas;
}

std::string strong_pressure_because(const cases::Case& setup,
                                    const std::string& method,
                                    const meshes::Mesh& mesh) {
  if (setup.scheme.volumes != "auto") return "";
  if (method != "sph" && !meshes::is_undistorted_block(mesh) &&
      !meshes::areas_are_of_cells(mesh, meshes::Quadrature::vertex))
    return "";
  if (is_held_on_all_sides(setup, mesh)) {
    if (const std::string because = volume_because(setup, mesh); !because.empty()) return because;
  }
  const double most = borne_on(mesh);
  const double weight = pressure_of_weight(setup, mesh) / setup.material.shear_modulus;
  if (weight > most) {
    return fmt::format(
        "cells carry the pressure of the body's own weight, which comes to {:.3g} shear moduli",
        weight);
  }
  for (const cases::BoundaryCase& boundary : setup.boundaries) {
    const std::vector<Expression> load = load_of(boundary);
    if (load.empty()) continue;
    for (const std::string& name : boundary.groups) {
      const meshes::BoundaryGroup* group = group_of(mesh, name);
      if (group == nullptr) continue;
      const double ratio = largest_pressure(load, corners_of(mesh, *group), setup.time.end) /
                           setup.material.shear_modulus;
      if (ratio > most) {
        return fmt::format("cells carry the pressure on \"{}\", which comes to {:.3g} shear moduli",
                           name, ratio);
      }
    }
  }
  return "";
}

bool can_press(const cases::Case& setup, const meshes::Mesh& mesh) {
  const double little = 0.1 * setup.material.shear_modulus;
  if (!setup.initial.displacement.is_zero() || setup.initial.deformation_gradient || setup.motion)
    return true;
  for (const Vec3& v : functions::vectors_at(setup.initial.velocity, mesh.nodes, 0))
    if (setup.material.density * v.squaredNorm() > little) return true;
  if (weight_of(setup, mesh.nodes) > little) return true;
  for (const cases::BoundaryCase& boundary : setup.boundaries) {
    const std::vector<Expression> load = load_of(boundary);
    if (load.empty() && (!boundary.value.is_zero() || boundary.manufactured)) return true;
    for (const std::string& name : boundary.groups) {
      const meshes::BoundaryGroup* group = group_of(mesh, name);
      if (load.empty() || group == nullptr) continue;
      if (largest_of(load, corners_of(mesh, *group), setup.time.end,
                     [](const Vec3& t, const Vec3&) { return t.norm(); }) > little)
        return true;
    }
  }
  return false;
}

bool may_press_strongly(const cases::Case& setup) {
  if (setup.scheme.volumes != "auto") return false;
  const Vec3 e[3] = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  const Corners any_side{std::vector<Vec3>(6, Vec3::Zero()),
                         {e[0], e[1], e[2], -e[0], -e[1], -e[2]}};
  size_t n_held = 0;
  for (const cases::BoundaryCase& boundary : setup.boundaries) {
    if (holds_the_normal(boundary)) n_held += boundary.groups.size();
    const std::vector<Expression> load = load_of(boundary);
    if (load.empty()) continue;
    if (depends_on_position(load) ||
        largest_pressure(load, any_side, setup.time.end) > borne * setup.material.shear_modulus)
      return true;
  }
  // of a mesh from a file one group may be all of the boundary
  const size_t n_sides =
      setup.mesh.file.empty() ? 2 * static_cast<size_t>(cases::dimension_of(setup.mesh)) : 1;
  const auto moves = [](const cases::BoundaryCase& boundary) {
    return boundary.type == "velocity" && !boundary.value.is_zero();
  };
  if (setup.mesh.file.empty() && n_held + 1 >= n_sides &&
      weight_of(setup, {setup.mesh.lower, setup.mesh.upper}) > borne * setup.material.shear_modulus)
    return true;
  return n_held >= n_sides &&
         (is_nearly_incompressible(setup.material) ||
          std::any_of(setup.boundaries.begin(), setup.boundaries.end(), moves));
}

}  // namespace diptych::harness
