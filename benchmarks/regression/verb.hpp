#pragma once
/// The verb `diptych regress`: which cases, against which baselines, what is written; new
/// baselines. Tests: tests/command_line/regress_test.cpp, tests/command_line/case_folder_test.cpp

#include "benchmarks/regression/report.hpp"
#include "benchmarks/run/case_list.hpp"

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

/// The cases of a request, unread: those that are named, that of --bless, or all of the folder.
/// @throws base::InputError for a request that contradicts itself, a word that is no case, a folder
///         without cases, two cases of one name, cases that are not shipped without --baselines
std::vector<ListedCase> wanted_cases(const RegressRequest& request);

/// Where the baseline of a case is, or would be.
std::string baseline_path(const RegressRequest& request, const std::string& case_name);

/// What was recorded of a case. @throws base::InputError for a file that is none, or of another
/// case
RegressBaseline read_baseline(const std::string& path, const std::string& case_name);

/// A failed case for every baseline whose case is gone from the folder of the request.
std::vector<RegressedCase> orphans(const RegressRequest& request);

/// The size at which a case is blessed: that of the request, else what was recorded, else the case
/// as it stands on levels 0 and 1 where that is a matter of seconds.
/// @param recorded  without methods where there is no baseline yet
/// @throws base::InputError for a first baseline without a size of a case that takes longer
RegressBaseline blessed_size(const RegressRequest& request,
                             const ListedCase& entry,
                             RegressBaseline recorded);

/// The baseline that a measurement makes.
RegressBaseline record_of(RegressBaseline size,
                          const RegressMeasurement& now,
                          const std::string& why);

/// Prints what changes and writes the new baseline.
/// @throws base::BreakdownError where a run broke down, base::InputError where a figure is not
///         finite: nothing is recorded
RegressBaseline recorded(const RegressRequest& request,
                         const RegressBaseline& old,
                         const RegressBaseline& size,
                         const RegressMeasurement& now);

}  // namespace diptych::harness
