/// What carries the pressure of a scene by default: nodes where little presses on it, and where a
/// load is strong or a nearly incompressible body is held on all sides, what bears it.

#include "benchmarks/run/strong_pressure.hpp"

#include "benchmarks/run/case_mesh.hpp"
#include "benchmarks/run/scene.hpp"
#include "common/cases/reader.hpp"
#include "common/run/solver.hpp"
#include "common/scheme/option_menus.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace diptych::harness {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

const std::string pressed = R"([[boundary]]
group = "x_max"
type = "pressure"
value = "0"
)";

/// Shear modulus 1, nu = 0.3.
cases::Case block(const std::vector<std::string>& overrides,
                  const std::string& boundary = pressed) {
  return cases::case_from_text(R"([mesh]
element = "hexahedron"
cells = [4, 4, 4]
[material]
model = "neo-hookean"
density = 1
shear_modulus = 1
lame = 1.5
[time]
end = 1
)" + boundary,
                               "block", overrides);
}

CaseGraph made(const std::string& method, const std::vector<std::string>& overrides) {
  return graph_of(block(overrides), method, 0);
}

std::string because(const std::vector<std::string>& overrides,
                    const std::string& boundary = pressed) {
  const cases::Case setup = block(overrides, boundary);
  return strong_pressure_because(setup, "fvm", mesh_of(setup, 0).mesh);
}

TEST(StrongPressure, IsAFollowerPressureAboveWhatNodesBear) {
  EXPECT_THAT(because({}), IsEmpty());
  EXPECT_THAT(because({"boundary.0.value=1.4"}), IsEmpty());
  EXPECT_THAT(because({"boundary.0.value=3"}), HasSubstr("\"x_max\", which comes to 3 shear"));
  EXPECT_THAT(because({"boundary.0.value=2*y"}), HasSubstr("2 shear moduli"));  // at y = 1
  EXPECT_THAT(because({"boundary.0.value=2*x*(1 - y)"}), HasSubstr("2 shear moduli"));
  EXPECT_THAT(because({"boundary.0.value=2*(1 - x)"}), IsEmpty());  // strong elsewhere
  EXPECT_THAT(because({"boundary.0.value=-3"}), IsEmpty());         // it pulls
  // a pulse of a tenth of the run
  EXPECT_THAT(because({"boundary.0.value=(t > 0.4 && t < 0.5) ? 5 : 0"}), HasSubstr("5 shear"));
  // pulses of a 100th of the run, between two of 65 instants
  EXPECT_THAT(because({"boundary.0.value=(abs(t - 0.5078) < 0.005) ? 5 : 0"}),
              HasSubstr("5 shear"));
  EXPECT_THAT(because({"boundary.0.value=5*max(0, 1 - abs(t - 0.5078)/0.006)"}),
              HasSubstr("5 shear"));
  EXPECT_THAT(because({"boundary.0.value=5*exp(-((t - 0.5078)/0.002)^2)"}), HasSubstr("5 shear"));
  // it has no value from t = 0.5 on: a run that gets there tells
  EXPECT_THAT(because({"boundary.0.value=4*sqrt(0.5 - t)"}), HasSubstr("2.83 shear"));
  EXPECT_THAT(because({"boundary.0.value=3", "scheme.volumes=nodes"}), IsEmpty());
  // the solver tells that there is no such group
  EXPECT_THAT(because({"boundary.0.value=3", "boundary.0.group=x_mx"}), IsEmpty());
}

TEST(StrongPressure, IsLessOnLongCellsOffBoxes) {
  const auto on = [](const char* upper, const char* moved, const char* value) {
    return because({std::string("mesh.upper=") + upper, std::string("mesh.perturbation=") + moved,
                    std::string("boundary.0.value=") + value});
  };
  EXPECT_THAT(on("[1, 1, 2]", "0.2", "0.7"), IsEmpty());
  EXPECT_THAT(on("[1, 1, 2]", "0.2", "0.8"), HasSubstr("0.8 shear moduli"));
  EXPECT_THAT(on("[4, 1, 1]", "0.2", "0.4"), HasSubstr("0.4 shear moduli"));
  EXPECT_THAT(on("[1, 1, 4]", "0", "1.4"), IsEmpty());
  EXPECT_THAT(on("[1, 1, 1]", "0.2", "1.4"), IsEmpty());
}

