#include "benchmarks/run/quantities.hpp"

#include "common/run/oscillation.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace diptych::harness {

namespace {

/// Recorded values of one probe: of every step where it was evaluated then, else of output times.
struct Record {
  std::vector<double> times, values;
};

template <class Row>
Record column_of(const std::vector<Row>& rows, size_t k) {
  Record record;
  for (const Row& row : rows) {
    record.times.push_back(row.time);
    record.values.push_back(row.probes.at(k));
  }
  return record;
}

io::QuantitySummary summary_of(const cases::ProbeCase& probe, const Record& record) {
  io::QuantitySummary q;
  q.name = probe.name;
  q.unit = probe.unit;
  q.final_value = record.values.back();
  q.least = *std::min_element(record.values.begin(), record.values.end());
  q.greatest = *std::max_element(record.values.begin(), record.values.end());
  if (!probe.oscillation) return q;
  if (const auto oscillation = run::oscillation_of(record.times, record.values)) {
    q.n_periods = oscillation->n_periods;
    q.period = oscillation->period;
    q.mean = oscillation->mean;
    q.amplitude = oscillation->amplitude;
    q.decrement = oscillation->decrement;
  }
  return q;
}

}  // namespace

std::vector<io::QuantitySummary> quantities_of(const std::vector<cases::ProbeCase>& probes,
                                               const RunResult& result) {
  std::vector<io::QuantitySummary> quantities;
  size_t n_stepped = 0;
  for (size_t k = 0; k < probes.size(); ++k) {
    const Record record =
        probes[k].every_step ? column_of(result.steps, n_stepped++) : column_of(result.history, k);
    quantities.push_back(summary_of(probes[k], record));
  }
  return quantities;
}

std::vector<std::string> probe_columns(const cases::Case& setup, bool stepped) {
  std::vector<std::string> columns;
  for (const cases::ProbeCase& probe : setup.probes) {
    if (!stepped || probe.every_step) columns.push_back(probe.column());
  }
  return columns;
}

std::string quantity_line(const io::QuantitySummary& q) {
  const std::string unit = q.unit == "-" ? "" : " " + q.unit;
  std::string line = fmt::format("{}: {:.6g}{} at the end, {:.6g} to {:.6g}", q.name, q.final_value,
                                 unit, q.least, q.greatest);
  if (q.n_periods > 0) {
    line +=
        fmt::format("; period {:.6g} s ({}), amplitude {:.4g}", q.period, q.n_periods, q.amplitude);
  }
  if (q.decrement) line += fmt::format(", decrement {:.3g}", *q.decrement);
  return line;
}

}  // namespace diptych::harness
