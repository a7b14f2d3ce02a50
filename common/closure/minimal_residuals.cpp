#include "common/closure/minimal_residuals.hpp"

#include <algorithm>

namespace diptych::closure {

namespace {

/// Steps after which the residual itself is looked at, which costs a product with S.
constexpr int steps_at_once = 20;

/// x = a x + b y by component.
void combine(const Vec3& a, Field& x, const Vec3& b, const Field& y) {
  for_each_node(x.size(), [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i)
      x[i] = a.cwiseProduct(x[i]) + b.cwiseProduct(y[i]);
  });
}

Vec3 root(const Vec3& squares) {
  return squares.cwiseMax(0).cwiseSqrt();
}

/// The rotations that bring the tridiagonal matrix of the Lanczos vectors to triangular form, of
/// each component.
struct Rotations {
  Vec3 cosine = -Vec3::Ones(), sine = Vec3::Zero();
  Vec3 diagonal = Vec3::Zero(), above = Vec3::Zero();  ///< of the next column, before it is turned
  Vec3 left;                                           ///< norm of the residual

  struct Column {
    Vec3 second_above, above, diagonal, part;  ///< part of the right side
  };

  /// @param alpha, beta  diagonal of the next row, and what is below it
  Column turn(const Vec3& alpha, const Vec3& beta) {
    Column column;
    column.second_above = above;
    column.above = cosine.cwiseProduct(diagonal) + sine.cwiseProduct(alpha);
    const Vec3 turned = sine.cwiseProduct(diagonal) - cosine.cwiseProduct(alpha);
    above = sine.cwiseProduct(beta);
    diagonal = -cosine.cwiseProduct(beta);
    column.diagonal = root(turned.cwiseAbs2() + beta.cwiseAbs2());
    cosine = quotient(turned, column.diagonal);
    sine = quotient(beta, column.diagonal);
    column.part = cosine.cwiseProduct(left);
    left = left.cwiseProduct(sine);
    return column;
  }
};

}  // namespace

int minimal_residuals(const FieldOperator& S,
                      const FieldOperator& precondition,
                      const std::vector<double>& unit,
                      const SolveLimits& limits,
                      const Field& r,
                      Field& y) {
  const size_t n = r.size();
  const Vec3 one = Vec3::Ones(), none = Vec3::Zero();
  y.assign(n, none);
  Field before(n, none), now = r, v(n, none), next_v(n), q(n);
  Field direction(n, none), last_direction(n, none), next_direction(n);
  precondition(now, v);
  Vec3 beta = root(dot(now, v)), last_beta = none;
  Rotations rotations;
  rotations.left = beta;
  Field best_y = y;
  double best = greatest(r, unit);
  int step = 0, best_step = 0;
  while (step < limits.steps && best > limits.residual && step < best_step + limits.patience) {
    combine(quotient(one, beta), v, none, v);
    S(v, q);
    if (step > 0) combine(one, q, -quotient(beta, last_beta), before);
    const Vec3 alpha = dot(v, q);
    combine(one, q, -quotient(alpha, beta), now);
    before.swap(now);
    now.swap(q);  // what was `before` is overwritten next
    precondition(now, next_v);
    last_beta = beta;
    beta = root(dot(now, next_v));
    const Rotations::Column column = rotations.turn(alpha, beta);
    next_direction = v;
    combine(one, next_direction, -column.second_above, last_direction);
    combine(quotient(one, column.diagonal), next_direction,
            -quotient(column.above, column.diagonal), direction);
    last_direction.swap(direction);
    direction.swap(next_direction);
    combine(one, y, column.part, direction);
    v.swap(next_v);
    ++step;
    if (step % steps_at_once != 0 && step != limits.steps) continue;
    S(y, q);
    combine(-one, q, one, r);
    const double residual = greatest(q, unit);
    if (residual < 0.9 * best || residual <= limits.residual) best_step = step;
    if (residual < best) {
      best = residual;
      best_y = y;
    }
  }
  y = best_y;
  return step;
}

}  // namespace diptych::closure
