#pragma once
/// The programs of the ranks of a run: machines may have other builds of the same name, which may
/// not even wait for the same, and other processors. Test: tests/harness/rank_programs_test.cpp,
/// tests/ranks

#include "common/parallel/communicator.hpp"

#include <optional>
#include <string>
#include <vector>

namespace diptych::harness {

/// As it goes from rank to rank.
struct RankProgram {
  char version[96] = {};          ///< with the commit
  char hash[32] = {};             ///< program_hash()
  char instruction_set[32] = {};  ///< what its sweeps run
};

/// [size] of all ranks, which call this together.
std::vector<RankProgram> programs_of_all(parallel::Communicator& ranks);

/// @throws base::EnvironmentError where one is not that of rank 0
void require_one_program(const std::vector<RankProgram>& all);

/// Where processors of ranks run other instructions: nothing where all run the same.
std::optional<std::string> notice_of_processors(const std::vector<RankProgram>& all);

/// The same program on all ranks; does nothing where there is one. All ranks call it together.
/// @throws base::EnvironmentError where it is not, on all
void require_one_program();

}  // namespace diptych::harness
