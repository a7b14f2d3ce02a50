#pragma once
/// What the sweeps make of one pair, written out for one pair at a time in doubles and 3x3 matrices
/// from the equations of notes 3.4 and not from the code: what tests of the pair kernels compare
/// with. Plane strain: components out of plane are zero, or those of I.

#include "common/algebra/layout.hpp"
#include "common/physics/wave_speeds.hpp"
#include "common/scheme/sweeps/momentum.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace diptych::tests {

using algebra::Mat3;
using algebra::Vec3;

/// What a pair reads of one of its nodes.
struct NodeOfPair {
  Vec3 v, X, u, spin;  ///< the last two where the reconstruction is objective
  Mat3 P, L, H;        ///< Pa, 1/s, -
  double z_p, z_s;     ///< kg/(m^2 s)
  // exact impedance
  Mat3 F, A_tot, S_tot;
  double W_JJ, W_FJ;  ///< Pa
};

/// The components of a node as they stand in its frame.
template <int Dim, class Put>
void put_frame(const NodeOfPair& node, const Put& put) {
  using Frame = scheme::NodeFrame<Dim>;
  for (int i = 0; i < Dim; ++i) {
    put(Frame::u + i, node.u[i]);
    for (int j = 0; j < Dim; ++j)
      put(Frame::F + i * Dim + j, node.F(i, j) - (i == j ? 1 : 0));
  }
  for (int k = 0; k < Frame::n_spin; ++k)
    put(Frame::spin + k, node.spin[Dim == 3 ? k : 2]);
}

/// The components of a node as they stand in its record.
/// @param put  put(component, value)
template <int Dim, class Put>
void put_record(const NodeOfPair& node, bool exact, const Put& put) {
  using Record = scheme::NodeRecord<Dim>;
  for (int i = 0; i < Dim; ++i) {
    for (int j = 0; j < Dim; ++j) {
      const double one = i == j ? 1 : 0;
      put(Record::P + i * Dim + j, node.P(i, j));
      put(Record::L + i * Dim + j, node.L(i, j));
      put(Record::H + i * Dim + j, node.H(i, j) - one);
      if (exact) put(Record::F + i * Dim + j, node.F(i, j) - one);
    }
  }
  put(Record::z_p, node.z_p);
  put(Record::z_s, node.z_s);
  if (!exact) return;
  constexpr int in_space[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};
  constexpr int A_in_plane[3][2] = {{0, 0}, {1, 1}, {0, 1}};
  constexpr int S_in_plane[4][2] = {{0, 0}, {1, 1}, {0, 1}, {2, 2}};
  for (int k = 0; k < algebra::Layout<Dim>::n_A; ++k) {
    const auto& at = Dim == 3 ? in_space[k] : A_in_plane[k];
    put(Record::A_tot + k, node.A_tot(at[0], at[1]));
  }
  for (int k = 0; k < algebra::Layout<Dim>::n_S; ++k) {
    const auto& at = Dim == 3 ? in_space[k] : S_in_plane[k];
    put(Record::S_tot + k, node.S_tot(at[0], at[1]));
  }
  put(Record::W_JJ, node.W_JJ);
  put(Record::W_FJ, node.W_FJ);
}

/// A random matrix about a multiple of I.
template <int Dim>
Mat3 random_matrix(std::mt19937& random, double size, double diagonal, double out_of_plane) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  Mat3 M = Mat3::Zero();
  for (int i = 0; i < Dim; ++i) {
    for (int j = 0; j < Dim; ++j)
      M(i, j) = size * uniform(random) + (i == j ? diagonal : 0);
  }
  if (Dim == 2) M(2, 2) = out_of_plane;
  return M;
}

