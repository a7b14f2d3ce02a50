#include "common/cases/reader.hpp"

#include "common/base/error.hpp"
#include "common/cases/keys.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>

namespace diptych::cases {
namespace {

using testing::HasSubstr;

const std::string small_case = R"([mesh]
cells = [2, 2, 2]
[material]
model = "neo-hookean"
density = 1100
youngs_modulus = 17e6
poissons_ratio = 0.3
[time]
end = 1.0
)";

Case read(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return case_from_text(text, "cube/case.toml", overrides);
}

std::string refusal(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    read(text, overrides);
  } catch (const base::InputError& error) {
    return error.what();
  }
  return "accepted";
}

const std::string swinging_cube = R"toml(title = "swinging cube"
[parameters]
E = 17e6
nu = 0.3
rho = 1100
M = "E*(1 - nu)/((1 + nu)*(1 - 2*nu))"
omega = "sqrt(3*pi^2/4*M/rho)"
[functions.q]
type = "zener_mode"
wave_number_squared = "3*pi^2/4"
density = "rho"
modulus = "M"
amplitude = 5e-4
[mesh]
element = "tetrahedron"
cells = [4, 4, "2*4"]
upper = [1, 1.0, "1 + 1"]
perturbation = 0.2
[material]
density = "rho"
youngs_modulus = "E"
poissons_ratio = "nu"
zeta_ratio = 0.5
[[material.branch]]
beta_C = 0.5
tau_C = 2e-3
beta_G = 0.25
tau_G = "1/1000"
[[material.branch]]
beta_C = 1
tau_C = 1
[initial]
displacement = ["q*sin(pi*x/2)", 0, 0]
internal = "relaxed"
[[boundary]]
group = ["x_min", "y_min"]
type = "symmetry"
[[boundary]]
group = "x_max"
type = "pressure"
value = "1e3*t"
[load]
body_force = [0, 0, "-9.81*rho"]
[time]
end = "1.25*2*pi/omega"
integrator = "ssp-rk3"
[exact]
velocity = ["q_dot*sin(pi*x/2)", 0, 0]
deformation_gradient = [[1, 0, 0], [0, 1, 0], ["x", 0, 1]]
)toml";

TEST(CaseReader, ReadsASwingingCube) {
  const Case c = read(swinging_cube);
  EXPECT_EQ(c.name, "cube");
  EXPECT_EQ(c.title, "swinging cube");
  EXPECT_EQ(c.mesh.element, "tetrahedron");
  EXPECT_EQ(c.mesh.cells, (std::array<int, 3>{4, 4, 8}));
  EXPECT_EQ(c.mesh.upper, Vec3(1, 1, 2));
  const double omega = 392.424371;  // nine digits
  EXPECT_NEAR(c.time.end, 1.25 * 2 * std::acos(-1.0) / omega, 1e-10);
  EXPECT_NEAR(c.material.lame, 9.807692307e6, 1);
  EXPECT_NEAR(c.material.shear_modulus, 6.538461538e6, 1);
  ASSERT_EQ(c.material.branches.size(), 2u);
  EXPECT_EQ(c.material.branches[0].tau_G, 1e-3);
  EXPECT_EQ(c.material.branches[1].beta_G, 0);
  EXPECT_TRUE(c.initial.relaxed);
  EXPECT_NEAR(c.initial.displacement(Vec3::Ones(), 0)[0], 5e-4, 1e-18);
  ASSERT_EQ(c.boundaries.size(), 2u);
  EXPECT_EQ(c.boundaries[0].groups, (std::vector<std::string>{"x_min", "y_min"}));
  EXPECT_EQ(c.boundaries[1].pressure(Vec3::Zero(), 2), 2000);
  EXPECT_EQ(c.boundaries[1].where.line, 38);
  EXPECT_NEAR(c.body_force(Vec3::Zero(), 0)[2], -10791, 1e-9);
  const double quarter = std::acos(-1.0) / 2 / omega;
  EXPECT_NEAR(c.exact.velocity->operator()(Vec3::Ones(), quarter)[0], -5e-4 * omega, 1e-9);
  EXPECT_EQ((*c.exact.deformation_gradient)(Vec3(3, 0, 0), 0)(2, 0), 3);
  EXPECT_FALSE(c.exact.stress);
}

