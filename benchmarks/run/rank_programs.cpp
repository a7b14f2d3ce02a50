#include "benchmarks/run/rank_programs.hpp"

#include "benchmarks/run/provenance.hpp"
#include "common/base/error.hpp"
#include "common/parallel/ranks.hpp"

#include <cstring>
#include <fmt/format.h>

namespace diptych::harness {

namespace {

template <size_t n>
void put(const std::string& text, char (&to)[n]) {
  std::strncpy(to, text.c_str(), n - 1);
}

RankProgram this_program() {
  const io::Provenance here = provenance("");
  RankProgram program;
  put(here.version + " " + here.commit, program.version);
  put(here.program, program.hash);
  put(here.instruction_set, program.instruction_set);
  return program;
}

std::string name_of(const RankProgram& program) {
  return fmt::format("{}, build {}", program.version, program.hash);
}

}  // namespace

std::vector<RankProgram> programs_of_all(parallel::Communicator& ranks) {
  std::vector<RankProgram> all(static_cast<size_t>(ranks.size()));
  all[ranks.rank()] = this_program();
  const std::vector<std::int64_t> bytes(all.size(), sizeof(RankProgram));
  ranks.all_gather(parallel::bytes_of(all.data()), bytes);
  return all;
}

void require_one_program(const std::vector<RankProgram>& all) {
  for (size_t r = 1; r < all.size(); ++r) {
    if (std::strcmp(all[r].hash, all[0].hash) == 0) continue;
    throw base::EnvironmentError(fmt::format(
        "rank {} of {} is another program ({}) than rank 0 ({}): start the same build on all "
        "machines",
        r, all.size(), name_of(all[r]), name_of(all[0])));
  }
}

std::optional<std::string> notice_of_processors(const std::vector<RankProgram>& all) {
  for (size_t r = 1; r < all.size(); ++r) {
    if (std::strcmp(all[r].instruction_set, all[0].instruction_set) == 0) continue;
    return fmt::format(
        "rank {} of {} runs on a processor with {}, rank 0 with {}: the last bits of results may "
        "differ from those of one process",
        r, all.size(), all[r].instruction_set, all[0].instruction_set);
  }
  return std::nullopt;
}

void require_one_program() {
  if (parallel::all_ranks() != nullptr)
    require_one_program(programs_of_all(*parallel::all_ranks()));
}

}  // namespace diptych::harness
