#pragma once
/// Smoothing kernels W(r, h) = sigma_d / h^d f(r/h), normalised to int W dV = 1.
/// To add one: a file beside this one, and a line in kernels.def.
/// Test: tests/graphs/kernels_test.cpp.

#include "common/base/registry.hpp"

#include <string>

namespace diptych::sph {

struct Kernel {
  double support = 2;  ///< f(q) = 0 for q >= support                              [-]
  double sigma_2 = 0;  ///< 1 / int f dA in the plane                              [-]
  double sigma_3 = 0;  ///< 1 / int f dV in space                                  [-]
  double (*f)(double q) = nullptr;
  double (*f_slope)(double q) = nullptr;  ///< df/dq

  double sigma(int dimension) const { return dimension == 2 ? sigma_2 : sigma_3; }
  /// W [1/m^d] and dW/dr [1/m^(d+1)]
  double value(double r, double h, int dimension) const {
    return sigma(dimension) / (dimension == 2 ? h * h : h * h * h) * f(r / h);
  }
  double slope(double r, double h, int dimension) const {
    const double square = h * h;
    return sigma(dimension) / (dimension == 2 ? square * h : square * square) * f_slope(r / h);
  }
};

#define DIPTYCH_KERNEL(name, function) Kernel function();
#include "sph/kernels/kernels.def"
#undef DIPTYCH_KERNEL

/// All of kernels.def by name.
base::Registry<Kernel> kernels();

}  // namespace diptych::sph
