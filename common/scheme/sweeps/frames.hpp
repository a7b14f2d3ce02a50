#pragma once
/// What the objective reconstruction reads of neighbours (NodeFrame): positions, deformation and
/// spin of the nodes, and what pairs make of it. Test: tests/common/scheme/sweeps_test.cpp

#include "common/scheme/body/body.hpp"
#include "common/scheme/sweeps/pair_access.hpp"

namespace diptych::scheme {

/// Frames of blocks [begin, end) from u, F and L as they stand.
template <int Dim>
void set_frames(Body<Dim>& body, std::int64_t begin, std::int64_t end);

/// What the mean spin of the pair, W_ab, makes of eight pairs: velocities of a rigid spin of the
/// deformed body.
template <int Dim, class T>
struct SpinningPair {
  algebra::Vector<T> jump{};    ///< W_ab (x_b - x_a)  [m/s]
  algebra::Vector<T> slopes{};  ///< W_ab (F_a + F_b) X_ab, what both slopes have of it
};

/// omega x r; in the plane omega has the one component about the normal.
template <int Dim, class T>
DIPTYCH_INLINE algebra::Vector<T> spin_times(const algebra::Vector<T>& omega,
                                             const algebra::Vector<T>& r) {
  algebra::Vector<T> w{};
  if constexpr (Dim == 3) {
    w[0] = omega[1] * r[2] - omega[2] * r[1];
    w[1] = omega[2] * r[0] - omega[0] * r[2];
    w[2] = omega[0] * r[1] - omega[1] * r[0];
  } else {
    w[0] = -omega[0] * r[1];
    w[1] = omega[0] * r[0];
  }
  return w;
}

/// @param frames  pairs of Body::frames
/// @param X_ab    X_b - X_a  [m]
template <int Dim, class Frames, class T>
DIPTYCH_INLINE SpinningPair<Dim, T> spinning_pair(const Frames& frames,
                                                  const algebra::Vector<T>& X_ab) {
  using Frame = NodeFrame<Dim>;
  algebra::Vector<T> omega{}, x_ab{}, F_X{};
  for (int k = 0; k < Frame::n_spin; ++k)
    omega[k] = 0.5 * (frames.neighbour(Frame::spin + k) + frames.own(Frame::spin + k));
#pragma GCC unroll 3
  for (int i = 0; i < Dim; ++i) {
    x_ab[i] = X_ab[i] + (frames.neighbour(Frame::u + i) - frames.own(Frame::u + i));
    F_X[i] = X_ab[i] + X_ab[i];  // frames hold F - I
#pragma GCC unroll 3
    for (int j = 0; j < Dim; ++j) {
      const int ij = Frame::F + i * Dim + j;
      F_X[i] += (frames.neighbour(ij) + frames.own(ij)) * X_ab[j];
    }
  }
  return {spin_times<Dim>(omega, x_ab), spin_times<Dim>(omega, F_X)};
}

}  // namespace diptych::scheme
