#pragma once
/// The ranks of this process, as the program that started it (mpirun, srun) made them. MPI itself
/// stands behind a module that is loaded only where there are ranks: a program that was started by
/// itself needs no MPI library. Test: tests/ranks/ranks_test.cpp, tests/ranks

#include "common/parallel/communicator.hpp"
#include "common/parallel/partition.hpp"

#include <string>

namespace diptych::parallel {

/// Signals go to one process, and rank 0 alone can do what they ask for: what the thread that
/// watches the other ranks asks the program for and tells it.
struct PassedSignals {
  int (*take)() = nullptr;                       ///< of another rank: what it was sent; 0: nothing
  void (*obey)(int rank, int signal) = nullptr;  ///< of rank 0: another rank was sent this one
};

/// What the module gives (common/mpi/module.cpp). It is looked for beside the program, and in
/// lib/diptych of the folder above it.
struct RanksModule {
  /// Calls MPI_Init, and watches the other ranks from then on.
  /// @param phase    what this rank does: phase(), below
  /// @param signals  passed to rank 0 while ranks watch each other
  /// @return null, and a message in `error`, where that is not possible; what one rank meets
  ///         behind MPI_Init is null and the same message on all
  Communicator* (*begin)(std::string& error, const char* (*phase)(), PassedSignals signals);
  /// Calls MPI_Finalize.
  void (*end)();
  std::vector<int> (*metis)(const ChunkGraph& graph, int n_parts);
};
using RanksModuleFunction = const RanksModule* (*)();
/// Its number grows when RanksModule changes: a module of another version is not called.
inline constexpr const char* ranks_module_symbol = "diptych_ranks_module_2";
inline constexpr const char* ranks_module_file = "libdiptych_mpi.so";

/// Processes that this one was started among, by the variables that mpirun and srun leave; 1 where
/// there are none.
int launched_ranks();
/// The number of this one among them, from 0.
int launched_rank();

/// Joins the ranks that this process was started among, for its lifetime.
class Ranks {
 public:
  /// @throws base::EnvironmentError where there are several and MPI cannot be had
  explicit Ranks(PassedSignals signals);
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;
};

/// Of all ranks while there is a Ranks and there are several of them, null otherwise: like the
/// processes themselves, there is one for a program.
Communicator* all_ranks();

/// Of several ranks on one machine, those that may run on the same processors share them: what
/// thread_count() leaves each. 1 where there is one rank.
int ranks_that_share_processors();

/// What this rank does, for who is told to end and says where it was (from a handler of signals),
/// and for the rank that watches this one.
/// @return a text that stays; null: nothing that concerns other ranks
const char* phase();
/// Sets it for its lifetime.
struct Phase {
  /// @param name  a text that stays
  explicit Phase(const char* name);
  ~Phase();
  Phase(const Phase&) = delete;
  Phase& operator=(const Phase&) = delete;
};

/// @throws base::EnvironmentError where the program was built without METIS
std::vector<int> metis_partition(const ChunkGraph& graph, int n_parts);

}  // namespace diptych::parallel
