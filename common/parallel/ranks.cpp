#include "common/parallel/ranks.hpp"

#include "common/base/error.hpp"

#include <algorithm>
#include <atomic>
#include <dlfcn.h>
#include <filesystem>
#include <sched.h>
#include <system_error>
#include <unistd.h>

namespace diptych::parallel {

namespace {

namespace fs = std::filesystem;

Communicator* communicator = nullptr;
int n_sharing = 1;
std::atomic<const char*> current_phase = nullptr;  // lock-free: handlers of signals read it

fs::path program_folder() {
  std::error_code error;
  return fs::read_symlink("/proc/self/exe", error).parent_path();
}

/// @throws base::EnvironmentError
const RanksModule& module() {
  static const RanksModule* loaded = [] {
    std::string reason = "there is none beside the program";
    for (const fs::path& folder : {program_folder(), program_folder() / "../lib/diptych"}) {
      const fs::path file = folder / ranks_module_file;
      std::error_code error;
      if (!fs::exists(file, error)) continue;
      // its symbols are for all: what MPI loads itself looks for them
      void* opened = dlopen(file.c_str(), RTLD_NOW | RTLD_GLOBAL);
      void* found = opened == nullptr ? nullptr : dlsym(opened, ranks_module_symbol);
      if (found != nullptr) return reinterpret_cast<RanksModuleFunction>(found)();
      reason = dlerror();
      if (opened != nullptr) reason += " (it is of another version of the program)";
    }
    throw base::EnvironmentError(
        std::string("several ranks need ") + ranks_module_file + ": " + reason +
        "; build with -DDIPTYCH_WITH_MPI=ON where MPI and METIS " +
        "are (apt-get install libopenmpi-dev libmetis-dev; an installed program takes it by " +
        "cmake --install BUILD --component ranks), or start the program without mpirun");
  }();
  return *loaded;
}

/// What tells whether two processes may run on the same processors of the same machine.
struct Processors {
  char machine[64] = {};
  cpu_set_t allowed;
};

int count_sharing(Communicator& ranks) {
  std::vector<Processors> all(static_cast<size_t>(ranks.size()));
  Processors& mine = all[ranks.rank()];
  gethostname(mine.machine, sizeof mine.machine - 1);
  CPU_ZERO(&mine.allowed);
  sched_getaffinity(0, sizeof mine.allowed, &mine.allowed);
  const std::vector<std::int64_t> bytes(all.size(), sizeof(Processors));
  ranks.all_gather(bytes_of(all.data()), bytes);
  const Processors& here = all[ranks.rank()];
  return static_cast<int>(std::count_if(all.begin(), all.end(), [&](const Processors& other) {
    return std::string(other.machine) == here.machine && CPU_EQUAL(&other.allowed, &here.allowed);
  }));
}

}  // namespace

Ranks::Ranks(PassedSignals signals) {
  if (launched_ranks() <= 1) return;
  std::string error;
  communicator = module().begin(error, phase, signals);
  if (communicator == nullptr) throw base::EnvironmentError("ranks cannot begin: " + error);
  n_sharing = count_sharing(*communicator);
}

Ranks::~Ranks() {
  if (communicator == nullptr) return;
  communicator = nullptr;
  module().end();
}

Communicator* all_ranks() {
  return communicator;
}

int ranks_that_share_processors() {
  return n_sharing;
}

Phase::Phase(const char* name) {
  current_phase = name;
}
Phase::~Phase() {
  current_phase = nullptr;
}

const char* phase() {
  return current_phase;
}

std::vector<int> metis_partition(const ChunkGraph& graph, int n_parts) {
  return module().metis(graph, n_parts);
}

}  // namespace diptych::parallel
