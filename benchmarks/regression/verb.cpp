/// The verb: runs the cases, prints the table, writes what was asked for.

#include "benchmarks/regression/verb.hpp"

#include "benchmarks/run/backends.hpp"
#include "benchmarks/run/interruption.hpp"
#include "benchmarks/run/menus.hpp"
#include "benchmarks/run/provenance.hpp"
#include "benchmarks/terminal/output.hpp"
#include "benchmarks/terminal/progress.hpp"
#include "benchmarks/terminal/schedule.hpp"
#include "common/base/error.hpp"
#include "common/io/atomic_file.hpp"
#include "common/io/run_record.hpp"
#include "meshes/gmsh.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <new>

namespace diptych::harness {

namespace {

namespace fs = std::filesystem;

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
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
    const MethodMeasurement& measured = now.methods.at(method);
    rows.push_back({name, method, checks_of(old, measured, same_platform), measured.seconds});
  }
  rows.push_back({name, "both", agreement_checks(baseline, now)});
  return rows;
}

void write_measured(const RegressRequest& request,
                    const RegressBaseline& baseline,
                    const RegressMeasurement& now) {
  const std::string path = (fs::path(request.directory) / (baseline.case_name + ".json")).string();
  std::string text;
  try {
    text = to_json(record_of(baseline, now, "measured"));
  } catch (const base::InputError& error) {  // its figures have failed in the table
    std::fputs(fmt::format("diptych: {} is not written: {}\n", path, error.what()).c_str(), stderr);
    return;
  }
  io::write_file_atomically(path, text);
}

/// The pass numbers of the case itself, added to the rows of its methods, which may be none.
std::vector<RegressRow> with_expected(std::vector<RegressRow> rows,
                                      const std::string& name,
                                      const cases::Case& setup,
                                      int threads) {
  if (!setup.expect.is_given) return rows;
  const auto measured = measure_expectations(setup, threads);
  for (const std::string& method : method_menu().names()) {
    const auto found = measured.find(method);
    if (found == measured.end()) continue;  // interrupted
    auto row = std::find_if(rows.begin(), rows.end(),
                            [&](const RegressRow& other) { return other.method == method; });
    if (row == rows.end()) row = rows.insert(row, {name, method, {}, 0});
    row->checks.insert(row->checks.end(), found->second.checks.begin(), found->second.checks.end());
    row->seconds += found->second.seconds;
  }
  return rows;
}

/// Checks a case or records its baseline. @return empty after an interrupt
/// @throws base::Error where it cannot be judged
std::vector<RegressRow> judged(const ListedCase& entry, const RegressRequest& request) {
  const std::string path = baseline_path(request, entry.name);
  const bool blesses = !request.bless.empty(), has_baseline = fs::exists(path);
  const RegressBaseline old = has_baseline ? read_baseline(path, entry.name) : RegressBaseline{};
  const std::string mesh = harness::read_case(entry.file, old.set).mesh.file;
  const cases::Case as_it_stands = harness::read_case(entry.file);
  if (fs::path(mesh).extension() == ".geo" && !meshes::has_gmsh()) {
    RegressCheck check{"run", "", Verdict::skipped, 0, 0, "its mesh needs the gmsh program"};
    return {{entry.name, "both", {check}}};
  }
  // --bless all records what has been recorded, and no case that asks for its pass numbers alone
  const bool is_recorded = blesses && request.bless != "all";
  if (!has_baseline && as_it_stands.expect.is_given && !is_recorded)
    return with_expected({}, entry.name, as_it_stands, request.threads);
  if (!has_baseline && !blesses) {
    const std::string note = fmt::format(
        "{} is not there; 'diptych regress --bless {} --why \"...\"', with the same --cases and "
        "--baselines, records it",
        path, entry.name);
    return {{entry.name, "both", {failure("record", "no baseline", note)}}};
  }
  const RegressBaseline size = blesses ? blessed_size(request, entry, old) : old;
  const RegressMeasurement now = measure_regress(entry.file, size, {}, request.threads);
  if (interrupt_requested()) return {};
  if (blesses) {
    return with_expected(rows_of(entry.name, recorded(request, old, size, now), now), entry.name,
                         as_it_stands, request.threads);
  }
  write_measured(request, size, now);
  return with_expected(rows_of(entry.name, size, now), entry.name, as_it_stands, request.threads);
}

