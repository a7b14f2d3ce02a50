#pragma once
/// A case that runs in a tenth of a second, for tests that run many.

#include "common/io/run_record.hpp"
#include "tests/command_line/program.hpp"

#include <string>

namespace diptych::tests {

inline std::string small_case(const std::string& title) {
  return "title = \"" + title + "\"\n" + R"(
[parameters]
E = 2e6

[mesh]
element = "quadrilateral"
lower = [0, 0]
upper = [0.1, 0.02]
cells = [10, 2]

[material]
model = "neo-hookean"
density = 1100
youngs_modulus = "E"
poissons_ratio = 0.3

[initial]
velocity = ["10*x", 0]

[[boundary]]
group = "x_min"
type = "fixed"

[time]
end = 5e-4

[output]
frames = 2
)";
}

/// A cube in shear, without times.
inline const std::string cube = R"([mesh]
element = "hexahedron"
lower = [0, 0, 0]
upper = [1, 1, 1]
cells = [4, 4, 4]
[material]
model = "neo-hookean"
density = 1100
youngs_modulus = 17e6
poissons_ratio = 0.3
[initial]
velocity = ["y", "0", "0"]
)";
/// Of the cube: one of every step, one of output times.
inline const std::string probes = R"([[probe]]
name = "speed"
unit = "m/s"
kind = "mean"
quantity = "vx"
every_step = true
[[probe]]
name = "at a corner"
unit = "m"
kind = "point"
at = [1, 1, 1]
quantity = "ux"
)";

/// Writes DIR/NAME/case.toml in the folder of the test.
inline void write_case(const Folder& folder,
                       const std::string& directory,
                       const std::string& name,
                       const std::string& text) {
  std::filesystem::create_directories(folder.path() / directory / name);
  folder.write(directory + "/" + name + "/case.toml", text);
}

/// What a run has left in its folder.
inline io::RunSummary summary_in(const std::filesystem::path& directory) {
  return io::summary_from_json(text_of(directory / "summary.json"), "summary.json");
}

}  // namespace diptych::tests
