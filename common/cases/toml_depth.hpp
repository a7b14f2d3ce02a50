#pragma once
/// How deep a TOML text nests, before it is parsed: the parser and all that walks its tree call
/// themselves once a level, and a text of some kilobytes can ask for more levels than the stack
/// has. Test: tests/common/cases/hostile_cases_test.cpp.

#include <string>

namespace diptych::cases {

/// Refuses keys of more than 32 parts and values nested more than 32 deep; no case needs five.
/// @param file name for the place
/// @throws base::InputError with file:line:column of the first part too many
void check_depth(const std::string& text, const std::string& file);

}  // namespace diptych::cases
