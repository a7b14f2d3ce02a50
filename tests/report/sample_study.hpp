#pragma once
/// A small study with both methods: errors fall with exactly the second order (SPH) and the first
/// (finite volume), so that orders are known.

#include "postprocess/report/study_report.hpp"

#include <cmath>
#include <string>

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
      row.energy = {2.0 - 0.5 * i, 1.0 + 0.25 * i, 0.25 * i, 0.125 * i, 0.125 * i, 1e-7 * i};
      study.histories[method].push_back(row);
    }
  }
  study.acceptance = {{"velocity order", ">= 1.8", "2.00", true}, {"gap", "<= 1 %", "2 %", false}};
  study.differences = {{"velocity", 6.1e-4}, {"stress", 2e-3}};
  return study;
}

}  // namespace diptych::test
