#include "common/parallel/ranks.hpp"

#include <cstdlib>
#include <initializer_list>

namespace diptych::parallel {

namespace {

/// The first of these variables that is a number; else `otherwise`.
int number_in(std::initializer_list<const char*> names, int otherwise) {
  for (const char* name : names) {
    const char* text = std::getenv(name);
    char* end = nullptr;
    const long number = text == nullptr ? 0 : std::strtol(text, &end, 10);
    if (text != nullptr && end != text && *end == '\0') return static_cast<int>(number);
  }
  return otherwise;
}

}  // namespace

int launched_ranks() {
  return number_in({"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"}, 1);
}

int launched_rank() {
  return number_in({"OMPI_COMM_WORLD_RANK", "PMI_RANK", "SLURM_PROCID"}, 0);
}

}  // namespace diptych::parallel
