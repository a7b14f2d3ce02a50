#include "common/run/exact_errors.hpp"

#include <algorithm>
#include <cmath>

namespace diptych::run {

using algebra::Vec3;

ExactErrors::ExactErrors(const Case& setup, const scheme::PairGraph& graph, const Solver& solver)
    : setup_(setup), graph_(graph), solver_(solver) {}

/// F of the exact solution: as given, or I + grad u by an eighth-order central difference whose
/// step balances truncation against rounding (relative error about 1e-12 for smooth fields).
Mat3 ExactErrors::exact_deformation_gradient(const Vec3& X, double t) const {
  if (setup_.exact.deformation_gradient) return (*setup_.exact.deformation_gradient)(X, t);
  constexpr double weight[4] = {4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280};
  const double step = 1e-2 * std::pow(graph_.Omega[0], 1.0 / graph_.dimension) + 1e-3;
  Mat3 F = Mat3::Identity();
  for (int j = 0; j < graph_.dimension; ++j) {
    for (int k = 1; k <= 4; ++k) {
      const Vec3 shift = k * step * Vec3::Unit(j);
      const Vec3 difference =
          (*setup_.exact.displacement)(X + shift, t) - (*setup_.exact.displacement)(X - shift, t);
      F.col(j) += weight[k - 1] / step * difference;
    }
  }
  return F;
}

/// @param error  node -> size of the error  @param value  node -> size of the exact field
template <class Error, class Value>
void ExactErrors::measure_field(const std::string& name, const Error& error, const Value& value) {
  Norms& norms = norms_[name];
  io::ErrorNorms e, f;
  for (std::int64_t a = 0; a < graph_.n_nodes(); ++a) {
    const double Omega = graph_.Omega[a], d = error(a), v = value(a);
    e.l1 += Omega * d;
    e.l2 += Omega * d * d;
    e.linf = std::max(e.linf, d);
    f.l1 += Omega * v;
    f.l2 += Omega * v * v;
    f.linf = std::max(f.linf, v);
  }
  e.l2 = std::sqrt(e.l2);
  f.l2 = std::sqrt(f.l2);
  norms.error = e;
  norms.scale.l1 = std::max(norms.scale.l1, f.l1);
  norms.scale.l2 = std::max(norms.scale.l2, f.l2);
  norms.scale.linf = std::max(norms.scale.linf, f.linf);
}

void ExactErrors::measure(const Snapshot& s) {
  const double t = s.time;
  const auto& exact = setup_.exact;
  const auto vectors = [&](const std::string& name, const VectorExpression& f,
                           const std::vector<Vec3>& field) {
    std::vector<Vec3> value(field.size());
    for (size_t a = 0; a < field.size(); ++a)
      value[a] = f(graph_.X[a], t);
    measure_field(
        name, [&](std::int64_t a) { return (field[a] - value[a]).norm(); },
        [&](std::int64_t a) { return value[a].norm(); });
  };
  if (exact.velocity) vectors("velocity", *exact.velocity, s.v);
  if (!exact.displacement) return;
  vectors("displacement", *exact.displacement, s.u);
  std::vector<Mat3> F(s.F.size()), P(s.F.size());
  for (size_t a = 0; a < F.size(); ++a)
    F[a] = exact_deformation_gradient(graph_.X[a], t);
  measure_field(
      "deformation_gradient", [&](std::int64_t a) { return (s.F[a] - F[a]).norm(); },
      [&](std::int64_t a) { return (F[a] - Mat3::Identity()).norm(); });
  if (!exact.stress && !setup_.material.branches.empty()) return;
  for (size_t a = 0; a < F.size(); ++a) {
    P[a] = exact.stress ? (*exact.stress)(graph_.X[a], t) : solver_.equilibrium_stress(F[a]);
  }
  measure_field(
      "stress", [&](std::int64_t a) { return (s.P[a] - P[a]).norm(); },
      [&](std::int64_t a) { return P[a].norm(); });
}

std::map<std::string, io::ErrorNorms> ExactErrors::relative() const {
  std::map<std::string, io::ErrorNorms> result;
  const auto ratio = [](double error, double scale) { return scale > 0 ? error / scale : error; };
  for (const auto& [name, norms] : norms_) {
    result[name] = {ratio(norms.error.l1, norms.scale.l1), ratio(norms.error.l2, norms.scale.l2),
                    ratio(norms.error.linf, norms.scale.linf)};
  }
  return result;
}

namespace {

template <class Field>
double relative_difference_of(const scheme::PairGraph& graph,
                              const std::vector<Field>& first,
                              const std::vector<Field>& second,
                              const Field& rest) {
  double difference = 0, norm_first = 0, norm_second = 0;
  for (std::int64_t a = 0; a < graph.n_nodes(); ++a) {
    difference += graph.Omega[a] * (first[a] - second[a]).squaredNorm();
    norm_first += graph.Omega[a] * (first[a] - rest).squaredNorm();
    norm_second += graph.Omega[a] * (second[a] - rest).squaredNorm();
  }
  const double scale = std::max(norm_first, norm_second);
  return scale > 0 ? std::sqrt(difference / scale) : std::sqrt(difference);
}

}  // namespace

double relative_difference(const scheme::PairGraph& graph,
                           const std::vector<Mat3>& first,
                           const std::vector<Mat3>& second) {
  return relative_difference_of<Mat3>(graph, first, second, Mat3::Zero());
}

double relative_difference(const scheme::PairGraph& graph,
                           const std::vector<Vec3>& first,
                           const std::vector<Vec3>& second) {
  return relative_difference_of<Vec3>(graph, first, second, Vec3::Zero());
}

}  // namespace diptych::run
