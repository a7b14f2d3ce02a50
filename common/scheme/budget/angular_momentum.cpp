#include "common/scheme/budget/angular_momentum.hpp"

#include "common/parallel/reduction.hpp"

#include <algorithm>

namespace diptych::scheme {

using algebra::n_lanes;

namespace {

struct Moments {
  double mass = 0;
  Vec3 first = Vec3::Zero();             ///< sum m x
  Vec3 momentum = Vec3::Zero();          ///< sum m v
  Mat3 second = Mat3::Zero();            ///< sum m x (x) x
  Vec3 angular_momentum = Vec3::Zero();  ///< sum x cross m v
};

template <int Dim>
Vec3 position(const Body<Dim>& body, std::int64_t a) {
  Vec3 x = body.X_centred(a);
  for (int i = 0; i < Dim; ++i)
    x[i] += body.u.at(a, i);
  return x;
}

}  // namespace

template <int Dim>
Projection project_angular_momentum(Body<Dim>& body, const Vec3& wanted) {
  const auto for_nodes = [&](const auto& work) {
    parallel::for_chunks(body.part(), body.n_blocks,
                         [&](std::int64_t begin, std::int64_t end, std::int64_t chunk) {
                           const std::int64_t last = std::min(end * n_lanes, body.n_owned);
                           for (std::int64_t a = begin * n_lanes; a < last; ++a)
                             work(a, chunk);
                         });
  };
  std::vector<Moments> parts(parallel::n_chunks_of(body.n_blocks));
  for_nodes([&](std::int64_t a, std::int64_t chunk) {
    const double m = body.options.rho_R * body.graph.Omega[a];
    const Vec3 x = position(body, a);
    Vec3 v = Vec3::Zero();
    for (int i = 0; i < Dim; ++i)
      v[i] = body.v.at(a, i);
    parts[chunk].mass += m;
    parts[chunk].first += m * x;
    parts[chunk].momentum += m * v;
    parts[chunk].second += m * x * x.transpose();
    parts[chunk].angular_momentum += m * x.cross(v);
  });
  const auto sum = parallel::sum_of_chunks(body.part(), parts);
  const Vec3 centre = sum.first / sum.mass;
  const Mat3 second = sum.second - sum.mass * centre * centre.transpose();
  Mat3 K = second.trace() * Mat3::Identity() - second;
  Vec3 missing = wanted - sum.angular_momentum;
  if constexpr (Dim == 2) {  // only the moment about z exists
    K = Mat3::Identity() * K(2, 2);
    missing[0] = missing[1] = 0;
  }
  const Vec3 lambda = K.ldlt().solve(missing);
  // of v + lambda x (x - centre): the first moment of the change is zero
  const Vec3 spin = sum.angular_momentum - centre.cross(sum.momentum);
  const double gain = lambda.dot(spin) + 0.5 * lambda.dot(missing);
  for_nodes([&](std::int64_t a, std::int64_t) {
    const Vec3 change = lambda.cross(position(body, a) - centre);
    for (int i = 0; i < Dim; ++i)
      body.v.add(a, i, change[i]);
  });
  return {lambda, centre, gain};
}

template Projection project_angular_momentum(Body<2>&, const Vec3&);
template Projection project_angular_momentum(Body<3>&, const Vec3&);

}  // namespace diptych::scheme
