#include "common/scheme/boundary/body_loads.hpp"

#include "common/algebra/tensor.hpp"
#include "common/parallel/reduction.hpp"

namespace diptych::scheme {

using algebra::Lanes;

BodyLoads::BodyLoads(std::shared_ptr<KnownLoads> known,
                     const std::vector<Vec3>& X,
                     const std::vector<double>& Omega)
    : known_(std::move(known)),
      X_(static_cast<std::int64_t>(X.size()), 3),
      Omega_(static_cast<std::int64_t>(X.size()), 1) {
  for (size_t a = 0; a < X.size(); ++a) {
    const auto node = static_cast<std::int64_t>(a);
    for (int i = 0; i < 3; ++i)
      X_.set(node, i, X[a][i]);
    Omega_.set(node, 0, Omega[a]);
  }
}

template <int Dim>
LoadRates BodyLoads::add_blocks(const algebra::BlockField& forces,
                                Body<Dim>& body,
                                std::int64_t begin,
                                std::int64_t end) const {
  algebra::Vector<Lanes> force{}, torque{};
  Lanes power = Lanes{};
  for (std::int64_t b = begin; b < end; ++b) {
    algebra::Vector<Lanes> f{}, x{};
    for (int i = 0; i < Dim; ++i) {
      f[i] = Omega_.get(b, 0) * forces.get(b, i);
      x[i] = X_.get(b, i) + body.u.get(b, i);
      power = power + f[i] * body.v.get(b, i);
      body.T.put(b, i, body.T.get(b, i) + f[i]);
    }
    force = force + f;
    torque = torque + algebra::cross(x, f);
  }
  LoadRates rates;
  rates.power = algebra::lane_sum(power);
  for (int i = 0; i < 3; ++i) {
    rates.force[i] = algebra::lane_sum(force[i]);
    rates.torque[i] = algebra::lane_sum(torque[i]);
  }
  return rates;
}

template <int Dim>
LoadRates BodyLoads::add_to(Body<Dim>& body) const {
  const algebra::BlockField& forces = known().body_forces();
  std::vector<LoadRates> parts(static_cast<size_t>(parallel::n_chunks_of(body.n_blocks)));
  parallel::for_chunks(body.part(), body.n_blocks, [&](auto begin, auto end, auto chunk) {
    parts[static_cast<size_t>(chunk)] = add_blocks(forces, body, begin, end);
  });
  return parallel::sum_of_chunks(body.part(), parts);
}

template <int Dim>
double BodyLoads::power_of_blocks(const algebra::BlockField& forces,
                                  const Body<Dim>& body,
                                  std::int64_t begin,
                                  std::int64_t end) const {
  Lanes power = Lanes{};
  for (std::int64_t b = begin; b < end; ++b) {
    for (int i = 0; i < Dim; ++i)
      power = power + Omega_.get(b, 0) * forces.get(b, i) * body.v.get(b, i);
  }
  return algebra::lane_sum(power);
}

template <int Dim>
double BodyLoads::power(const Body<Dim>& body) const {
  const algebra::BlockField& forces = known().body_forces();
  std::vector<double> parts(static_cast<size_t>(parallel::n_chunks_of(body.n_blocks)));
  parallel::for_chunks(body.part(), body.n_blocks, [&](auto begin, auto end, auto chunk) {
    parts[static_cast<size_t>(chunk)] = power_of_blocks(forces, body, begin, end);
  });
  return parallel::sum_of_chunks(body.part(), parts);
}

#define DIPTYCH_INSTANTIATE(Dim)                               \
  template LoadRates BodyLoads::add_to(Body<Dim>& body) const; \
  template double BodyLoads::power(const Body<Dim>& body) const;
DIPTYCH_INSTANTIATE(2)
DIPTYCH_INSTANTIATE(3)
#undef DIPTYCH_INSTANTIATE

}  // namespace diptych::scheme
