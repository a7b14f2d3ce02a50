#include "common/run/probes.hpp"

#include "common/base/error.hpp"
#include "common/run/boundary_group.hpp"
#include "common/scheme/boundary/patch_faces.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <map>
#include <numeric>

namespace diptych::run {

namespace {

[[noreturn]] void refuse_point(const cases::ProbeCase& probe, const std::vector<Vec3>& X) {
  const Vec3 nearest = *std::min_element(X.begin(), X.end(), [&](const Vec3& a, const Vec3& b) {
    return (a - probe.at).norm() < (b - probe.at).norm();
  });
  throw base::InputError(
      fmt::format("{}probe '{}' is in no cell of the mesh, {:.3g} m away from the nearest node, at "
                  "({:g}, {:g}, "
                  "{:g}); its point must be in the body",
                  functions::prefix(probe.where), probe.name, (nearest - probe.at).norm(),
                  nearest[0], nearest[1], nearest[2]));
}

Interpolation interpolation_of(const cases::ProbeCase& probe,
                               const scheme::PairGraph& graph,
                               const MeshAround& mesh) {
  const std::vector<std::int32_t> corners = mesh.cells_at(probe.at);
  if (corners.empty()) refuse_point(probe, graph.X);
  const std::vector<std::int32_t> nearest = nearest_nodes(probe.at, graph.X, corners, mesh.nodes);
  // Omega of a corner is a part of a cell: its edge is up to 2^d times as large
  const double spacing = 2 * std::pow(graph.Omega[nearest.front()], 1.0 / graph.dimension);
  return interpolation_at(probe.at, graph.X, graph.dimension, nearest, spacing, mesh.nodes);
}

/// Whether these fields hold all that the quantity of a probe reads.
bool gives(const Snapshot& fields, const cases::ProbeCase& probe) {
  if (probe.kind == "reaction") return false;
  const std::vector<std::string> names = probe.fields->names();
  const std::string text = probe.quantity.text();
  const auto in_name = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
  };
  for (size_t begin = 0, end = 0; begin < text.size(); begin = end) {
    for (end = begin + 1; in_name(text[begin]) && end < text.size() && in_name(text[end]);)
      ++end;
    const std::string name = text.substr(begin, end - begin);
    if (std::find(names.begin(), names.end(), name) == names.end()) continue;
    const bool is_stress = name[0] == 's' || name == "mises" || name == "p";
    if (name[0] == 'u' && fields.u.empty()) return false;
    if (name[0] == 'v' && fields.v.empty()) return false;
    if ((name[0] == 'F' || name[0] == 'J' || is_stress) && fields.F.empty()) return false;
    if ((name[0] == 'P' || is_stress) && fields.P.empty()) return false;
  }
  return true;
}

cases::NodeValues node_of(const Snapshot& s, size_t k) {
  return {s.u[k], s.v[k], s.F[k], s.P[k], s.J[k]};
}

}  // namespace

std::vector<std::string> probe_columns(const std::vector<cases::ProbeCase>& probes, bool stepped) {
  std::vector<std::string> columns;
  for (const cases::ProbeCase& probe : probes) {
    if (!stepped || probe.every_step) columns.push_back(probe.column());
  }
  return columns;
}

Probes::PlacedProbe Probes::placed(const cases::ProbeCase& probe,
                                   const scheme::PairGraph& graph,
                                   const MeshAround& mesh) {
  PlacedProbe result{probe, {}, {}};
  if (probe.kind == "point") {
    auto [nodes, weights] = interpolation_of(probe, graph, mesh);
    result.nodes = std::move(nodes);
    result.weights = std::move(weights);
    return result;
  }
  if (probe.groups.empty()) {
    result.nodes.resize(graph.X.size());
    std::iota(result.nodes.begin(), result.nodes.end(), 0);
    result.weights = graph.Omega;
  } else {
    std::map<std::int32_t, double> area;
    for (const auto* patch : patches_with_each_face_once(graph, probe.groups, probe.where)) {
      const std::vector<double> of_patch = scheme::areas_as_numbers(graph, *patch);
      for (size_t k = 0; k < of_patch.size(); ++k)
        area[patch->nodes[k]] += of_patch[k];
    }
    for (const auto& [node, weight] : area) {
      result.nodes.push_back(node);
      result.weights.push_back(weight);
    }
  }
  if (probe.region) keep_region(graph, result);
  return result;
}