TEST(StrongPressure, IsADeadTractionThatPressesAsMuch) {
  const std::string text = "[[boundary]]\ngroup = [\"x_max\", \"y_max\"]\ntype = \"traction\"\n";
  EXPECT_THAT(because({}, text + "value = [0, \"-3*t\", 0]"),
              HasSubstr("\"y_max\", which comes to 3"));
  EXPECT_THAT(because({}, text + "value = [0, \"-4*z*(t > 0.5)\", 0]"), HasSubstr("comes to 4"));
  EXPECT_THAT(because({}, text + "value = [0, \"3*t\", \"-3\"]"), IsEmpty()) << "pulls, and shears";
}

TEST(StrongPressure, IsThatOfANearlyIncompressibleBodyHeldOnAllSides) {
  const std::string rollers =
      "[[boundary]]\ngroup = [\"x_min\", \"x_max\", \"y_min\", \"y_max\", \"z_min\"]\n"
      "type = \"symmetry\"\n";
  const std::string piston =
      "[[boundary]]\ngroup = \"z_max\"\ntype = \"velocity\"\nvalue = [0, 0, \"-0.1\"]\n";
  EXPECT_THAT(because({"material.lame=4"}, rollers + piston), HasSubstr("held on all sides"));
  EXPECT_THAT(because({"material.lame=4"}, rollers), IsEmpty()) << "a free side gives way";
  EXPECT_THAT(because({}, rollers + piston), IsEmpty());
}

/// What carries the pressure.
std::string carrier(const std::string& method, const std::vector<std::string>& overrides) {
  return scheme::name_of(run::volumes_of(block(overrides), made(method, overrides).graph));
}

// A ball that its surface squeezed to J = 0.22 at nu = 0.3 (5.5 shear moduli) turned inside out.
TEST(StrongPressure, IsThatOfABodyWhoseSupportsLeaveItLittleRoom) {
  const auto pressed_to = [](const char* J) {
    return because({}, fmt::format(R"([[boundary]]
group = ["x_min", "y_min", "z_min", "y_max", "z_max"]
type = "symmetry"
[[boundary]]
group = "x_max"
type = "velocity"
value = ["({} - 1)*2*t", "0", "0"]
)",
                                   J));
  };
  EXPECT_THAT(pressed_to("0.62"), IsEmpty());
  EXPECT_THAT(pressed_to("0.5"), HasSubstr("leave it 0.5 of its volume"));
  EXPECT_THAT(pressed_to("1.5"), IsEmpty());
  std::string
      sides;  // J = 0.614, of which edges and corners would make less if they moved for each
  for (const char* side : {"x_min", "x_max", "y_min", "y_max", "z_min", "z_max"}) {
    sides += fmt::format(
        "[[boundary]]\ngroup = \"{}\"\ntype = \"velocity\"\n"
        "value = [\"-0.15*x\", \"-0.15*y\", \"-0.15*z\"]\n",
        side);
  }
  EXPECT_THAT(because({}, sides), IsEmpty());
  EXPECT_THAT(because({}, R"([[boundary]]
group = "x_max"
type = "velocity"
value = ["-0.9", "0", "0"]
)"),
              IsEmpty());  // it gives way to the sides
}

