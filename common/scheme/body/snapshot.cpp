#include "common/scheme/body/snapshot.hpp"

#include "common/scheme/body/material_model.hpp"
#include "common/scheme/body/point_access.hpp"

#include <numeric>

namespace diptych::scheme {

template <int Dim>
Snapshot snapshot_of(const MaterialModel& material,
                     const Body<Dim>& body,
                     double time,
                     std::span<const std::int32_t> nodes) {
  const size_t n = nodes.size(), n_branches = material.branches().size();
  Snapshot s;
  s.time = time;
  s.u.assign(n, Vec3::Zero());
  s.v.assign(n, Vec3::Zero());
  for (auto* field : {&s.F, &s.H, &s.P})
    field->resize(n);
  s.J.resize(n);
  s.A.assign(n_branches, std::vector<Mat3>(n));
  s.S.assign(body.S.empty() ? 0 : n_branches, std::vector<Mat3>(n));
  const std::vector<double> cell_J =
      body.cells.empty() ? std::vector<double>{} : body.cells.ratios(body);
  for (size_t k = 0; k < n; ++k) {
    const std::int32_t a = nodes[k];
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
      s.P[k] += (material.volumetric_stress(cell_J[a]) - material.volumetric_stress(X.J)) * s.H[k];
      s.J[k] = cell_J[a];
    }
    for (size_t r = 0; r < n_branches; ++r) {
      s.A[r][k] = algebra::to_eigen(branches[r].A);
      if (!s.S.empty()) s.S[r][k] = algebra::to_eigen(branches[r].S);
    }
  }
  return s;
}

template <int Dim>
Snapshot snapshot_of(const MaterialModel& material, const Body<Dim>& body, double time) {
  std::vector<std::int32_t> nodes(body.n_owned);
  std::iota(nodes.begin(), nodes.end(), 0);
  return snapshot_of(material, body, time, std::span<const std::int32_t>(nodes));
}

#define DIPTYCH_INSTANTIATE(Dim)                                                \
  template Snapshot snapshot_of(const MaterialModel&, const Body<Dim>&, double, \
                                std::span<const std::int32_t>);                 \
  template Snapshot snapshot_of(const MaterialModel&, const Body<Dim>&, double);
DIPTYCH_INSTANTIATE(2)
DIPTYCH_INSTANTIATE(3)
#undef DIPTYCH_INSTANTIATE

}  // namespace diptych::scheme
