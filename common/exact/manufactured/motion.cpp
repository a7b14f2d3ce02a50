#include "common/exact/manufactured/motion.hpp"

namespace diptych::exact {

Motion::Motion(const std::vector<ExpressionText>& displacement,
               const functions::Vocabulary& vocabulary) {
  for (const ExpressionText& u : displacement)
    components_.push_back(tape_.append(u.text, vocabulary, u.where));
}

std::array<Vec3, 3> Motion::rates(const Vec3& X, double t) const {
  TapeEvaluation<double, 0, true> evaluated(tape_);
  evaluated.place(X.data());
  evaluated.time(tape_.at_time(t));
  std::array<Vec3, 3> rates{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  for (int i = 0; i < dimension(); ++i) {
    const Jet<double, 1>& u = evaluated[components_[i]];
    rates[0][i] = u.v;
    rates[1][i] = u.d[0];
    rates[2][i] = u.dd[0];
  }
  return rates;
}

}  // namespace diptych::exact
