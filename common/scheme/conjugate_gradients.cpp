#include "common/scheme/conjugate_gradients.hpp"

#include "common/parallel/for_chunks.hpp"

#include <algorithm>

namespace diptych::scheme {

namespace {

/// Below this many nodes a loop is too short to be worth the start of threads.
constexpr size_t least_parallel = 50000;

/// Steps without progress after which the system has no solution, or round-off is reached.
constexpr int patience = 500;

/// Component by component.
Vec3 dot(const Field& x, const Field& y) {
  Vec3 sum = Vec3::Zero();
  for (size_t a = 0; a < x.size(); ++a)
    sum += x[a].cwiseProduct(y[a]);
  return sum;
}

/// x / y by component, 0 where y is: a component that is solved (or absent, z in 2-D) rests.
Vec3 quotient(const Vec3& x, const Vec3& y) {
  Vec3 result = Vec3::Zero();
  for (int i = 0; i < 3; ++i) {
    if (y[i] > 0) result[i] = x[i] / y[i];
  }
  return result;
}

}  // namespace

void for_each_node(size_t n, const std::function<void(std::int64_t, std::int64_t)>& work) {
  const auto end = static_cast<std::int64_t>(n);
  if (n < least_parallel) {
    work(0, end);
    return;
  }
  parallel::for_chunks(
      end, [&](std::int64_t first, std::int64_t last, std::int64_t) { work(first, last); });
}

AffinePart::AffinePart(const std::vector<Vec3>& X) : X_(X) {
  for (const Vec3& x : X_)
    centre_ += x / static_cast<double>(X_.size());
  Mat3 moment = Mat3::Zero();
  for (const Vec3& x : X_)
    moment += (x - centre_) * (x - centre_).transpose();
  if (moment(2, 2) == 0) moment(2, 2) = moment.trace();
  inverse_ = moment.inverse();
}

void AffinePart::remove(Field& r) const {
  Vec3 mean = Vec3::Zero();
  Mat3 slope = Mat3::Zero();
  for (size_t a = 0; a < r.size(); ++a) {
    mean += r[a];
    slope += r[a] * (X_[a] - centre_).transpose();
  }
  mean /= static_cast<double>(r.size());
  slope = slope * inverse_;
  for (size_t a = 0; a < r.size(); ++a)
    r[a] -= mean + slope * (X_[a] - centre_);
}

int conjugate_gradients(const FieldOperator& S,
                        const FieldOperator& precondition,
                        const AffinePart& affine_part,
                        const std::vector<double>& unit,
                        const SolveLimits& limits,
                        Field r,
                        Field& y) {
  const size_t n = r.size();
  y.assign(n, Vec3::Zero());
  affine_part.remove(r);
  Field z(n, Vec3::Zero()), Sp(n);
  precondition(r, z);
  Field p = z;
  Vec3 rz = dot(r, z);
  Field best_y = y;
  double residual = greatest(r, unit), best = residual;
  int step = 0, best_step = 0;
  while (step < limits.steps && residual > limits.residual && step < best_step + patience) {
    S(p, Sp);
    const Vec3 alpha = quotient(rz, dot(p, Sp));
    for (size_t a = 0; a < n; ++a) {
      y[a] += alpha.cwiseProduct(p[a]);
      r[a] -= alpha.cwiseProduct(Sp[a]);
    }
    affine_part.remove(r);
    precondition(r, z);
    const Vec3 rz_next = dot(r, z);
    const Vec3 beta = quotient(rz_next, rz);
    for (size_t a = 0; a < n; ++a)
      p[a] = z[a] + beta.cwiseProduct(p[a]);
    rz = rz_next;
    residual = greatest(r, unit);
    ++step;
    if (residual < 0.7 * best) {
      best = residual;
      best_step = step;
      best_y = y;
    }
  }
  if (residual > best) y = best_y;
  return step;
}

double greatest(const Field& r, const std::vector<double>& unit) {
  double result = 0;
  for (size_t a = 0; a < r.size(); ++a)
    result = std::max(result, r[a].norm() * unit[a]);
  return result;
}

}  // namespace diptych::scheme
