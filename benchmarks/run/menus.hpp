#pragma once
/// The menus of all rooms, and case files read with them: a wrong name is told with its place in
/// the file. Test: tests/command_line/bad_input_test.cpp

#include "common/cases/reader.hpp"

#include <string>
#include <vector>

namespace diptych::harness {

/// Of the rooms above common/cases.
const cases::Menus& menus();

/// cases::read_case with them. @throws base::InputError, base::EnvironmentError
cases::Case read_case(const std::string& path, const std::vector<std::string>& overrides = {});

}  // namespace diptych::harness
