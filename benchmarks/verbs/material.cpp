/// diptych material: strain paths on the material of a case alone.

#include "benchmarks/material/material_report.hpp"
#include "benchmarks/verbs/case_arguments.hpp"
#include "benchmarks/verbs/table.hpp"
#include "common/base/error.hpp"
#include "common/base/registry.hpp"

#include <cmath>
#include <fmt/format.h>
#include <memory>

namespace diptych::verbs {

namespace {

struct MaterialArguments : CaseArguments {
  std::string path = "shear-oscillation", update = "gauss";
  harness::MaterialPath material;
};

int strain_material(const MaterialArguments& arguments) {
  const cases::Case setup = arguments.read();
  harness::MaterialPath path = arguments.material;
  harness::read_path_name(arguments.path, path);
  path.update = base::Registry<harness::Update>("--update")
                    .add("linear", harness::Update::linear)
                    .add("gauss", harness::Update::gauss)
                    .at(arguments.update);
  const auto material = run::make_material_point(setup.material);
  const auto points = harness::follow(material, path);
  for (const harness::PathPoint& point : points) {
    if (std::isfinite(point.energy) && point.P.allFinite()) continue;
    throw base::InputError(fmt::format(
        "at {:.6g} s of the path the energy or the stress is no finite number; take a smaller "
        "--amplitude, --rate or --end",
        point.time));
  }
  print(
      harness::path_table(setup, path, points, harness::scan_hyperbolicity(material, points, 200)));
  const std::string folder = arguments.output_folder(setup);
  const std::string name = "material-" + arguments.path;
  write_output(folder, name + ".csv", harness::path_csv(points));
  write_output(folder, name + ".svg", harness::path_svg(setup, path, points));
  constexpr double most = 1e-2;
  if (const double residual = harness::energy_residual(points); residual > most) {
    throw base::BoundError(
        fmt::format("work, stored and dissipated energy of the path are out of balance "
                    "by {:.2g} of the largest, bound {:g}: a branch may relax within a "
                    "step, take more --steps; where that changes little, the stress of "
                    "the material is no derivative of its energy",
                    residual, most));
  }
  return 0;
}

}  // namespace

Action declare_material(CommandLine& line) {
  const auto arguments = std::make_shared<MaterialArguments>();
  harness::MaterialPath& path = arguments->material;
  arguments->declare_case(line);
  line.option("--path", arguments->path,
              "{shear, confined, uniaxial, creep}-{step, ramp, oscillation}: F12, F11, F11 with "
              "free sides, or P11 with free sides");
  line.option("--amplitude", path.amplitude, "strain, or Pa for creep, of step or oscillation");
  line.option("--rate", path.rate, "of a ramp, per second");
  line.option("--frequency", path.angular_frequency, "of an oscillation, rad/s");
  line.required("--end", path.end, "final time, s");
  line.option("--steps", path.n_steps, "number of steps (default 1000)");
  line.option("--update", arguments->update, "of the branches: gauss (default) or linear");
  line.repeated("--set", arguments->overrides, "key=value, overrides the case file; repeatable");
  line.option("--out", arguments->directory, "output folder (default results/CASE)");
  return [arguments] { return strain_material(*arguments); };
}

}  // namespace diptych::verbs
