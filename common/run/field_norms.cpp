#include "common/run/field_norms.hpp"

#include "common/parallel/for_chunks.hpp"

#include <cmath>

namespace diptych::run {

namespace {

/// @param value  value(a): a vector or a tensor at node a
template <class Value>
double norm_of(const scheme::PairGraph& graph, const Value& value) {
  const auto n = static_cast<std::int64_t>(graph.X.size());
  std::vector<double> parts(static_cast<size_t>(parallel::n_chunks_of(n)));
  parallel::for_chunks(n, [&](std::int64_t begin, std::int64_t end, std::int64_t chunk) {
    double sum = 0;
    for (auto a = static_cast<size_t>(begin); a < static_cast<size_t>(end); ++a)
      sum += graph.Omega[a] * value(a).squaredNorm();
    parts[chunk] = sum;
  });
  return std::sqrt(parallel::sum_in_order(parts));
}

}  // namespace

std::map<std::string, double> field_norms(const scheme::PairGraph& graph, const Snapshot& s) {
  using algebra::Vec3;
  return {
      {"displacement", norm_of(graph, [&](size_t a) -> Vec3 { return s.u[a]; })},
      {"velocity", norm_of(graph, [&](size_t a) -> Vec3 { return s.v[a]; })},
      {"deformation_gradient",
       norm_of(graph, [&](size_t a) -> Mat3 { return s.F[a] - Mat3::Identity(); })},
      {"stress", norm_of(graph, [&](size_t a) -> Mat3 { return s.P[a]; })},
  };
}

std::map<std::string, double> difference_norms(const scheme::PairGraph& graph,
                                               const Snapshot& s,
                                               const Snapshot& t) {
  using algebra::Vec3;
  return {
      {"displacement", norm_of(graph, [&](size_t a) -> Vec3 { return s.u[a] - t.u[a]; })},
      {"velocity", norm_of(graph, [&](size_t a) -> Vec3 { return s.v[a] - t.v[a]; })},
      {"deformation_gradient", norm_of(graph, [&](size_t a) -> Mat3 { return s.F[a] - t.F[a]; })},
      {"stress", norm_of(graph, [&](size_t a) -> Mat3 { return s.P[a] - t.P[a]; })},
  };
}

}  // namespace diptych::run
