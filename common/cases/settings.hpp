#pragma once
/// What a case says, key by key: whether a run that goes on from a checkpoint is still of the same
/// case. Test: tests/common/cases/settings_test.cpp

#include "common/cases/case.hpp"

#include <map>
#include <string>

namespace diptych::cases {

/// Path of each key, "material.branch.0.tau_C", with its value as the file and the overrides have
/// it. Without those that a run may be given anew where it goes on from a checkpoint: time.end,
/// time.max_steps, time.checkpoint_every, time.checkpoint_seconds, time.checkpoint_interval, all of
/// [output], and [[variant]], which a run does not know.
/// @throws base::InputError where the text of the case is none
std::map<std::string, std::string> lasting_settings(const Case& setup);

/// A line a setting, "material.density = 1100".
std::string settings_text(const std::map<std::string, std::string>& settings);

/// The first setting that is not the same in both texts: "material.density was 1100, is 1200";
/// empty where they say the same.
std::string changed_setting(const std::string& before, const std::string& now);

}  // namespace diptych::cases
