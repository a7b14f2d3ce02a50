#pragma once
/// A case that runs in a tenth of a second, for tests that run many.

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

/// Writes DIR/NAME/case.toml in the folder of the test.
inline void write_case(const Folder& folder,
                       const std::string& directory,
                       const std::string& name,
                       const std::string& text) {
  std::filesystem::create_directories(folder.path() / directory / name);
  folder.write(directory + "/" + name + "/case.toml", text);
}

}  // namespace diptych::tests
