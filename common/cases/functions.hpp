#pragma once
/// [functions.NAME] of a case file: named functions of time, or of place and time.
/// A new type: its class, a word in menus::functions, its keys in case_keys.cpp, a line here.
/// Test: tests/common/cases/functions_test.cpp.

#include "common/cases/values.hpp"

#include <memory>
#include <string>

namespace diptych::cases {

/// @param section  [functions.NAME]
/// @throws base::InputError on missing keys, and on keys that this type does not have
std::shared_ptr<const functions::TimeFunction> read_function(const std::string& name,
                                                             const SectionValues& section);

}  // namespace diptych::cases
