#include "common/scheme/time_step.hpp"

#include "common/parallel/for_chunks.hpp"

#include <algorithm>

namespace diptych::scheme {

std::vector<double> geometric_rates(const PairGraph& graph) {
  const auto row_sum = [&](std::int64_t a) {
    double sum = 0;
    for (std::int64_t k = graph.row[a]; k < graph.row[a + 1]; ++k)
      sum += graph.C[k].norm();
    return sum;
  };
  const EqualGroups& rows = graph.classes.rows;
  std::vector<double> of_class;
  for (const std::int32_t a : rows.representative)
    of_class.push_back(row_sum(a));
  std::vector<double> rates(static_cast<size_t>(graph.n_nodes()));
  parallel::for_chunks(graph.n_nodes(), [&](std::int64_t begin, std::int64_t end, std::int64_t) {
    for (std::int64_t a = begin; a < end; ++a) {
      const double of_row = of_class.empty() ? row_sum(a) : of_class[rows.of[a]];
      rates[a] = 0.5 * of_row / graph.Omega[a];
    }
  });
  return rates;
}

double geometric_rate(const PairGraph& graph) {
  const std::vector<double> rates = geometric_rates(graph);
  return *std::max_element(rates.begin(), rates.end());
}

}  // namespace diptych::scheme
