#include "common/scheme/body/health.hpp"

#include "common/parallel/sharing.hpp"
#include "common/scheme/body/point_access.hpp"
#include "common/scheme/boundary/node_vector.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <string_view>
#include <vector>

namespace diptych::scheme {

namespace {

using algebra::Lanes;
using algebra::Mat3;
using algebra::n_lanes;

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

/// The other nodes whose state enters the rates of node a.
template <int Dim, class Use>
void for_neighbours(const SweepGraph<Dim>& graph, std::int64_t a, const Use& use) {
  if (graph.offset.size() == 0) {
    for (std::int64_t chunk = graph.row[a]; chunk < graph.row[a + 1]; ++chunk) {
      for (const std::int32_t b : graph.neighbours[chunk].node) {
        if (b != a) use(b);  // the padding of a row is its node
      }
    }
    return;
  }
  const std::int64_t block = a / n_lanes;
  VectorCursor<Dim> cursor(graph.strain, graph.first[block]);
  for (std::int64_t chunk = graph.row[block]; chunk < graph.row[block + 1]; ++chunk) {
    Lanes C[Dim];
    cursor.next(C);
    bool is_pair = false;
    for (int i = 0; i < Dim; ++i)
      is_pair |= C[i][a % n_lanes] != 0;
    if (is_pair) use(a + graph.offset[chunk]);
  }
}

enum class Fault { none, not_finite, inside_out, not_definite };

bool is_definite(const algebra::Mat3& A) {
  return A(0, 0) > 0 && A(0, 0) * A(1, 1) > A(0, 1) * A(0, 1) && A.determinant() > 0;
}

/// Whether the internal variables of a node are all positive definite.
template <int Dim>
bool are_definite(const Body<Dim>& body, bool of_G, std::int64_t a) {
  for (const auto& branch : branches_at(body, a)) {
    if (!is_definite(algebra::to_eigen(of_G ? branch.S : branch.A))) return false;
  }
  return true;
}

/// What is wrong with a field at a node.
template <int Dim>
Fault fault_at(const Body<Dim>& body, const Field<Dim>& field, std::int64_t a) {
  for (int k = 0; k < field.n_components; ++k) {
    if (!std::isfinite(field.at(body, a, k))) return Fault::not_finite;
  }
  const bool has_J = body.options.unknowns != Unknowns::F;
  const bool is_J = field.role == Role::unknown && field.name == (has_J ? "J" : "F");
  if (is_J && !(deformation_at(body, a).J > 0)) return Fault::inside_out;
  const bool is_internal = field.name == "A" || field.name == "S";
  return is_internal && !are_definite(body, field.name == "S", a) ? Fault::not_definite
                                                                  : Fault::none;
}

/// Where something went wrong first.
struct Origin {
  Fault fault = Fault::none;
  std::string_view field;
  std::int64_t node = -1, n_bad = 0;
};

/// Of nodes that are bad, the one to name.
struct Middle {
  std::int64_t node = -1, most = -1;
  /// @param n  of its neighbours where all are bad, -1 where not
  void take(std::int64_t a, std::int64_t n) {
    if (a < 0 || (node >= 0 && n <= most)) return;
    node = a;
    most = n;
  }
};

/// Of nodes that are bad in one field, with all that they made bad there: the one whose neighbours
/// are all among them, of several the one with most of them. Each rank knows the pairs of its own.
template <int Dim>
std::int64_t middle_of(const Body<Dim>& body, const std::vector<char>& is_bad) {
  std::vector<Middle> parts(parallel::n_chunks_of(body.n_blocks));
  parallel::for_chunks(body.part(), body.n_blocks, [&](auto begin, auto end, auto chunk) {
    for (std::int64_t a = begin * n_lanes; a < std::min(end * n_lanes, body.n_owned); ++a) {
      if (!is_bad[static_cast<size_t>(a)]) continue;
      std::int64_t n = 0;
      bool is_inside = true;
      for_neighbours(body.graph, a, [&](std::int64_t b) {
        ++n;
        is_inside = is_inside && is_bad[static_cast<size_t>(b)];
      });
      parts[chunk].take(a, is_inside ? n : -1);
    }
  });
  body.part().complete(parts);
  Middle middle;
  for (const Middle& part : parts)
    middle.take(part.node, part.most);
  return middle.node;
}

/// What rank 0 has found, which has the fields of all, to the others.
template <int Dim>
void share(const Body<Dim>& body, Origin& origin, std::vector<char>& is_bad) {
  if (!body.division) return;
  parallel::Communicator& ranks = body.part().ranks();
  parallel::share(ranks, origin.fault);
  parallel::share(ranks, origin.n_bad);
  is_bad.resize(static_cast<size_t>(body.n_owned));
  ranks.broadcast(parallel::bytes_of(is_bad.data()), body.n_owned);
}

/// Reference position, which the rank that owns the node has.  [m]
template <int Dim>
Vec3 position_of(const Body<Dim>& body, std::int64_t a) {
  std::vector<Vec3> X{body.X[a]};
  const std::int32_t chunk[] = {static_cast<std::int32_t>(chunk_of_node(a))};
  body.part().complete(X, chunk);
  return X.front();
}

/// A bad value spreads over neighbours with every sweep, from field to field: it arose in the field
/// that is bad at the fewest nodes.
template <int Dim>
Origin origin_of(const Body<Dim>& body) {
  Origin origin;
  std::vector<char> is_bad(static_cast<size_t>(body.n_owned)), worst;
  for (const Field<Dim>& field : body.fields()) {
    if (field.role == Role::step_begin) continue;
    Origin here{Fault::none, field.name, -1, 0};
    for (std::int64_t a = 0; a < body.n_owned; ++a) {
      const Fault fault = fault_at(body, field, a);
      is_bad[static_cast<size_t>(a)] = fault != Fault::none;
      if (fault == Fault::none) continue;
      if (here.n_bad++ == 0) here.fault = fault;
    }
    if (here.n_bad == 0 || (origin.n_bad > 0 && origin.n_bad <= here.n_bad)) continue;
    origin = here;
    worst = is_bad;
  }
  share(body, origin, worst);
  if (origin.n_bad == 0) return origin;
  origin.node = middle_of(body, worst);
  return origin;
}

/// As in "J <= 0 at node 7": what the messages of users and of tests begin with.
std::string words_of(const Origin& origin) {
  switch (origin.fault) {
    case Fault::inside_out:
      return "J <= 0";
    case Fault::not_definite:
      return fmt::format("{} is not positive definite",
                         origin.field == "A" ? "C_v^-1 of a branch" : "G_v^-1 of a branch");
    default:
      return fmt::format("a value of {} is not finite", origin.field);
  }
}

const char* advice_on(Fault fault) {
  switch (fault) {
    case Fault::inside_out:
      return "the material was turned inside out there: refine, load more slowly, or use the "
             "sign-preserving limiter";
    case Fault::not_definite:
      return "relaxation keeps internal variables positive definite: the memory of this machine "
             "has changed a value, or the program is wrong; go on from a checkpoint";
    default:
      return "the scheme became unstable: use a smaller time.cfl, or look at the first frames";
  }
}

/// What a message says of a node.
template <int Dim>
std::string state_of(const Body<Dim>& body, std::int64_t a) {
  Vec3 u = Vec3::Zero(), v = Vec3::Zero();
  for (int i = 0; i < Dim; ++i) {
    u[i] = body.u.at(a, i);
    v[i] = body.v.at(a, i);
  }
  const auto X = deformation_at(body, a);
  const Vec3 X_a = position_of(body, a);
  return fmt::format("X = {} m, x = {} m, v = {} m/s\n  F = [{}], J = {:.6g}", place(X_a),
                     place(X_a + u), place(v), rows_of(algebra::to_eigen(X.F)), X.J);
}

}  // namespace

template <int Dim>
base::BreakdownError breakdown_error(
    const Body<Dim>& body, std::int64_t step, double time, double dt, const std::string& remark) {
  const Origin origin = origin_of(body);
  const std::string end = remark.empty() ? "" : "\n  " + remark;
  if (origin.node < 0) {
    return base::BreakdownError(
        fmt::format("a value that is not a number appeared between two "
                    "checks, step {}, time {:.6g} s, dt {:.4g} s{}",
                    step, time, dt, end));
  }
  const std::string message = fmt::format(
      "{} at node {} ({} of {} nodes are bad), step {}, time {:.6g} s, dt {:.4g} s\n"
      "  {}\n  {}{}",
      words_of(origin), origin.node, origin.n_bad, body.n_owned, step, time, dt,
      state_of(body, origin.node), advice_on(origin.fault), end);
  return {message, origin.node};
}

template <int Dim>
base::BreakdownError collapse_error(const Body<Dim>& body,
                                    std::int64_t step,
                                    double time,
                                    double dt,
                                    double first_dt,
                                    double least_share) {
  // of forces or wave speeds that are no numbers
  if (origin_of(body).node >= 0) return breakdown_error(body, step, time, dt, "");
  std::int64_t worst = 0;
  double least = 1e300;
  for (std::int64_t a = 0; a < body.n_owned; ++a) {
    const double J = deformation_at(body, a).J;
    if (J < least) {
      least = J;
      worst = a;
    }
  }
  if (body.division) parallel::share(body.part().ranks(), worst);
  const std::string message = fmt::format(
      "the stable time step collapsed to {:.4g} s (first step {:.4g} s) at step {}, time {:.6g} s; "
      "least J = {:.4g} at node {}, X = {} m\n"
      "  wave speeds grow without bound where a body is crushed or torn: refine, load more slowly, "
      "or use the sign-preserving limiter; guards.least_step ({:g} of the first step) says what is "
      "too small",
      dt, first_dt, step, time, least, worst, place(position_of(body, worst)), least_share);
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
