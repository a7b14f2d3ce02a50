#include "common/scheme/budget/balance.hpp"

#include "common/parallel/reduction.hpp"
#include "common/scheme/body/point_access.hpp"

#include <algorithm>
#include <cmath>

namespace diptych::scheme {

using algebra::Lanes;
using algebra::n_lanes;

namespace {

/// X - centroid of the nodes of a block, zero in the padding  [m]
template <int Dim>
DIPTYCH_INLINE void load_positions(const Body<Dim>& body, std::int64_t b, Lanes (&x)[Dim]) {
  const std::int64_t first = b * n_lanes;
  const auto n = static_cast<int>(std::min<std::int64_t>(n_lanes, body.n_owned - first));
  for (int i = 0; i < Dim; ++i)
    x[i] = Lanes{};
  for (int l = 0; l < n; ++l) {
    for (int i = 0; i < Dim; ++i)
      x[i][l] = body.X[first + l][i] - body.centroid[i];
  }
}

template <int Dim>
DIPTYCH_CLONES void add_momenta(const Body<Dim>& body,
                                std::int64_t begin,
                                std::int64_t end,
                                Balance& sum) {
  Lanes linear[3]{}, angular[3]{}, momentum_scale{}, angular_scale{};
  for (std::int64_t b = begin; b < end; ++b) {
    const Lanes mass = body.options.rho_R * algebra::load(body.graph.Omega.data() + b * n_lanes);
    Lanes x[Dim], p[Dim], x_x{}, p_p{};
    load_positions(body, b, x);
    for (int i = 0; i < Dim; ++i) {
      p[i] = mass * body.v.get(b, i);
      x[i] += body.u.get(b, i);
      linear[i] += p[i];
      x_x += x[i] * x[i];
      p_p += p[i] * p[i];
    }
    angular[2] += x[0] * p[1] - x[1] * p[0];
    if constexpr (Dim == 3) {
      angular[0] += x[1] * p[2] - x[2] * p[1];
      angular[1] += x[2] * p[0] - x[0] * p[2];
    }
    const Lanes size = algebra::square_root(p_p);
    momentum_scale += size;
    angular_scale += algebra::square_root(x_x) * size;
  }
  for (int i = 0; i < 3; ++i) {
    sum.linear_momentum[i] += algebra::lane_sum(linear[i]);
    sum.angular_momentum[i] += algebra::lane_sum(angular[i]);
  }
  sum.momentum_scale += algebra::lane_sum(momentum_scale);
  sum.angular_scale += algebra::lane_sum(angular_scale);
}

/// Of all ranks, from what each chunk has.
Balance total(const parallel::Part& part, const std::vector<Balance>& of_chunks) {
  const auto column = [&](const auto& number_of) {
    std::vector<double> numbers;
    for (const Balance& of_chunk : of_chunks)
      numbers.push_back(number_of(of_chunk));
    return numbers;
  };
  const auto of = [&](double Balance::*member) {
    return column([member](const Balance& balance) { return balance.*member; });
  };
  Balance total;
  parallel::Reduction reduction(part);
  for (double Balance::*member :
       {&Balance::kinetic, &Balance::strain, &Balance::momentum_scale, &Balance::angular_scale,
        &Balance::carried_volume, &Balance::volume_apart})
    reduction.sum(of(member), total.*member);
  for (Vec3 Balance::*member : {&Balance::linear_momentum, &Balance::angular_momentum}) {
    for (int i = 0; i < 3; ++i) {
      reduction.sum(column([&](const Balance& balance) { return (balance.*member)[i]; }),
                    (total.*member)[i]);
    }
  }
  reduction.least(of(&Balance::least_J), total.least_J);
  reduction.largest(of(&Balance::involution_H), total.involution_H);
  reduction.largest(of(&Balance::involution_J), total.involution_J);
  reduction.finish();
  return total;
}

}  // namespace

template <int Dim>
Balance balance(const MaterialModel& material, const Body<Dim>& body) {
  const auto add_energies = block_physics<Dim>(material).add_energies;
  const std::vector<double> J = body.bulk ? body.bulk->ratios(body) : std::vector<double>{};
  std::vector<Balance> parts(parallel::n_chunks_of(body.n_blocks));
  parallel::for_chunks(
      body.part(), body.n_blocks, [&](std::int64_t begin, std::int64_t end, std::int64_t c) {
        parts[c].least_J = 1e300;
        add_energies(material, body, begin, end, parts[c]);
        add_momenta(body, begin, end, parts[c]);
        if (J.empty()) return;
        for (std::int64_t a = begin * n_lanes; a < std::min(end * n_lanes, body.n_owned); ++a) {
          const double V = body.bulk->reference(a);
          parts[c].strain += V * material.volumetric_energy(J[a]);
          parts[c].carried_volume += V * J[a];
          parts[c].volume_apart += V * std::abs(deformation_at(body, a).J - J[a]);
        }
      });
  if (body.bulk) {
    std::vector<double> shear(parts.size());
    body.bulk->add_shear_energies(body, shear);
    for (size_t c = 0; c < parts.size(); ++c)
      parts[c].strain += shear[c];
  }
  if (body.hourglass) {
    std::vector<double> energy(parts.size());
    body.hourglass->add_energies(body, energy);
    for (size_t c = 0; c < parts.size(); ++c)
      parts[c].strain += energy[c];
  }
  return total(body.part(), parts);
}

template Balance balance(const MaterialModel&, const Body<2>&);
template Balance balance(const MaterialModel&, const Body<3>&);

}  // namespace diptych::scheme
