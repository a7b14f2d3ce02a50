#pragma once
/// Curves as one self-contained SVG picture: panels side by side, round ticks, no scripts, no fonts
/// of its own. Test: tests/report/line_plot_test.cpp.

#include <string>
#include <vector>

namespace diptych::report {

struct Curve {
  std::string name;  ///< of the legend; empty: none
  std::vector<double> x, y;
};

struct Panel {
  std::string title, x_label, y_label;
  std::vector<Curve> curves;
  bool logarithmic = false;  ///< both axes; values that are not positive are left out
};

/// Colour of the curve with this number.
const char* curve_colour(size_t number);

/// Round ticks that span [least, most]: steps of 1, 2 or 5 times a power of ten.
std::vector<double> round_ticks(double least, double most);

/// Logarithms (base ten) of round values that span [10^least, 10^most]: powers of ten, and 2 and 5
/// times them where there are few.
std::vector<double> logarithmic_ticks(double least, double most);

/// @throws base::InputError on a panel without a finite point
std::string svg_plot(const std::string& title, const std::vector<Panel>& panels);

}  // namespace diptych::report
