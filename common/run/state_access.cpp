#include "common/run/state_access.hpp"

#include "common/base/error.hpp"

#include <fmt/format.h>
#include <xxhash.h>

namespace diptych::run {

using algebra::n_lanes;
using algebra::Vec3;

std::vector<Vec3> centred(const scheme::PairGraph& graph) {
  Vec3 sum = Vec3::Zero();
  double volume = 0;
  for (std::int64_t a = 0; a < graph.n_nodes(); ++a) {
    sum += graph.Omega[a] * graph.X[a];
    volume += graph.Omega[a];
  }
  std::vector<Vec3> X = graph.X;
  for (Vec3& x : X)
    x -= sum / volume;
  return X;
}

namespace {

/// G_a = sum_b 1/2 (u_b - u_a) (x) C_ab / Omega_a, and with the face correction
/// G_a + kappa_f/Omega_a sum_b [(G_a - G_b) X_ab] (x) S_ab: what (18b) would have made of u.
std::vector<Mat3> discrete_gradients(const scheme::PairGraph& graph,
                                     const std::vector<Vec3>& u,
                                     double kappa_f) {
  const std::int64_t n = graph.n_nodes();
  std::vector<Mat3> plain(n, Mat3::Zero());
  for (std::int64_t a = 0; a < n; ++a) {
    for (std::int64_t k = graph.row[a]; k < graph.row[a + 1]; ++k) {
      plain[a] += (u[graph.neighbour[k]] - u[a]) * graph.C[k].transpose();
    }
    plain[a] *= 0.5 / graph.Omega[a];
  }
  if (kappa_f == 0) return plain;
  std::vector<Mat3> corrected = plain;
  for (std::int64_t a = 0; a < n; ++a) {
    for (std::int64_t k = graph.row[a]; k < graph.row[a + 1]; ++k) {
      const std::int32_t b = graph.neighbour[k];
      // S_ab in single precision, as the sweeps have it
      const Vec3 S_ab =
          (0.5 * (graph.C[k] - graph.C[graph.reverse[k]])).cast<float>().cast<double>();
      corrected[a] += kappa_f / graph.Omega[a] *
                      ((plain[a] - plain[b]) * (graph.X[b] - graph.X[a])) * S_ab.transpose();
    }
  }
  return corrected;
}

template <int Dim>
void put_deformation(scheme::State<Dim>& state, std::int64_t a, const Mat3& F) {
  const auto X = physics::deformation_of(algebra::to_tensor(F));
  const auto deviation = [](const auto& T, int k) {
    return T(k / Dim, k % Dim) - (k % (Dim + 1) == 0 ? 1 : 0);
  };
  for (int k = 0; k < Dim * Dim; ++k)
    state.F.set(a, k, deviation(F, k));
  if (state.unknowns == scheme::Unknowns::FHJ) {
    for (int k = 0; k < Dim * Dim; ++k)
      state.records.set(a, scheme::NodeRecord<Dim>::H + k, deviation(X.H, k));
    if constexpr (Dim == 2) state.H_33.set(a, 0, X.H(2, 2) - 1);
  }
  if (!state.J.empty()) state.J.set(a, 0, X.J - 1);
}

/// Uniform in [-1, 1), by position in a fixed sequence (splitmix64).
double random_number(std::uint64_t position) {
  std::uint64_t z = (position + 1) * 0x9e3779b97f4a7c15U;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
  return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-52 - 1;
}

template <int Dim>
void put_internal_variables(scheme::State<Dim>& state,
                            std::int64_t a,
                            const Mat3& F,
                            bool relaxed) {
  using Layout = algebra::Layout<Dim>;
  const auto X = physics::deformation_of(algebra::to_tensor(F));
  const auto I = algebra::symmetric_identity<double>();
  const auto A = relaxed ? physics::inverse_C(X) : I;
  const auto S = relaxed ? physics::inverse_G(X) : I;
  const auto deviation = [](const auto& T, int s) { return s < 3 ? T.s[s] - 1 : T.s[s]; };
  for (int k = 0; k < state.n_branches; ++k) {
    for (int c = 0; c < Layout::n_A; ++c)
      state.A.set(a, k * Layout::n_A + c, deviation(A, algebra::order_of_A<Dim>[c]));
    if (state.S.empty()) continue;
    for (int c = 0; c < Layout::n_S; ++c)
      state.S.set(a, k * Layout::n_S + c, deviation(S, algebra::order_of_S<Dim>[c]));
  }
}

}  // namespace

template <int Dim>
void set_initial_state(const scheme::PairGraph& graph,
                       const cases::InitialCase& initial,
                       double kappa_f,
                       scheme::State<Dim>& state) {
  const std::int64_t n = graph.n_nodes();
  std::vector<Vec3> u(n);
  const exact::Motion* motion = initial.motion.get();
  for (std::int64_t a = 0; a < n; ++a)
    u[a] = motion ? motion->displacement(graph.X[a], 0) : initial.displacement(graph.X[a], 0);
  const std::vector<Mat3> gradients = discrete_gradients(graph, u, kappa_f);
  for (std::int64_t a = 0; a < n; ++a) {
    const Vec3 v = motion ? motion->velocity(graph.X[a], 0) : initial.velocity(graph.X[a], 0);
    for (int i = 0; i < Dim; ++i) {
      state.u.set(a, i, u[a][i]);
      const double noise = initial.velocity_noise;
      state.v.set(a, i, noise == 0 ? v[i] : v[i] + noise * random_number(Dim * a + i));
    }
    Mat3 F = initial.deformation_gradient ? (*initial.deformation_gradient)(graph.X[a], 0)
                                          : Mat3(Mat3::Identity() + gradients[a]);
    if (Dim == 2) {
      F.row(2) = Vec3::UnitZ().transpose();
      F.col(2) = Vec3::UnitZ();
    }
    if (!(F.determinant() > 0)) {
      throw base::InputError(
          fmt::format("initial displacement gives J = {:g} at the node at ({:g}, {:g}, {:g}); J "
                      "must be positive",
                      F.determinant(), graph.X[a][0], graph.X[a][1], graph.X[a][2]));
    }
    put_deformation(state, a, F);
    put_internal_variables(state, a, F, initial.relaxed);
  }
}

template <int Dim>
std::string hash_of(const scheme::State<Dim>& state,
                    const std::vector<std::int32_t>& order,
                    double time) {
  std::vector<std::int64_t> node_of(order.size());
  for (size_t a = 0; a < order.size(); ++a)
    node_of[order[a]] = static_cast<std::int64_t>(a);
  std::vector<double> values{time};
  const auto add = [&](int n_components, const auto& value) {
    for (const std::int64_t a : node_of) {
      for (int c = 0; c < n_components; ++c)
        values.push_back(value(a, c));
    }
  };
  const auto add_field = [&](const algebra::BlockField& field) {
    add(field.n_components(), [&](std::int64_t a, int c) { return field.at(a, c); });
  };
  add(Dim, [&](std::int64_t a, int c) { return state.v.at(a, c); });
  add_field(state.u);
  add_field(state.F);
  if (state.unknowns == scheme::Unknowns::FHJ) {
    add(algebra::Layout<Dim>::n_H, [&](std::int64_t a, int c) { return state.H(a, c); });
  }
  for (const auto* field : {&state.J, &state.A, &state.S})
    add_field(*field);
  const XXH128_hash_t hash = XXH3_128bits(values.data(), values.size() * sizeof(double));
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

namespace {

std::string place(const Vec3& X) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", X[0], X[1], X[2]);
}

std::string rows_of(const Mat3& M) {
  std::string text;
  for (int i = 0; i < 3; ++i) {
    text += fmt::format("{}[{:.6g}, {:.6g}, {:.6g}]", i > 0 ? ", " : "", M(i, 0), M(i, 1), M(i, 2));
  }
  return text;
}

}  // namespace

std::string breakdown_report(const Snapshot& s,
                             const scheme::PairGraph& graph,
                             std::int64_t step,
                             double dt) {
  std::int64_t first = -1, n_bad = 0;
  for (std::int64_t a = 0; a < graph.n_nodes(); ++a) {
    const bool sound = s.J[a] > 0 && s.F[a].allFinite() && s.v[a].allFinite();
    if (sound) continue;
    if (first < 0) first = a;
    ++n_bad;
  }
  if (first < 0) return "a value that is not a number appeared between two checks";
  const bool finite = s.F[first].allFinite() && s.v[first].allFinite();
  return fmt::format(
      "{} at node {} ({} of {} nodes are bad), step {}, time {:.6g} s, dt {:.4g} s\n"
      "  X = {} m, x = {} m, v = {} m/s\n  F = [{}], J = {:.6g}\n  {}",
      finite ? "J <= 0" : "a value is not finite", first, n_bad, graph.n_nodes(), step, s.time, dt,
      place(graph.X[first]), place(graph.X[first] + s.u[first]), place(s.v[first]),
      rows_of(s.F[first]), s.J[first],
      finite ? "the material was turned inside out there: refine, load more slowly, or use the "
               "sign-preserving limiter"
             : "the scheme became unstable: use a smaller time.cfl, or look at the first frames");
}

template <int Dim>
std::string collapse_report(const scheme::State<Dim>& state,
                            const scheme::PairGraph& graph,
                            std::int64_t step,
                            double time,
                            double dt,
                            double first_dt) {
  std::int64_t worst = 0;
  double least = 1e300;
  for (std::int64_t a = 0; a < graph.n_nodes(); ++a) {
    const double J = deformation_at(state, a).J;
    if (J < least) {
      least = J;
      worst = a;
    }
  }
  return fmt::format(
      "the stable time step collapsed to {:.4g} s (first step {:.4g} s) at step {}, time {:.6g} s; "
      "least J = {:.4g} at node {}, X = {} m",
      dt, first_dt, step, time, least, worst, place(graph.X[worst]));
}

#define DIPTYCH_INSTANTIATE(Dim)                                                               \
  template void set_initial_state(const scheme::PairGraph&, const cases::InitialCase&, double, \
                                  scheme::State<Dim>&);                                        \
  template std::string hash_of(const scheme::State<Dim>&, const std::vector<std::int32_t>&,    \
                               double);                                                        \
  template std::string collapse_report(const scheme::State<Dim>&, const scheme::PairGraph&,    \
                                       std::int64_t, double, double, double);
DIPTYCH_INSTANTIATE(2)
DIPTYCH_INSTANTIATE(3)
#undef DIPTYCH_INSTANTIATE

}  // namespace diptych::run
