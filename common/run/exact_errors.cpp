#include "common/run/exact_errors.hpp"

#include "common/functions/placed_values.hpp"
#include "common/run/lanczos.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace diptych::run {

using algebra::Vec3;
using lanczos::for_nodes;

ExactErrors::ExactErrors(const cases::Case& setup,
                         const scheme::PairGraph& graph,
                         const Solver& solver)
    : setup_(setup), graph_(graph), solver_(solver) {}

/// F = I + grad u of the exact solution at all nodes.
std::vector<Mat3> ExactErrors::exact_deformation_gradients(double t) {
  if (!is_placed_) {
    gradients_ = functions::gradients_of(*setup_.exact.displacement, graph_.dimension, graph_.X);
    is_placed_ = true;
  }
  if (!gradients_) return differences_of_displacement(t);
  const int d = graph_.dimension;
  const auto n_values = static_cast<size_t>(d * d);
  std::vector<double> values(n_values * graph_.X.size());
  gradients_->at(t, values);
  std::vector<Mat3> F(graph_.X.size(), Mat3::Identity());
  for_nodes(std::ssize(F), [&](std::int64_t a) {
    for (int k = 0; k < d * d; ++k)
      F[a](k / d, k % d) += values[static_cast<size_t>(a) * n_values + static_cast<size_t>(k)];
  });
  return F;
}

/// Where it has no derivative somewhere: I + grad u by an eighth-order central difference whose
/// step balances truncation against rounding (relative error about 1e-12 for smooth fields).
std::vector<Mat3> ExactErrors::differences_of_displacement(double t) const {
  constexpr double weight[4] = {4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280};
  const double step = 1e-2 * std::pow(graph_.Omega[0], 1.0 / graph_.dimension) + 1e-3;
  const auto shifted = [&](const Vec3& shift) {
    std::vector<Vec3> X = graph_.X;
    for (Vec3& place : X)
      place += shift;
    return functions::vectors_at(*setup_.exact.displacement, X, t);
  };
  std::vector<Mat3> F(graph_.X.size(), Mat3::Identity());
  for (int j = 0; j < graph_.dimension; ++j) {
    for (int k = 1; k <= 4; ++k) {
      const Vec3 shift = k * step * Vec3::Unit(j);
      const std::vector<Vec3> above = shifted(shift), below = shifted(-shift);
      for (size_t a = 0; a < F.size(); ++a)
        F[a].col(j) += weight[k - 1] / step * (above[a] - below[a]);
    }
  }
  return F;
}

namespace {

double size_of(double value) {
  return std::abs(value);
}
template <class Field>
double size_of(const Field& value) {
  return value.norm();
}

}  // namespace

