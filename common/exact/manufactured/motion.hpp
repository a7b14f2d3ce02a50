#pragma once
/// A motion x = X + u(X, t) given by smooth expressions, with its exact derivatives by X and t:
/// operations of one program. Test: tests/common/exact/motion_test.cpp.

#include "common/functions/placed_program.hpp"
#include "common/physics/deformation.hpp"

#include <array>
#include <memory>
#include <vector>

namespace diptych::exact {

using algebra::Lanes;
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

  int dimension() const { return static_cast<int>(rates_[0].size()); }
  Vec3 displacement(const Vec3& X, double t) const { return rate_at(0, X, t); }
  Vec3 velocity(const Vec3& X, double t) const { return rate_at(1, X, t); }
  Vec3 acceleration(const Vec3& X, double t) const { return rate_at(2, X, t); }
  std::vector<Vec3> displacements(std::span<const Vec3> X, double t) const {
    return rates_at(0, X, t);
  }
  std::vector<Vec3> velocities(std::span<const Vec3> X, double t) const {
    return rates_at(1, X, t);
  }

  const std::shared_ptr<const functions::Program>& program() const { return program_; }
  /// Places in the program of u, du/dt or d2u/dt2 (order 0, 1, 2)  [dimension]
  const std::vector<int>& rates(int order) const { return rates_[static_cast<size_t>(order)]; }
  /// Places of du_i/dX_j, i and j < dimension, then of d2u_i/dX_j dX_k, j <= k: the rows of
  /// DeformationGradient.
  const std::vector<int>& gradients() const { return gradients_; }

 private:
  Vec3 rate_at(int order, const Vec3& X, double t) const {
    return rates_at(order, {&X, 1}, t).front();
  }
  std::vector<Vec3> rates_at(int order, std::span<const Vec3> X, double t) const;

  std::shared_ptr<const functions::Program> program_;
  std::array<std::vector<int>, 3> rates_;
  std::vector<int> gradients_;
};

/// F = I + grad u with its gradient, from a placed program whose first results are
/// Motion::gradients().
template <int Dim>
class DeformationGradient {
 public:
  using Scalar = algebra::Dual<Lanes, Dim>;
  static constexpr int n_second = Dim * (Dim + 1) / 2;

  DeformationGradient(const functions::PlacedProgram& placed,
                      std::int64_t strip,
                      const functions::PlacedProgram::Instant& instant,
                      const functions::PlacedProgram::Workspace& workspace) {
    for (int k = 0; k < n_rows; ++k)
      rows_[static_cast<size_t>(k)] = placed.result(k, strip, instant, workspace);
  }
  /// Of the nodes of a block of the strip.
  DIPTYCH_INLINE algebra::Tensor<Scalar> at(int block) const {
    algebra::Tensor<Scalar> F = algebra::identity<Scalar>();
    for (int i = 0; i < Dim; ++i) {
      for (int j = 0; j < Dim; ++j) {
        F(i, j).v = F(i, j).v + rows_[Dim * i + j][block];
        for (int k = 0; k < Dim; ++k)
          F(i, j).d[k] = rows_[Dim * Dim + n_second * i + second(j, k)][block];
      }
    }
    return F;
  }
  /// F without its gradient, and dF/dX_I; in plane strain of the plane alone.
  DIPTYCH_INLINE algebra::Tensor<Lanes> value_at(int block) const {
    algebra::Tensor<Lanes> F = algebra::identity<Lanes>();
    for (int i = 0; i < Dim; ++i) {
      for (int j = 0; j < Dim; ++j)
        F(i, j) = F(i, j) + rows_[Dim * i + j][block];
    }
    return F;
  }
  template <int I>
  DIPTYCH_INLINE algebra::Tensor<Lanes> derivative_at(int block) const {
    algebra::Tensor<Lanes> dF;
    for (int i = 0; i < Dim; ++i) {
      for (int j = 0; j < Dim; ++j)
        dF(i, j) = rows_[Dim * Dim + n_second * i + second(j, I)][block];
    }
    return dF;
  }
  static constexpr int n_rows = Dim * Dim + Dim * n_second;

 private:
  /// 00, 01, ..., 11, ...
  static constexpr int second(int j, int k) {
    return j <= k ? j * Dim - j * (j - 1) / 2 + k - j : second(k, j);
  }
  std::array<functions::PlacedProgram::Blocks, n_rows> rows_;
};

}  // namespace diptych::exact
