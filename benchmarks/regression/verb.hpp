#pragma once
/// The verb `diptych regress`: which cases, against which baselines, what is written.
/// Tests: tests/command_line/regress_test.cpp, tests/command_line/case_folder_test.cpp

#include <string>
#include <vector>

namespace diptych::harness {

struct RegressRequest {
  std::vector<std::string> cases;  ///< names or paths; empty: all of the folder
  std::string cases_folder;        ///< --cases; empty: see harness::cases_folder
  std::string baselines_folder;    ///< --baselines; empty: see harness::baselines_folder
  std::string bless, why;          ///< a case or "all"; the reason
  std::vector<std::string> set;    ///< with bless: the size, "key=value"
  int levels = 0;                  ///< with bless: 1 or 2; 0: as recorded, or 2
  std::string one_level_because;   ///< with levels = 1
  std::string directory;           ///< of regress.txt and what was measured
  std::string junit, json;         ///< files to write; empty: none
  int threads = 0;
  bool quiet = false;
};

/// Prints the table; writes it, what was measured, and the files that were asked for, also where a
/// case fails or cannot be read: the others go on.
/// @throws base::Error  after the table, with the code of exit_code_of
void regress(const RegressRequest& request);

}  // namespace diptych::harness
