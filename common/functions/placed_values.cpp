#include "common/functions/placed_values.hpp"

#include <cmath>

namespace diptych::functions {

using algebra::n_lanes;

void PlacedValues::at(double t, std::span<double> values) const {
  const PlacedProgram::Instant instant = placed_.at(t);
  const std::int64_t per_strip = placed_.width() * n_lanes;
  placed_.for_strips([&](std::int64_t strip, PlacedProgram::Workspace& workspace) {
    placed_.evaluate(strip, t, instant, workspace);
    const std::int64_t first = strip * per_strip;
    const std::int64_t n = std::min(per_strip, n_places() - first);
    for (int k = 0; k < n_results_; ++k) {
      const PlacedProgram::Blocks result = placed_.result(k, strip, instant, workspace);
      for (std::int64_t a = 0; a < n; ++a)
        values[static_cast<size_t>((first + a) * n_results_ + k)] =
            result[static_cast<int>(a / n_lanes)][a % n_lanes];
    }
  });
}

namespace {

PlacedValues values_of(const std::vector<Expression>& expressions, std::span<const Vec3> X) {
  const auto program = std::make_shared<Program>();
  std::vector<int> results;
  for (const Expression& e : expressions)
    results.push_back(program->append(e));
  return {program, results, X};
}

}  // namespace

PlacedExpressions::PlacedExpressions(std::vector<Expression> expressions, std::span<const Vec3> X)
    : expressions_(std::move(expressions)),
      X_(X.begin(), X.end()),
      values_(values_of(expressions_, X)) {}

void PlacedExpressions::move_to(std::span<const Vec3> X) {
  X_.assign(X.begin(), X.end());
  values_.move_to(X);
}

std::vector<double> PlacedExpressions::at(double t) const {
  const size_t n = expressions_.size();
  std::vector<double> values(X_.size() * n);
  values_.at(t, values);
  for (size_t a = 0; a < values.size(); ++a) {
    if (!std::isfinite(values[a])) expressions_[a % n].refuse_value(values[a], X_[a / n], t);
  }
  return values;
}

std::optional<PlacedValues> gradients_of(const VectorExpression& vector,
                                         int dimension,
                                         std::span<const Vec3> X) {
  const auto program = std::make_shared<Program>();
  std::vector<int> results;
  for (int i = 0; i < dimension; ++i) {
    const int u = program->append(vector.component[static_cast<size_t>(i)]);
    if (!program->smooth_in_place(u)) return std::nullopt;
    for (int j = 0; j < dimension; ++j)
      results.push_back(program->derivative(u, j));
  }
  return PlacedValues(program, results, X);
}

std::vector<Vec3> vectors_at(const VectorExpression& vector, std::span<const Vec3> X, double t) {
  const auto& c = vector.component;
  const std::vector<double> values = PlacedExpressions({c.begin(), c.end()}, X).at(t);
  std::vector<Vec3> vectors(X.size());
  for (size_t a = 0; a < X.size(); ++a)
    vectors[a] = {values[3 * a], values[3 * a + 1], values[3 * a + 2]};
  return vectors;
}

std::vector<Mat3> tensors_at(const TensorExpression& tensor, std::span<const Vec3> X, double t) {
  const auto& c = tensor.component;
  const std::vector<double> values = PlacedExpressions({c.begin(), c.end()}, X).at(t);
  std::vector<Mat3> tensors(X.size());
  for (size_t a = 0; a < X.size(); ++a) {
    for (size_t k = 0; k < 9; ++k)
      tensors[a](static_cast<int>(k) / 3, static_cast<int>(k) % 3) = values[9 * a + k];
  }
  return tensors;
}

}  // namespace diptych::functions
