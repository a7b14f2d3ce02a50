#pragma once
/// Whether two methods agree on a scalar, as far as refinement lets anybody say.
/// Test: tests/report/agreement_test.cpp

#include "postprocess/report/grid_convergence.hpp"
#include "postprocess/report/orders.hpp"

#include <optional>
#include <string>

namespace diptych::report {

/// A scalar of one method on its finest level.
struct ScalarOfMethod {
  std::string method;  ///< as it stands within a sentence
  double value = 0;
  double error_bar = 0;                     ///< half width, >= 0
  std::optional<GridConvergence> estimate;  ///< three levels or more
  FormalOrder formal_order;
};

/// Three grids say where a quantity goes where they are alike, or the observed order is within
/// `order_tolerance` of the formal ones and the error bar below `largest_index` of the scale. Error
/// bars that are wide, or of values that follow no power law, hold nothing against each other: a
/// verdict on two methods asks this of both.
constexpr double order_tolerance = 0.5, largest_index = 0.05;

enum class Agreement {
  agree,      ///< both resolved, apart by no more than the sum of their error bars
  apart,      ///< both resolved, apart by more
  near,       ///< one not resolved; apart by no more than three times what their levels change by
  far,        ///< one not resolved; apart by more, although their levels change by little
  unresolved  ///< fewer than three levels, or they change by too much to say anything
};

struct Verdict {
  Agreement agreement = Agreement::unresolved;
  double difference = 0;
  double allowed = 0;  ///< sum of both error bars, or of both ranges times three (near, far)
  std::string why;     ///< "SPH oscillates; finite volume shows order 1.1 (its own is 2)": what
                       ///< resolution lacks; empty of agree and apart
};

/// Three times the range of three levels is the bar that L. Eca and M. Hoekstra (J. Comput. Phys.
/// 262, 2014) give values without an order; near and far are said where it is below
/// `largest_index` of the scale for both. Values that are equal in the six digits that a page
/// shows agree, or are near.
/// @param scale  > 0, largest size of the quantity over the runs of the finest level
Verdict verdict_on(const ScalarOfMethod& a, const ScalarOfMethod& b, double scale);

/// "agree", "APART", "unresolved, near: ...", "unresolved, far: ...", "unresolved: ..."
std::string verdict_text(const Verdict& verdict);

}  // namespace diptych::report
