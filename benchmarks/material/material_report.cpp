#include "benchmarks/material/material_report.hpp"

#include "postprocess/report/line_plot.hpp"

#include <cmath>
#include <fmt/format.h>

namespace diptych::harness {

namespace {

double strain(const MaterialPath& path, const PathPoint& point) {
  return path.loading == Loading::shear ? point.state.F(0, 1) : point.state.F(0, 0) - 1;
}

/// P11, or P12 in shear: what the loop shows.
double main_stress(const MaterialPath& path, const PathPoint& point) {
  return path.loading == Loading::shear ? point.P(0, 1) : point.P(0, 0);
}

const char* stress_name(const MaterialPath& path) {
  return path.loading == Loading::shear ? "P12" : "P11";
}

void add_tensor_names(std::string& head, const std::string& name, const std::string& unit) {
  for (int i = 1; i <= 3; ++i) {
    for (int j = 1; j <= 3; ++j)
      head += fmt::format(",{}_{}{} [{}]", name, i, j, unit);
  }
}

void add_tensor(std::string& row, const run::Mat3& M) {
  for (int k = 0; k < 9; ++k)
    row += fmt::format(",{:.12g}", M(k / 3, k % 3));
}

}  // namespace

double energy_residual(const std::vector<PathPoint>& points) {
  const PathPoint& end = points.back();
  return std::abs(end.work - (end.energy - points.front().energy) - end.dissipated) /
         std::max({std::abs(end.work), end.energy, end.dissipated, 1e-300});
}

std::string path_table(const cases::Case& setup,
                       const MaterialPath& path,
                       const std::vector<PathPoint>& points,
                       const HyperbolicityScan& scan) {
  std::string text =
      fmt::format("{:>11}{:>11}{:>11}{:>13}{:>13}{:>13}{:>13}{:>13}\n", "t [s]", "F11 [-]",
                  "F12 [-]", "P11 [Pa]", "P12 [Pa]", "P22 [Pa]", "W [Pa]", "D [W/m^3]");
  const size_t last = points.size() - 1, n_rows = std::min<size_t>(12, last);
  for (size_t k = 0; k <= n_rows; ++k) {
    const PathPoint& p = points[last * k / n_rows];
    text += fmt::format(
        "{:>11.4g}{:>11.5g}{:>11.5g}{:>13.5g}{:>13.5g}{:>13.5g}{:>13.5g}{:>13.5g}\n", p.time,
        p.state.F(0, 0), p.state.F(0, 1), p.P(0, 0), p.P(0, 1), p.P(1, 1), p.energy, p.dissipation);
  }
  const PathPoint& end = points.back();
  text += fmt::format(
      "work {:.6g}, stored {:.6g}, dissipated {:.6g} J/m^3; residual {:.1e} of the largest\n",
      end.work, end.energy - points.front().energy, end.dissipated, energy_residual(points));
  const double cycles = path.end * path.angular_frequency / (2 * 3.14159265358979323846);
  if (path.course == Course::oscillation && cycles >= 1 - 1e-9) {
    const DynamicModuli G = dynamic_moduli(points, path);
    text += fmt::format(
        "last cycle, {}: storage modulus {:.6g} Pa, loss modulus {:.6g} Pa, loss factor {:.4g}\n",
        stress_name(path), G.storage, G.loss, G.loss / G.storage);
  }
  text += fmt::format(
      "hyperbolicity, {} states x {} directions: least eigenvalue of the acoustic tensor {:.6g} "
      "Pa\n",
      scan.n_states, scan.n_directions, scan.least);
  text += scan.least > 0 ? fmt::format("  all wave speeds are real; the slowest is {:.4g} m/s",
                                       std::sqrt(scan.least / setup.material.density))
                         : std::string("  NOT hyperbolic: a wave speed is not real");
  return text + fmt::format(", at t = {:.4g} s along ({:.3f}, {:.3f}, {:.3f})\n", scan.time,
                            scan.direction[0], scan.direction[1], scan.direction[2]);
}

std::string path_csv(const std::vector<PathPoint>& points) {
  std::string csv = "time [s],control";
  add_tensor_names(csv, "F", "-");
  add_tensor_names(csv, "P", "Pa");
  for (size_t k = 0; k < points.front().state.branches.size(); ++k) {
    add_tensor_names(csv, fmt::format("A{}", k + 1), "-");
    add_tensor_names(csv, fmt::format("S{}", k + 1), "-");
  }
  csv += ",energy [Pa],dissipation [W/m^3],dissipated [J/m^3],work [J/m^3]\n";
  for (const PathPoint& p : points) {
    csv += fmt::format("{:.12g},{:.12g}", p.time, p.control);
    add_tensor(csv, p.state.F);
    add_tensor(csv, p.P);
    for (const auto& branch : p.state.branches) {
      add_tensor(csv, algebra::to_eigen(branch.A));
      add_tensor(csv, algebra::to_eigen(branch.S));
    }
    csv += fmt::format(",{:.12g},{:.12g},{:.12g},{:.12g}\n", p.energy, p.dissipation, p.dissipated,
                       p.work);
  }
  return csv;
}

std::string path_svg(const cases::Case& setup,
                     const MaterialPath& path,
                     const std::vector<PathPoint>& points) {
  report::Curve loop, first{"P11", {}, {}}, second{"P12", {}, {}}, dissipated{"dissipated", {}, {}},
      stored{"stored", {}, {}};
  for (const PathPoint& p : points) {
    loop.x.push_back(strain(path, p));
    loop.y.push_back(main_stress(path, p));
    for (report::Curve* curve : {&first, &second, &dissipated, &stored})
      curve->x.push_back(p.time);
    first.y.push_back(p.P(0, 0));
    second.y.push_back(p.P(0, 1));
    dissipated.y.push_back(p.dissipated);
    stored.y.push_back(p.energy);
  }
  std::vector<report::Curve> stresses{first};
  if (path.loading == Loading::shear) stresses = {second, first};
  const std::string strain_name =
      path.loading == Loading::shear ? "shear strain [-]" : "stretch - 1 [-]";
  return report::svg_plot("Material of " + setup.name,
                          {{"loop", strain_name, fmt::format("{} [Pa]", stress_name(path)), {loop}},
                           {"stress", "time [s]", "stress [Pa]", stresses},
                           {"energy", "time [s]", "energy [J/m^3]", {stored, dissipated}}});
}

}  // namespace diptych::harness
