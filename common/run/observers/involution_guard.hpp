#pragma once
/// Stops a run whose evolved H and J are no longer the cofactor and the determinant of its F
/// (notes 6): stress then belongs to no motion. Test: tests/common/run/guards_test.cpp

#include "common/run/observers/observer.hpp"

namespace diptych::run {

class InvolutionGuard : public Observer {
 public:
  /// @param solver     says which node it is; kept by reference
  /// @param threshold  largest admissible |H - cof F|, |J - det F| of a node
  InvolutionGuard(const Solver& solver, double threshold)
      : solver_(solver), threshold_(threshold) {}

  /// @throws base::BreakdownError
  void at_check(const Check& check) override;
  void at_output(const Output& output) override {
    at_check({output.step, output.balance, output.audit});
  }

 private:
  const Solver& solver_;
  double threshold_;
};

}  // namespace diptych::run
