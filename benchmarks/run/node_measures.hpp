#pragma once
/// Numbers made of the final state of a run by expressions of its nodal fields: means over a part
/// of the body, integrals, extremes. They go to summary.json.
/// Test: tests/report/node_measures_test.cpp

#include "common/functions/expressions.hpp"
#include "common/run/solver.hpp"

#include <map>
#include <string>
#include <vector>

namespace diptych::harness {

/// Names that `value` and `where` may use besides the parameters: x, y, z (m), t (s), u1 u2 u3 (m),
/// v1 v2 v3 (m/s), F11 ... F33, J, P11 ... P33 (Pa), and error_velocity, error_displacement, ... of
/// error_fields(): the size of the error at the node, absolute.
struct NodeMeasure {
  std::string name;
  std::string reduce;  ///< mean, integral, max or min; the first two weigh nodes by volume
  functions::Expression value, where;  ///< nodes at which `where` is 0 are left out
  std::string text;                    ///< as it was written: what a change of it is seen by
};

/// Fields whose errors at the nodes have a name.
const std::vector<std::string>& error_fields();

/// Final state of a run.
struct NodeStates {
  const scheme::PairGraph& graph;
  const scheme::Snapshot& state;
  const std::map<std::string, std::vector<double>>& errors;  ///< field: size at each node
};

/// The names that expressions of a measure may use.
functions::Vocabulary node_vocabulary(const std::map<std::string, double>& parameters);

/// Entries of NodeMeasure::reduce.
const std::vector<std::string>& reductions();

/// Name and number of each; nothing where there is no state.
/// @throws base::InputError where no node is left over, or an error is asked for that the case does
///         not have
std::map<std::string, double> measured(const std::vector<NodeMeasure>& measures,
                                       const NodeStates& nodes);

}  // namespace diptych::harness
