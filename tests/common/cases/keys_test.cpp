#include "common/cases/keys.hpp"

#include "common/base/error.hpp"
#include "common/cases/reader.hpp"

#include <gmock/gmock.h>

namespace diptych::cases {
namespace {

using testing::HasSubstr;

// Defaults stand in the structs alone: the table prints them, and a file without a key keeps them.
TEST(CaseKeys, HaveTheDefaultsOfTheStructs) {
  const Case made;
  EXPECT_EQ(find_key("material.model")->standard, "\"" + made.material.model + "\"");
  EXPECT_EQ(find_key("mesh.upper")->standard, "[1, 1, 1]");
  EXPECT_EQ(find_key("sph.kappa")->standard, "1.2");
  EXPECT_EQ(find_key("initial.internal")->standard, "\"virgin\"");
  EXPECT_EQ(find_key("time.end")->standard, "");
  const Case read = case_from_text(
      "[mesh]\ncells = [4, 4, 4]\n[material]\nmodel = 'neo-hookean'\ndensity = 1\n"
      "shear_modulus = 1\nlame = 1\n[time]\nend = 1\n",
      "case.toml");
  EXPECT_EQ(read.mesh.generator, made.mesh.generator);
  EXPECT_EQ(read.mesh.element, made.mesh.element);
  EXPECT_EQ(read.mesh.lower, made.mesh.lower);
  EXPECT_EQ(read.mesh.upper, made.mesh.upper);
  EXPECT_EQ(read.mesh.cells, made.mesh.cells);
  EXPECT_EQ(read.mesh.perturbation, made.mesh.perturbation);
  EXPECT_EQ(read.mesh.seed, made.mesh.seed);
  EXPECT_EQ(read.initial.relaxed, made.initial.relaxed);
  EXPECT_EQ(read.time.integrator, made.time.integrator);
  EXPECT_EQ(read.time.cfl, made.time.cfl);
  EXPECT_EQ(read.time.speeds, made.time.speeds);
  EXPECT_EQ(read.time.max_steps, made.time.max_steps);
  EXPECT_EQ(read.time.max_retries, made.time.max_retries);
  EXPECT_EQ(read.output.frames, made.output.frames);
  EXPECT_EQ(read.output.fields, made.output.fields);
  EXPECT_EQ(read.scheme.unknowns, made.scheme.unknowns);
  EXPECT_EQ(read.scheme.reconstruction, made.scheme.reconstruction);
  EXPECT_EQ(read.scheme.limiter, made.scheme.limiter);
  EXPECT_EQ(read.scheme.impedance, made.scheme.impedance);
  EXPECT_EQ(read.scheme.dissipation, made.scheme.dissipation);
  EXPECT_EQ(read.scheme.face_correction, made.scheme.face_correction);
  EXPECT_EQ(read.scheme.precision, made.scheme.precision);
  EXPECT_EQ(read.scheme.angular_momentum_projection, made.scheme.angular_momentum_projection);
  EXPECT_EQ(read.sph.kernel, made.sph.kernel);
  EXPECT_EQ(read.sph.kappa, made.sph.kappa);
  EXPECT_EQ(read.sph.closure, made.sph.closure);
  EXPECT_EQ(read.fvm.stencil, made.fvm.stencil);
  EXPECT_EQ(read.fvm.order, made.fvm.order);
  EXPECT_EQ(read.guards.energy_residual, made.guards.energy_residual);
  EXPECT_EQ(read.guards.involution, made.guards.involution);
  EXPECT_EQ(read.guards.angular_drift, made.guards.angular_drift);
  EXPECT_EQ(read.guards.volumes_apart, made.guards.volumes_apart);
  EXPECT_EQ(read.guards.least_step, made.guards.least_step);
  EXPECT_EQ(read.guards.inverted_cells, made.guards.inverted_cells);
}

TEST(CaseKeys, TakeTheMenusOfRoomsAboveFromOutside) {
  const Menus menus{{"sph.kernel", {"cubic-spline", "wendland-c2"}}};
  const std::string text =
      "[mesh]\ncells = [4, 4, 4]\n[material]\nmodel = 'neo-hookean'\ndensity = 1\n"
      "shear_modulus = 1\nlame = 1\n[time]\nend = 1\n[sph]\nkernel = 'wendland-c3'\n";
  EXPECT_EQ(case_from_text(text, "case.toml").sph.kernel,
            "wendland-c3");  // who takes it refuses it
  try {
    case_from_text(text, "case.toml", {}, menus);
    FAIL() << "accepted";
  } catch (const base::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("case.toml:11:10: sph.kernel = 'wendland-c3' is not on its "
                                        "menu; did you mean 'wendland-c2'?"));
  }
  EXPECT_THAT(explain("sph.kernel", menus), HasSubstr("one of: cubic-spline, wendland-c2"));
}

TEST(Explain, TellsTypeUnitRangeDefaultAndExample) {
  const std::string text = explain("material.poissons_ratio");
  EXPECT_THAT(text, HasSubstr("in (-1, 0.5)"));
  EXPECT_THAT(text, HasSubstr("example: poissons_ratio = 0.3"));
  EXPECT_THAT(explain("scheme.limiter"),
              HasSubstr("one of: none, barth-jespersen, venkatakrishnan"));
  EXPECT_THAT(explain("time.end"), HasSubstr("number, s, > 0, required"));
  EXPECT_THAT(explain("output.frames"), HasSubstr("default 10"));
}

TEST(Explain, TakesPathsWithNamesAndIndicesAndSections) {
  EXPECT_THAT(explain("material.branch.0.tau_C"), HasSubstr("Relaxation time"));
  EXPECT_THAT(explain("parameters.E"), HasSubstr("by its name"));
  EXPECT_THAT(explain("functions.q.rate"), HasSubstr("1/s"));
  EXPECT_THAT(explain("mesh"), HasSubstr("cells: list of integers"));
  EXPECT_THAT(explain("boundary"), HasSubstr("[[boundary]]"));
}

TEST(Explain, SuggestsTheNearestKey) {
  const auto refusal = [](const std::string& path) -> std::string {
    try {
      return explain(path);
    } catch (const base::InputError& error) {
      return error.what();
    }
  };
  EXPECT_THAT(refusal("mesh.cels"), HasSubstr("did you mean 'mesh.cells'?"));
  EXPECT_THAT(refusal("mesh.density"), HasSubstr("did you mean 'material.density'?"));
  EXPECT_THAT(refusal("cfl"), HasSubstr("did you mean 'time.cfl'?"));
  EXPECT_THAT(refusal("meshes"), HasSubstr("did you mean 'mesh'?"));
}

TEST(ReferencePage, NamesEveryKeyAndMenuEntry) {
  const std::string page = reference_page();
  for (const Section& section : sections()) {
    const std::string path = section.path == "functions.*" ? "functions.NAME" : section.path;
    EXPECT_THAT(page, HasSubstr(path));
  }
  for (const Key& key : keys()) {
    if (key.path == "parameters.*") continue;
    const std::string last(key.path.substr(key.path.rfind('.') + 1));
    EXPECT_THAT(page, HasSubstr("| `" + last + "` |"));
    for (const auto& name : key.menu)
      EXPECT_THAT(page, HasSubstr(std::string(name)));
  }
}

}  // namespace
}  // namespace diptych::cases
