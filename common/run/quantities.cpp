#include "common/run/quantities.hpp"

#include "common/run/oscillation.hpp"

#include <algorithm>
#include <string>

namespace diptych::run {

namespace {

/// Recorded values of one probe.
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
  if (const auto oscillation = oscillation_of(record.times, record.values)) {
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
                                               const std::vector<io::HistoryRow>& history,
                                               const std::vector<io::StepRow>& steps) {
  std::vector<io::QuantitySummary> quantities;
  size_t n_stepped = 0;
  for (size_t k = 0; k < probes.size(); ++k) {
    const Record record =
        probes[k].every_step ? column_of(steps, n_stepped++) : column_of(history, k);
    quantities.push_back(summary_of(probes[k], record));
  }
  return quantities;
}

}  // namespace diptych::run
