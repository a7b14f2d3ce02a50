#pragma once
/// Energies, momenta and involution drifts of a body (notes 6).

#include "common/scheme/body/material_model.hpp"

namespace diptych::scheme {

template <int Dim>
Balance balance(const MaterialModel& material, const Body<Dim>& body);

}  // namespace diptych::scheme
