#pragma once
/// [material] to Lame constants, with the conditions under which the model is well posed.

#include "common/cases/case.hpp"
#include "common/cases/values.hpp"

namespace diptych::cases {

/// @param section  [material]
/// @param branches entries of [[material.branch]]
/// @throws base::InputError on anything but one pair of constants; lambda_hat = lambda - 4 zeta <=
/// 0
///         (paper eq. 4; isochoric models: bulk modulus <= 0); incomplete branches
MaterialCase read_material(const SectionValues& section,
                           const std::vector<SectionValues>& branches);

}  // namespace diptych::cases
