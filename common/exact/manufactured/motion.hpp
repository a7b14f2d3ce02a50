#pragma once
/// A motion x = X + u(X, t) given by smooth expressions, with its exact derivatives by X and t.
/// Test: tests/common/exact/motion_test.cpp.

#include "common/exact/manufactured/tape.hpp"
#include "common/physics/deformation.hpp"

namespace diptych::exact {

using algebra::Vec3;

/// An expression as it was written.
struct ExpressionText {
  std::string text;
  functions::SourcePlace where;  ///< of its first character
};

class Motion {
 public:
  /// @param displacement  u, one text per direction: 3, or 2 in plane strain  [m]
  /// @throws base::InputError on texts that are not smooth
  Motion(const std::vector<ExpressionText>& displacement, const functions::Vocabulary& vocabulary);

  int dimension() const { return static_cast<int>(components_.size()); }
  Vec3 displacement(const Vec3& X, double t) const { return rates(X, t)[0]; }
  Vec3 velocity(const Vec3& X, double t) const { return rates(X, t)[1]; }
  Vec3 acceleration(const Vec3& X, double t) const { return rates(X, t)[2]; }

  const Tape& tape() const { return tape_; }
  /// Place on the tape of u_i; i < dimension().
  int component(int i) const { return components_[i]; }

 private:
  std::array<Vec3, 3> rates(const Vec3& X, double t) const;  ///< u, du/dt, d2u/dt2

  Tape tape_;
  std::vector<int> components_;
};

/// F = I + grad u with its gradient, from the evaluated tape of the motion.
template <int Dim, class Evaluation>
DIPTYCH_INLINE algebra::Tensor<algebra::Dual<Lanes, Dim>> deformation_gradient(
    const Motion& motion, const Evaluation& evaluated) {
  algebra::Tensor<algebra::Dual<Lanes, Dim>> F = algebra::identity<algebra::Dual<Lanes, Dim>>();
  for (int i = 0; i < Dim; ++i) {
    const auto& u = evaluated[motion.component(i)];
    for (int j = 0; j < Dim; ++j) {
      F(i, j).v = F(i, j).v + u.d[j];
      for (int k = 0; k < Dim; ++k)
        F(i, j).d[k] = u.dd[u.index(j, k)];
    }
  }
  return F;
}

}  // namespace diptych::exact
