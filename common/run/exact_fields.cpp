#include "common/run/exact_fields.hpp"

#include "common/algebra/tensor.hpp"
#include "common/base/error.hpp"
#include "common/cases/reader.hpp"
#include "common/physics/deformation.hpp"

#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace diptych::run {

/// All expressions together: the functions that they share are evaluated once.
ExactFields::ExactFields(const cases::Case& setup,
                         std::vector<Vec3> X,
                         double length,
                         Stress stress)
    : setup_(setup), X_(std::move(X)), length_(length), stress_(std::move(stress)) {
  const auto& exact = setup.exact;
  std::vector<functions::Expression> all;
  const auto place_of = [&](const auto& field) {
    const size_t first = all.size();
    if (field) all.insert(all.end(), field->component.begin(), field->component.end());
    return first;
  };
  of_v_ = place_of(exact.velocity);
  of_u_ = place_of(exact.displacement);
  of_F_ = place_of(exact.deformation_gradient);
  of_P_ = place_of(exact.stress);
  n_values_ = all.size();
  values_.emplace(std::move(all), X_);
  if (!exact.displacement || exact.deformation_gradient) {
    X_ = {};
    return;
  }
  gradients_ = functions::gradients_of(*exact.displacement, cases::dimension_of(setup.mesh), X_);
  const auto program = std::make_shared<functions::Program>();
  for (const functions::Expression& component : exact.displacement->component)
    results_.push_back(program->append(component));
  program_ = program;
}

/// F = I + grad u of the exact solution, by differences where the derivative is no number, as that
/// of x sqrt(x^2 + y^2) at the origin.
std::vector<Mat3> ExactFields::deformation_gradients(double t,
                                                     std::int64_t begin,
                                                     std::int64_t end) const {
  const std::span<const Vec3> X = std::span(X_).subspan(begin, end - begin);
  if (!gradients_) return differences(t, X);
  const int d = cases::dimension_of(setup_.mesh);
  const auto n = static_cast<size_t>(end - begin), n_values = static_cast<size_t>(d * d);
  std::vector<double> values(n_values * n);
  gradients_->at(t, begin, end, values);
  std::vector<Mat3> F(n, Mat3::Identity());
  for (size_t a = 0; a < n; ++a) {
    for (int k = 0; k < d * d; ++k)
      F[a](k / d, k % d) += values[a * n_values + static_cast<size_t>(k)];
    if (!F[a].allFinite()) F[a] = differences(t, X.subspan(a, 1)).front();
  }
  return F;
}

/// Where it has no derivative: I + grad u by an eighth-order central difference whose step balances
/// truncation against rounding (relative error about 1e-12 for smooth fields).
std::vector<Mat3> ExactFields::differences(double t, std::span<const Vec3> places) const {
  constexpr double weight[4] = {4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280};
  const double step = 1e-2 * length_;
  const auto shifted = [&](const Vec3& shift) {
    std::vector<Vec3> X(places.begin(), places.end());
    for (Vec3& place : X)
      place += shift;
    std::vector<double> u(3 * X.size());
    functions::PlacedValues(program_, results_, X).at(t, u);
    return u;
  };
  std::vector<Mat3> F(places.size(), Mat3::Identity());
  for (int j = 0; j < cases::dimension_of(setup_.mesh); ++j) {
    for (int k = 1; k <= 4; ++k) {
      const Vec3 shift = k * step * Vec3::Unit(j);
      const std::vector<double> above = shifted(shift), below = shifted(-shift);
      for (size_t a = 0; a < F.size(); ++a)
        F[a].col(j) += weight[k - 1] / step * (Vec3(&above[3 * a]) - Vec3(&below[3 * a]));
    }
  }
  for (size_t a = 0; a < F.size(); ++a) {
    if (F[a].allFinite()) continue;
    throw base::InputError(fmt::format(
        "exact.displacement has no finite gradient at ({:g}, {:g}, {:g}) at t = {:g} s: give "
        "exact.deformation_gradient, or a displacement that is finite around the body, too",
        places[a][0], places[a][1], places[a][2], t));
  }
  return F;
}

scheme::Snapshot ExactFields::at(double t, std::int64_t begin, std::int64_t end) const {
  const auto& exact = setup_.exact;
  const auto n = static_cast<size_t>(end - begin);
  const std::vector<double> values = values_->at(t, begin, end);
  const auto vectors = [&](size_t first) {
    std::vector<Vec3> field(n);
    for (size_t a = 0; a < n; ++a)
      field[a] = Vec3(values.data() + a * n_values_ + first);
    return field;
  };
  const auto tensors = [&](size_t first) {
    std::vector<Mat3> field(n);
    for (size_t a = 0; a < n; ++a)  // which stands row by row
      field[a] = Mat3(values.data() + a * n_values_ + first).transpose();
    return field;
  };
  scheme::Snapshot s;
  s.time = t;
  if (exact.velocity) s.v = vectors(of_v_);
  if (exact.displacement) s.u = vectors(of_u_);
  if (exact.deformation_gradient) {
    s.F = tensors(of_F_);
  } else if (exact.displacement) {
    s.F = deformation_gradients(t, begin, end);
  }
  for (const Mat3& F : s.F) {
    const auto X = physics::deformation_of(algebra::to_tensor(F));
    s.H.push_back(algebra::to_eigen(X.H));
    s.J.push_back(X.J);
  }
  if (exact.stress) {
    s.P = tensors(of_P_);
  } else if (setup_.material.branches.empty()) {
    for (const Mat3& F : s.F)
      s.P.push_back(stress_(F));
  }
  return s;
}

}  // namespace diptych::run
