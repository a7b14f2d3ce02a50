#pragma once
/// What ranks give each other of a body's fields, by its table of fields. With one rank nothing is
/// done. All ranks call these together.

#include "common/scheme/body/body.hpp"

#include <initializer_list>
#include <span>

namespace diptych::scheme {

/// Brings what neighbours of its nodes have in these tables to each rank
/// (Field::read_by_neighbours).
template <int Dim>
void exchange(Body<Dim>& body, std::initializer_list<NodeTable Body<Dim>::*> tables);

/// Brings the fields of a role to rank 0.
template <int Dim>
void gather(Body<Dim>& body, Role role);

/// All that is of the state as it stands, of every role but step_begin.
template <int Dim>
void gather_state(Body<Dim>& body);

/// Brings the unknowns of these nodes to all ranks.
template <int Dim>
void gather_unknowns(Body<Dim>& body, std::span<const std::int32_t> nodes);

}  // namespace diptych::scheme
