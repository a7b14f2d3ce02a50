#pragma once
/// Smoothing kernels W(r, h) = sigma_d / h^d f(r/h), normalised to int W dV = 1.
/// To add one: a file beside this one, and a line in kernels().
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

Kernel cubic_spline();
Kernel quintic_spline();
Kernel wendland_c2();

/// The menu: cubic-spline, quintic-spline, wendland-c2.
base::Registry<Kernel> kernels();

}  // namespace diptych::sph
