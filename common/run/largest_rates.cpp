#include "common/run/largest_rates.hpp"

#include "common/scheme/body/pointwise.hpp"
#include "common/scheme/sweeps/strain_rates.hpp"

#include <cmath>

namespace diptych::run {

using algebra::Four;
using algebra::Lanes;
using lanczos::for_nodes;
using scheme::NodeRecord;

template <int Dim>
LargestRates<Dim>::LargestRates(scheme::Body<Dim>& body, double kappa_f, std::vector<double> moves)
    : body_(body),
      kappa_f_(kappa_f),
      moves_(std::move(moves)),
      momentum_(scheme::momentum_function<Dim>(
          {.reconstruction = body.options.has_moments ? scheme::Reconstruction::symmetric
                                                      : scheme::Reconstruction::none,
           .limiter = scheme::PairLimiter::none,
           .impedance = scheme::Impedance::isotropic},
          true)),
      face_(scheme::face_correction_sweeps<Dim>()),
      scratch_(3 * static_cast<size_t>(parallel::n_chunks_of(body.n_blocks))) {}

template <int Dim>
void LargestRates<Dim>::put_velocities(const Vectors& v) {
  for_nodes(body_.n_owned, [&](std::int64_t a) {
    const Four v_a = moves_.empty() ? v[a] : v[a] * moves_[a];
    for (int i = 0; i < Dim; ++i) {
      body_.v.set(a, i, v_a[i]);
      if (!body_.in_runs())  // rows read the copy in the records
        body_.records.set(a, NodeRecord<Dim>::v(body_.options.exact_impedance) + i, v_a[i]);
    }
  });
}

template <int Dim>
void LargestRates<Dim>::divide_forces(Vectors& out) const {
  for_nodes(body_.n_owned, [&](std::int64_t a) {
    out[a] = Four{};
    for (int i = 0; i < Dim; ++i)
      out[a][i] = -body_.T.at(a, i) / body_.graph.Omega[a];
    if (!moves_.empty()) out[a] *= moves_[a];
  });
}

template <int Dim>
void LargestRates<Dim>::sum_forces(double dissipation_factor) {
  const scheme::MomentumSweep<Dim> sweep{body_,
                                         dissipation_factor,
                                         false,
                                         scratch_.data(),
                                         scratch_.data() + scratch_.size() / 3,
                                         scratch_.data() + scratch_.size() / 3 * 2};
  if (body_.options.has_moments) {
    scheme::sum_moments(sweep, scheme::moments_function<Dim>(scheme::Impedance::isotropic, true));
    scheme::take_moments(body_);
  }
  scheme::sum_forces(sweep, momentum_);
}

template <int Dim>
void LargestRates<Dim>::clear_stresses() {
  for_nodes(body_.n_owned, [&](std::int64_t a) {
    for (int k = 0; k < Dim * Dim; ++k)
      body_.records.set(a, NodeRecord<Dim>::P + k, 0);
  });
}

/// Stresses of the velocity gradients in the records, for c_p = 1 and rho_R = 1.
template <int Dim>
void LargestRates<Dim>::put_stresses(const ElasticRatios& ratios) {
  const double mu = ratios.shear * ratios.shear, lambda = 1 - 2 * mu - ratios.cells;
  parallel::for_chunks(body_.n_blocks, [&](std::int64_t begin, std::int64_t end, std::int64_t) {
    for (std::int64_t b = begin; b < end; ++b) {
      const auto L = scheme::velocity_gradient(body_, b);
      algebra::Tensor<Lanes> P = L;
      Lanes trace{};
      for (int i = 0; i < Dim; ++i)
        trace += L(i, i);
      for (int i = 0; i < Dim; ++i) {
        for (int j = 0; j < Dim; ++j)
          P(i, j) = mu * (L(i, j) + L(j, i)) - ratios.cell_shear * L(i, j) +
                    (i == j ? lambda * trace : Lanes{});
      }
      if (kappa_f_ != 0) {
        algebra::put_tensor<Dim>(body_.stresses, b, 0, P);
      } else {
        algebra::put_tensor<Dim>(body_.records, b, NodeRecord<Dim>::P, P);
      }
    }
  });
  if (kappa_f_ == 0) return;
  parallel::for_chunks(body_.n_blocks, [&](std::int64_t begin, std::int64_t end, std::int64_t) {
    face_.stresses(body_, kappa_f_, begin, end);
  });
}

template <int Dim>
void LargestRates<Dim>::put_impedances(double shear_ratio) {
  clear_stresses();
  for_nodes(body_.n_owned, [&](std::int64_t a) {
    body_.records.set(a, NodeRecord<Dim>::z_p, 1);
    body_.records.set(a, NodeRecord<Dim>::z_s, shear_ratio);
  });
}

template <int Dim>
void LargestRates<Dim>::apply(const Vectors& u,
                              const ElasticRatios& ratios,
                              double strength,
                              Vectors& out) {
  put_velocities(u);
  scheme::velocity_gradients(body_, kappa_f_);
  put_stresses(ratios);
  if (body_.hourglass) {
    body_.hourglass->evaluate_linear(body_, ratios.hourglass);
    body_.hourglass->take_stresses(body_);
  }
  sum_forces(strength);
  if (body_.bulk) {
    body_.bulk->evaluate_linear(body_, ratios.cells, ratios.cell_shear);
    body_.bulk->add_forces(body_);
  }
  if (body_.hourglass) body_.hourglass->add_forces(body_);
  divide_forces(out);
}

template <int Dim>
double LargestRates<Dim>::dissipation(double shear_ratio) {
  put_impedances(shear_ratio);
  return lanczos::largest_eigenvalue<Four>(body_.graph.Omega, body_.n_owned,
                                           [&](const Vectors& v, Vectors& out) {
                                             put_velocities(v);
                                             if (body_.options.has_moments) {
                                               scheme::velocity_gradients(body_, kappa_f_);
                                               clear_stresses();
                                             }
                                             sum_forces(1);
                                             divide_forces(out);
                                           });
}

template <int Dim>
void LargestRates<Dim>::put_cofactors(int axis, double across) {
  for_nodes(body_.n_owned, [&](std::int64_t a) {
    for (int i = 0; i < Dim; ++i)
      body_.records.set(a, NodeRecord<Dim>::H + i * (Dim + 1), i == axis ? 0 : across - 1);
  });
}

template <int Dim>
double LargestRates<Dim>::dissipation_turned(double shear_ratio) {
  constexpr double across = 0.1;
  double largest = 0;
  for (int axis = 0; axis < Dim; ++axis) {
    put_cofactors(axis, across);
    largest = std::max(largest, dissipation(shear_ratio));
  }
  put_cofactors(0, 1);
  return largest;
}

template <int Dim>
double LargestRates<Dim>::frequency(const ElasticRatios& ratios) {
  put_impedances(ratios.shear);
  return std::sqrt(lanczos::largest_eigenvalue<Four>(
      body_.graph.Omega, body_.n_owned,
      [&](const Vectors& u, Vectors& out) { apply(u, ratios, 0, out); }));
}

template <int Dim>
double LargestRates<Dim>::leapfrog_limit(double dt, const ElasticRatios& ratios, double strength) {
  put_impedances(ratios.shear);
  const double of_both = lanczos::largest_eigenvalue<Four>(
      body_.graph.Omega, body_.n_owned,
      [&](const Vectors& v, Vectors& out) { apply(v, ratios, 2 * strength / dt, out); });
  return 0.25 * dt * dt * of_both;
}

template class LargestRates<2>;
template class LargestRates<3>;

}  // namespace diptych::run
