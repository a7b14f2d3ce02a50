#pragma once
/// What three grids say of the value that a quantity would have on an infinitely fine one:
/// Richardson extrapolation, observed order, grid convergence index (P. J. Roache, J. Fluids Eng.
/// 116, 1994; procedure of I. B. Celik et al., J. Fluids Eng. 130, 2008, after ASME V&V 20).
/// Test: tests/report/grid_convergence_test.cpp

#include <optional>
#include <string>
#include <vector>

namespace diptych::report {

/// How three values follow each other; the ratio is (fine - medium)/(medium - coarse).
enum class Convergence {
  monotone,     ///< ratio in (0, 1)
  same,         ///< they differ by rounding only
  oscillating,  ///< ratio <= 0
  diverging     ///< ratio >= 1
};

struct GridConvergence {
  Convergence kind = Convergence::monotone;
  double order = 0;         ///< observed; NaN unless monotone
  double extrapolated = 0;  ///< NaN unless monotone or same
  double error_bar = 0;     ///< about the fine value, half its width, >= 0
  double index = 0;         ///< error bar over the fine value; NaN where that is zero
  double range = 0;         ///< largest value less the smallest one
};

/// Spacings h_fine < h_medium < h_coarse, any ratios. Where the values are monotone
///   error bar = 1.25 |fine - medium|/(r^q - 1), q the observed order but at most `formal_order`;
/// where they oscillate or diverge no order stands and the bar is three times their range
/// (L. Eca and M. Hoekstra, J. Comput. Phys. 262, 2014, for data that do not fit a power law).
GridConvergence grid_convergence(const double (&spacing)[3],
                                 const double (&value)[3],
                                 double formal_order = 2);

/// Of the last three of values that go from coarse to fine; nothing where there are fewer, one is
/// not finite, or the spacings do not fall.
std::optional<GridConvergence> finest_convergence(const std::vector<double>& spacings,
                                                  const std::vector<double>& values);

/// Two grids: no order can be observed. With the formal one and Roache's factor 3:
/// 3 |fine - coarse|/(r^p - 1).
double two_grid_error_bar(const double (&spacing)[2],
                          const double (&value)[2],
                          double formal_order = 2);

/// "monotone", "same on all", "oscillates", "diverges"
std::string convergence_name(Convergence kind);

}  // namespace diptych::report
