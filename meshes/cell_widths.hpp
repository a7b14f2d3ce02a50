#pragma once
/// How long the cells of a body are along each direction, in the mean: what operators are made
/// with where cells are long (common/scheme/graph/equal_widths.hpp).
/// Test: tests/graphs/equal_widths_test.cpp

#include "meshes/mesh.hpp"

namespace diptych::meshes {

using algebra::Mat3;

/// The mean over the cells of (d/n) sum_e e e^T, e the n edges of a cell, over the d-th root of its
/// determinant; in the plane 1 across it. The identity of cubes, squares and regular prisms. With
/// simplices, whose edges lean where their nodes do not, it is the identity, too, unless it is
/// longer than the diagonals of ordered meshes of equal sides make it.
Mat3 mean_shape(const Mesh& mesh);

/// Length over width of a shape.
double aspect_of(const Mat3& shape);

/// Whether cells, each for itself and in the mean over the body, are at most 1.5 times as long as
/// wide. The edges of simplices lean: they count as those that the diagonals make of such cells.
bool has_short_cells(const Mesh& mesh);

/// S^(-1/2) of a shape: the map after which cells are as long as wide.
Mat3 to_equal_widths(const Mat3& shape);

}  // namespace diptych::meshes
