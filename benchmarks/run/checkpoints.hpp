#pragma once
/// The checkpoints in the folder of a run, DIR/checkpoint_STEP.hdf: the two latest generations, of
/// which the later one is taken if it is whole. Test: tests/command_line/restart_test.cpp

#include "common/algebra/archive.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace diptych::harness {

/// Whether a run names a checkpoint so; the unfinished one of a run that was killed ends with
/// ".tmp".
bool is_checkpoint_name(const std::string& name);

/// Writes a checkpoint of this step, whole or not at all, and removes all but it and the one
/// before.
/// @param archive  puts all that is to be kept into what it is given
/// @throws base::EnvironmentError
void write_checkpoint(const std::string& directory,
                      std::int64_t step,
                      const std::function<void(algebra::Archive&)>& archive);

/// Removes those of later steps: a run that goes on from this one makes them anew.
/// @throws base::EnvironmentError
void remove_later_checkpoints(const std::string& directory, std::int64_t step);

/// What there is to go on from.
struct FoundCheckpoint {
  std::optional<std::string> path;   ///< the latest that is whole
  std::vector<std::string> refused;  ///< later ones, each with the reason
};

/// Nothing where the folder has no checkpoint. @throws base::InputError where none is whole, with
/// all reasons; base::EnvironmentError where one cannot be read
FoundCheckpoint latest_checkpoint(const std::string& directory);

}  // namespace diptych::harness
