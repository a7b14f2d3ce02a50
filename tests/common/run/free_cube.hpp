#pragma once
/// What tests of guards are tried on.

#include <string>

namespace diptych::tests {

/// A free cube that is thrown at itself, slowly.
inline const std::string free_cube = R"([mesh]
element = "hexahedron"
cells = [4, 4, 4]
[material]
model = "neo-hookean"
density = 1100
youngs_modulus = 17e6
poissons_ratio = 0.3
[initial]
velocity = ["-1*x", 0, 0]
[time]
end = 0.08
integrator = "ssp-rk2"
[output]
frames = 10
)";

}  // namespace diptych::tests
