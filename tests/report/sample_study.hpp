#pragma once
/// A small study with both methods: errors fall with exactly the second order (SPH) and the first
/// (finite volume), so that orders are known.

#include "postprocess/report/study_report.hpp"

#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace diptych::test {

inline io::RunSummary sample_run(const std::string& method, int level) {
  io::RunSummary run;
  const bool sph = method == "sph";
  run.method = method, run.case_name = "swinging-cube", run.title = "Swinging cube";
  run.level = level, run.spacing = 0.25 / (1 << level);
  run.nodes = 125LL << (3 * level), run.pairs = run.nodes * (sph ? 51 : 26);
  run.steps = 60LL << level, run.stages = 2 * run.steps, run.integrator = "leapfrog";
  run.loop_seconds = (sph ? 0.08 : 0.05) * std::pow(16.0, level);
  run.wall_seconds = run.loop_seconds + 0.1;
  run.nanoseconds_per_node_stage = sph ? 452 : 252;
  run.dt_min = run.dt_max = 1e-4 / (1 << level);
  double l2 = sph ? 0.016 / (1 << (2 * level)) : 0.032 / (1 << level);
  for (const char* field : {"velocity", "displacement", "deformation_gradient", "stress"}) {
    run.errors[field] = {l2 / 2, l2, 3 * l2};
    l2 *= 1.5;
  }
  run.energy.relative_residual = 3e-6;
  run.provenance = {"0.1.0", "c0ffee",     "GCC 12", "-O3",  "cpu",
                    "avx2",  "2026-01-02", "d00d",   "beef", "f00d"};
  return run;
}

inline report::StudyReport sample_study() {
  report::StudyReport study;
  study.title = "Swinging cube";
  study.description = "A cube swings.";
  study.material = {"Mooney-Rivlin", "branch 1: tau_C = 2 ms"};
  for (int level = 0; level < 3; ++level) {
    for (const char* method : {"fvm", "sph"})
      study.runs.push_back(sample_run(method, level));
  }
  for (const char* method : {"sph", "fvm"}) {
    for (int i = 0; i <= 4; ++i) {
      io::HistoryRow row;
      row.time = 0.001 * i;
      row.energy = {2.0 - 0.5 * i, 1.0 + 0.25 * i, 0.25 * i, 0.125 * i, 0.125 * i, 0, 1e-7 * i};
      study.histories[method].push_back(row);
    }
  }
  study.differences = {{"velocity", 6.1e-4}, {"stress", 2e-3}};
  return study;
}

/// The sides of a cube of n x n squares each that rises and brightens; the two methods part by
/// 0.01 m along z for each frame.
inline std::map<std::string, report::ShapeRecord> sample_shapes(int n, int n_frames) {
  report::ShapeRecord record;
  std::vector<std::array<double, 3>> X;
  for (int side = 0; side < 6; ++side) {
    for (int j = 0; j <= n; ++j) {
      for (int i = 0; i <= n; ++i) {
        std::array<double, 3> x{};
        x[side % 3] = side < 3 ? 0 : 1;
        x[(side + 1) % 3] = i / double(n);
        x[(side + 2) % 3] = j / double(n);
        const auto a = static_cast<std::int32_t>(X.size());
        X.push_back(x);
        record.surface.nodes.push_back(a);
        if (i < n && j < n) record.surface.faces.push_back({a, a + 1, a + n + 2, a + n + 1});
      }
    }
  }
  record.surface.n_points_of_mesh = X.size();
  record.fields = {{"speed", "m/s"}, {"pressure", "Pa"}, {"von Mises stress", "Pa"}, {"J", "-"}};
  record.n_outputs = static_cast<size_t>(n_frames);
  std::map<std::string, report::ShapeRecord> shapes;
  for (const char* method : {"sph", "fvm"}) {
    report::ShapeRecord& one = shapes[method] = record;
    for (int k = 0; k < n_frames; ++k) {
      report::ShapeFrame frame{0.001 * k, {}, std::vector<std::vector<double>>(4)};
      for (const auto& x : X) {
        const double apart = std::string(method) == "fvm" ? 0.01 * k : 0;
        frame.x.insert(frame.x.end(), {x[0], x[1], x[2] + 0.05 * k + apart});
        for (auto& values : frame.values)
          values.push_back(x[0] + x[2] + 0.1 * k);
      }
      one.frames.push_back(frame);
    }
  }
  return shapes;
}

/// The same with everything that a page can show: probes, shapes, quantities with error bars.
inline report::StudyReport full_study() {
  report::StudyReport study = sample_study();
  for (io::RunSummary& run : study.runs) {
    run.quantities = {{"tip <z>", "m", 0.5, -1.25, 2, 3, 0.25, 0.1, 0.9, 0.04},
                      {"swept share", "-", 1, 0, 1, 0, 0, 0, 0, {}}};
  }
  for (auto& [method, rows] : study.histories) {
    for (io::HistoryRow& row : rows)
      row.probes = {std::sin(1000 * row.time), row.energy.viscous_dissipation};
  }
  study.references.exact = {{"time", "s", {0, 0.001, 0.002, 0.003, 0.004}},
                            {"kinetic energy", "J", {2, 1.5, 1, 0.5, 0}},
                            {"tip <z>", "m", {0, 0.84, 0.91, 0.14, -0.76}}};
  study.references.points = {{"tip <z>", "Doe <i>et al.</i>, table 2", {{0.0015, 1}}}};
  study.shapes = sample_shapes(4, 3);
  for (const char* method : {"sph", "fvm"}) {
    const double off = std::string(method) == "sph" ? 0.01 : 0;
    report::GridSeries series{method, {}, report::GridConvergence{}};
    series.points = {{0, 0.25, 1.16 + off, 0}, {1, 0.125, 1.04, 0.12}, {2, 0.0625, 1.01, 0.0125}};
    *series.estimate = {report::Convergence::monotone, 2, 1, 0.0125, 0.0124};
    study.quantities[{"strain energy", "J"}].push_back(series);
  }
  return study;
}

}  // namespace diptych::test
