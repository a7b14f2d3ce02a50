#pragma once
/// Conjugate gradients for the singular systems of the closure repair and of summation by parts:
/// S y = r with S symmetric positive semi-definite and zero on polynomial fields. The three
/// components of the fields have the same S and run side by side, each with its own step lengths.
/// Test: tests/graphs/closure_repair_test.cpp.

#include "common/algebra/vectors.hpp"

#include <cstdint>
#include <functional>
#include <vector>

namespace diptych::closure {

using algebra::Mat3;
using algebra::Vec3;

using Field = std::vector<Vec3>;
/// out = S in, or out = (approximate inverse of S) in
using FieldOperator = std::function<void(const Field& in, Field& out)>;

/// Calls work(begin, end) for pieces of [0, n), in parallel.
void for_each_node(size_t n, const std::function<void(std::int64_t begin, std::int64_t end)>& work);

/// Takes the affine part out of a field. Right-hand sides are free of it in exact arithmetic; what
/// round-off leaves of it would end the conjugate gradients in noise.
class AffinePart {
 public:
  /// @param X [n] m; must outlive this
  explicit AffinePart(const std::vector<Vec3>& X);
  void remove(Field& r) const;

 private:
  const std::vector<Vec3>& X_;
  Vec3 centre_ = Vec3::Zero();
  Mat3 inverse_ = Mat3::Identity();
};

/// Takes out of a field what S does not see.
using NullPart = std::function<void(Field& r)>;

struct SolveLimits {
  double residual = 0;  ///< greatest |r_a| unit_a to stop below
  int steps = 0;
  /// Steps without progress after which the system has no solution, or round-off is reached.
  int patience = 500;
};

/// Solves from y = 0 until max_a |r_a| unit_a <= limits.residual, or until that stops falling (a
/// system without a solution): y is then the best found.
/// @return steps taken
int conjugate_gradients(const FieldOperator& S,
                        const FieldOperator& precondition,
                        const NullPart& remove_null_part,
                        const std::vector<double>& unit,
                        const SolveLimits& limits,
                        Field r,
                        Field& y);

/// Component by component.
Vec3 dot(const Field& x, const Field& y);

/// x / y by component, 0 where y is: a component that is solved (or absent, z in 2-D) rests.
Vec3 quotient(const Vec3& x, const Vec3& y);

/// max_a |r_a| unit_a, r with the same number of entries for each unit
double greatest(const Field& r, const std::vector<double>& unit);

}  // namespace diptych::closure
