#pragma once
/// The report of a study: one HTML file that needs no network and nothing beside it. It begins with
/// a verdict in plain words and says what was run, what each method costs for the error it makes,
/// how fast the errors fall, how the body moved and where the methods part, what the probes saw,
/// and where the energy went. Reads on a phone, in the dark and on
/// paper. Its charts are drawn by Chart.js (Debian: libjs-chart.js), copied into the page as it is
/// written. Test: tests/report/study_report_test.cpp

#include "common/io/run_record.hpp"
#include "postprocess/report/grid_convergence.hpp"
#include "postprocess/report/orders.hpp"
#include "postprocess/report/shapes.hpp"

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace diptych::report {

/// A scalar at the final time on one level, with the half width of its error bar: 0 where the level
/// and those before it give none.
struct GridPoint {
  int level = 0;
  double spacing = 0, value = 0, error_bar = 0;
};

/// A scalar of one column (RunSummary::column) from coarse to fine.
struct GridSeries {
  std::string column;
  std::vector<GridPoint> points;
  std::optional<GridConvergence> estimate;  ///< of the finest level: three grids or more
  FormalOrder formal_order = {};            ///< of the method as it ran
  std::optional<double> scale = {};  ///< over the run of the finest level; nothing: of the points
};

/// Values of a probe from elsewhere.
struct ReferencePoints {
  std::string probe, source;
  std::vector<std::array<double, 2>> points;  ///< s, unit of the probe
};

/// How far a variant is from a method at the settings of the case, on the same nodes.
struct ColumnDistance {
  std::string column, method;
  std::map<std::string, double> fields;  ///< as StudyReport::differences
};

/// What the curves of both methods are held against.
struct References {
  std::vector<io::HistoryColumn> exact;  ///< time first, names as in history.csv; may be empty
  std::vector<ReferencePoints> points;
};

/// A run that the physics or the scheme ended before its time.
struct Breakdown {
  std::string column;
  int level = 0;
  double time = 0;  ///< s
  std::int64_t step = 0;
  std::int64_t node = -1;                           ///< below zero: of no one node
  std::string message;                              ///< what happened, without a full stop
  std::optional<std::array<double, 3>> place = {};  ///< m, of the node in the undeformed body
};

struct StudyReport {
  std::string title, description;
  std::vector<std::string> material;  ///< lines of text: law, constants with units, branches
  std::vector<io::RunSummary> runs;   ///< any columns and levels, in any order
  std::map<std::string, std::string> settings;  ///< column of a variant: what it sets
  std::map<std::string, std::vector<io::HistoryRow>> histories;  ///< column: finest level
  std::vector<Breakdown> breakdowns;                             ///< named before anything else
  std::map<std::string, double> differences;  ///< field: L2 between the methods at the end, over
                                              ///< its largest norm at any output time
  std::vector<ColumnDistance> distances;
  References references;
  std::map<std::string, std::string> causes;  ///< quantity: why the methods are apart on it
  std::map<std::string, ShapeRecord> shapes;  ///< method: deformed surfaces of the finest level
  /// name and unit of a scalar: its values on the levels of each column
  std::map<std::pair<std::string, std::string>, std::vector<GridSeries>> quantities;
};

/// Writes the page, whole or not at all.
/// @throws base::EnvironmentError where Chart.js is missing or the file cannot be written
void write_report(const std::string& path, const StudyReport& study);

/// The page as text. @param chart_script text of Chart.js, version 3 or 4
std::string report_html(const StudyReport& study, const std::string& chart_script);

/// Text of Chart.js as installed. @throws base::EnvironmentError naming the package
std::string chart_script(const std::string& path);

/// Where Chart.js was at build time: CMake's DIPTYCH_CHART_JS.
std::string chart_script_path();

}  // namespace diptych::report
