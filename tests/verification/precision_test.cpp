/// States in single precision repeat those in double to some units of its rounding, at strains of
/// order one and of 1e-6 alike, since what is stored of F, H, J, A, S is the deviation from rest.

#include "tests/verification/case_scene.hpp"

#include <gtest/gtest.h>

namespace diptych {
namespace {

using tests::text_of;

struct PrecisionCase {
  std::string name;
  std::vector<std::string> overrides;
  double end;
  int n_steps;
};

std::ostream& operator<<(std::ostream& out, const PrecisionCase& c) {
  out << c.name;
  for (const auto& text : c.overrides)
    out << " " << text;
  return out;
}

class Precision
    : public testing::TestWithParam<std::tuple<std::string, PrecisionCase, std::string>> {};

scheme::Snapshot final_state(const std::string& method,
                             const PrecisionCase& c,
                             const std::string& precision) {
  std::vector<std::string> overrides = c.overrides;
  overrides.push_back(tests::any_step);
  overrides.push_back(text_of("scheme.precision", precision));
  const auto scene = tests::scene_of_case(method, c.name, overrides);
  tests::make_steps(*scene.solver, c.end, c.n_steps);
  return scene.solver->snapshot();
}

TEST_P(Precision, RepeatsDouble) {
  const auto& [method, c, precision] = GetParam();
  const auto full = final_state(method, c, "double"), less = final_state(method, c, precision);
  const double distance = tests::distance(less, full);
  if (std::string(precision) == "single") {  // the areas of a lattice may have no digits to lose
    EXPECT_GT(distance, 1e-12);
  }
  EXPECT_LT(distance, 1e-5);
}

const std::string leapfrog = text_of("time.integrator", "leapfrog");

INSTANTIATE_TEST_SUITE_P(
    Both,
    Precision,
    testing::Combine(
        testing::Values("sph", "fvm"),
        testing::Values(
            PrecisionCase{"swinging-cube-ve2-hex", {}, 2e-3, 20},
            PrecisionCase{"swinging-cube-ve2-hex",
                          {"mesh.perturbation=0.2", leapfrog, text_of("scheme.unknowns", "F")},
                          2e-3,
                          20},
            PrecisionCase{
                "swinging-cube-elastic-tet", {text_of("scheme.unknowns", "FJ")}, 2e-3, 20},
            PrecisionCase{"swinging-cube-elastic-tet",  // far from the origin
                          {"mesh.lower=[1e5, 1e5, 1e5]", "mesh.upper=[100001, 100001, 100001]"},
                          2e-3,
                          20},
            PrecisionCase{"manufactured-swirl-2d", {"scheme.face_correction=1/6"}, 1e-3, 10},
            PrecisionCase{"vibrating-bar", {leapfrog}, 0.005, 30}),
        testing::Values("mixed", "single")));

}  // namespace
}  // namespace diptych
