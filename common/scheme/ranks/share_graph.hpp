#pragma once
/// Graphs are built by rank 0 alone; the other ranks are given what their part takes: nodes and
/// indices, which are few, whole, and of the geometry what their own rows use. All ranks call these
/// functions together. Test: tests/ranks

#include "common/scheme/body/body.hpp"

namespace diptych::scheme {

/// Nodes, boundary, and what the volumes of these nodes are made of; no pairs.
void share_nodes(parallel::Communicator& ranks, PairGraph& graph, Volumes volumes);

/// All but the geometry of pairs, which other ranks get room for.
template <int Dim>
void share_indices(parallel::Communicator& ranks, SweepGraph<Dim>& graph);

/// The geometry of the pairs that a rank works.
/// @pre body.division
template <int Dim>
void share_geometry(Body<Dim>& body);

/// All fields in the last block, whose lanes behind the last node are worked too and which no
/// archive keeps.
/// @pre body.division
template <int Dim>
void share_last_block(Body<Dim>& body);

}  // namespace diptych::scheme
