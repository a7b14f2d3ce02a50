/// The verb: runs the cases, prints the table, records baselines.

#include "benchmarks/harness/backends.hpp"
#include "benchmarks/harness/case_list.hpp"
#include "benchmarks/harness/interruption.hpp"
#include "benchmarks/harness/progress.hpp"
#include "benchmarks/harness/provenance.hpp"
#include "benchmarks/harness/regress.hpp"
#include "benchmarks/harness/regress_table.hpp"
#include "common/base/error.hpp"
#include "common/base/text.hpp"
#include "common/io/atomic_file.hpp"
#include "common/io/run_record.hpp"
#include "common/run/case_reader.hpp"
#include "meshes/gmsh.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <set>

namespace diptych::harness {

namespace {

namespace fs = std::filesystem;

void print(const std::string& text) {
  std::fputs(text.c_str(), stdout);
  std::fflush(stdout);
}

std::vector<std::string> shipped_names() {
  std::vector<std::string> names;
  for (const auto& [name, title] : shipped_cases())
    names.push_back(name);
  return names;
}

void check_request(const RegressRequest& request) {
  if (request.bless.empty() && !request.why.empty())
    throw base::InputError("--why goes with --bless CASE");
  if (request.bless.empty()) return;
  if (!request.cases.empty())
    throw base::InputError("--bless names the case itself: give no other case");
  if (request.why.find_first_not_of(" \t\n") == std::string::npos)
    throw base::InputError("--bless needs --why \"...\": the reason is kept with the baseline");
}

std::vector<std::string> cases_of(const RegressRequest& request) {
  const std::vector<std::string> known = shipped_names();
  std::vector<std::string> wanted = request.cases;
  if (!request.bless.empty() && request.bless != "all") wanted = {request.bless};
  for (const std::string& name : wanted) {
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw base::InputError("no shipped case '" + name + "'" + base::suggestion(name, known));
  }
  return wanted.empty() ? known : wanted;
}

fs::path baseline_path(const std::string& name) {
  return fs::path(baselines_folder()) / (name + ".json");
}

/// What was recorded, or a case as it stands on two levels.
RegressBaseline baseline_of(const std::string& name) {
  const fs::path path = baseline_path(name);
  if (fs::exists(path)) {
    RegressBaseline baseline = baseline_from_json(io::read_file(path.string()), path.string());
    if (baseline.case_name != name)
      throw base::InputError(fmt::format("{}: is of case '{}'", path.string(), baseline.case_name));
    return baseline;
  }
  RegressBaseline baseline;
  baseline.case_name = name;
  baseline.levels = 2;
  return baseline;
}

/// The baseline that a measurement would make.
RegressBaseline record_of(RegressBaseline size,
                          const RegressMeasurement& now,
                          const std::string& why) {
  const io::Provenance p = provenance("");
  size.reason = why;
  size.commit = p.commit;
  size.date = p.date;
  size.platform = this_platform();
  size.methods.clear();
  for (const auto& [method, measurement] : now.methods)
    size.methods[method] = measurement.figures;
  size.disagreement.clear();
  for (const auto& [name, figure] : now.agreement) {
    if (figure.excess() > 1) size.disagreement[name] = figure.excess();
  }
  return size;
}

std::vector<RegressRow> rows_of(const std::string& name,
                                const RegressBaseline& baseline,
                                const RegressMeasurement& now) {
  const bool same_platform = baseline.platform == this_platform();
  std::vector<RegressRow> rows;
  for (const std::string& method : method_menu().names()) {
    const auto recorded = baseline.methods.find(method);
    const MethodFigures nothing{};
    const MethodFigures& old = recorded == baseline.methods.end() ? nothing : recorded->second;
    rows.push_back({name, method, checks_of(old, now.methods.at(method), same_platform)});
  }
  rows.push_back({name, "both", agreement_checks(baseline, now)});
  return rows;
}

/// Records a baseline. @return rows of what must hold whatever was recorded
std::vector<RegressRow> bless(const RegressBaseline& old,
                              const RegressMeasurement& now,
                              const std::string& why) {
  for (const auto& [method, measurement] : now.methods) {
    if (!measurement.failure.empty()) {
      throw base::BreakdownError(fmt::format("{} {}: {}; nothing is recorded", old.case_name,
                                             method, measurement.failure));
    }
  }
  const RegressBaseline record = record_of(old, now, why);
  const std::string text = to_json(record);  // before anything is said of it
  print(difference_text(old, record));
  io::make_directory(baselines_folder());
  io::write_file_atomically(baseline_path(old.case_name).string(), text);
  return rows_of(old.case_name, record, now);
}

/// Baselines of cases that are gone.
std::vector<RegressRow> orphans() {
  const std::vector<std::string> known = shipped_names();
  const std::set<std::string> names(known.begin(), known.end());
  std::vector<RegressRow> rows;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(baselines_folder(), error)) {
    const std::string name = entry.path().stem().string();
    if (entry.path().extension() != ".json" || names.count(name) > 0) continue;
    RegressCheck check{"record", entry.path().filename().string(), Verdict::failed, 0,
                       0,        "no case of this name is shipped"};
    rows.push_back({name, "-", {check}});
  }
  return rows;
}

std::vector<RegressRow> rows_of_case(const std::string& name, const RegressRequest& request) {
  const RegressBaseline baseline = baseline_of(name);
  const std::string file = find_case(name);
  const std::string mesh = run::read_case(file, baseline.set).mesh.file;
  if (fs::path(mesh).extension() == ".geo" && !meshes::has_gmsh()) {
    RegressCheck check{"run", "", Verdict::skipped, 0, 0, "its mesh needs the gmsh program"};
    return {{name, "both", {check}}};
  }
  const RegressMeasurement now = measure_regress(file, baseline, {}, request.threads);
  if (interrupt_requested()) return {};
  if (!request.bless.empty()) return bless(baseline, now, request.why);
  const fs::path measured = fs::path(request.directory) / (name + ".json");
  std::vector<RegressRow> rows = rows_of(name, baseline, now);
  try {
    io::write_file_atomically(measured.string(), to_json(record_of(baseline, now, "measured")));
  } catch (const base::InputError& error) {  // its figures have failed above
    std::fputs(
        fmt::format("diptych: {} is not written: {}\n", measured.string(), error.what()).c_str(),
        stderr);
  }
  return rows;
}

}  // namespace

void regress(const RegressRequest& request) {
  check_request(request);
  const std::vector<std::string> names = cases_of(request);
  for (const std::string& name : names)
    baseline_of(name);  // all are read before the first is run
  io::make_directory(request.directory);
  const auto start = std::chrono::steady_clock::now();
  const auto seconds = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  std::vector<RegressRow> rows;
  if (request.cases.empty() && request.bless.empty()) rows = orphans();
  for (size_t i = 0; i < names.size(); ++i) {
    const double before = seconds();
    const auto more = rows_of_case(names[i], request);
    if (interrupt_requested()) break;
    rows.insert(rows.end(), more.begin(), more.end());
    if (!request.quiet) {
      std::fputs(fmt::format("  {} of {}: {}, {:.1f} s\n", i + 1, names.size(), names[i],
                             seconds() - before)
                     .c_str(),
                 stderr);
    }
  }
  const std::string table = regress_table(rows) + fmt::format("{}\n", duration_text(seconds()));
  print(table);
  const std::string file = (fs::path(request.directory) / "regress.txt").string();
  io::write_file_atomically(file, table);
  print("output: " + file + "\n");
  if (interrupt_requested()) return;
  if (has_failed(rows)) throw base::BoundError("a bound was not met; see above");
}

}  // namespace diptych::harness
