#pragma once
/// SPH whose gradients sum by parts as a pair graph, on an undistorted block of hexahedra or
/// quadrilaterals: rows of lattice_operator.hpp in lattice coordinates, turned into space by the
/// cofactors of the edges of a cell. Lines of nodes have the smoothing length kappa in units of
/// their own spacing.
/// Source: notes 4.4. Test: tests/graphs/sph_sbp_test.cpp

#include "sph/kernels/kernel.hpp"
#include "sph/sph_graph.hpp"

namespace diptych::sph {

/// @throws base::InputError where the mesh is no undistorted block, has lines of two nodes, or
/// where
///         the support is too small
scheme::PairGraph sbp_graph(const meshes::Mesh& mesh, const Kernel& kernel, double kappa);

/// Why gradient = "auto" does not take sbp_graph on a mesh; empty where it does: on undistorted
/// blocks with lines of three nodes and more, whose boundary groups have areas of their own, and
/// supports of two to four spacings: wider rows than that the layers beside the boundary cannot
/// correct (notes 4.4).
std::string unsure_because(const meshes::Mesh& mesh, const Kernel& kernel, double kappa);
constexpr int least_nodes = 3;
constexpr double widest_sure_support = 4;

/// "sbp: order 4 inside, 2 within 3 nodes of the boundary, kappa 1.2"
std::string sbp_text(double kappa);

/// Of short lines, on which the sign of D_ab is not known without slopes along lines (notes 4.4).
/// @pre sbp_graph takes the mesh
std::vector<std::string> sbp_notices(const meshes::Mesh& mesh);

}  // namespace diptych::sph