// In a mould with an open top a column of 10 shear moduli turned inside out on tetrahedra, moved
// hexahedra and with SPH.
TEST(StrongPressure, IsThatOfTheOwnWeightInAMould) {
  const auto under = [](const char* sides, const char* force,
                        const std::vector<std::string>& overrides = {}) {
    return because(overrides, fmt::format("[[boundary]]\ngroup = [{}]\ntype = \"symmetry\"\n"
                                          "[load]\nbody_force = [{}]\n",
                                          sides, force));
  };
  const char* walls = R"("x_min", "x_max", "y_min", "y_max", "z_min")";
  EXPECT_THAT(under(walls, "0, 0, \"-10*min(1, 2*t)\""), HasSubstr("weight, which comes to 10 "));
  EXPECT_THAT(under(walls, "0, 0, -1.4"), IsEmpty());
  EXPECT_THAT(under(walls, "0, 0, -1.6"), HasSubstr("comes to 1.6 shear moduli"));
  EXPECT_THAT(under(walls, "0, 0, -1.6", {"mesh.upper=[1, 1, 0.9]"}), IsEmpty());
  EXPECT_THAT(under(walls, "0, 0, -0.5", {"mesh.upper=[1, 1, 4]", "mesh.cells=[4, 4, 16]"}),
              HasSubstr("comes to 2 shear"))
      << "as long as the body is";
  EXPECT_THAT(under(walls, R"(0, 0, "-4*z")"), HasSubstr("comes to 2 shear")) << "the mean";
  EXPECT_THAT(under(walls, "\"10*sin(2*pi*x)\", 0, 0"), IsEmpty()) << "no resultant";
  EXPECT_THAT(under(walls, "0, 0, 10"), IsEmpty()) << "it hangs on its floor";
  EXPECT_THAT(under(walls, "10, 0, 0"), IsEmpty()) << "it gives way to the open side";
  EXPECT_THAT(under(R"("x_min", "x_max", "y_min", "z_min")", "0, 0, -10"), IsEmpty());
  EXPECT_THAT(under(R"("z_min")", "0, 0, -10"), IsEmpty()) << "a column that stands free";
  // on a corner, and without any side that is free
  EXPECT_THAT(under(R"("x_min", "y_min", "z_min")", "-1, -1, -1"), HasSubstr("comes to 3 shear"));
  const std::string all = std::string(walls) + R"(, "z_max")";
  EXPECT_THAT(under(all.c_str(), "0, 0, -2.8"), IsEmpty());
  EXPECT_THAT(under(all.c_str(), "0, 0, -3.2"), HasSubstr("comes to 1.6 shear moduli"));
  EXPECT_THAT(under(walls, "0, 0, -10", {"scheme.volumes=nodes"}), IsEmpty());
  EXPECT_THAT(because({}, "[load]\nbody_force = [0, 0, -10]\n"), IsEmpty()) << "it falls";
}

TEST(StrongPressure, MayBeThatOfTheOwnWeightBeforeThereIsAMesh) {
  const auto may = [](const char* sides, const char* force) {
    return may_press_strongly(block({}, fmt::format("[[boundary]]\ngroup = [{}]\n"
                                                    "type = \"symmetry\"\n"
                                                    "[load]\nbody_force = [0, 0, \"{}\"]\n",
                                                    sides, force)));
  };
  const char* walls = R"("x_min", "x_max", "y_min", "y_max", "z_min")";
  EXPECT_TRUE(may(walls, "-10*t"));
  EXPECT_FALSE(may(walls, "-0.01*t"));
  EXPECT_FALSE(may(R"("x_min", "z_min")", "-10*t"));
}

