#include "postprocess/report/line_plot.hpp"

#include "common/base/error.hpp"
#include "postprocess/report/html.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace diptych::report {

namespace {

constexpr double panel_width = 460, panel_height = 340;
constexpr double left = 78, right = 14, top = 56, bottom = 52;
constexpr std::array colours{"#1f5fa8", "#c4501b", "#2d7d46", "#7a3e9d",
                             "#555555", "#b8860b", "#008b8b", "#d1408f"};

struct Span {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  void add(double value) {
    if (!std::isfinite(value)) return;
    least = std::min(least, value);
    most = std::max(most, value);
  }
};

/// Place of a value between two ends of the picture.
struct Scale {
  double least, most, from, to;
  double operator()(double value) const {
    return from + (value - least) / (most - least) * (to - from);
  }
};

std::string tick_text(double value, double step, bool logarithmic) {
  if (logarithmic) return fmt::format("{:.4g}", std::pow(10.0, value));
  if (std::abs(value) < 1e-9 * step) return "0";
  return fmt::format("{:.4g}", value);
}

std::string text_at(double x, double y, const char* anchor, const std::string& text) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", x, y, anchor,
                     escaped(text));
}

std::string line(double x1, double y1, double x2, double y2, const char* kind) {
  return fmt::format(
      "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" class=\"{}\"/>\n", x1, y1, x2,
      y2, kind);
}

std::string axes(const Panel& panel,
                 double origin,
                 const std::vector<double>& x_ticks,
                 const std::vector<double>& y_ticks,
                 const Scale& sx,
                 const Scale& sy) {
  std::string svg;
  const double floor = panel_height - bottom, end = origin + panel_width - right;
  for (const double tick : x_ticks) {
    svg += line(sx(tick), floor, sx(tick), top, "grid");
    svg += text_at(sx(tick), floor + 16, "middle",
                   tick_text(tick, x_ticks[1] - x_ticks[0], panel.logarithmic));
  }
  for (const double tick : y_ticks) {
    svg += line(origin + left, sy(tick), end, sy(tick), "grid");
    svg += text_at(origin + left - 6, sy(tick) + 4, "end",
                   tick_text(tick, y_ticks[1] - y_ticks[0], panel.logarithmic));
  }
  svg += line(origin + left, floor, end, floor, "axis");
  svg += line(origin + left, floor, origin + left, top, "axis");
  svg += text_at(0.5 * (origin + left + end), panel_height - 12, "middle", panel.x_label);
  svg += text_at(origin + left, top - 10, "start", panel.y_label);
  return svg;
}

std::string polyline(const Curve& curve, const Scale& sx, const Scale& sy, const char* colour) {
  std::string points;
  for (size_t i = 0; i < std::min(curve.x.size(), curve.y.size()); ++i) {
    if (!std::isfinite(curve.x[i]) || !std::isfinite(curve.y[i])) continue;
    points += fmt::format("{:.1f},{:.1f} ", sx(curve.x[i]), sy(curve.y[i]));
  }
  return fmt::format("<polyline points=\"{}\" stroke=\"{}\"/>\n", points, colour);
}

/// The panel with the logarithms of its values.
Panel in_logarithms(Panel panel) {
  for (Curve& curve : panel.curves) {
    for (std::vector<double>* values : {&curve.x, &curve.y}) {
      for (double& value : *values)
        value = std::log10(value);  // of what is not positive: not finite, not drawn
    }
  }
  return panel;
}

std::string points(const Curve& curve, const Scale& sx, const Scale& sy, const char* colour) {
  std::string svg;
  for (size_t i = 0; i < std::min(curve.x.size(), curve.y.size()); ++i) {
    if (!std::isfinite(curve.x[i]) || !std::isfinite(curve.y[i])) continue;
    svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\" fill=\"{}\"/>\n",
                       sx(curve.x[i]), sy(curve.y[i]), colour);
  }
  return svg;
}

