#pragma once
/// What nodal volumes and areas must agree about, so that rows exact for quadratics have an adjoint
/// that is exact for linear stresses:
///   sum_a Omega_a d_i X^m = sum_a (A_aN_a)_i X_a^m   for all monomials up to degree 3.
/// Source: notes 4.5. Test: tests/graphs/quadratic_measure_test.cpp

#include "meshes/mesh.hpp"
#include "meshes/side_areas.hpp"
#include "meshes/surface.hpp"

#include <vector>

namespace diptych::meshes {

/// By how much moments of these volumes and areas differ, over the largest moment of the areas [-].
double moment_difference(const Mesh& mesh,
                         const std::vector<double>& Omega,
                         const std::vector<Vec3>& boundary_area);

/// The same with integrals over a body that ends at its facets in place of volumes.
double moment_difference_of_facets(const Mesh& mesh,
                                   const Surface& surface,
                                   const std::vector<Vec3>& boundary_area);

/// By how much areas of boundary groups differ from those of the surface or its facets, largest,
/// over their size [-].
double group_difference(const Mesh& mesh,
                        const Surface& surface,
                        Faces kind,
                        const std::vector<FaceArea>& faces);

/// Changes volumes and areas, those of plane sides in their direction, least beside what they are,
/// so that they agree, or agree as well as they can: where nodes of a side stand nearly in three
/// lines, cubics are told apart by next to nothing, and what that would take of changes is left,
/// but not for linear fields. Areas of boundary groups are those of the surface: loads on them are
/// whole.
/// @param kind   which areas groups keep
/// @param most   change of a volume or an area over what it was, if less can be had
/// @param faces  [boundary faces]
/// @param Omega  [n_nodes] m^3 (m^2 in 2-D)
/// @return the largest change of a volume or an area over what it was [-]; NaN where there is none
double balance_moments(const Mesh& mesh,
                       const Surface& surface,
                       Faces kind,
                       double most,
                       std::vector<FaceArea>& faces,
                       std::vector<double>& Omega);

}  // namespace diptych::meshes
