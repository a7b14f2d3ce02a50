#pragma once
/// [functions.NAME] of a case file: named functions of time, or of place and time.
/// A new type: its class, a word in menus::functions, its keys in case_keys.cpp, a line here.
/// Test: tests/common/run/case_functions_test.cpp.

#include "common/run/case_values.hpp"

#include <memory>
#include <string>

namespace diptych::run {

/// @param section  [functions.NAME]
/// @throws base::InputError on missing keys, and on keys that this type does not have
std::shared_ptr<const TimeFunction> read_function(const std::string& name,
                                                  const SectionValues& section);

}  // namespace diptych::run
