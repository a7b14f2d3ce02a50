#pragma once
/// How cost, set-up and memory grow with the size of a body: cubes with and without the neighbours'
/// data in cache, SPH (kappa 1.2), FVM on hexahedra and on tetrahedra. Mooney-Rivlin, F, H and J
/// evolved, linear reconstruction, leapfrog: one evaluation a step, the shortest run that set-up
/// can be compared with.

#include <cstdint>
#include <string>
#include <vector>

namespace diptych::harness {

struct SizeRow {
  std::string graph;  ///< "SPH", "FVM hexahedra", "FVM tetrahedra"
  std::int64_t nodes = 0, pairs = 0;
  double mesh_seconds = 0, graph_seconds = 0, solver_seconds = 0;  ///< processor time of set-up
  double step_seconds = 0;                                         ///< the least of the steps made
  double stage_ns = 0;  ///< per node and stage, of that step
  // per node  [bytes]
  double counted = 0;   ///< arrays of the solver
  double running = 0;   ///< resident set once the solver stands
  double building = 0;  ///< largest resident set until then

  /// Steps that take as long as graph and solver.
  double setup_steps() const { return (graph_seconds + solver_seconds) / step_seconds; }
};

struct SizeRequest {
  std::vector<int> sides;  ///< nodes along a side of the cubes
  int threads = 1;
  std::vector<std::string> overrides;  ///< key=value, of the scene
  bool quiet = false;
};

std::vector<SizeRow> measure_size_costs(const SizeRequest& request);

std::string size_text(const std::vector<SizeRow>& rows);
std::string size_csv(const std::vector<SizeRow>& rows);

}  // namespace diptych::harness