/// The two nodes of a random pair. H of the mean state is its cof F, for which alone the closed
/// form of the exact impedance is exact.
/// @param has_H      of the material: with W_FJ = 0, otherwise with S_tot = 0
/// @param roughness  of v beside an affine field: one where slopes and jumps have nothing in common
template <int Dim>
std::array<NodeOfPair, 2> random_pair(std::mt19937& random, bool has_H, double roughness) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::array<NodeOfPair, 2> pair;
  const Mat3 L = random_matrix<Dim>(random, 1, 0, 0), F = random_matrix<Dim>(random, 0.2, 1, 1);
  const Mat3 H = F.determinant() * F.inverse().transpose();
  const Mat3 dF = random_matrix<Dim>(random, 0.2, 0, 0), dH = random_matrix<Dim>(random, 0.2, 0, 0);
  double side = -1;
  for (NodeOfPair& node : pair) {
    node.X = node.v = Vec3::Zero();
    for (int i = 0; i < Dim; ++i) {
      node.X[i] = uniform(random);
      node.v[i] = roughness * uniform(random);
    }
    node.v += L * node.X;
    node.L = L + roughness * random_matrix<Dim>(random, 1, 0, 0);
    node.P = random_matrix<Dim>(random, 1, 0, 0);
    node.H = H + side * dH;
    node.F = F + side * dF;
    side = 1;
    node.z_p = 2 + 0.5 * uniform(random);
    node.z_s = 1 + 0.5 * uniform(random);
    const Mat3 A = random_matrix<Dim>(random, 0.3, 2, 1),
               S = random_matrix<Dim>(random, 0.3, 1, 1.5);
    node.A_tot = 0.5 * (A + A.transpose());
    node.S_tot = has_H ? Mat3(0.5 * (S + S.transpose())) : Mat3(Mat3::Zero());
    node.W_JJ = 3 + uniform(random);
    node.W_FJ = has_H ? 0 : -0.3 + 0.1 * uniform(random);
    node.u = node.spin = Vec3::Zero();
    for (int i = 0; i < Dim; ++i)
      node.u[i] = 0.2 * uniform(random);
    for (int i = Dim == 3 ? 0 : 2; i < 3; ++i)
      node.spin[i] = uniform(random);
  }
  return pair;
}

/// Factor of a slope from the jumps to both sides.
inline double slope_factor(scheme::PairLimiter limiter, double forward, double backward) {
  if (forward * backward <= 0) return 0;
  const double f = std::abs(forward), b = std::abs(backward);
  const double y = std::min(f, b) / (0.25 * (f + b));
  if (limiter == scheme::PairLimiter::barth_jespersen) return std::min(1.0, y);
  return (y * y + 2 * y) / (y * y + y + 2);
}

/// v_b^rec - v_a^rec, limited along n and across it.
/// @param jump       that of plain or seen velocities without the slopes
/// @param l_a, l_b   L_a X_ab, L_b X_ab
/// @param at_switch  set where one part is zero but for rounding, which then decides whether the
///                   slopes across both n and the plain jump count: Barth and Jespersen's limiter
///                   takes a slope above twice the jump to just that
inline Vec3 jump_written_out(scheme::PairLimiter limiter,
                             const Vec3& plain,
                             const Vec3& jump,
                             const Vec3& l_a,
                             const Vec3& l_b,
                             const Vec3& n,
                             bool& at_switch) {
  if (limiter == scheme::PairLimiter::none) return jump;
  const Vec3 across = plain - plain.dot(n) * n;
  const Vec3 t = across.norm() > 0 ? Vec3(across.normalized()) : Vec3(Vec3::Zero());
  if (limiter == scheme::PairLimiter::sign_preserving) {
    const auto between = [](double part, double whole) {  // nothing and all of it
      return whole > 0 ? std::clamp(part, 0.0, whole) : std::clamp(part, whole, 0.0);
    };
    return between(jump.dot(n), plain.dot(n)) * n + between(jump.dot(t), plain.dot(t)) * t;
  }
  Vec3 sum = Vec3::Zero();
  for (const bool is_along : {true, false}) {
    const Vec3& e = is_along ? n : t;
    const double D = plain.dot(e), a = l_a.dot(e), b = l_b.dot(e);
    const double phi_a = slope_factor(limiter, D, 2 * a - D);
    const double phi_b = slope_factor(limiter, D, 2 * b - D);
    const double scalar = D - (phi_a * a + phi_b * b) / 2;
    at_switch = at_switch || std::abs(scalar) < 1e-6 * std::abs(D);
    if (scalar * D <= 0) continue;
    const double strength = 1 + 2 * (1 - std::min(phi_a, phi_b));
    const auto part = [&](const Vec3& w) -> Vec3 {
      return is_along ? Vec3(w.dot(n) * n) : Vec3(w - w.dot(n) * n);
    };
    sum += strength * (part(plain) - (phi_a * part(l_a) + phi_b * part(l_b)) / 2);
  }
  return sum;
}

