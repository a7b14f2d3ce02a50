#pragma once
/// The shipped cases: folders of benchmarks/cases with a case.toml.

#include <string>
#include <utility>
#include <vector>

namespace diptych::harness {

/// Folder of the shipped cases: the environment variable DIPTYCH_CASES, or the program's data.
std::string cases_folder();

/// (name, title), by name.
std::vector<std::pair<std::string, std::string>> shipped_cases();

/// Path of a case file: the argument where it is a file or a folder with a case.toml, else the
/// shipped case of that name. @throws base::InputError with the nearest name
std::string find_case(const std::string& name);

}  // namespace diptych::harness
