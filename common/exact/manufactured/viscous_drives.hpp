#pragma once
/// What drives the internal variables of a known motion (viscous_history.hpp): C^-1 and G^-1 with
/// their gradients, for eight nodes at a time. Test: tests/common/exact/manufactured_test.cpp

#include "common/exact/manufactured/motion.hpp"
#include "common/physics/deformation.hpp"

#include <type_traits>

namespace diptych::exact {

/// C^-1 and G^-1 of a block, or their derivatives by one direction; in plane strain of the plane,
/// and G_33^-1. What physics::right_tensors comes to, whose duals by all directions are several
/// times as many as registers hold.
struct Drives {
  algebra::SymmetricTensor<Lanes> inverse_C, inverse_G;
};

template <int Dim>
class DrivesOf {
 public:
  DIPTYCH_INLINE explicit DrivesOf(const algebra::Tensor<Lanes>& F) : F_(F) {
    if constexpr (Dim == 3) {
      const physics::RightTensors<Lanes> X = physics::right_tensors(F);
      values_ = {X.inverse_C, X.inverse_G};
      inverse_det_ = X.inverse_G(0, 0) / X.C(0, 0);
    } else {
      const Lanes C_00 = F(0, 0) * F(0, 0) + F(1, 0) * F(1, 0);
      const Lanes C_11 = F(0, 1) * F(0, 1) + F(1, 1) * F(1, 1);
      const Lanes C_01 = F(0, 0) * F(0, 1) + F(1, 0) * F(1, 1);
      inverse_det_ = 1.0 / (C_00 * C_11 - C_01 * C_01);
      auto& [inverse_C, inverse_G] = values_;
      inverse_G(0, 0) = inverse_C(1, 1) = inverse_det_ * C_00;
      inverse_G(1, 1) = inverse_C(0, 0) = inverse_det_ * C_11;
      inverse_G(0, 1) = inverse_det_ * C_01;
      inverse_C(0, 1) = -1.0 * inverse_G(0, 1);
      inverse_G(2, 2) = inverse_det_;
    }
  }
  const Drives& values() const { return values_; }

  /// d(C^-1) = -C^-1 dC C^-1 and d(C/det C) = dC/det C - (C^-1 : dC) C/det C for dC = F^T dF + dF^T
  /// F.
  DIPTYCH_INLINE Drives derivatives(const algebra::Tensor<Lanes>& dF) const {
    const algebra::SymmetricTensor<Lanes>&inverse_C = values_.inverse_C,
          &inverse_G = values_.inverse_G;
    algebra::Tensor<Lanes> M, K;  // F^T dF, dC C^-1
    algebra::SymmetricTensor<Lanes> dC;
    Drives d;
    for (int i = 0; i < Dim; ++i) {
      for (int j = 0; j < Dim; ++j)
        M(i, j) = sum([&](int k) DIPTYCH_INLINE_LAMBDA { return F_(k, i) * dF(k, j); });
    }
    for (int i = 0; i < Dim; ++i) {
      for (int j = i; j < Dim; ++j)
        dC(i, j) = M(i, j) + M(j, i);
    }
    for (int i = 0; i < Dim; ++i) {
      for (int j = 0; j < Dim; ++j)
        K(i, j) = sum([&](int k) DIPTYCH_INLINE_LAMBDA { return dC(i, k) * inverse_C(k, j); });
    }
    const Lanes trace = sum([&](int k) DIPTYCH_INLINE_LAMBDA { return K(k, k); });
    for (int i = 0; i < Dim; ++i) {
      for (int j = i; j < Dim; ++j) {
        d.inverse_C(i, j) =
            -sum([&](int k) DIPTYCH_INLINE_LAMBDA { return inverse_C(i, k) * K(k, j); });
        d.inverse_G(i, j) = inverse_det_ * dC(i, j) - trace * inverse_G(i, j);
      }
    }
    if constexpr (Dim == 2) d.inverse_G(2, 2) = -trace * inverse_G(2, 2);
    return d;
  }

 private:
  template <class Term>
  static DIPTYCH_INLINE Lanes sum(const Term& term) {
    if constexpr (Dim == 2) return term(0) + term(1);
    return term(0) + term(1) + term(2);
  }
  const algebra::Tensor<Lanes>& F_;
  Drives values_;
  Lanes inverse_det_;
};

/// A = old A_before + weight C^-1 of what Drives are of: the values (I = -1) or a direction.
template <int I, int Dim>
DIPTYCH_INLINE void add_drive(const algebra::SymmetricTensor<Lanes>& drive,
                              bool of_G,
                              double old,
                              const algebra::SymmetricTensor<algebra::Dual<Lanes, Dim>>& before,
                              double weight,
                              algebra::SymmetricTensor<algebra::Dual<Lanes, Dim>>& A) {
  const auto add = [&](int i, int j) DIPTYCH_INLINE_LAMBDA {
    const algebra::Dual<Lanes, Dim>& from = before(i, j);
    algebra::Dual<Lanes, Dim>& to = A(i, j);
    if constexpr (I < 0) {
      to.v = old * from.v + weight * drive(i, j);
    } else {
      to.d[I] = old * from.d[I] + weight * drive(i, j);
    }
  };
  for (int i = 0; i < Dim; ++i) {
    for (int j = i; j < Dim; ++j)
      add(i, j);
  }
  if (Dim == 2 && of_G) add(2, 2);
}

/// use(direction, Drives) for the values (-1) and for each direction.
template <int Dim, class Use>
DIPTYCH_INLINE void for_drives(const DeformationGradient<Dim>& gradient,
                               int block,
                               const Use& use) {
  const algebra::Tensor<Lanes> F = gradient.value_at(block);
  const DrivesOf<Dim> of(F);
  use(std::integral_constant<int, -1>(), of.values());
  use(std::integral_constant<int, 0>(), of.derivatives(gradient.template derivative_at<0>(block)));
  use(std::integral_constant<int, 1>(), of.derivatives(gradient.template derivative_at<1>(block)));
  if constexpr (Dim == 3) {
    use(std::integral_constant<int, 2>(),
        of.derivatives(gradient.template derivative_at<2>(block)));
  }
}

}  // namespace diptych::exact