std::string panel_svg(const Panel& given, double origin) {
  const Panel panel = given.logarithmic ? in_logarithms(given) : given;
  Span x, y;
  for (const Curve& curve : panel.curves) {
    for (const double value : curve.x)
      x.add(value);
    for (const double value : curve.y)
      y.add(value);
  }
  if (!(x.least <= x.most) || !(y.least <= y.most))
    throw base::InputError("the plot '" + panel.title + "' has no finite point");
  const auto ticks = panel.logarithmic ? logarithmic_ticks : round_ticks;
  const auto x_ticks = ticks(x.least, x.most), y_ticks = ticks(y.least, y.most);
  const Scale sx{x_ticks.front(), x_ticks.back(), origin + left, origin + panel_width - right};
  const Scale sy{y_ticks.front(), y_ticks.back(), panel_height - bottom, top};
  std::string svg = axes(panel, origin, x_ticks, y_ticks, sx, sy);
  double legend = origin + panel_width - right;
  for (size_t i = 0; i < panel.curves.size(); ++i) {
    const Curve& curve = panel.curves[i];
    const char* colour = curve_colour(i);
    svg += polyline(curve, sx, sy, colour);
    if (panel.logarithmic) svg += points(curve, sx, sy, colour);
    if (curve.name.empty()) continue;
    svg += fmt::format("<g fill=\"{}\">{}</g>\n", colour,
                       text_at(legend, top - 10, "end", curve.name));
    legend -= 9.0 * static_cast<double>(curve.name.size()) + 12;
  }
  return svg;
}

}  // namespace

const char* curve_colour(size_t number) {
  return colours[number % colours.size()];
}

std::vector<double> logarithmic_ticks(double least, double most) {
  const bool dense = most - least < 2.5;
  std::vector<double> all;
  for (double power = std::floor(least - 1e-9); power <= std::ceil(most + 1e-9); ++power) {
    for (const double factor : {1.0, 2.0, 5.0}) {
      if (factor == 1 || dense) all.push_back(power + std::log10(factor));
    }
  }
  const auto inside = [&](double tick) { return tick >= least - 1e-9 && tick <= most + 1e-9; };
  std::vector<double> ticks;  // those inside and the nearest outside
  for (size_t i = 0; i < all.size(); ++i) {
    const bool below = i + 1 < all.size() && all[i] < least - 1e-9 && all[i + 1] > least - 1e-9;
    const bool above = i > 0 && all[i] > most + 1e-9 && all[i - 1] < most + 1e-9;
    if (inside(all[i]) || below || above) ticks.push_back(all[i]);
  }
  return ticks;
}

std::vector<double> round_ticks(double least, double most) {
  const double size = std::max(std::abs(least), std::abs(most));
  if (!(most - least > 1e-12 * size)) {
    const double half = size > 0 ? 0.5 * size : 1;
    least -= half;
    most += half;
  }
  const double raw = (most - least) / 5;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  const double step = power * (raw < 1.5 * power   ? 1
                               : raw < 3.5 * power ? 2
                               : raw < 7.5 * power ? 5
                                                   : 10);
  std::vector<double> ticks;
  for (double k = std::floor(least / step + 1e-9); (k - 1) * step < most - 1e-9 * step; ++k)
    ticks.push_back(k * step);
  return ticks;
}

std::string svg_plot(const std::string& title, const std::vector<Panel>& panels) {
  const double width = panel_width * static_cast<double>(panels.size());
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" "
      "height=\"{1:.0f}\" font-family=\"sans-serif\" font-size=\"12\">\n<title>{2}</title>\n"
      "<style>.grid{{stroke:#e3e3e3}}.axis{{stroke:#444}}polyline{{fill:none;stroke-width:1.6}}"
      "</style>\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
      width, panel_height, escaped(title));
  svg += "<g font-size=\"14\" font-weight=\"bold\">" + text_at(14, 22, "start", title) + "</g>\n";
  for (size_t i = 0; i < panels.size(); ++i)
    svg += panel_svg(panels[i], panel_width * static_cast<double>(i));
  return svg + "</svg>\n";
}

}  // namespace diptych::report