void Probes::keep_region(const scheme::PairGraph& graph, PlacedProbe& placed) {
  const cases::ProbeCase& probe = placed.probe;
  PlacedProbe kept{probe, {}, {}};
  bool any = false;
  for (size_t k = 0; k < placed.nodes.size(); ++k) {
    const bool in_region = (*probe.region)(graph.X[placed.nodes[k]], 0) != 0;
    any = any || in_region;
    // a checkerboard is seen against neighbours, which may be outside
    if (!in_region && probe.kind != "checkerboard") continue;
    kept.nodes.push_back(placed.nodes[k]);
    kept.weights.push_back(in_region ? placed.weights[k] : 0);
  }
  if (!any) {
    throw base::InputError(
        fmt::format("{}no node of probe '{}' is in its region, '{}'; give it one "
                    "in reference coordinates [m]",
                    functions::prefix(probe.where), probe.name, probe.region->text()));
  }
  placed = std::move(kept);
}

Probes::Probes(const std::vector<cases::ProbeCase>& probes,
               const scheme::PairGraph& graph,
               const MeshAround& mesh) {
  if (probes.empty()) return;
  X_ = graph.X;
  for (const cases::ProbeCase& probe : probes) {
    const PlacedProbe where = placed(probe, graph, mesh);
    all_.add(where);
    if (probe.every_step) stepped_.add(where);
    if (probe.kind == "checkerboard" && !checkerboard_)
      checkerboard_.emplace(graph.X, graph.Omega, graph.dimension, mesh.nodes);
  }
}

void Probes::Selection::add(const PlacedProbe& placed) {
  probes.push_back(placed);
  if (placed.probe.kind == "reaction") return;
  std::vector<std::int32_t> merged;
  std::set_union(nodes.begin(), nodes.end(), placed.nodes.begin(), placed.nodes.end(),
                 std::back_inserter(merged));
  nodes = std::move(merged);
}

std::vector<double> Probes::evaluate(const Selection& selection, Solver& solver) const {
  const Snapshot snapshot = solver.snapshot(std::span<const std::int32_t>(selection.nodes));
  std::vector<double> results;
  for (const PlacedProbe& placed : selection.probes) {
    if (placed.probe.kind == "reaction") {
      results.push_back(solver.reaction(placed.nodes).dot(placed.probe.direction));
      continue;
    }
    std::vector<double> values;
    auto next = selection.nodes.begin();
    for (const std::int32_t node : placed.nodes) {
      next = std::lower_bound(next, selection.nodes.end(), node);
      placed.probe.fields->set(
          node_of(snapshot, static_cast<size_t>(next - selection.nodes.begin())));
      values.push_back(placed.probe.quantity(X_[static_cast<size_t>(node)], snapshot.time));
    }
    results.push_back(reduced(placed.probe.kind, values, placed.weights));
  }
  return results;
}

std::vector<Vec3> Probes::places() const {
  std::vector<Vec3> X;
  for (const std::int32_t a : all_.nodes)
    X.push_back(X_[static_cast<size_t>(a)]);
  return X;
}

std::vector<std::optional<double>> Probes::exact_values(const Snapshot& exact) const {
  std::vector<std::optional<double>> results;
  for (const PlacedProbe& placed : all_.probes) {
    if (!gives(exact, placed.probe)) {
      results.emplace_back();
      continue;
    }
    std::vector<double> values;
    auto next = all_.nodes.begin();
    for (const std::int32_t node : placed.nodes) {
      next = std::lower_bound(next, all_.nodes.end(), node);
      const auto a = static_cast<size_t>(next - all_.nodes.begin());
      cases::NodeValues fields;
      if (!exact.u.empty()) fields.u = exact.u[a];
      if (!exact.v.empty()) fields.v = exact.v[a];
      if (!exact.F.empty()) fields.F = exact.F[a], fields.J = exact.J[a];
      if (!exact.P.empty()) fields.P = exact.P[a];
      placed.probe.fields->set(fields);
      values.push_back(placed.probe.quantity(X_[static_cast<size_t>(node)], exact.time));
    }
    results.emplace_back(reduced(placed.probe.kind, values, placed.weights));
  }
  return results;
}

double Probes::reduced(const std::string& kind,
                       const std::vector<double>& values,
                       const std::vector<double>& weights) const {
  if (kind == "checkerboard") return checkerboard_->part_of(values, weights);
  if (kind == "least") return *std::min_element(values.begin(), values.end());
  if (kind == "greatest") return *std::max_element(values.begin(), values.end());
  const double integral = std::inner_product(values.begin(), values.end(), weights.begin(), 0.0);
  if (kind == "integral") return integral;
  return integral / std::accumulate(weights.begin(), weights.end(), 0.0);
}

}  // namespace diptych::run
