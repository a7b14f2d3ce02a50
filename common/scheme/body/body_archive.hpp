#pragma once
/// The fields of a body kept in an archive and taken from it, by a loop over its table of fields.
/// Test: tests/common/run/restart_test.cpp

#include "common/algebra/archive.hpp"
#include "common/scheme/body/body.hpp"

namespace diptych::scheme {

/// All fields of a role, each as "body/ROLE/NAME", [n_stored][n_components] in the order of the
/// nodes; a field in two places is one table. In the precision that they have, as doubles.
/// @throws base::InputError where it is loading a body of another size
template <int Dim>
void archive_fields(Body<Dim>& body, Role role, algebra::Archive& archive);

}  // namespace diptych::scheme
