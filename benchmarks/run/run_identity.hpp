#pragma once
/// Which run a checkpoint is of: a run goes on from it only where it is the same one.
/// Test: tests/command_line/restart_test.cpp

#include "common/algebra/archive.hpp"
#include "common/cases/case.hpp"
#include "common/io/run_record.hpp"
#include "common/scheme/graph/pair_graph.hpp"

#include <string>

namespace diptych::harness {

struct RunIdentity {
  std::string method;
  int level = 0;
  std::string settings;         ///< cases::lasting_settings, a line each
  std::string nodes;            ///< hash of their places and volumes
  std::string groups;           ///< hash of the boundary groups
  std::string volumes;          ///< what scheme.volumes came to
  std::string program;          ///< hash of the executable
  std::string version;          ///< of it, with the commit
  std::string instruction_set;  ///< that it ran with

  void archive(algebra::Archive& archive);
};

RunIdentity identity_of(const cases::Case& setup,
                        const scheme::PairGraph& graph,
                        const io::RunSummary& summary);

/// What is not the same in a way that makes a run another one; empty where there is nothing.
std::string difference_of(const RunIdentity& before, const RunIdentity& now);

/// What may change the last bits of the results; empty where there is nothing.
std::string doubt_about(const RunIdentity& before, const RunIdentity& now);

/// The identity in a checkpoint. @throws base::InputError, base::EnvironmentError
RunIdentity identity_in(const std::string& path);

}  // namespace diptych::harness