/// What a case that cannot be judged looks like among the others.
RegressRow row_of_error(const std::string& name, base::ExitCode code, const std::string& what) {
  if (code == base::ExitCode::wrong_input)
    return {name, "both", {failure("case", "cannot be read", what, code)}};
  return {name, "both", {failure("run", kind_of(code), what, code)}};
}

/// The same, where one case does not end the others.
std::vector<RegressRow> judged_or_failed(const ListedCase& entry, const RegressRequest& request) {
  try {
    return judged(entry, request);
  } catch (const base::Error& error) {
    if (!request.bless.empty() && request.bless != "all") throw;
    return {row_of_error(entry.name, error.code(), error.what())};
  } catch (const std::bad_alloc&) {
    return {row_of_error(entry.name, base::ExitCode::environment,
                         "out of memory; record a smaller size")};
  }
}

void write_files(const RegressRequest& request, const RegressReport& report) {
  const auto write = [](const std::string& path, const std::string& text) {
    const fs::path folder = fs::path(path).parent_path();
    if (!folder.empty()) io::make_directory(folder.string());
    io::write_file_atomically(path, text);
  };
  if (!request.junit.empty()) write(request.junit, junit_xml(report));
  if (!request.json.empty()) write(request.json, regress_json(report));
}

void print_table(const RegressRequest& request, const RegressReport& report) {
  const std::string table =
      regress_table(report.rows()) + fmt::format("{}\n", duration_text(report.seconds));
  const std::string file = (fs::path(request.directory) / "regress.txt").string();
  print(table);
  io::write_file_atomically(file, table);
  std::string written = "output: " + file;
  for (const std::string& path : {request.junit, request.json}) {
    if (!path.empty()) written += ", " + path;
  }
  print(written + "\n");
}

}  // namespace

void regress(const RegressRequest& request) {
  const std::vector<ListedCase> cases = wanted_cases(request);
  io::make_directory(request.directory);
  const auto start = Clock::now();
  RegressReport report;
  report.provenance = provenance("");
  report.cases_folder = cases_folder(request.cases_folder);
  report.baselines_folder = baselines_folder(request.baselines_folder);
  if (request.cases.empty() && request.bless.empty()) report.cases = orphans(request);
  report.n_wanted = report.cases.size() + cases.size();
  write_files(request, report);  // a kill leaves no file of an earlier check
  // cases have nothing in common: those to come take what those that are over took in the mean
  Schedule schedule(std::vector<PlannedRun>(cases.size(), {"", "case", 0, 3}));
  for (size_t i = 0; i < cases.size(); ++i) {
    const auto begin = Clock::now();
    RegressedCase entry{cases[i].name, cases[i].file, baseline_path(request, cases[i].name), 0, {}};
    entry.rows = judged_or_failed(cases[i], request);
    if (interrupt_requested()) break;
    entry.seconds = seconds_since(begin);
    report.cases.push_back(entry);
    schedule.finish(entry.seconds);
    if (!request.quiet) {
      const auto left = schedule.seconds_left();
      const bool is_last = i + 1 == cases.size();
      std::fputs(fmt::format(
                     "  {} of {}: {}, {:.1f} s{}\n", i + 1, cases.size(), entry.name, entry.seconds,
                     left && !is_last ? fmt::format("; about {} left", duration_text(*left)) : "")
                     .c_str(),
                 stderr);
    }
  }
  report.seconds = seconds_since(start);
  report.state = interrupt_requested() ? RegressState::interrupted : RegressState::done;
  write_files(request, report);
  print_table(request, report);
  const std::vector<RegressRow> rows = report.rows();
  if (interrupt_requested() || !has_failed(rows)) return;
  throw base::Error(exit_code_of(rows), failures_in_words(rows) + "; see above");
}

}  // namespace diptych::harness
