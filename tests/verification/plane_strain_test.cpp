/// Plane strain is a slice of three dimensions: FVM on one layer of cells between rollers repeats
/// the plane scene under every integrator, and the plane scene stores only what it needs. SPH has
/// no such layer, its kernel spans several.

#include "benchmarks/run/run_case.hpp"
#include "tests/verification/case_scene.hpp"

#include <gtest/gtest.h>

namespace diptych {
namespace {

using tests::Scene;
using tests::text_of;

const std::string body = tests::viscoelastic("0.4") + R"toml([[boundary]]
group = "x_min"
type = "velocity"
)toml";

const std::string plane = body + R"toml(value = ["4*sin(300*t)", "-2*y*sin(200*t)"]
[[boundary]]
group = "x_max"
type = "traction"
value = ["2e5*y", "-4e5*sin(300*t)"]
[[boundary]]
group = "y_max"
type = "pressure"
value = "4e5*x"
[mesh]
element = "quadrilateral"
lower = [0, 0]
upper = [1, 1]
cells = [5, 5]
[initial]
velocity = ["30*y*y*x", "-20*x*y"]
[time]
end = 3e-3
)toml";

const std::string layer = body + R"toml(value = ["4*sin(300*t)", "-2*y*sin(200*t)", "0"]
[[boundary]]
group = "x_max"
type = "traction"
value = ["2e5*y", "-4e5*sin(300*t)", "0"]
[[boundary]]
group = "y_max"
type = "pressure"
value = "4e5*x"
[[boundary]]
group = ["z_min", "z_max"]
type = "symmetry"
[mesh]
element = "hexahedron"
lower = [0, 0, 0]
upper = [1, 1, 0.5]
cells = [5, 5, 1]
[initial]
velocity = ["30*y*y*x", "-20*x*y", "0"]
[time]
end = 3e-3
)toml";

template <class Value>
double relative_gap(const std::vector<Value>& plane_field, const std::vector<Value>& solid_field) {
  double gap = 0, size = 0;
  for (size_t a = 0; a < plane_field.size(); ++a) {
    gap = std::max(gap, (plane_field[a] - solid_field[a]).norm());
    size = std::max(size, plane_field[a].norm());
  }
  return gap / size;
}

TEST(PlaneStrain, RepeatsOneLayerBetweenRollers) {
  parallel::set_threads(1);
  for (const auto& setting : std::vector<std::vector<std::string>>{
           {text_of("time.integrator", "ssp-rk3")},
           {text_of("time.integrator", "ssp-rk2"), text_of("scheme.unknowns", "F")},
           {text_of("time.integrator", "leapfrog"), text_of("scheme.limiter", "sign-preserving")},
           {text_of("time.integrator", "leapfrog"), "scheme.face_correction=\"1/6\""},
           {text_of("time.integrator", "ssp-rk3"), text_of("scheme.impedance", "exact")}}) {
    auto overrides = setting;
    overrides.push_back(tests::any_step);
    const Scene flat = tests::scene_of("fvm", plane, overrides);
    const Scene solid = tests::scene_of("fvm", layer, overrides);
    tests::make_steps(*flat.solver, 3e-3, 60);
    tests::make_steps(*solid.solver, 3e-3, 60);
    const auto p = flat.solver->snapshot(), s = solid.solver->snapshot();
    ASSERT_GT(s.u.size(), p.u.size());
    EXPECT_LE(relative_gap(p.u, s.u), 1e-10) << setting.back();
    EXPECT_LE(relative_gap(p.v, s.v), 1e-10) << setting.back();
    EXPECT_LE(relative_gap(p.F, s.F), 1e-10) << setting.back();
    EXPECT_LE(relative_gap(p.H, s.H), 1e-10) << setting.back();
    EXPECT_LE(relative_gap(p.P, s.P), 1e-10) << setting.back();
    EXPECT_LE(relative_gap(p.A[0], s.A[0]), 1e-10) << setting.back();
    EXPECT_LE(relative_gap(p.S[0], s.S[0]), 1e-10) << setting.back();
    const auto e_p = flat.solver->balance(), e_s = solid.solver->balance();
    EXPECT_NEAR(e_p.strain, e_s.strain / 0.5, 1e-10 * e_p.strain) << "per metre of thickness";
    EXPECT_NEAR(e_p.kinetic, e_s.kinetic / 0.5, 1e-10 * e_p.kinetic);
  }
}

// v, u, F, then H (with H_33) and J where they are unknowns, A and S (with S_33) of each branch.
TEST(PlaneStrain, StoresWhatAPlaneNeeds) {
  struct Expectation {
    const char* unknowns;
    int in_plane, in_space;
  };
  for (const auto& [unknowns, in_plane, in_space] :
       {Expectation{"F", 2 + 2 + 4 + 3 + 4, 3 + 3 + 9 + 6 + 6},
        Expectation{"FJ", 2 + 2 + 4 + 1 + 3 + 4, 3 + 3 + 9 + 1 + 6 + 6},
        Expectation{"FHJ", 2 + 2 + 4 + 5 + 1 + 3 + 4, 3 + 3 + 9 + 9 + 1 + 6 + 6}}) {
    harness::RunOptions options;
    options.threads = 1;
    options.quiet = true;
    const auto of = [&](const char* name) {
      return run_case(cases::read_case(harness::find_case(name),
                                       {text_of("scheme.unknowns", unknowns), "time.max_steps=1"}),
                      options)
          .summary.unknowns_per_node;
    };
    EXPECT_EQ(of("shear-wave-plane-ve2"), in_plane) << unknowns;
    EXPECT_EQ(of("shear-wave-ve2"), in_space) << unknowns;
  }
}

}  // namespace
}  // namespace diptych
