#pragma once
/// The cases that a name stands for: folders NAME/case.toml of one folder, the shipped ones or
/// those of the user (--cases). Test: tests/command_line/case_folder_test.cpp

#include <string>
#include <vector>

namespace diptych::harness {

/// Folder in which names of cases are looked up.
/// @param asked  of --cases; empty: the environment variable DIPTYCH_CASES, else the shipped cases
std::string cases_folder(const std::string& asked = {});

struct ListedCase {
  std::string name, file;
};

/// The cases of a folder by name, unread.
/// @param asked  as of cases_folder
/// @throws base::InputError where there is none: the folder, and what it should hold
std::vector<ListedCase> listed_cases(const std::string& asked = {});

/// Path of a case file: the word where it is a file or a folder with a case.toml, else the case of
/// that name. With `asked` a word without '/' that does not end in .toml is a name.
/// @param asked  as of cases_folder
/// @throws base::InputError with the nearest name
std::string find_case(const std::string& word, const std::string& asked = {});

}  // namespace diptych::harness