TEST(CaseReader, EmbedsThePlane) {
  const Case c = read(R"([mesh]
element = "triangle"
cells = [3, 5]
upper = [2, 3]
[material]
model = "neo-hookean-isochoric"
density = 1
shear_modulus = 3
bulk_modulus = 1
[initial]
velocity = ["x", "y"]
deformation_gradient = [[2, 0], ["x", 1]]
[time]
end = 1
[exact]
stress = [[0, 0, 0], [0, 0, 0], [0, 0, "x"]]
)");
  EXPECT_EQ(dimension_of(c.mesh), 2);
  EXPECT_EQ(c.mesh.cells, (std::array<int, 3>{3, 5, 1}));
  EXPECT_EQ(c.mesh.upper, Vec3(2, 3, 0));
  EXPECT_EQ(c.initial.velocity(Vec3(4, 5, 0), 0), Vec3(4, 5, 0));
  const Mat3 F = (*c.initial.deformation_gradient)(Vec3(7, 0, 0), 0);
  EXPECT_EQ(F, (Mat3() << 2, 0, 0, 7, 1, 0, 0, 0, 1).finished());
  EXPECT_EQ((*c.exact.stress)(Vec3(7, 0, 0), 0)(2, 2), 7);
  EXPECT_NEAR(c.material.lame, -1, 1e-15);  // isochoric: only the bulk modulus must be positive
}

TEST(CaseReader, AllPairsOfConstantsAgree) {
  const std::string head =
      "[mesh]\ncells = [1, 1, 1]\n[time]\nend = 1\n[material]\ndensity = 1\n"
      "zeta_ratio = 0.2\n";
  const Case a = read(head + "youngs_modulus = 2.6\npoissons_ratio = 0.3\n");
  const Case b = read(head + "shear_modulus = 1\nlame = 1.5\n");
  const Case c = read(head + "shear_modulus = 1\nbulk_modulus = '1.5 + 2/3'\n");
  for (const Case* other : {&b, &c}) {
    EXPECT_NEAR(other->material.lame, a.material.lame, 1e-14);
    EXPECT_NEAR(other->material.shear_modulus, a.material.shear_modulus, 1e-14);
  }
}

TEST(CaseReader, OverridesReachEveryKindOfKey) {
  const std::string text = "[parameters]\nrate = 2\nend = '3*rate'\n" + small_case +
                           "[[material.branch]]\nbeta_C = 1\ntau_C = 1\n[[material.branch]]\n"
                           "beta_C = 1\ntau_C = 2\n";
  const Case c = read(
      text, {"time.end=end", "parameters.rate=5", "material.branch.1.tau_C=1e-3",
             "mesh.element=tetrahedron", "mesh.cells = [3, 4, 5]", "scheme.limiter=sign-preserving",
             "mesh.lower=[-1, '-rate', 0]", "output.fields=false", "title=a title"});
  EXPECT_EQ(c.time.end, 15);
  EXPECT_EQ(c.material.branches[0].tau_C, 1);
  EXPECT_EQ(c.material.branches[1].tau_C, 1e-3);
  EXPECT_EQ(c.mesh.element, "tetrahedron");
  EXPECT_EQ(c.mesh.cells, (std::array<int, 3>{3, 4, 5}));
  EXPECT_EQ(c.mesh.lower, Vec3(-1, -5, 0));
  EXPECT_EQ(c.scheme.limiter, "sign-preserving");
  EXPECT_FALSE(c.output.fields);
  EXPECT_EQ(c.title, "a title");
  EXPECT_EQ(read(text, {"mesh.cells.2=7"}).mesh.cells, (std::array<int, 3>{2, 2, 7}));
}

TEST(CaseReader, RefusesWrongOverrides) {
  const auto refused = [](const std::string& assignment) {
    return refusal("[parameters]\nrate = 2\n" + small_case, {assignment});
  };
  EXPECT_THAT(refused("mesh.cels=3"), HasSubstr("--set mesh.cels=3: unknown key 'mesh.cels'; did "
                                                "you mean 'mesh.cells'?"));
  EXPECT_THAT(refused("time.end=-1"), HasSubstr("--set time.end=-1: time.end = -1 s is not adm"));
  EXPECT_THAT(refused("time.end=2*rat"), HasSubstr("did you mean 'rate'?"));
  EXPECT_THAT(refused("time.end=nan"), HasSubstr("not a finite number"));
  EXPECT_THAT(refused("time.end=1e400"), HasSubstr("--set time.end=1e400: "));
  EXPECT_THAT(refused("time.end"), HasSubstr("write --set key=value"));
  EXPECT_THAT(refused("time.end="), HasSubstr("empty"));
  EXPECT_THAT(refused("parameters.rato=1"), HasSubstr("did you mean 'rate'?"));
  EXPECT_THAT(refused("material.branch.0.tau_C=1"), HasSubstr("--set material.branch.0"));
  EXPECT_THAT(refused("mesh.cells.3=1"), HasSubstr("it has 3, counted from 0"));
  EXPECT_THAT(refused("mesh=3"), HasSubstr("'mesh' is a section"));
  EXPECT_THAT(refused("time.end=1\n[sph]"), HasSubstr("control characters"));
  EXPECT_THAT(refusal(small_case, {"time.end=1", "time.end=2"}), HasSubstr("set twice"));
  for (const auto& order : {std::vector<std::string>{"mesh.cells=[4,4,4]", "mesh.cells.0=8"},
                            {"mesh.cells.0=8", "mesh.cells=[4,4,4]"}}) {
    EXPECT_THAT(refusal(small_case, order),
                HasSubstr("'mesh.cells.0' is a part of 'mesh.cells', which is set too"));
  }
}

