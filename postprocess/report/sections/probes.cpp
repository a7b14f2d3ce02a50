/// What the probes of the case saw: histories of both methods and their numbers.

#include "postprocess/report/html.hpp"
#include "postprocess/report/orders.hpp"
#include "postprocess/report/sections.hpp"
#include "postprocess/report/sections/parts.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace diptych::report {
namespace {

std::string with_unit(const io::QuantitySummary& quantity) {
  return escaped(quantity.name) + (quantity.unit == "-" ? "" : " [" + escaped(quantity.unit) + "]");
}

/// Which columns some run has something for.
struct Columns {
  bool period = false, decrement = false;
};

std::string row(const io::RunSummary& run, const io::QuantitySummary& q, const Columns& has) {
  std::string html = "<tr><th scope=\"row\">" + column_mark(run.column()) + "</th>" +
                     cell(precise_html(q.final_value)) + cell(precise_html(q.least)) +
                     cell(precise_html(q.greatest));
  if (has.period) html += cell(q.n_periods > 0 ? precise_html(q.period) : "");
  if (has.decrement) html += cell(q.decrement ? number_html(*q.decrement) : "");
  return html + "</tr>\n";
}

/// The numbers of one probe, a row for each method.
std::string numbers(const std::vector<io::RunSummary>& runs, size_t probe) {
  Columns has;
  std::string rows;
  for (const io::RunSummary& run : runs) {
    has.period = has.period || run.quantities[probe].n_periods > 0;
    has.decrement = has.decrement || run.quantities[probe].decrement.has_value();
  }
  for (const io::RunSummary& run : runs)
    rows += row(run, run.quantities[probe], has);
  std::string head = heading_cell("method") + heading_cell("at the end") + heading_cell("least") +
                     heading_cell("greatest");
  if (has.period) head += heading_cell("period [s]");
  if (has.decrement) head += heading_cell("decrement");
  return table(head, rows);
}

}  // namespace

size_t row_stride(size_t n_rows) {
  constexpr size_t most_rows = 1000;
  return (n_rows + most_rows - 1) / most_rows;
}

std::string stride_note(const StudyReport& study) {
  size_t stride = 1;
  for (const auto& [method, rows] : study.histories)
    stride = std::max(stride, row_stride(rows.size()));
  return stride == 1 ? "" : fmt::format(" The curves keep one of {} output times.", stride);
}

std::vector<io::RunSummary> probed_runs(const StudyReport& study) {
  std::vector<io::RunSummary> runs;
  for (const std::string& column : columns_of(study.runs)) {
    const io::RunSummary run = runs_of(study.runs, column).back();
    const bool fits = runs.empty() || run.quantities.size() == runs.front().quantities.size();
    if (!run.quantities.empty() && fits) runs.push_back(run);
  }
  return runs;
}

namespace {

/// Where the points beside the curves of a probe are from.
std::string sources(const StudyReport& study, const std::string& probe) {
  std::string text;
  for (const ReferencePoints& one : study.references.points) {
    if (one.probe == probe) text += (text.empty() ? "Reference: " : "; ") + escaped(one.source);
  }
  return text.empty() ? "" : text + ".";
}

/// Whether a run is within the uncertainty of a reference, and at how many of its times.
std::string inside(const StudyReport& study,
                   const io::RunSummary& run,
                   const io::ReferenceSummary& one) {
  if (!one.uncertainty) return "no uncertainty stated";
  if (one.is_inside()) {
    for (const ReferencePoints& all : study.references.points) {
      if (all.probe != one.probe || all.source != one.source) continue;
      const auto n = std::count_if(all.points.begin(), all.points.end(), [&](const auto& point) {
        return point[0] <= run.end_time * (1 + 1e-9);
      });
      if (n < std::ssize(all.points))
        return fmt::format("met at {} of {} times", n, all.points.size());
    }
    return "met";
  }
  return "<strong>not met</strong>, " + number_html(one.greatest / *one.uncertainty) + " times";
}

/// How far each column is from the values beside the curves of a probe, on its finest level.
std::string distances(const StudyReport& study,
                      const std::vector<io::RunSummary>& runs,
                      const std::string& probe) {
  std::string rows;
  for (const io::RunSummary& run : runs) {
    for (const io::ReferenceSummary& one : run.references) {
      if (one.probe != probe) continue;
      rows += "<tr><th scope=\"row\">" + column_mark(run.column()) + "</th>" +
              cell(number_html(one.greatest)) + cell(number_html(one.greatest_at)) +
              cell(number_html(one.rms)) + cell(number_html(one.at_end)) +
              cell(one.uncertainty ? number_html(*one.uncertainty) : "") +
              cell(inside(study, run, one)) + "</tr>\n";
    }
  }
  if (rows.empty()) return "";
  return table(heading_cell("off the reference") + heading_cell("at most") +
                   heading_cell("at [s]") + heading_cell("rms") + heading_cell("at the end") +
                   heading_cell("its uncertainty") + heading_cell("within it"),
               rows);
}

/// Energies and momenta over time with those of the exact solution.
std::string other_charts(const StudyReport& study) {
  std::string html;
  size_t number = 0;
  for (const io::HistoryColumn& column : exact_others(study)) {
    const std::string title = escaped(column.name) + " [" + escaped(column.unit) + "]";
    html += fmt::format("<div>\n<h3>{}</h3>\n{}</div>\n", title,
                        chart(fmt::format("exact-{}", number++), title + " over time", ""));
  }
  return html;
}

}  // namespace

std::string probes_section(const StudyReport& study) {
  const std::vector<io::RunSummary> runs = probed_runs(study);
  const std::string others = other_charts(study);
  if (runs.empty() && others.empty()) return "";
  const size_t n_methods = methods_of(study.runs).size();
  std::string html = n_methods < 2            ? "<p>On the finest level."
                     : study.settings.empty() ? "<p>Both methods on the finest level."
                                              : "<p>Both methods and their variants on the finest "
                                                "level.";
  if (!runs.empty()) {
    html +=
        " Extremes, period and logarithmic decrement are of the recorded values; a probe that the "
        "case records at every step has them from there.";
  }
  if (!others.empty()) html += " Dotted: the exact solution, on the same nodes.";
  html += stride_note(study) + "</p>\n<div class=\"pair\">\n";
  for (size_t k = 0; !runs.empty() && k < runs.front().quantities.size(); ++k) {
    const io::QuantitySummary& quantity = runs.front().quantities[k];
    const std::string title = with_unit(quantity);
    html += fmt::format(
        "<div>\n<h3>{}</h3>\n{}{}</div>\n", title,
        chart(fmt::format("probe-{}", k), title + " over time", sources(study, quantity.name)),
        numbers(runs, k) + distances(study, runs, quantity.name));
  }
  return section("probes", runs.empty() ? "Against the exact solution" : "What the probes saw",
                 html + others + "</div>\n");
}

}  // namespace diptych::report
