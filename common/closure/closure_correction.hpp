#pragma once
/// What a closure repair (closure_repair.hpp) asks of a correction.

#include "common/closure/conjugate_gradients.hpp"

namespace diptych::closure {

using algebra::Vec3;

/// C is changed by a linear function of y, the gap by -S y.
class Correction {
 public:
  virtual ~Correction() = default;
  virtual void apply_S(const Field& y, Field& Sy) = 0;
  virtual void precondition(const Field& r, Field& z) = 0;
  virtual void change(const Field& y, std::vector<Vec3>& C) = 0;
};

/// z = r / diagonal, 0 where that is not positive.
inline void divide(const Field& r, const std::vector<double>& diagonal, Field& z) {
  for_each_node(r.size(), [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t a = begin; a < end; ++a)
      z[a] = diagonal[a] > 0 ? Vec3(r[a] / diagonal[a]) : Vec3(Vec3::Zero());
  });
}

}  // namespace diptych::closure
