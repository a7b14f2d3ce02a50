#pragma once
/// Operators that sum by parts on curved blocks of hexahedra or quadrilaterals, glued at the nodes
/// that they share (meshes/lattice_blocks.hpp). With the metrics M_d of a block and the weights H_t
/// of the lines across (block_metrics.hpp),
///   Omega = sum of H_1 H_2 H_3 det,
///   C_ab = sum of 2 Q_ij H_t M_d(a) for neighbours a, b on a line of direction d,
///   A_aN_a = sum of -+ H_t M_d at the ends of lines that are on the boundary,
/// sums over blocks and directions. C_ab is the split form Q_ij (M_d(a) + M_d(b)) H_t, which is
/// skew and is all of S_ab, and the part Q_ij (M_d(a) - M_d(b)) H_t, which is the same both ways
/// and makes rows exact for linear fields. Closure is exact in 2-D and on extruded blocks;
/// elsewhere it misses what the discrete metric identities miss, and is repaired
/// (closure_repair.hpp). Source: notes 4.6. Test: tests/graphs/sbp_blocks_test.cpp

#include "common/scheme/graph/pair_graph.hpp"
#include "meshes/lattice_blocks.hpp"

#include <string>
#include <vector>

namespace diptych::fvm {

/// The blocks on which sbp_blocks_graph works; empty where a mesh is none or too rough
/// (meshes::is_smooth).
std::vector<meshes::LatticeBlock> smooth_blocks(const meshes::Mesh& mesh);

/// @param order  2 or 4; more counts as 4, since D_ab of linear reconstructions gives energy with
///               order 6 (sbp_operator.hpp), and curved lines have no slopes of their own. On lines
///               too short for it the widest that fits
/// @throws base::InputError where lines bend too much for their spacing
scheme::PairGraph sbp_blocks_graph(const meshes::Mesh& mesh,
                                   const std::vector<meshes::LatticeBlock>& blocks,
                                   int order);

/// "sbp: 3 blocks glued at their nodes, order 4 on lines of 9 to 17 nodes"
std::string blocks_text(const std::vector<meshes::LatticeBlock>& blocks, int order);

/// Whether a block has lines of three nodes along more than one direction: what D_ab gives energy
/// to there breaks bodies, or is not braked (notes 4.6). They sum by parts as any nodes do.
bool is_too_small(const std::vector<meshes::LatticeBlock>& blocks);

/// Whether a block is one cell thick: the trapezoid rule along its lines makes the moments of a
/// cross section too large where other blocks lie beside it (an O-grid of two rings by a fourth).
bool has_lines_of_two(const std::vector<meshes::LatticeBlock>& blocks);

/// How many times as long as its neighbour a cell is on lines of three to seven nodes, on which the
/// operator is of second order: the root mean square, in the logarithm, over the lines of one
/// direction of a block, of the block and direction with the most; 1 where there are none. The
/// maps of such lines err: strips and plates of two to four cells across bend too little (notes
/// 4.6).
double unevenness_of_short_lines(const meshes::Mesh& mesh,
                                 const std::vector<meshes::LatticeBlock>& blocks);
/// Up to here tips of cantilevers lose less than a hundredth by it, if two cells are across.
constexpr double most_uneven = 1.1;

/// Whether D_ab of unlimited reconstructions feeds some motions faster than others of its pairs
/// brake them: on lines of six nodes, whose Q_14 > 0 (notes 4.6).
bool gives_energy(const std::vector<meshes::LatticeBlock>& blocks, int order);

/// What is lost there, one entry for each length of lines too short for the order asked for, and
/// what to look out for.
std::vector<std::string> blocks_notices(const std::vector<meshes::LatticeBlock>& blocks, int order);

}  // namespace diptych::fvm