TEST(CaseReader, FindsMeshFilesBesideTheCase) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(testing::TempDir()) / "diptych_case_reader";
  fs::create_directories(folder);
  std::ofstream(folder / "bar.geo") << "// nothing\n";
  std::string text = small_case;
  text.replace(0, text.find("[material]"),
               "[mesh]\nelement = 'tetrahedron'\nfile = './bar.geo'\nsize = 0.1\n");
  std::ofstream(folder / "case.toml") << text;
  const Case c = read_case(folder.string());
  EXPECT_EQ(c.mesh.file, (folder / "bar.geo").string());
  EXPECT_EQ(c.mesh.size, 0.1);
  EXPECT_EQ(c.mesh.generator, "");
  EXPECT_EQ(c.name, "diptych_case_reader");
  EXPECT_EQ(c.text, text);
  EXPECT_THROW(read_case((folder / "none.toml").string()), base::InputError);
  EXPECT_THROW(read_case((folder / "case.toml").string(), {"mesh.file=foo.geo"}), base::InputError);
  std::ofstream(folder / "empty.toml") << "";
  EXPECT_THROW(read_case((folder / "empty.toml").string()), base::InputError);
  fs::remove_all(folder);
}

TEST(CaseReader, AcceptsByteOrderMarkAndCarriageReturns) {
  std::string text = "\xEF\xBB\xBF";
  for (const char c : small_case)
    text += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_EQ(read(text).time.end, 1);
}

TEST(CaseReader, AcceptsEveryExampleOfAKeyWithOneValue) {
  for (const Key& key : keys()) {
    const std::string path(key.path);
    const bool is_plain = path.find('*') == std::string::npos && path.rfind("boundary", 0) != 0 &&
                          path.rfind("material", 0) != 0 && path.rfind("mesh.", 0) != 0 &&
                          path.rfind("probe.", 0) != 0 && path.rfind("reference.", 0) != 0 &&
                          path.rfind("expect.", 0) != 0 &&  // of other keys
                          path.rfind("apart.", 0) != 0 && path.rfind("variant.", 0) != 0 &&
                          path.rfind("record.", 0) != 0;  // is not set on the command line
    if (!is_plain) continue;
    const std::string head =
        "[parameters]\nomega = 2\nrho = 1\nmu = 3\nq = 1\nq_dot = 1\n" + small_case;
    std::vector<std::string> overrides{path + "=" + std::string(key.example)};
    EXPECT_NO_THROW(read(head, overrides)) << path;
  }
}

TEST(CaseReader, TakesAnOrderOfFiniteVolumesOnlyWhereItCounts) {
  EXPECT_EQ(read(small_case, {"fvm.stencil=sbp"}).fvm.order, 4);
  EXPECT_EQ(read(small_case, {"fvm.stencil=sbp", "fvm.order=6"}).fvm.order, 6);
  EXPECT_EQ(read(small_case, {"fvm.order=6"}).fvm.order, 6) << "with auto";
  EXPECT_THAT(refusal(small_case, {"fvm.stencil=edge", "fvm.order=4"}),
              HasSubstr("has no effect on stencil = \"edge\""));
  EXPECT_THAT(refusal(small_case, {"fvm.stencil=sbp", "fvm.order=5"}), HasSubstr("use 2, 4 or 6"));
  EXPECT_THAT(refusal(small_case, {"fvm.stencil=sbp", "fvm.order=8"}), HasSubstr("fvm.order"));
}

