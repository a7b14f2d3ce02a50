#pragma once
/// Homogeneous tests of a case's material: a path of strain (or of stress) is imposed on one point,
/// what is not imposed follows from free faces, internal variables from the solver's updates.
///
///   shear     F = I + a e1(x)e2
///   confined  F = diag(1 + a, 1, 1)
///   uniaxial  F = diag(1 + a, l, l), P22 = P33 = 0
///   creep     F = diag(s, l, l), P11 = a, P22 = P33 = 0
///
/// with a(t) a step (amplitude at t = 0+), a ramp (rate t), or an oscillation (amplitude sin omega
/// t). Test: tests/verification/material_paths_test.cpp.

#include "common/run/material_point.hpp"

#include <string>
#include <vector>

namespace diptych::harness {

enum class Loading { shear, confined, uniaxial, creep };
enum class Course { step, ramp, oscillation };
enum class Update { linear, gauss };  ///< LIN or GEXP

struct MaterialPath {
  Loading loading = Loading::shear;
  Course course = Course::oscillation;
  Update update = Update::gauss;
  double amplitude = 0;          ///< - or Pa: of a step or an oscillation
  double rate = 0;               ///< 1/s or Pa/s: of a ramp
  double angular_frequency = 0;  ///< 1/s: of an oscillation
  double end = 0;                ///< s, > 0
  int n_steps = 1000;
};

/// "shear-step", "uniaxial-oscillation", ... @throws base::InputError
void read_path_name(const std::string& name, MaterialPath& path);

struct PathPoint {
  double time = 0, control = 0;  ///< s, a(t)
  run::PointState state;
  run::Mat3 P;                      ///< Pa
  double energy = 0;                ///< Pa
  double dissipation = 0;           ///< W/m^3
  double dissipated = 0, work = 0;  ///< J/m^3 since t = 0+
};

/// The path from t = 0+ on, n_steps + 1 points.
/// @throws base::InputError on values that the path needs and lacks, base::BreakdownError where no
///         deformation satisfies the conditions
std::vector<PathPoint> follow(const run::MaterialPoint& material, const MaterialPath& path);

/// Steps of a cycle from which on both moduli are within 1 % of those of many more steps.
double steps_of_a_cycle(Update update);

/// Storage and loss modulus of the last whole cycle of an oscillation: first Fourier coefficients
/// of P12 (shear) or P11 over the amplitude; of creep from those of the strain  [Pa].
struct DynamicModuli {
  double storage = 0, loss = 0;
};
DynamicModuli dynamic_moduli(const std::vector<PathPoint>& points, const MaterialPath& path);

/// The least eigenvalue of the acoustic tensor over all points of a path and many directions.
struct HyperbolicityScan {
  double least = 0;     ///< Pa; not above 0: a wave speed is not real
  double time = 0;      ///< s
  run::Vec3 direction;  ///< material
  std::int64_t n_states = 0, n_directions = 0;
};
HyperbolicityScan scan_hyperbolicity(const run::MaterialPoint& material,
                                     const std::vector<PathPoint>& points,
                                     int n_directions);

}  // namespace diptych::harness
