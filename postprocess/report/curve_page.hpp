#pragma once
/// A page of log-log plots of the same curves and a table as text, in the style of the reports: one
/// file, drawn by Chart.js, with their zoom and legends. Tests:
/// tests/harness/work_precision_test.cpp, tests/browser/browser_test.cpp

#include "postprocess/report/line_plot.hpp"

#include <string>
#include <vector>

namespace diptych::report {

/// @param verdict       what the curves say, HTML; may be empty
/// @param panels        values that are not positive are left out
/// @param chart_script  text of Chart.js, see study_report.hpp
std::string curve_page(const std::string& title,
                       const std::string& lead,
                       const std::string& verdict,
                       const std::vector<Panel>& panels,
                       const std::string& table,
                       const std::string& chart_script);

}  // namespace diptych::report
