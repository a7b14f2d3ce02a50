#pragma once
/// Sizes of fields and of their differences: L2 norms over the nodes, weighted by the nodal
/// volumes, of u, v, P and F - I, under the names of error norms. Differences of two runs are
/// relative to the same as errors are, the largest norm of the field at any output time, so that
/// both can be held against each other. Test: tests/common/run/field_norms_test.cpp

#include "common/run/solver.hpp"

#include <map>
#include <string>

namespace diptych::run {

/// sqrt(sum Omega |f|^2) of each field.
std::map<std::string, double> field_norms(const scheme::PairGraph& graph, const Snapshot& state);

/// sqrt(sum Omega |f - g|^2) of each field of two states on the same nodes.
std::map<std::string, double> difference_norms(const scheme::PairGraph& graph,
                                               const Snapshot& first,
                                               const Snapshot& second);

}  // namespace diptych::run
