#include "common/exact/manufactured/motion.hpp"

#include "common/functions/placed_values.hpp"

namespace diptych::exact {

using functions::Program;

Motion::Motion(const std::vector<ExpressionText>& displacement,
               const functions::Vocabulary& vocabulary) {
  const auto program = std::make_shared<Program>();
  for (const ExpressionText& u : displacement)
    rates_[0].push_back(program->append(u.text, vocabulary, u.where, Program::Accepts::smooth));
  const int n = dimension();
  for (size_t order = 1; order < rates_.size(); ++order) {
    for (const int before : rates_[order - 1])
      rates_[order].push_back(program->derivative(before, 3));
  }
  for (const int u : rates_[0]) {
    for (int j = 0; j < n; ++j)
      gradients_.push_back(program->derivative(u, j));
  }
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      for (int k = j; k < n; ++k)
        gradients_.push_back(program->derivative(gradients_[static_cast<size_t>(n * i + j)], k));
    }
  }
  program_ = program;
}

std::vector<Vec3> Motion::rates_at(int order, std::span<const Vec3> X, double t) const {
  const functions::PlacedValues placed(program_, rates(order), X);
  const auto n = static_cast<size_t>(dimension());
  std::vector<double> values(n * X.size());
  placed.at(t, values);
  std::vector<Vec3> rates(X.size(), Vec3::Zero());
  for (size_t k = 0; k < values.size(); ++k)
    rates[k / n][static_cast<int>(k % n)] = values[k];
  return rates;
}

}  // namespace diptych::exact
