#pragma once
/// Expressions at given places, all of them for one instant after the other, by all threads.
/// Test: tests/common/functions/program_test.cpp

#include "common/functions/placed_program.hpp"

#include <optional>

namespace diptych::functions {

/// Results of a program at all places.
class PlacedValues {
 public:
  PlacedValues(std::shared_ptr<const Program> program,
               const std::vector<int>& results,
               std::span<const Vec3> X)
      : placed_(std::move(program), results, X), n_results_(static_cast<int>(results.size())) {}

  void move_to(std::span<const Vec3> X) { placed_.move_to(X); }
  std::int64_t n_places() const { return placed_.n_places(); }
  const Vec3& X(std::int64_t place) const { return placed_.X(place); }
  /// @param values  [place][result]
  void at(double t, std::span<double> values) const { at(t, 0, n_places(), values); }
  /// Of places [begin, end).  @param values  [place - begin][result]
  void at(double t, std::int64_t begin, std::int64_t end, std::span<double> values) const;

 private:
  PlacedProgram placed_;
  int n_results_;
};

/// Values of expressions; each must be finite.
class PlacedExpressions {
 public:
  PlacedExpressions(std::vector<Expression> expressions, std::span<const Vec3> X);
  void move_to(std::span<const Vec3> X) { values_.move_to(X); }
  std::int64_t n_places() const { return values_.n_places(); }
  /// @return [place][expression]
  /// @throws base::InputError on a value that is not finite
  std::vector<double> at(double t) const { return at(t, 0, values_.n_places()); }
  /// Of places [begin, end).
  std::vector<double> at(double t, std::int64_t begin, std::int64_t end) const;

 private:
  std::vector<Expression> expressions_;
  PlacedValues values_;
};

/// du_i/dX_j of a vector of place and time, i and j < dimension, row by row; nothing where it has
/// no derivative somewhere.
std::optional<PlacedValues> gradients_of(const VectorExpression& vector,
                                         int dimension,
                                         std::span<const Vec3> X);

/// Values of a vector [m, m/s, ...] at places X at time t.
std::vector<Vec3> vectors_at(const VectorExpression& vector, std::span<const Vec3> X, double t);
/// Values of a tensor at places X at time t.
std::vector<Mat3> tensors_at(const TensorExpression& tensor, std::span<const Vec3> X, double t);

}  // namespace diptych::functions
