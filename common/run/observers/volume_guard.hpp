#pragma once
/// Stops a run in which the volumes that carry the pressure (of cells or lines, notes 3.9, 3.10)
/// and J of the nodes, to which the rest of the stress belongs, have come apart in the body as a
/// whole: what moves the one then is not seen by the other, and energy and reactions are those of
/// no body, however well the budget closes. Test: tests/common/run/volume_guard_test.cpp

#include "common/run/observers/observer.hpp"

#include <optional>
#include <string>

namespace diptych::run {

class VolumeGuard : public Observer {
 public:
  /// @param solver     says where they are farthest apart; kept by reference
  /// @param threshold  largest admissible scheme::Balance::volumes_apart()
  VolumeGuard(const Solver& solver, double threshold) : solver_(solver), threshold_(threshold) {}

  /// @throws base::BreakdownError
  void at_check(const Check& check) override;
  void at_output(const Output& output) override {
    at_check({output.step, output.balance, output.audit});
  }
  void archive(algebra::Archive& archive) override;

  /// What is to be said of a run that came to its end with volumes far apart, though not so far.
  std::optional<std::string> notice() const;

  /// From here on energies and reactions err by some per cent, on a few cells by half (notes 3.13).
  static constexpr double worth_telling = 0.05;

 private:
  const Solver& solver_;
  double threshold_;
  double largest_ = 0;  // of all checks
  double time_ = 0;     // s, of that
};

}  // namespace diptych::run
