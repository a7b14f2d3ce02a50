#pragma once
/// Whether a scene can be under more bulk pressure than nodes bear that carry it (notes 3.9, 10.1).
/// Test: tests/harness/strong_pressure_test.cpp

#include "common/cases/case.hpp"
#include "meshes/mesh.hpp"

#include <string>

namespace diptych::harness {

/// Whether the bulk modulus is more than 2.5 shear moduli (nu above 0.32): at J = 0.6 the pressure
/// is then the shear modulus.
bool is_nearly_incompressible(const cases::MaterialCase& material);

/// Whether volumes of lines may carry the pressure where nothing presses: of a nearly
/// incompressible material whose resistance to changes of areas (zeta) is a quarter of the shear
/// modulus and more. With less, rows of nodes along free edges come apart in tension (notes 3.10).
bool holds_with_lines(const cases::MaterialCase& material);

/// Why `auto` takes operators that bear any bulk pressure, for the record: a follower pressure or a
/// dead traction presses with more than 1.5 shear moduli (on moved nodes over the cells'
/// length by width) at a node and one of 65 instants, or a
/// nearly incompressible body is held on all sides, or another that is has no more room than leads
/// to such a pressure, or body forces (their mean over the nodes) make as much over the length of a
/// body of which supports hold all sides but those that face against them, and the mesh has what
/// bears it (finite volumes have no cells on faces that are no parallelograms). What walls,
/// impacts, supports of a part of the boundary, manufactured velocities, body forces of bodies that
/// may give way to a side and manufactured tractions press is not seen, and loads on one group are
/// not added. Empty where nothing presses so, or where the case says what carries the pressure
/// (scheme.volumes).
std::string strong_pressure_because(const cases::Case& setup,
                                    const std::string& method,
                                    const meshes::Mesh& mesh);

/// Whether anything in a scene could bring a pressure of some size, a fifteenth of what nodes bear:
/// loads, body forces, moving supports, a deformation or a kinetic energy to begin with.
bool can_press(const cases::Case& setup, const meshes::Mesh& mesh);

/// Before there is a mesh: loads that depend on the place may be strong, groups may be all there
/// are.
bool may_press_strongly(const cases::Case& setup);

}  // namespace diptych::harness
