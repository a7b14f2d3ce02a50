/// The quantities of a study as text, CSV and a page.

#include "benchmarks/study/variant_quantities.hpp"
#include "benchmarks/terminal/text.hpp"
#include "postprocess/report/curve_page.hpp"
#include "postprocess/report/orders.hpp"
#include "postprocess/report/study_report.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <set>

namespace diptych::harness {

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
constexpr size_t page_width = 100, column_width = 13;

/// A run that a table has a column for.
struct MethodLevel {
  std::string method;
  int level;
  bool operator<(const MethodLevel& other) const {
    return std::pair(other.method, level) < std::pair(method, other.level);  // SPH first
  }
  std::string title() const { return fmt::format("{} {}", method == "sph" ? "SPH" : "FVM", level); }
};

std::vector<MethodLevel> columns_of(const VariantStudy& study) {
  std::set<MethodLevel> columns;
  for (const WorkCurve& curve : study.curves) {
    for (const WorkPoint& point : curve.points)
      columns.insert({curve.method, point.run.level});
  }
  return {columns.begin(), columns.end()};
}

/// What a variant has as a quantity, NaN where that run is not there.
double value_of(const VariantStudy& study,
                const std::string& variant,
                const MethodLevel& column,
                const std::string& quantity) {
  for (const WorkCurve& curve : study.curves) {
    if (curve.variant != variant || curve.method != column.method) continue;
    for (const WorkPoint& point : curve.points) {
      if (point.run.level == column.level) return value_of(point, quantity);
    }
  }
  return nothing;
}

std::string unit_of(const VariantStudy& study, const std::string& quantity) {
  for (const WorkCurve& curve : study.curves) {
    for (const RunQuantity& q : quantities_of_run(curve.points.front())) {
      if (q.name == quantity) return q.unit;
    }
  }
  return "-";
}

/// Rows of one quantity for some of the columns.
std::string block(const VariantStudy& study,
                  const std::string& quantity,
                  const std::vector<MethodLevel>& columns,
                  size_t width) {
  std::string text = fmt::format("{:<{}}", "", width);
  for (const MethodLevel& column : columns)
    text += fmt::format("{:>{}}", column.title(), column_width);
  text += "\n";
  for (const Variant& variant : study.variants) {
    text += fmt::format("{:<{}}", variant.label.empty() ? "as it stands" : variant.label, width);
    for (const MethodLevel& column : columns)
      text += fmt::format("{:>{}}",
                          number_text(value_of(study, variant.label, column, quantity), "{:.5g}"),
                          column_width);
    text += "\n";
  }
  return text;
}

/// Keys that vary, of any variant.
std::vector<std::string> varied_keys(const VariantStudy& study) {
  std::vector<std::string> keys;
  for (const std::string& text : study.variants.front().overrides)
    keys.push_back(text.substr(0, text.find('=')));
  return keys;
}

std::string setting(const Variant& variant, size_t key) {
  if (key >= variant.overrides.size()) return "";  // of --with, beside those that vary
  const std::string& text = variant.overrides[key];
  return text.substr(text.find('=') + 1);
}

const Variant& variant_named(const VariantStudy& study, const std::string& label) {
  return *std::find_if(study.variants.begin(), study.variants.end(),
                       [&](const Variant& variant) { return variant.label == label; });
}

std::optional<double> parsed(const std::string& text) {
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [last, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || last != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// The first key that takes two numbers or more, and nothing else.
std::optional<size_t> abscissa_of(const VariantStudy& study) {
  const size_t n_keys = study.variants.front().overrides.size();
  for (size_t key = 0; key < n_keys; ++key) {
    std::set<double> values;
    bool all = true;
    for (const Variant& variant : study.variants) {
      const auto value = parsed(setting(variant, key));
      all = all && value;
      if (value) values.insert(*value);
    }
    if (all && values.size() > 1) return key;
  }
  return std::nullopt;
}

/// The other settings of a variant, as they stand in its label.
std::string label_without(const Variant& variant, size_t left_out) {
  std::string label;
  for (size_t key = 0; key < variant.overrides.size(); ++key) {
    if (key == left_out) continue;
    const std::string& text = variant.overrides[key];
    const size_t dot = text.rfind('.', text.find('='));
    label += ' ';
    label += text.substr(dot == std::string::npos ? 0 : dot + 1);
  }
  return label;
}

report::Curve& curve_named(report::Panel& panel, const std::string& name) {
  for (report::Curve& curve : panel.curves) {
    if (curve.name == name) return curve;
  }
  return panel.curves.emplace_back(report::Curve{name, {}, {}});
}

report::Panel panel_of(const VariantStudy& study,
                       const std::string& quantity,
                       std::optional<size_t> key) {
  report::Panel panel;
  const std::string unit = unit_of(study, quantity);
  panel.title = quantity;
  panel.y_label = with_unit(quantity, unit);
  panel.x_label = key ? varied_keys(study)[*key] : "spacing [m]";
  for (const MethodLevel& column : columns_of(study)) {
    for (const WorkCurve& curve : study.curves) {
      if (curve.method != column.method) continue;
      for (const WorkPoint& point : curve.points) {
        if (point.run.level != column.level) continue;
        const Variant& variant = variant_named(study, curve.variant);
        report::Curve& line =
            curve_named(panel, key ? column.title() + label_without(variant, *key) : curve.name());
        line.x.push_back(key ? *parsed(setting(variant, *key)) : point.run.spacing);
        line.y.push_back(value_of(point, quantity));
      }
    }
  }
  return panel;
}

}  // namespace

std::string quantities_table(const VariantStudy& study) {
  size_t width = 12;
  for (const Variant& variant : study.variants)
    width = std::max(width, variant.label.size());
  const std::vector<MethodLevel> columns = columns_of(study);
  const size_t fit = width + column_width < page_width ? (page_width - width) / column_width : 1;
  std::string text;
  for (const std::string& quantity : study.quantities) {
    text += fmt::format("\n{}\n", with_unit(quantity, unit_of(study, quantity)));
    for (size_t first = 0; first < columns.size(); first += fit) {
      const size_t last = std::min(first + fit, columns.size());
      text += block(study, quantity,
                    {columns.begin() + static_cast<std::ptrdiff_t>(first),
                     columns.begin() + static_cast<std::ptrdiff_t>(last)},
                    width);
    }
  }
  return text;
}

std::string quantities_csv(const VariantStudy& study) {
  std::string csv = "variant";
  const std::vector<std::string> keys = varied_keys(study);
  for (const std::string& key : keys)
    csv += fmt::format(",{}", key);
  csv += ",method,level,spacing [m]";
  const WorkPoint& first = study.curves.front().points.front();
  for (const RunQuantity& q : quantities_of_run(first))
    csv += fmt::format(",{}", quoted(with_unit(q.name, q.unit)));
  csv += "\n";
  for (const WorkCurve& curve : study.curves) {
    const Variant& variant = variant_named(study, curve.variant);
    for (const WorkPoint& point : curve.points) {
      csv += quoted(curve.variant);
      for (size_t key = 0; key < keys.size(); ++key)
        csv += fmt::format(",{}", quoted(setting(variant, key)));
      csv += fmt::format(",{},{},{:.17g}", curve.method, point.run.level, point.run.spacing);
      for (const RunQuantity& q : quantities_of_run(point))
        csv += "," + number_text(q.value, "{:.17g}", "");
      csv += "\n";
    }
  }
  return csv;
}

std::string quantities_html(const std::string& title, const VariantStudy& study) {
  const std::optional<size_t> key = abscissa_of(study);
  std::vector<report::Panel> panels;
  for (const std::string& quantity : study.quantities)
    panels.push_back(panel_of(study, quantity, key));
  return report::curve_page(title,
                            key ? "Each quantity against " + varied_keys(study)[*key] +
                                      ", both methods, every level; the table is below."
                                : "Each quantity against the spacing, both methods, every "
                                  "variant; the table is below.",
                            quantities_verdict(study), panels, quantities_table(study),
                            report::chart_script(report::chart_script_path()));
}

}  // namespace diptych::harness
