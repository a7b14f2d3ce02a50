#pragma once
/// A fingerprint of a state: two runs that agree to the last bit have the same.

#include "common/scheme/body/body.hpp"

#include <string>
#include <vector>

namespace diptych::run {

/// XXH3 (128 bits) of the time and of the sum of the hashes of all nodes, each of the number of the
/// node and its unknowns in the order of the table of fields, as 32 hexadecimal digits. A sum has
/// no order: ranks hash what they own. Among ranks all call this together.
/// @param order  [node] its number in the user's mesh, on rank 0
template <int Dim>
std::string state_hash(const scheme::Body<Dim>& body,
                       const std::vector<std::int32_t>& order,
                       double time);

/// XXH3 (64 bits) of places and volumes of the nodes, as 16 hexadecimal digits.
std::string hash_of_nodes(const scheme::PairGraph& graph);
/// The same of names, nodes, areas and faces of the boundary groups.
std::string hash_of_groups(const scheme::PairGraph& graph);

}  // namespace diptych::run