/// Square root of rho_R Q(N) of the mean state of a pair.
inline Mat3 exact_impedance(const NodeOfPair& a, const NodeOfPair& b, double rho_R, const Vec3& N) {
  physics::Response<double> r{};
  physics::Deformation<double> X{};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      X.F(i, j) = (a.F(i, j) + b.F(i, j)) / 2;
      X.H(i, j) = (a.H(i, j) + b.H(i, j)) / 2;
      r.A_tot(i, j) = (a.A_tot(i, j) + b.A_tot(i, j)) / 2;
      r.S_tot(i, j) = (a.S_tot(i, j) + b.S_tot(i, j)) / 2;
    }
  }
  r.W_JJ = (a.W_JJ + b.W_JJ) / 2;
  r.W_FJ = (a.W_FJ + b.W_FJ) / 2;
  const auto Q = physics::acoustic_tensor(r, X, algebra::Vector<double>{{N[0], N[1], N[2]}});
  Mat3 rho_Q;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j)
      rho_Q(i, j) = rho_R * Q(i, j);
  }
  return Eigen::SelfAdjointEigenSolver<Mat3>(rho_Q).operatorSqrt();
}

/// The numbers of one pair.
struct PairWrittenOut {
  Vec3 D = Vec3::Zero();  ///< D_ab  [N]
  double power = 0;       ///< (v_b - v_a) . D_ab  [W]
  bool is_limited = false;
  bool at_switch = false;  ///< of the limiter: rounding decides
};

inline PairWrittenOut pair_written_out(const scheme::DissipationKind& kind,
                                       double rho_R,
                                       const NodeOfPair& a,
                                       const NodeOfPair& b,
                                       const Vec3& C_ab,
                                       const Vec3& C_ba) {
  PairWrittenOut pair;
  const Vec3 S = (C_ab - C_ba) / 2;
  if (S.norm() == 0) return pair;
  const Vec3 plain = b.v - a.v, X_ab = b.X - a.X, n = ((a.H + b.H) * S).normalized();
  Vec3 jump = plain;
  if (kind.reconstruction != scheme::Reconstruction::none) {
    const Vec3 l_a = a.L * X_ab, l_b = b.L * X_ab;
    Vec3 unlimited = plain - (l_a + l_b) / 2;
    if (kind.reconstruction == scheme::Reconstruction::objective) {
      const Vec3 x_ab = X_ab + b.u - a.u;
      unlimited -= ((a.spin + b.spin) / 2).cross(x_ab - (a.F + b.F) / 2 * X_ab);
    }
    jump = jump_written_out(kind.limiter, plain, unlimited, l_a, l_b, n, pair.at_switch);
    pair.is_limited = (jump - unlimited).norm() > 0.01 * plain.norm();
  }
  Mat3 Z = exact_impedance(a, b, rho_R, S.normalized());
  if (kind.impedance == scheme::Impedance::isotropic) {
    const Mat3 n_n = n * n.transpose();
    Z = (a.z_p + b.z_p) / 2 * n_n + (a.z_s + b.z_s) / 2 * (Mat3::Identity() - n_n);
  }
  pair.D = S.norm() / 2 * Z * jump;
  pair.power = plain.dot(pair.D);
  return pair;
}

}  // namespace diptych::tests