TEST(StrongPressure, IsLeftToNodesWhereNothingPresses) {
  const std::string press = "boundary.0.value=3", rubber = "material.lame=4",
                    moved = "mesh.perturbation=0.2";
  const std::string quads = "mesh.element=quadrilateral", square = "mesh.cells=[6, 6]";
  for (const char* method : {"sph", "fvm"}) {
    SCOPED_TRACE(method);
    EXPECT_EQ(carrier(method, {}), "nodes");
    EXPECT_EQ(carrier(method, {moved}), "nodes");
    EXPECT_THAT(made(method, {moved}).operators, StartsWith("sbp"));
    EXPECT_EQ(carrier(method, {moved, press}), "cells");
    EXPECT_THAT(made(method, {moved, press}).operators, HasSubstr("3 shear moduli"));
    EXPECT_EQ(carrier(method, {quads, square}), "nodes");
    EXPECT_EQ(carrier(method, {quads, square, moved, press}), "cells");
    EXPECT_EQ(carrier(method, {"mesh.element=triangle", square, "scheme.face_correction=1/8"}),
              "nodes");
  }
  // rubber that nothing presses sums by parts, off boxes with nodes, and where nothing but F
  // resists shear: lines come apart in tension
  EXPECT_EQ(carrier("sph", {rubber}), "nodes");
  const std::string areas = "material.model=mooney-rivlin";
  EXPECT_EQ(carrier("sph", {rubber, areas, "material.zeta_ratio=0.25"}), "lines");
  EXPECT_EQ(carrier("sph", {rubber, areas, "material.zeta_ratio=0.2"}), "nodes");
  EXPECT_THAT(made("sph", {rubber, "boundary.0.value=0.2*t"}).notices,
              Contains(HasSubstr("nodes carry the bulk")));
  for (const char* method : {"sph", "fvm"}) {
    EXPECT_EQ(carrier(method, {rubber, moved}), "nodes");
    EXPECT_THAT(made(method, {rubber, moved}).operators, StartsWith("sbp"));
    EXPECT_THAT(made(method, {rubber, moved, "boundary.0.value=0.2*t"}).notices,
                Contains(HasSubstr("nodes carry the bulk")));
    EXPECT_THAT(made(method, {rubber, moved, "initial.velocity=[\"x\", 0, 0]"}).notices,
                Contains(HasSubstr("nodes carry the bulk")));
    EXPECT_THAT(
        made(method, {rubber, moved, "boundary.0.value=0.05", "initial.velocity=[\"0.1*x\", 0, 0]"})
            .notices,
        IsEmpty())
        << "nothing presses";
  }
  EXPECT_EQ(carrier("sph", {press}), "lines");
  EXPECT_THAT(made("sph", {press}).operators, StartsWith("sbp"));
  EXPECT_EQ(carrier("fvm", {press}), "nodes") << "whose derivatives commute";
  EXPECT_THAT(made("fvm", {press}).operators, StartsWith("sbp"));
}

TEST(StrongPressure, IsToldOfWhereTheOperatorsAskedForLeaveItToNodes) {
  const std::vector<std::string> asked{"boundary.0.value=3", "mesh.perturbation=0.2",
                                       "sph.gradient=sbp", "fvm.stencil=sbp"};
  for (const char* method : {"sph", "fvm"}) {
    EXPECT_EQ(carrier(method, asked), "nodes");
    EXPECT_THAT(made(method, asked).notices, Contains(HasSubstr("nodes carry the bulk pressure")));
  }
}

// Where little presses, too, but for edges of hexahedra: they err less off boxes, unless cells are
// long, and bear the pressure of rubber.
TEST(StrongPressure, IsThatOfCellsWhereOperatorsAreOfSecondOrderOffBoxes) {
  const std::string rubber = "material.lame=4", moved = "mesh.perturbation=0.2";
  const std::string flat = "mesh.upper=[4, 4, 1]", corrected = "scheme.face_correction=0.125";
  for (const auto& [method, asked] :
       {std::pair{"sph", "sph.gradient=corrected"}, std::pair{"fvm", "fvm.stencil=edge"}}) {
    EXPECT_EQ(carrier(method, {asked}), "nodes");
    const std::string tetrahedra = "mesh.element=tetrahedron";
    EXPECT_EQ(carrier(method, {tetrahedra, asked}), "cells");
    EXPECT_EQ(carrier(method, {tetrahedra, asked, corrected}), "nodes");
    EXPECT_EQ(carrier(method, {tetrahedra, asked, flat}), "nodes");
    EXPECT_EQ(carrier(method, {moved, asked, rubber}), "cells");
    EXPECT_EQ(carrier(method, {moved, asked, flat, rubber}), "cells");
  }
  EXPECT_EQ(carrier("sph", {moved, "sph.gradient=corrected"}), "cells");
  EXPECT_EQ(carrier("fvm", {moved, "fvm.stencil=edge"}), "nodes");
  EXPECT_EQ(carrier("fvm", {moved, "fvm.stencil=integral"}), "cells");
}

}  // namespace
}  // namespace diptych::harness
