#pragma once
/// The cells of the deformed mesh, each rank those whose first node is its own.
/// Test: tests/harness/surveys_test.cpp, tests/ranks

#include "common/run/observers/cell_watch.hpp"
#include "common/run/solver.hpp"
#include "meshes/deformed_cells.hpp"

#include <vector>

namespace diptych::harness {

/// Cells of a rank, whose nodes have numbers of their own.
struct OwnCells {
  meshes::Mesh mesh;                ///< nodes and cells only
  std::vector<std::int32_t> nodes;  ///< [mesh.n_nodes()] in the body, ascending
  std::vector<std::int64_t> cells;  ///< [mesh.n_cells()] in the whole mesh, ascending
};

/// Gives each rank its cells. All ranks call it together.
/// @param whole  on rank 0; else null
/// @param part   of this rank
OwnCells share_cells(const meshes::Mesh* whole, const parallel::Part& part);

class CellSurvey : public run::Survey {
 public:
  /// Of a body that is not divided. @param mesh  kept by reference
  CellSurvey(const meshes::Mesh& mesh, const run::Solver& solver);
  /// Of a rank.
  CellSurvey(OwnCells own, const run::Solver& solver);
  CellSurvey(const CellSurvey&) = delete;
  CellSurvey& operator=(const CellSurvey&) = delete;

  /// @param question  dt  [s]
  /// @return for outlook_of(); nothing where this rank has no cell
  std::vector<double> answer(const run::Solver& solver, std::span<const double> question) override;

 private:
  OwnCells own_;  ///< empty where the mesh is the whole one
  const meshes::Mesh& mesh_;
  run::NodeReads reads_;
  meshes::DeformedCells deformed_;
};

/// Of all cells: the least J, of several the first cell with it, whatever the ranks.
/// @param n_cells  of the whole mesh
run::CellOutlook outlook_of(const run::Answers& answers, std::int64_t n_cells);

}  // namespace diptych::harness
