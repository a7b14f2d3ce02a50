#pragma once
/// The fields of the exact solution that a case gives by expressions, at places.
/// Test: tests/common/run/exact_survey_test.cpp

#include "common/cases/case.hpp"
#include "common/functions/placed_values.hpp"
#include "common/scheme/body/snapshot.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace diptych::run {

using algebra::Mat3;
using algebra::Vec3;

class ExactFields {
 public:
  /// P(F) of the material without its branches  [Pa]
  using Stress = std::function<Mat3(const Mat3& F)>;

  /// @param setup   kept by reference
  /// @param X       m
  /// @param length  m, of the differences that stand in where the displacement has no derivative
  ExactFields(const cases::Case& setup, std::vector<Vec3> X, double length, Stress stress);

  /// What the case gives, or what follows from it, at places [begin, end); the other fields stay
  /// empty. @throws base::InputError on a value that is not finite
  scheme::Snapshot at(double t, std::int64_t begin, std::int64_t end) const;
  scheme::Snapshot at(double t) const { return at(t, 0, values_->n_places()); }

 private:
  std::vector<Mat3> deformation_gradients(double t, std::int64_t begin, std::int64_t end) const;
  std::vector<Mat3> differences(double t, std::span<const Vec3> places) const;

  const cases::Case& setup_;
  std::vector<Vec3> X_;  ///< empty where no gradients are wanted
  double length_;
  Stress stress_;
  size_t of_v_ = 0, of_u_ = 0, of_F_ = 0, of_P_ = 0, n_values_ = 0;  ///< places in values_
  std::optional<functions::PlacedExpressions> values_;
  std::optional<functions::PlacedValues> gradients_;   ///< of the displacement, where it has any
  std::shared_ptr<const functions::Program> program_;  ///< of the displacement, for differences
  std::vector<int> results_;
};

}  // namespace diptych::run