/// @param fields, exact  [part][node]; parts (branches) add in squares
/// @param rest           value of the undeformed body
template <class Field>
void ExactErrors::measure_field(const std::string& name,
                                const std::vector<const std::vector<Field>*>& fields,
                                const std::vector<const std::vector<Field>*>& exact,
                                const Field& rest) {
  if (exact.empty() || exact[0]->empty() || fields.empty()) return;
  Norms& norms = norms_[name];
  std::vector<double>& nodal = nodal_[name];
  nodal.assign(graph_.X.size(), 0.0);
  io::ErrorNorms e, f;
  for (std::int64_t a = 0; a < graph_.n_nodes(); ++a) {
    const auto error_of = [&](size_t part) {
      return size_of(Field((*fields[part])[a] - (*exact[part])[a]));
    };
    const auto size_of_part = [&](size_t part) { return size_of(Field((*exact[part])[a] - rest)); };
    double d = error_of(0), v = size_of_part(0);
    for (size_t part = 1; part < exact.size(); ++part) {
      d = std::hypot(d, error_of(part));
      v = std::hypot(v, size_of_part(part));
    }
    nodal[a] = d;
    const double Omega = graph_.Omega[a];
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

/// What [exact] gives or what follows from it; the other fields stay empty. All expressions
/// together: the functions that they share are evaluated once.
Snapshot ExactErrors::exact_snapshot(double t) {
  const auto& exact = setup_.exact;
  std::vector<functions::Expression> all;
  const auto place_of = [&](const auto& field) {
    const size_t first = all.size();
    if (field) all.insert(all.end(), field->component.begin(), field->component.end());
    return first;
  };
  const size_t of_v = place_of(exact.velocity), of_u = place_of(exact.displacement);
  const size_t of_F = exact.displacement ? place_of(exact.deformation_gradient) : all.size();
  const size_t of_P = exact.displacement ? place_of(exact.stress) : all.size();
  const size_t n_values = all.size();
  if (!placed_) placed_.emplace(std::move(all), graph_.X);
  const std::vector<double> values = placed_->at(t);
  const size_t n = graph_.X.size();
  const auto vectors = [&](size_t first) {
    std::vector<Vec3> field(n);
    for_nodes(std::ssize(field), [&](std::int64_t a) {
      field[a] = Vec3(values.data() + static_cast<size_t>(a) * n_values + first);
    });
    return field;
  };
  const auto tensors = [&](size_t first) {
    std::vector<Mat3> field(n);
    for_nodes(std::ssize(field), [&](std::int64_t a) {  // which stands row by row
      field[a] = Mat3(values.data() + static_cast<size_t>(a) * n_values + first).transpose();
    });
    return field;
  };
  Snapshot s;
  if (exact.velocity) s.v = vectors(of_v);
  if (!exact.displacement) return s;
  s.u = vectors(of_u);
  s.F = exact.deformation_gradient ? tensors(of_F) : exact_deformation_gradients(t);
  s.H.resize(n);
  s.J.resize(n);
  for_nodes(std::ssize(s.F), [&](std::int64_t a) {
    const auto X = physics::deformation_of(algebra::to_tensor(s.F[a]));
    s.H[a] = algebra::to_eigen(X.H);
    s.J[a] = X.J;
  });
  if (exact.stress) {
    s.P = tensors(of_P);
  } else if (setup_.material.branches.empty()) {
    s.P.resize(n);
    for_nodes(std::ssize(s.F),
              [&](std::int64_t a) { s.P[a] = solver_.equilibrium_stress(s.F[a]); });
  }
  return s;
}

Snapshot ExactErrors::measure(const Snapshot& s) {
  std::optional<Snapshot> known = solver_.exact_state(s.time);
  Snapshot exact = known ? std::move(*known) : exact_snapshot(s.time);
  exact.time = s.time;
  const Vec3 zero = Vec3::Zero();
  const Mat3 I = Mat3::Identity();
  measure_field<Vec3>("velocity", {&s.v}, {&exact.v}, zero);
  measure_field<Vec3>("displacement", {&s.u}, {&exact.u}, zero);
  measure_field<Mat3>("deformation_gradient", {&s.F}, {&exact.F}, I);
  measure_field<Mat3>("cofactor", {&s.H}, {&exact.H}, I);
  measure_field<double>("jacobian", {&s.J}, {&exact.J}, 1.0);
  measure_field<Mat3>("stress", {&s.P}, {&exact.P}, Mat3::Zero());
  // only what branches relax: a C branch has no S, a G branch no A
  std::vector<const std::vector<Mat3>*> A, A_exact, S, S_exact;
  for (size_t k = 0; k < exact.A.size(); ++k) {
    if (setup_.material.branches[k].beta_C > 0) {
      A.push_back(&s.A[k]);
      A_exact.push_back(&exact.A[k]);
    }
    if (setup_.material.branches[k].beta_G > 0 && !s.S.empty()) {
      S.push_back(&s.S[k]);
      S_exact.push_back(&exact.S[k]);
    }
  }
  measure_field<Mat3>("viscous_C", A, A_exact, I);
  measure_field<Mat3>("viscous_G", S, S_exact, I);
  return exact;
}

void ExactErrors::archive(algebra::Archive& archive) {
  std::vector<std::string> names;
  for (const auto& [name, norms] : norms_)
    names.push_back(name);
  archive.texts("errors/fields", names);
  for (const std::string& name : names) {
    auto& [error, scale] = norms_[name];
    archive.real("errors/" + name + " l1", "-", error.l1);
    archive.real("errors/" + name + " l2", "-", error.l2);
    archive.real("errors/" + name + " linf", "-", error.linf);
    archive.real("errors/" + name + " scale l1", "-", scale.l1);
    archive.real("errors/" + name + " scale l2", "-", scale.l2);
    archive.real("errors/" + name + " scale linf", "-", scale.linf);
  }
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

std::map<std::string, double> ExactErrors::scales() const {
  std::map<std::string, double> result;
  for (const auto& [name, norms] : norms_)
    result[name] = norms.scale.l2;
  return result;
}

}  // namespace diptych::run
