#include "common/functions/placed_values.hpp"

#include <algorithm>
#include <cmath>

namespace diptych::functions {

using algebra::n_lanes;

void PlacedValues::at(double t,
                      std::int64_t begin,
                      std::int64_t end,
                      std::span<double> values) const {
  const PlacedProgram::Instant instant = placed_.at(t);
  const std::int64_t per_strip = placed_.width() * n_lanes;
  const auto evaluate = [&](std::int64_t strip, PlacedProgram::Workspace& workspace) {
    placed_.evaluate(strip, t, instant, workspace);
    const std::int64_t first = strip * per_strip;
    for (int k = 0; k < n_results_; ++k) {
      const PlacedProgram::Blocks result = placed_.result(k, strip, instant, workspace);
      for (std::int64_t a = std::max(begin, first); a < std::min(end, first + per_strip); ++a) {
        const std::int64_t lane = a - first;
        values[static_cast<size_t>((a - begin) * n_results_ + k)] =
            result[static_cast<int>(lane / n_lanes)][lane % n_lanes];
      }
    }
  };
  placed_.for_strips(begin / per_strip, (end + per_strip - 1) / per_strip, evaluate);
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
    : expressions_(std::move(expressions)), values_(values_of(expressions_, X)) {}

std::vector<double> PlacedExpressions::at(double t, std::int64_t begin, std::int64_t end) const {
  const size_t n = expressions_.size();
  std::vector<double> values(static_cast<size_t>(end - begin) * n);
  values_.at(t, begin, end, values);
  for (size_t k = 0; k < values.size(); ++k) {
    if (!std::isfinite(values[k]))
      expressions_[k % n].refuse_value(values[k],
                                       values_.X(begin + static_cast<std::int64_t>(k / n)), t);
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
