#include "benchmarks/verbs/case_arguments.hpp"

#include "benchmarks/harness/backends.hpp"
#include "benchmarks/harness/case_list.hpp"
#include "benchmarks/harness/case_mesh.hpp"
#include "common/run/case_reader.hpp"

#include <cstdio>
#include <filesystem>

namespace diptych::verbs {

void CaseArguments::declare_case(CommandLine& line) {
  line.word("case", case_name, "path of a case file or its folder, or a name of 'list'");
  line.option("--cases", cases_folder, cases_help);
}

void CaseArguments::declare(CommandLine& line) {
  declare_case(line);
  line.option("--level", level, "the mesh spacing is divided by 2^level");
  line.option("--threads", threads, "0: all processors");
  line.repeated("--set", overrides, "key=value, overrides the case file; repeatable");
  line.option("--out", directory, "output folder (default results/CASE)");
  line.flag("--quiet", quiet, "no progress");
  line.flag("--no-fields", no_fields, "write no field frames");
}

void CaseArguments::declare_with_method(CommandLine& line) {
  declare(line);
  line.option("--method", method, "sph, fvm or both");
}

std::string CaseArguments::file() const {
  return harness::find_case(case_name, cases_folder);
}

run::Case CaseArguments::read() const {
  harness::check_level(level);
  return run::read_case(file(), overrides);
}

std::vector<std::string> CaseArguments::methods() const {
  if (method == "both") return harness::method_menu().names();
  harness::method_menu().at(method);
  return {method};
}

std::string CaseArguments::output_folder(const run::Case& setup) const {
  if (!directory.empty()) return directory;
  return (std::filesystem::path("results") / setup.name).string();
}

harness::StudyOptions CaseArguments::study_options(const run::Case& setup) const {
  harness::StudyOptions options;
  options.methods = methods();
  options.levels = {level};
  options.threads = threads;
  options.directory = output_folder(setup);
  options.fields = !no_fields;
  options.quiet = quiet;
  return options;
}

void print(const std::string& text) {
  std::fputs(text.c_str(), stdout);
  std::fflush(stdout);
}

void write_report(const run::Case& setup,
                  const harness::Study& study,
                  const std::string& folder,
                  const std::vector<harness::MethodConvergence>& convergence) {
  const std::string path = (std::filesystem::path(folder) / "report.html").string();
  report::write_report(path, harness::report_of(setup, study, convergence));
  print("\nreport: " + path + "\n");
}

}  // namespace diptych::verbs
