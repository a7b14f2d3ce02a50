#include "benchmarks/cost/cost_verb.hpp"

#include "benchmarks/cost/option_costs.hpp"
#include "common/io/atomic_file.hpp"
#include "common/io/run_record.hpp"

#include <cstdio>
#include <filesystem>

namespace diptych::harness {

namespace {

void show(const std::string& table,
          const std::string& folder,
          const std::string& name,
          const std::string& csv) {
  std::fputs(table.c_str(), stdout);
  io::make_directory(folder);
  const std::string file = (std::filesystem::path(folder) / name).string();
  io::write_file_atomically(file, csv);
  std::fputs(("output: " + file + "\n").c_str(), stdout);
}

}  // namespace

void report_option_costs(const std::string& folder, bool quiet) {
  const auto table = measure_option_costs(20, 12, quiet);
  show(cost_text(table), folder, "option_costs.csv", cost_csv(table));
}

void report_size_costs(const SizeRequest& request, const std::string& folder) {
  const auto rows = measure_size_costs(request);
  if (!rows.empty()) show(size_text(rows), folder, "size_costs.csv", size_csv(rows));
}

}  // namespace diptych::harness
