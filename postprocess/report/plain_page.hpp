#pragma once
/// A page of one picture, its legend and a table as text, in the style of the reports.

#include <string>
#include <vector>

namespace diptych::report {

/// @param svg     of svg_plot, whose curves have no names of their own
/// @param legend  names of the curves in their order; each gets the colour of its curve
std::string plain_page(const std::string& title,
                       const std::string& lead,
                       const std::string& svg,
                       const std::vector<std::string>& legend,
                       const std::string& table);

}  // namespace diptych::report
