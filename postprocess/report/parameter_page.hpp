#pragma once
/// A page of plots of quantities against a parameter, and a table as text, in the style of the
/// reports. Both axes are linear, but for a parameter that spans more than a factor of twenty.
/// Tests: tests/harness/variant_quantities_test.cpp, tests/browser/browser_test.cpp

#include "postprocess/report/line_plot.hpp"

#include <string>
#include <vector>

namespace diptych::report {

/// @param verdict       HTML, what the plots come to
/// @param panels        values that are not finite are left out; points are put in order of x
/// @param chart_script  text of Chart.js, see study_report.hpp
std::string parameter_page(const std::string& title,
                           const std::string& lead,
                           const std::string& verdict,
                           const std::vector<Panel>& panels,
                           const std::string& table,
                           const std::string& chart_script);

}  // namespace diptych::report
