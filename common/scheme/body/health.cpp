#include "common/scheme/body/health.hpp"

#include "common/scheme/body/point_access.hpp"

#include <fmt/format.h>

namespace diptych::scheme {

namespace {

using algebra::Mat3;

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

/// What a message says of a node.
struct NodeState {
  Vec3 u = Vec3::Zero(), v = Vec3::Zero();
  Mat3 F;
  double J = 1;
  bool is_finite() const { return F.allFinite() && v.allFinite(); }
};
template <int Dim>
NodeState node_state(const Body<Dim>& body, std::int64_t a) {
  NodeState s;
  for (int i = 0; i < Dim; ++i) {
    s.u[i] = body.u.at(a, i);
    s.v[i] = body.v.at(a, i);
  }
  const auto X = deformation_at(body, a);
  s.F = algebra::to_eigen(X.F);
  s.J = X.J;
  return s;
}

}  // namespace

template <int Dim>
base::BreakdownError breakdown_error(
    const Body<Dim>& body, std::int64_t step, double time, double dt, const std::string& remark) {
  std::int64_t first = -1, n_bad = 0;
  for (std::int64_t a = 0; a < body.n_owned; ++a) {
    const NodeState s = node_state(body, a);
    if (s.J > 0 && s.is_finite()) continue;
    if (first < 0) first = a;
    ++n_bad;
  }
  const std::string end = remark.empty() ? "" : "\n  " + remark;
  if (first < 0) {
    return base::BreakdownError(
        fmt::format("a value that is not a number appeared between two "
                    "checks, step {}, time {:.6g} s, dt {:.4g} s{}",
                    step, time, dt, end));
  }
  const NodeState s = node_state(body, first);
  const Vec3& X = body.X[first];
  const std::string message = fmt::format(
      "{} at node {} ({} of {} nodes are bad), step {}, time {:.6g} s, dt {:.4g} s\n"
      "  X = {} m, x = {} m, v = {} m/s\n  F = [{}], J = {:.6g}\n  {}{}",
      s.is_finite() ? "J <= 0" : "a value is not finite", first, n_bad, body.n_owned, step, time,
      dt, place(X), place(X + s.u), place(s.v), rows_of(s.F), s.J,
      s.is_finite()
          ? "the material was turned inside out there: refine, load more slowly, or use the "
            "sign-preserving limiter"
          : "the scheme became unstable: use a smaller time.cfl, or look at the first frames",
      end);
  return {message, first};
}

template <int Dim>
base::BreakdownError collapse_error(const Body<Dim>& body,
                                    std::int64_t step,
                                    double time,
                                    double dt,
                                    double first_dt,
                                    double least_share) {
  std::int64_t worst = 0;
  double least = 1e300;
  for (std::int64_t a = 0; a < body.n_owned; ++a) {
    const double J = deformation_at(body, a).J;
    if (J < least) {
      least = J;
      worst = a;
    }
  }
  const std::string message = fmt::format(
      "the stable time step collapsed to {:.4g} s (first step {:.4g} s) at step {}, time {:.6g} s; "
      "least J = {:.4g} at node {}, X = {} m\n"
      "  wave speeds grow without bound where a body is crushed or torn: refine, load more slowly, "
      "or use the sign-preserving limiter; guards.least_step ({:g} of the first step) says what is "
      "too small",
      dt, first_dt, step, time, least, worst, place(body.X[worst]), least_share);
  return {message, worst};
}

#define DIPTYCH_INSTANTIATE(Dim)                                                                \
  template base::BreakdownError breakdown_error(const Body<Dim>&, std::int64_t, double, double, \
                                                const std::string&);                            \
  template base::BreakdownError collapse_error(const Body<Dim>&, std::int64_t, double, double,  \
                                               double, double);
DIPTYCH_INSTANTIATE(2)
DIPTYCH_INSTANTIATE(3)
#undef DIPTYCH_INSTANTIATE

}  // namespace diptych::scheme
