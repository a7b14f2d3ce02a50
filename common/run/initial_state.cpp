#include "common/run/initial_state.hpp"

#include "common/base/error.hpp"
#include "common/functions/placed_values.hpp"
#include "common/scheme/sweeps/strain_rates.hpp"

#include <fmt/format.h>
#include <utility>

namespace diptych::run {

using algebra::Mat3;
using algebra::Vec3;

namespace {

template <int Dim>
void put_deformation(scheme::Body<Dim>& body, std::int64_t a, const Mat3& F) {
  const auto X = physics::deformation_of(algebra::to_tensor(F));
  const auto deviation = [](const auto& T, int k) {
    return T(k / Dim, k % Dim) - (k % (Dim + 1) == 0 ? 1 : 0);
  };
  for (int k = 0; k < Dim * Dim; ++k)
    body.F.set(a, k, deviation(F, k));
  if (body.options.unknowns == scheme::Unknowns::FHJ) {
    for (int k = 0; k < Dim * Dim; ++k)
      body.records.set(a, scheme::NodeRecord<Dim>::H + k, deviation(X.H, k));
    if constexpr (Dim == 2) body.H_33.set(a, 0, X.H(2, 2) - 1);
  }
  if (!body.J.empty()) body.J.set(a, 0, X.J - 1);
}

/// Uniform in [-1, 1), by position in a fixed sequence (splitmix64).
double random_number(std::uint64_t position) {
  std::uint64_t z = (position + 1) * 0x9e3779b97f4a7c15U;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
  return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-52 - 1;
}

template <int Dim>
void put_internal_variables(scheme::Body<Dim>& body, std::int64_t a, const Mat3& F, bool relaxed) {
  using Layout = algebra::Layout<Dim>;
  const auto X = physics::deformation_of(algebra::to_tensor(F));
  const auto I = algebra::symmetric_identity<double>();
  const auto A = relaxed ? physics::inverse_C(X) : I;
  const auto S = relaxed ? physics::inverse_G(X) : I;
  const auto deviation = [](const auto& T, int s) { return s < 3 ? T.s[s] - 1 : T.s[s]; };
  for (int k = 0; k < body.options.n_branches; ++k) {
    for (int c = 0; c < Layout::n_A; ++c)
      body.A.set(a, k * Layout::n_A + c, deviation(A, algebra::order_of_A<Dim>[c]));
    if (body.S.empty()) continue;
    for (int c = 0; c < Layout::n_S; ++c)
      body.S.set(a, k * Layout::n_S + c, deviation(S, algebra::order_of_S<Dim>[c]));
  }
}

/// What (18b) makes of displacements where it stands for velocities: I + G u  [-]
template <int Dim>
std::vector<Mat3> discrete_deformation(scheme::Body<Dim>& body,
                                       const std::vector<Vec3>& u,
                                       double kappa_f) {
  const auto n = static_cast<std::int64_t>(u.size());
  for (std::int64_t a = 0; a < n; ++a) {
    for (int i = 0; i < Dim; ++i)
      body.v.set(a, i, u[a][i] - u[0][i]);  // a translation leaves single precision its digits
  }
  scheme::velocity_gradients(body, kappa_f);
  std::vector<Mat3> F(u.size(), Mat3::Identity());
  for (std::int64_t a = 0; a < n; ++a) {
    for (int k = 0; k < Dim * Dim; ++k)
      F[a](k / Dim, k % Dim) += body.L(a, k);
  }
  return F;
}

/// As given by the case, in plane strain without a third direction.
template <int Dim>
Mat3 of_dimension(Mat3 F) {
  if (Dim == 2) {
    F.row(2) = Vec3::UnitZ().transpose();
    F.col(2) = Vec3::UnitZ();
  }
  return F;
}

}  // namespace

template <int Dim>
void set_initial_state(const cases::InitialCase& initial, double kappa_f, scheme::Body<Dim>& body) {
  const std::int64_t n = body.n_owned;
  const exact::Motion* motion = initial.motion.get();
  const std::span<const Vec3> places(body.X.data(), static_cast<size_t>(n));
  const auto given = [&](const functions::VectorExpression& field) {
    return functions::vectors_at(field, places, 0);
  };
  const std::vector<Vec3> u =
      motion ? motion->displacements(places, 0) : given(initial.displacement);
  const std::vector<Vec3> velocity =
      motion ? motion->velocities(places, 0) : given(initial.velocity);
  std::vector<Mat3> given_F;
  if (initial.deformation_gradient)
    given_F = functions::tensors_at(*initial.deformation_gradient, places, 0);
  const std::vector<Mat3> discrete = discrete_deformation(body, u, kappa_f);
  for (std::int64_t a = 0; a < n; ++a) {
    const Vec3& X = body.X[a];
    const Vec3& v = velocity[a];
    for (int i = 0; i < Dim; ++i) {
      body.u.set(a, i, u[a][i]);
      const double noise = initial.velocity_noise;
      body.v.set(a, i, noise == 0 ? v[i] : v[i] + noise * random_number(Dim * a + i));
    }
    const Mat3 F = given_F.empty() ? discrete[a] : of_dimension<Dim>(given_F[a]);
    if (!(F.determinant() > 0)) {
      throw base::InputError(
          fmt::format("initial displacement gives J = {:g} at the node at ({:g}, {:g}, {:g}); J "
                      "must be positive",
                      F.determinant(), X[0], X[1], X[2]));
    }
    put_deformation(body, a, F);
    put_internal_variables(body, a, F, initial.relaxed);
  }
}

template void set_initial_state(const cases::InitialCase&, double, scheme::Body<2>&);
template void set_initial_state(const cases::InitialCase&, double, scheme::Body<3>&);

}  // namespace diptych::run
