#pragma once
/// A page of plots of curves and a table as text, in the style of the reports: one file, drawn by
/// Chart.js, with their zoom and legends. Tests: tests/harness/work_precision_test.cpp,
/// tests/harness/variant_quantities_test.cpp, tests/browser/browser_test.cpp

#include "postprocess/report/line_plot.hpp"

#include <string>
#include <vector>

namespace diptych::report {

/// @param verdict       what the curves say, HTML; may be empty
/// @param panels        logarithmic ones without values that are not positive. The others have
///                      their points in order of x, and linear axes, but for an x that spans more
///                      than a factor of twenty
/// @param chart_script  text of Chart.js, see study_report.hpp
std::string curve_page(const std::string& title,
                       const std::string& lead,
                       const std::string& verdict,
                       const std::vector<Panel>& panels,
                       const std::string& table,
                       const std::string& chart_script);

}  // namespace diptych::report
