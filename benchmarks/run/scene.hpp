#pragma once
/// A case with one method on one level, made in the one place there is for it: mesh, graph, solver.
/// Whoever runs, times, checks or tests a case takes them from here, so that each has the graph
/// that the keys of the case ask for. Test: tests/harness/scene_test.cpp

#include "benchmarks/run/backends.hpp"
#include "benchmarks/run/case_mesh.hpp"
#include "common/run/solver.hpp"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace diptych::harness {

/// What a scene is made of, in this order.
enum class ScenePart { mesh, graph, solver };

/// A case without a solver.
struct CaseGraph {
  CaseMesh mesh;
  scheme::PairGraph graph;
  std::string operators;       ///< what the method made of the mesh (scheme::Operators)
  std::string reconstruction;  ///< what scheme.reconstruction = "auto" comes to; empty: see there
  std::vector<std::string> notices;  ///< of them, of cavities, curved symmetries, single cells
};

/// Told when a part stands: for who counts what each costs, or looks at the pairs.
using PartMade = std::function<void(ScenePart part, const CaseGraph& scene)>;

/// @param made  may be empty
/// @throws base::InputError on a bad mesh, method or option of one; base::EnvironmentError where
/// the
///         machine has not the memory for it
CaseGraph graph_of(const cases::Case& setup,
                   const std::string& method,
                   int level,
                   const PartMade& made = {});

/// What becomes of the pairs of a graph once its solver stands: a run steps without them.
enum class GraphPairs { kept, released };

/// A case that can be stepped. It stays where it is: the solver refers to the graph.
struct Scene : CaseGraph {
  /// See graph_of. @throws base::InputError on a boundary group that the mesh lacks too
  Scene(const cases::Case& setup,
        const std::string& method,
        int level,
        GraphPairs pairs = GraphPairs::kept,
        const PartMade& made = {});
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  std::unique_ptr<run::Solver> solver;
};

}  // namespace diptych::harness
