#pragma once
/// Quantities of interest of a run ([[probe]] of the case file): where they look and what they are
/// at the solver's time. Only the nodes that the probes need are evaluated.
/// Test: tests/common/run/probes_test.cpp

#include "common/cases/case.hpp"
#include "common/run/interpolation.hpp"
#include "common/run/solver.hpp"

#include <optional>
#include <string>
#include <vector>

namespace diptych::run {

using algebra::Vec3;

/// Headers of the probes' columns. @param stepped  only those with every_step
std::vector<std::string> probe_columns(const std::vector<cases::ProbeCase>& probes, bool stepped);

class Probes {
 public:
  /// @param mesh  only asked for points and probes of kind checkerboard, not kept
  /// @throws base::InputError on a group that the graph lacks, a point outside
  Probes(const std::vector<cases::ProbeCase>& probes,
         const scheme::PairGraph& graph,
         const MeshAround& mesh);

  bool empty() const { return all_.probes.empty(); }
  size_t size() const { return all_.probes.size(); }
  size_t n_stepped() const { return stepped_.probes.size(); }
  bool has_stepped() const { return !stepped_.probes.empty(); }

  /// Of all probes, in the order of the case.
  std::vector<double> values(Solver& solver) const { return evaluate(all_, solver); }
  /// Nodes that all probes read, ascending, and their places  [m].
  const std::vector<std::int32_t>& nodes() const { return all_.nodes; }
  std::vector<Vec3> places() const;
  /// Of all probes in exact fields at nodes(); nothing where the exact solution does not give what
  /// the probe reads, as the force of a support.
  std::vector<std::optional<double>> exact_values(const Snapshot& exact) const;
  /// Of those with every_step.
  std::vector<double> stepped_values(Solver& solver) const { return evaluate(stepped_, solver); }

 private:
  struct PlacedProbe {
    cases::ProbeCase probe;
    std::vector<std::int32_t> nodes;  ///< ascending
    std::vector<double>
        weights;  ///< [nodes] m^2, m^3 or parts of one; 0 where only neighbours read it
  };
  struct Selection {
    std::vector<PlacedProbe> probes;
    std::vector<std::int32_t> nodes;  ///< ascending, all that the probes read
    void add(const PlacedProbe& placed);
  };
  Selection all_, stepped_;
  std::vector<Vec3> X_;  ///< [n_nodes] m
  std::optional<Checkerboard> checkerboard_;

  std::vector<double> evaluate(const Selection& selection, Solver& solver) const;
  /// What a probe of any kind but reaction makes of the values at its nodes.
  double reduced(const std::string& kind,
                 const std::vector<double>& values,
                 const std::vector<double>& weights) const;
  static PlacedProbe placed(const cases::ProbeCase& probe,
                            const scheme::PairGraph& graph,
                            const MeshAround& mesh);
  /// @throws base::InputError where no node is left
  static void keep_region(const scheme::PairGraph& graph, PlacedProbe& placed);
};

}  // namespace diptych::run
