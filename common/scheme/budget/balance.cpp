#include "common/scheme/budget/balance.hpp"

#include <algorithm>

namespace diptych::scheme {

using algebra::n_lanes;

namespace {

template <int Dim>
void add_momenta(const Body<Dim>& body, std::int64_t begin, std::int64_t end, Balance& sum) {
  for (std::int64_t a = begin * n_lanes; a < std::min(end * n_lanes, body.n_owned); ++a) {
    Vec3 p = Vec3::Zero(), x = body.X_centred(a);
    for (int i = 0; i < Dim; ++i) {
      p[i] = body.options.rho_R * body.graph.Omega[a] * body.v.at(a, i);
      x[i] += body.u.at(a, i);
    }
    sum.linear_momentum += p;
    sum.angular_momentum += x.cross(p);
    sum.momentum_scale += p.norm();
    sum.angular_scale += x.norm() * p.norm();
  }
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
        for (std::int64_t a = begin * n_lanes; a < std::min(end * n_lanes, body.n_owned); ++a)
          parts[c].strain += body.bulk->reference(a) * material.volumetric_energy(J[a]);
      });
  body.part().complete(parts);
  Balance sum;
  sum.least_J = 1e300;
  for (const Balance& part : parts) {
    sum.kinetic += part.kinetic;
    sum.strain += part.strain;
    sum.linear_momentum += part.linear_momentum;
    sum.angular_momentum += part.angular_momentum;
    sum.momentum_scale += part.momentum_scale;
    sum.angular_scale += part.angular_scale;
    sum.least_J = std::min(sum.least_J, part.least_J);
    sum.involution_H = std::max(sum.involution_H, part.involution_H);
    sum.involution_J = std::max(sum.involution_J, part.involution_J);
  }
  return sum;
}

template Balance balance(const MaterialModel&, const Body<2>&);
template Balance balance(const MaterialModel&, const Body<3>&);

}  // namespace diptych::scheme
