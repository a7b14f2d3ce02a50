#pragma once
/// What tests of ranks share: cases, how ranks are started, what of a run may not differ.

#include "tests/command_line/program.hpp"

#include <filesystem>
#include <ostream>
#include <regex>
#include <string>

namespace diptych::tests {

inline const std::string mpirun =
    "export OMP_WAIT_POLICY=passive; mpirun --oversubscribe --allow-run-as-root --bind-to none ";

/// A case with what tests change by --set; 1331 nodes, six chunks of them.
inline const std::string cube = R"toml(title = "Cube among ranks"
[mesh]
element = "hexahedron"
lower = [0, 0, 0]
upper = [1, 1, 1]
cells = [10, 10, 10]
[material]
model = "mooney-rivlin"
density = 1100
youngs_modulus = 17e6
poissons_ratio = 0.3
zeta_ratio = 0.5
[initial]
velocity = ["20*y*z", "-30*x", "10*sin(3*x)"]
[time]
end = 5e-3
max_steps = 12
[output]
frames = 40
fields = false
)toml";
inline const std::string held = R"toml([[boundary]]
group = "x_min"
type = "fixed"
[[boundary]]
group = "x_max"
type = "traction"
value = ["1e5*sin(500*t)", 0, "2e5*y"]
)toml";
inline const std::string branches = R"toml([[material.branch]]
beta_C = 0.5
tau_C = 1e-3
beta_G = 0.5
tau_G = 2e-3
)toml";
struct Scene {
  const char* name;
  std::string text;
  std::string options;  ///< of the command line
};
inline std::ostream& operator<<(std::ostream& to, const Scene& scene) {
  return to << scene.name;
}

/// What may differ: times of the clock, and how it was run.
inline std::string hash_in(const std::filesystem::path& run) {
  const std::string text = text_of(run / "summary.json");
  std::smatch found;
  return std::regex_search(text, found, std::regex(R"re("state_hash": "(\w+)")re")) ? found[1].str()
                                                                                    : "none";
}

/// Errors against the exact solution and the cells, as summary.json has them.
inline std::string errors_in(const std::filesystem::path& run) {
  const std::string text = text_of(run / "summary.json");
  const auto section = [&](const std::string& name) {
    const size_t begin = text.find("\"" + name + "\": {"), end = text.find("\n  ", begin);
    if (begin == std::string::npos ||
        text.compare(begin, name.size() + 6, "\"" + name + "\": {}") == 0)
      return std::string();
    return text.substr(begin, text.find("\n  }", end) - begin);
  };
  return section("cells") + section("errors");
}

}  // namespace diptych::tests
