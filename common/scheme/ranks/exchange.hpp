#pragma once
/// What ranks give each other of a body's fields, by its table of fields. With one rank nothing is
/// done. All ranks call these together.

#include "common/scheme/ranks/division.hpp"

#include <initializer_list>
#include <span>

namespace diptych::scheme {

/// Tables of a body.
template <int Dim>
using Tables = std::span<NodeTable Body<Dim>::*const>;

/// Begins to bring what neighbours of its nodes have in these tables to each rank
/// (Field::read_by_neighbours). Until it has been finished, with the same tables, the own nodes'
/// entries may be read, others neither read nor written, and nothing else is said to other ranks.
/// @pre body.division
template <int Dim>
void begin_exchange(Body<Dim>& body, Tables<Dim> tables);
template <int Dim>
void finish_exchange(Body<Dim>& body, Tables<Dim> tables);

/// Works while what neighbours have in these tables comes.
/// @pre body.division
template <int Dim, class Work>
void while_bringing(Body<Dim>& body,
                    std::initializer_list<NodeTable Body<Dim>::*> tables,
                    const Work& work) {
  const Tables<Dim> read(tables.begin(), tables.size());
  begin_exchange(body, read);
  work();
  finish_exchange(body, read);
}

/// Sweeps over pairs that read these tables of their neighbours, while those of other ranks come.
/// @param sweep  of a Share: once whole, or inner and then outer
template <int Dim, class Sweep>
void sweep_with(Body<Dim>& body,
                std::initializer_list<NodeTable Body<Dim>::*> tables,
                const Sweep& sweep) {
  if (!body.division) {
    sweep(Share::whole);
    return;
  }
  while_bringing(body, tables, [&] { sweep(Share::inner); });
  sweep(Share::outer);
}

/// Brings the fields of a role to rank 0.
template <int Dim>
void gather(Body<Dim>& body, Role role);

/// All that is of the state as it stands, of every role but step_begin.
template <int Dim>
void gather_state(Body<Dim>& body);

}  // namespace diptych::scheme
