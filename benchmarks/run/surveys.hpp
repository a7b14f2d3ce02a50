#pragma once
/// The surveys of a run: of cells, and against an exact solution where the case has one.
/// Test: tests/harness/surveys_test.cpp, tests/ranks

#include "benchmarks/run/case_mesh.hpp"
#include "common/cases/case.hpp"
#include "common/run/solver.hpp"

namespace diptych::harness {

/// Their places in the solver.
enum SurveyPlace : size_t { survey_of_cells, survey_of_exact };

/// Of a body that is not divided.
/// @param setup, mesh  kept by reference
run::Surveys surveys_of(const cases::Case& setup,
                        const meshes::Mesh& mesh,
                        const scheme::PairGraph& graph,
                        const run::Solver& solver);

/// Of a rank; all ranks call it together.
/// @param setup        kept by reference
/// @param mesh, graph  on rank 0; else null. What it takes of them is copied
run::Surveys surveys_among(parallel::Communicator& ranks,
                           const cases::Case& setup,
                           const meshes::Mesh* mesh,
                           const scheme::PairGraph* graph,
                           const run::Solver& solver);

}  // namespace diptych::harness
