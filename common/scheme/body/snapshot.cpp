#include "common/scheme/body/snapshot.hpp"

#include "common/parallel/for_chunks.hpp"
#include "common/scheme/body/material_model.hpp"
#include "common/scheme/body/node_chunks.hpp"
#include "common/scheme/body/point_access.hpp"

#include <algorithm>
#include <type_traits>

namespace diptych::scheme {

namespace {

/// J of nodes by the volumes of cells, of a rank's own; empty where these do not carry the
/// pressure.
template <int Dim>
std::vector<double> cell_ratios(const Body<Dim>& body, std::span<const std::int32_t> nodes) {
  if (!body.bulk) return {};
  const std::vector<double> all = body.bulk->ratios(body);
  std::vector<double> J;
  for (const std::int32_t a : nodes)
    J.push_back(all[a]);
  return J;
}

/// The entries of other ranks.
void complete(const parallel::Part& part, std::span<const std::int32_t> nodes, Snapshot& s) {
  if (part.is_whole()) return;
  std::vector<std::int32_t> chunks;
  for (const std::int32_t a : nodes)
    chunks.push_back(static_cast<std::int32_t>(chunk_of_node(a)));
  for (auto* field : {&s.u, &s.v})
    part.complete(*field, chunks);
  for (auto* field : {&s.F, &s.H, &s.P})
    part.complete(*field, chunks);
  part.complete(s.J, chunks);
  for (auto* branches : {&s.A, &s.S}) {
    for (std::vector<Mat3>& field : *branches)
      part.complete(field, chunks);
  }
}

/// Of a rank's own nodes.
/// @param node_of  node_of(k): the node of entry k
template <int Dim, class NodeOf>
void put_fields(const MaterialModel& material,
                const Body<Dim>& body,
                size_t n,
                const NodeOf& node_of,
                const std::vector<double>& cell_J,
                Snapshot& s) {
  const size_t n_branches = material.branches().size();
  for (auto* field : {&s.u, &s.v})
    field->resize(n);
  for (auto* field : {&s.F, &s.H, &s.P})
    field->resize(n);
  s.J.resize(n);
  s.A.resize(n_branches);
  s.S.resize(body.S.empty() ? 0 : n_branches);
  for (auto* branches : {&s.A, &s.S}) {
    for (std::vector<Mat3>& field : *branches)
      field.resize(n);
  }
  const auto take = [&](size_t k) {
    const std::int32_t a = node_of(k);
    if (!body.part().owns(chunk_of_node(a))) return;
    s.u[k] = s.v[k] = Vec3::Zero();
    for (int i = 0; i < Dim; ++i) {
      s.u[k][i] = body.u.at(a, i);
      s.v[k][i] = body.v.at(a, i);
    }
    const auto X = deformation_at(body, a);
    const auto branches = branches_at(body, a);
    s.F[k] = algebra::to_eigen(X.F);
    s.H[k] = algebra::to_eigen(X.H);
    s.J[k] = X.J;
    s.P[k] = algebra::to_eigen(material.stress(X, branches));
    if (!cell_J.empty()) {  // the pressure of the cells in place of that of the node
      s.P[k] += (material.volumetric_stress(cell_J[k]) - material.volumetric_stress(X.J)) * s.H[k];
      s.J[k] = cell_J[k];
    }
    for (size_t r = 0; r < n_branches; ++r) {
      s.A[r][k] = algebra::to_eigen(branches[r].A);
      if (!s.S.empty()) s.S[r][k] = algebra::to_eigen(branches[r].S);
    }
  };
  constexpr size_t together = 64;
  parallel::for_shares(static_cast<std::int64_t>((n + together - 1) / together),
                       [&](std::int64_t share) {
                         const size_t begin = static_cast<size_t>(share) * together;
                         for (size_t k = begin; k < std::min(n, begin + together); ++k)
                           take(k);
                       });
}

}  // namespace

Snapshot Snapshot::of(std::span<const std::int32_t> nodes) const {
  const auto picked = [&](const auto& field) {
    std::remove_cvref_t<decltype(field)> values;
    values.reserve(nodes.size());
    for (const std::int32_t a : nodes)
      values.push_back(field[static_cast<size_t>(a)]);
    return values;
  };
  Snapshot s{time, picked(u), picked(v), picked(F), picked(H), picked(P), picked(J), {}, {}};
  for (const std::vector<Mat3>& field : A)
    s.A.push_back(picked(field));
  for (const std::vector<Mat3>& field : S)
    s.S.push_back(picked(field));
  return s;
}

template <int Dim>
Snapshot snapshot_of(const MaterialModel& material,
                     const Body<Dim>& body,
                     double time,
                     std::span<const std::int32_t> nodes) {
  Snapshot s;
  s.time = time;
  put_fields(
      material, body, nodes.size(), [&](size_t k) { return nodes[k]; }, cell_ratios(body, nodes),
      s);
  complete(body.part(), nodes, s);
  return s;
}

template <int Dim>
void visit_chunks(
    const MaterialModel& material,
    const Body<Dim>& body,
    double time,
    const std::function<void(std::int64_t chunk, std::int64_t first, const Snapshot&)>& visit) {
  const std::vector<double> cell_J = body.bulk ? body.bulk->ratios(body) : std::vector<double>();
  parallel::for_chunks(
      body.part(), body.n_blocks, [&](std::int64_t begin, std::int64_t end, std::int64_t chunk) {
        const std::int64_t first = begin * algebra::n_lanes,
                           last = std::min(body.n_owned, end * algebra::n_lanes);
        Snapshot s;
        s.time = time;
        std::vector<double> J;
        if (!cell_J.empty()) J.assign(cell_J.begin() + first, cell_J.begin() + last);
        put_fields(
            material, body, static_cast<size_t>(last - first),
            [&](size_t k) {
              return static_cast<std::int32_t>(first) + static_cast<std::int32_t>(k);
            },
            J, s);
        visit(chunk, first, s);
      });
}

template <int Dim>
void take_snapshot(const MaterialModel& material,
                   const Body<Dim>& body,
                   double time,
                   Snapshot& snapshot) {
  snapshot.time = time;
  const std::vector<double> cell_J = body.bulk ? body.bulk->ratios(body) : std::vector<double>();
  put_fields(
      material, body, static_cast<size_t>(body.n_owned),
      [](size_t k) { return static_cast<std::int32_t>(k); }, cell_J, snapshot);
}

#define DIPTYCH_INSTANTIATE(Dim)                                                          \
  template Snapshot snapshot_of(const MaterialModel&, const Body<Dim>&, double,           \
                                std::span<const std::int32_t>);                           \
  template void take_snapshot(const MaterialModel&, const Body<Dim>&, double, Snapshot&); \
  template void visit_chunks(                                                             \
      const MaterialModel&, const Body<Dim>&, double,                                     \
      const std::function<void(std::int64_t, std::int64_t, const Snapshot&)>&);
DIPTYCH_INSTANTIATE(2)
DIPTYCH_INSTANTIATE(3)
#undef DIPTYCH_INSTANTIATE

}  // namespace diptych::scheme
