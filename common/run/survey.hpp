#pragma once
/// Questions about a whole body that every rank answers for its part of it, so that none has to
/// have all of it in one place: the state of all cells, errors against an exact solution. A body
/// that is not divided is the part of its one rank. Test: tests/harness/surveys_test.cpp,
/// tests/ranks

#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace diptych::run {

class Solver;

class Survey {
 public:
  virtual ~Survey() = default;
  /// Of the part of this rank as it stands; all ranks call it together.
  /// @param solver    of this rank
  /// @param question  the same on all ranks
  virtual std::vector<double> answer(const Solver& solver, std::span<const double> question) = 0;
};

using Surveys = std::vector<std::unique_ptr<Survey>>;
/// [rank]
using Answers = std::vector<std::vector<double>>;
/// Makes the surveys of a run, on every rank once its solver has its part: the same ones in the
/// same order.
using MakeSurveys = std::function<Surveys(const Solver& solver)>;

}  // namespace diptych::run
