#include "common/closure/conjugate_gradients.hpp"

#include "common/parallel/for_chunks.hpp"

#include <algorithm>

namespace diptych::closure {

namespace {

/// Below this many nodes a loop is too short to be worth the start of threads.
constexpr size_t least_parallel = 8192;

/// Sum of what work(begin, end) gives for the chunks of [0, n), with the same bits for every number
/// of threads.
template <class T, class Work>
T sum_of_chunks(size_t n, const Work& work) {
  const auto end = static_cast<std::int64_t>(n);
  std::vector<T> parts(static_cast<size_t>(parallel::n_chunks_of(end)));
  for_each_node(n, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t begin = first; begin < last; begin += parallel::chunk_size)
      parts[begin / parallel::chunk_size] =
          work(begin, std::min(last, begin + parallel::chunk_size));
  });
  T sum = parts.front();
  for (size_t i = 1; i < parts.size(); ++i)
    sum += parts[i];
  return sum;
}

/// to = from in parallel.
void copy(const Field& from, Field& to) {
  for_each_node(from.size(), [&](std::int64_t begin, std::int64_t end) {
    std::copy(from.begin() + begin, from.begin() + end, to.begin() + begin);
  });
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
  using Moments = Eigen::Matrix<double, 3, 4>;  // of degree 0, then 1
  Moments moments =
      sum_of_chunks<Moments>(r.size(), [&](std::int64_t begin, std::int64_t end) -> Moments {
        Moments sum = Moments::Zero();
        for (std::int64_t a = begin; a < end; ++a) {
          sum.col(0) += r[a];
          sum.rightCols<3>() += r[a] * (X_[a] - centre_).transpose();
        }
        return sum;
      });
  const Vec3 mean = moments.col(0) / static_cast<double>(r.size());
  const Mat3 slope = moments.rightCols<3>() * inverse_;
  for_each_node(r.size(), [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t a = begin; a < end; ++a)
      r[a] -= mean + slope * (X_[a] - centre_);
  });
}

Vec3 dot(const Field& x, const Field& y) {
  return sum_of_chunks<Vec3>(x.size(), [&](std::int64_t begin, std::int64_t end) -> Vec3 {
    Vec3 sum = Vec3::Zero();
    for (std::int64_t a = begin; a < end; ++a)
      sum += x[a].cwiseProduct(y[a]);
    return sum;
  });
}

Vec3 quotient(const Vec3& x, const Vec3& y) {
  Vec3 result = Vec3::Zero();
  for (int i = 0; i < 3; ++i) {
    if (y[i] > 0) result[i] = x[i] / y[i];
  }
  return result;
}

int conjugate_gradients(const FieldOperator& S,
                        const FieldOperator& precondition,
                        const NullPart& remove_null_part,
                        const std::vector<double>& unit,
                        const SolveLimits& limits,
                        Field r,
                        Field& y) {
  const size_t n = r.size();
  y.assign(n, Vec3::Zero());
  remove_null_part(r);
  Field z(n, Vec3::Zero()), Sp(n);
  precondition(r, z);
  Field p = z;
  Vec3 rz = dot(r, z);
  Field best_y = y;
  double residual = greatest(r, unit), best = residual;
  int step = 0, best_step = 0;
  while (step < limits.steps && residual > limits.residual && step < best_step + limits.patience) {
    S(p, Sp);
    const Vec3 alpha = quotient(rz, dot(p, Sp));
    for_each_node(n, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t a = begin; a < end; ++a) {
        y[a] += alpha.cwiseProduct(p[a]);
        r[a] -= alpha.cwiseProduct(Sp[a]);
      }
    });
    remove_null_part(r);
    precondition(r, z);
    const Vec3 rz_next = dot(r, z);
    const Vec3 beta = quotient(rz_next, rz);
    for_each_node(n, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t a = begin; a < end; ++a)
        p[a] = z[a] + beta.cwiseProduct(p[a]);
    });
    rz = rz_next;
    residual = greatest(r, unit);
    ++step;
    if (residual < 0.7 * best) {
      best = residual;
      best_step = step;
      copy(y, best_y);
    }
  }
  if (residual > best) y = best_y;
  return step;
}

double greatest(const Field& r, const std::vector<double>& unit) {
  const auto per_unit = static_cast<std::int64_t>(r.size() / unit.size());
  struct Largest {
    double value = 0;
    Largest& operator+=(const Largest& other) {
      value = std::max(value, other.value);
      return *this;
    }
  };
  return sum_of_chunks<Largest>(r.size(),
                                [&](std::int64_t begin, std::int64_t end) {
                                  Largest result;
                                  for (std::int64_t a = begin; a < end; ++a)
                                    result.value =
                                        std::max(result.value, r[a].norm() * unit[a / per_unit]);
                                  return result;
                                })
      .value;
}

}  // namespace diptych::closure
