#include "benchmarks/run/surveys.hpp"

#include "benchmarks/run/cell_survey.hpp"
#include "common/parallel/sharing.hpp"
#include "common/run/exact_survey.hpp"
#include "common/scheme/body/node_chunks.hpp"

namespace diptych::harness {

namespace {

/// Of each rank the entries of its nodes, of a table that rank 0 has.
template <class T>
std::vector<T> share_own(parallel::Communicator& ranks,
                         const std::vector<T>* whole,
                         const parallel::Part& part) {
  std::vector<T> own;
  parallel::share_pieces(ranks, whole, [&](std::int64_t first, const std::vector<T>& piece) {
    for (std::int64_t k = 0; k < std::ssize(piece); ++k)
      if (part.owns(scheme::chunk_of_node(first + k))) own.push_back(piece[static_cast<size_t>(k)]);
  });
  own.shrink_to_fit();
  return own;
}

}  // namespace

run::Surveys surveys_of(const cases::Case& setup,
                        const meshes::Mesh& mesh,
                        const scheme::PairGraph& graph,
                        const run::Solver& solver) {
  run::Surveys surveys;
  surveys.push_back(std::make_unique<CellSurvey>(mesh, solver));
  if (run::ExactSurvey::is_for(setup))
    surveys.push_back(std::make_unique<run::ExactSurvey>(setup, solver, graph));
  return surveys;
}

run::Surveys surveys_among(parallel::Communicator& ranks,
                           const cases::Case& setup,
                           const meshes::Mesh* mesh,
                           const scheme::PairGraph* graph,
                           const run::Solver& solver) {
  run::Surveys surveys;
  surveys.push_back(std::make_unique<CellSurvey>(share_cells(mesh, solver.part()), solver));
  if (!run::ExactSurvey::is_for(setup)) return surveys;
  run::ExactSurvey::Nodes nodes;
  if (!setup.motion)
    nodes.X = share_own(ranks, graph == nullptr ? nullptr : &graph->X, solver.part());
  nodes.Omega = share_own(ranks, graph == nullptr ? nullptr : &graph->Omega, solver.part());
  if (graph != nullptr) nodes.length = run::length_of(*graph);
  parallel::share(ranks, nodes.length);
  surveys.push_back(std::make_unique<run::ExactSurvey>(setup, solver, std::move(nodes)));
  return surveys;
}

}  // namespace diptych::harness
