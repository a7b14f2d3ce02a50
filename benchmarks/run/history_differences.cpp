#include "benchmarks/run/history_differences.hpp"

#include <algorithm>
#include <cmath>

namespace diptych::harness {

std::map<std::string, double> history_differences(const std::vector<std::string>& names,
                                                  const std::vector<io::HistoryRow>& a,
                                                  const std::vector<io::HistoryRow>& b) {
  std::map<std::string, double> differences;
  const size_t n = std::min(a.size(), b.size());
  for (size_t k = 0; k < names.size() && n > 0; ++k) {
    double square = 0, largest = 0;
    for (size_t i = 0; i < n; ++i) {
      const double one = a[i].probes[k], other = b[i].probes[k];
      square += (one - other) * (one - other);
      largest = std::max({largest, std::abs(one), std::abs(other)});
    }
    differences[names[k]] = largest > 0 ? std::sqrt(square / static_cast<double>(n)) / largest : 0;
  }
  return differences;
}

}  // namespace diptych::harness