TEST(CaseReader, RefusesOptionsOfTheSchemeThatDoNotGoTogether) {
  EXPECT_THAT(refusal(small_case, {"scheme.reconstruction=none", "scheme.limiter=barth-jespersen"}),
              HasSubstr("has no effect with reconstruction"));
  EXPECT_EQ(refusal(small_case, {"scheme.reconstruction=none", "scheme.limiter=none"}), "accepted");
  for (const char* other : {"scheme.impedance=exact", "scheme.limiter=barth-jespersen"})
    EXPECT_THAT(refusal(small_case, {"scheme.reconstruction=objective", other}),
                HasSubstr("reconstruction = \"linear\""));
  EXPECT_EQ(
      refusal(small_case, {"scheme.reconstruction=objective", "scheme.limiter=sign-preserving"}),
      "accepted");
  for (const char* other : {"scheme.limiter=sign-preserving", "scheme.face_correction=1/6"})
    EXPECT_THAT(refusal(small_case, {"scheme.reconstruction=symmetric", other}),
                HasSubstr("reconstruction = \"linear\""));
  EXPECT_EQ(refusal(small_case, {"scheme.reconstruction=symmetric", "scheme.impedance=exact"}),
            "accepted");
  EXPECT_THAT(refusal(small_case, {"sph.gradient=sbp", "sph.closure=false"}),
              HasSubstr("which closes"));
  EXPECT_EQ(refusal(small_case, {"sph.closure=false"}), "accepted");
}

TEST(CaseReader, AsksForCausesOfQuantitiesThatBothMethodsHave) {
  const auto apart = [](const std::string& quantity) {
    return "\n[[probe]]\nname = \"tip\"\nunit = \"m\"\nat = [0, 0, 0]\nquantity = \"ux\"\n"
           "[[apart]]\nquantity = \"" +
           quantity + "\"\nbecause = \"measured\"\n";
  };
  const Case setup = read(small_case + apart("tip"));
  ASSERT_EQ(setup.apart.size(), 1U);
  EXPECT_EQ(setup.apart[0].because, "measured");
  EXPECT_THAT(refusal(small_case + apart("kinetic enrgy")),
              HasSubstr("did you mean 'kinetic energy'?"));
  EXPECT_THAT(refusal(small_case + "\n[[apart]]\nquantity = \"min jacobian\"\n"),
              HasSubstr("because"));
  const std::string other = "[[apart]]\nquantity = \"tip\"\nbecause = \"another\"\n";
  EXPECT_THAT(refusal(small_case + apart("tip") + other), HasSubstr("has an [[apart]] already"));
}

TEST(CaseReader, RefusesWhatIsSaidTwiceOfAGroupOrAProbe) {
  const auto boundary = [](const std::string& type, const std::string& value) {
    return "\n[[boundary]]\ngroup = \"z_min\"\ntype = \"" + type + "\"\n" + value;
  };
  const std::string traction = boundary("traction", "value = [0, 0, 1]\n");
  const std::string pressure = boundary("pressure", "value = 1\n");
  EXPECT_THAT(refusal(small_case + traction + traction), HasSubstr("already of type traction"));
  EXPECT_THAT(refusal(small_case + boundary("fixed", "") + boundary("symmetry", "")),
              HasSubstr("already of type fixed"));
  EXPECT_EQ(refusal(small_case + traction + pressure), "accepted");
  EXPECT_EQ(refusal(small_case + traction + boundary("symmetry", "")), "accepted");
  EXPECT_THAT(refusal(small_case + boundary("traction", "value = \"manufactured\"\n")),
              HasSubstr("needs a motion"));
  const std::string probe =
      "\n[[probe]]\nname = \"tip\"\nunit = \"m\"\nat = [0, 0, 0]\nquantity = \"ux\"\n";
  EXPECT_THAT(refusal(small_case + probe + probe), HasSubstr("already called 'tip'"));
}

TEST(CaseHash, IsStableAndSeesTextAndOverrides) {
  EXPECT_EQ(case_hash("", {}), "af63bd4c8601b7df");  // FNV-1a of one zero byte
  EXPECT_EQ(case_hash(small_case, {"a=1", "b=2"}), case_hash(small_case, {"b=2", "a=1"}));
  EXPECT_NE(case_hash(small_case, {"a=1"}), case_hash(small_case, {"a=2"}));
  EXPECT_NE(case_hash(small_case, {}), case_hash(small_case + " ", {}));
  EXPECT_NE(case_hash("a", {"b"}), case_hash("ab", {}));
  EXPECT_EQ(read(small_case).hash, case_hash(small_case, {}));
}

}  // namespace
}  // namespace diptych::cases
