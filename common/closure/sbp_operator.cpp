#include "common/closure/sbp_operator.hpp"

#include "common/base/error.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fmt/format.h>

namespace diptych::closure {

namespace {

constexpr std::array<Rational, 1> H_2{{{1, 2}}};
constexpr std::array<Rational, 1> interior_2{{{1, 2}}};

constexpr std::array<Rational, 4> H_4{{{17, 48}, {59, 48}, {43, 48}, {49, 48}}};
constexpr std::array<Rational, 6> block_4{{{59, 96},
                                           {-1, 12},
                                           {-1, 32},  // row 0
                                           {59, 96},
                                           {0, 1},      // row 1
                                           {59, 96}}};  // row 2
constexpr std::array<Rational, 2> interior_4{{{2, 3}, {-1, 12}}};

constexpr std::array<Rational, 4> H_gregory{{{3, 8}, {7, 6}, {23, 24}, {1, 1}}};
constexpr std::array<Rational, 6> block_gregory{{{47523, 80264},
                                                 {-4749, 80264},
                                                 {-1321, 40132},  // row 0
                                                 {146783, 240792},
                                                 {-2107, 120396},    // row 1
                                                 {76301, 120396}}};  // row 2

constexpr std::array<Rational, 6> H_6{
    {{13649, 43200}, {12013, 8640}, {2711, 4320}, {5359, 4320}, {7877, 8640}, {43801, 43200}}};
constexpr std::array<Rational, 15> block_6{{{41863, 64800},
                                            {-15311, 259200},
                                            {-1739, 14400},
                                            {967, 51840},
                                            {1963, 129600},  // row 0
                                            {3761, 8640},
                                            {14933, 51840},
                                            {-73, 1728},
                                            {-3031, 86400},  // row 1
                                            {5861, 12960},
                                            {-1489, 17280},
                                            {439, 43200},  // row 2
                                            {17659, 25920},
                                            {-20327, 259200},  // row 3
                                            {203, 288}}};      // row 4
constexpr std::array<Rational, 3> interior_6{{{3, 4}, {-3, 20}, {1, 60}}};

constexpr std::array<Rational, 3> H_of_3{{{1, 3}, {4, 3}, {1, 3}}};
constexpr std::array<Rational, 3> Q_of_3{{{2, 3}, {-1, 6}, {2, 3}}};
constexpr std::array<Rational, 4> H_of_4{{{3, 8}, {9, 8}, {9, 8}, {3, 8}}};
constexpr std::array<Rational, 6> Q_of_4{{{9, 16}, {0, 1}, {-1, 16}, {9, 16}, {0, 1}, {9, 16}}};
constexpr std::array<Rational, 5> H_of_5{{{3, 8}, {7, 6}, {11, 12}, {7, 6}, {3, 8}}};
constexpr std::array<Rational, 10> Q_of_5{{{7, 12},
                                           {-1, 16},
                                           {0, 1},
                                           {-1, 48},  // row 0
                                           {7, 12},
                                           {0, 1},
                                           {0, 1},  // row 1
                                           {7, 12},
                                           {-1, 16},  // row 2
                                           {7, 12}}};
constexpr std::array<Rational, 6> H_of_6{{{3, 8}, {7, 6}, {23, 24}, {23, 24}, {7, 6}, {3, 8}}};
constexpr std::array<Rational, 15> Q_of_6{{{83, 144},
                                           {-7, 144},
                                           {0, 1},
                                           {-5, 144},
                                           {1, 144},  // row 0
                                           {83, 144},
                                           {-7, 144},
                                           {1, 12},
                                           {-5, 144},  // row 1
                                           {83, 144},
                                           {-7, 144},
                                           {0, 1},  // row 2
                                           {83, 144},
                                           {-7, 144},  // row 3
                                           {83, 144}}};
constexpr std::array<Rational, 7> H_of_7{
    {{3, 8}, {7, 6}, {23, 24}, {1, 1}, {23, 24}, {7, 6}, {3, 8}}};
constexpr std::array<Rational, 21> Q_of_7{{{7, 12},   {-5, 96}, {-1, 36}, {0, 1}, {0, 1},
                                           {-1, 288},                                      // row 0
                                           {7, 12},   {0, 1},   {0, 1},   {0, 1}, {0, 1},  // row 1
                                           {7, 12},   {-5, 96}, {0, 1},   {0, 1},          // row 2
                                           {7, 12},   {0, 1},   {-1, 36},                  // row 3
                                           {7, 12},   {-5, 96},                            // row 4
                                           {7, 12}}};

constexpr int least_line = 3;
const std::array<SbpTable, 5>& line_tables() {
  static const std::array<SbpTable, 5> all{{{2, H_of_3, Q_of_3, {}, true},
                                            {2, H_of_4, Q_of_4, {}, true},
                                            {2, H_of_5, Q_of_5, {}, true},
                                            {2, H_of_6, Q_of_6, {}, true},
                                            {2, H_of_7, Q_of_7, {}, true}}};
  return all;
}

const std::array<SbpTable, 3>& tables() {
  static const std::array<SbpTable, 3> all{
      {{2, H_2, {}, interior_2}, {4, H_4, block_4, interior_4}, {6, H_6, block_6, interior_6}}};
  return all;
}

/// Q_ij of the block, i < j < n.
Rational block_entry(const SbpTable& table, int i, int j) {
  const int n = table.block_size();
  return table.block[static_cast<size_t>(i * (2 * n - i - 1) / 2 + j - i - 1)];
}

/// Q_ij, i != j, on a line of n nodes.
double entry(const SbpTable& table, int n, int i, int j) {
  if (i > j) return -entry(table, n, j, i);
  const int size = table.block_size();
  if (j < size) return block_entry(table, i, j).value();
  // seen from the other end rows and signs turn round: Q_ij = -Q_{n-1-i,n-1-j}
  if (i >= n - size) return block_entry(table, n - 1 - j, n - 1 - i).value();
  const auto width = static_cast<int>(table.interior.size());
  return j - i <= width ? table.interior[static_cast<size_t>(j - i - 1)].value() : 0;
}

}  // namespace

const SbpTable& sbp_table(int order) {
  for (const SbpTable& table : tables()) {
    if (table.order == order) return table;
  }
  throw base::InputError(
      fmt::format("order {} of operators that sum by parts is unknown; use 2, 4 or 6", order));
}

const SbpTable& gregory_table(int n_nodes) {
  static const SbpTable two_blocks{4, H_gregory, block_gregory, interior_4};
  return n_nodes < two_blocks.least_nodes() ? widest_sbp_table(4, n_nodes) : two_blocks;
}

const SbpTable& sbp_line_table(int n) {
  return line_tables()[static_cast<size_t>(n - least_line)];
}

const SbpTable& widest_sbp_table(int order, int n_nodes) {
  const SbpTable* widest = &sbp_table(order);
  if (order > 2 && n_nodes >= least_line && n_nodes < sbp_table(4).least_nodes())
    return sbp_line_table(n_nodes);
  while (widest->least_nodes() > n_nodes && widest->order > 2)
    --widest;
  return *widest;
}

const SbpTable& widest_closed_table(int order, int n_nodes) {
  const SbpTable* widest = &sbp_table(order);
  while (2 * std::ssize(widest->interior) >= n_nodes && widest->order > 2)
    --widest;
  return *widest;
}

SbpOperator SbpOperator::closed(int order, int n_nodes) {
  const SbpTable& table = widest_closed_table(order, n_nodes);
  const auto width = static_cast<int>(table.interior.size());
  SbpOperator ring;
  ring.H_.assign(static_cast<size_t>(n_nodes), 1.0);
  ring.first_.push_back(0);
  for (int i = 0; i < n_nodes; ++i) {
    for (int step = -width; step <= width; ++step) {
      if (step == 0) continue;
      const double Q = table.interior[static_cast<size_t>(std::abs(step) - 1)].value();
      ring.entries_.push_back({(i + step + n_nodes) % n_nodes, step > 0 ? Q : -Q});
    }
    std::sort(ring.entries_.begin() + ring.first_.back(), ring.entries_.end(),
              [](const Entry& a, const Entry& b) { return a.node < b.node; });
    ring.first_.push_back(static_cast<std::int64_t>(ring.entries_.size()));
  }
  return ring;
}

SbpOperator::SbpOperator(const SbpTable& table, int n_nodes) : first_(1, 0) {
  const int size = table.block_size();
  const int reach = std::max(size - 1, static_cast<int>(table.interior.size()));
  for (int i = 0; i < n_nodes; ++i) {
    const int from_end = std::min(i, n_nodes - 1 - i);
    H_.push_back(from_end < size ? table.H[static_cast<size_t>(from_end)].value() : 1);
    for (int j = std::max(0, i - reach); j <= std::min(n_nodes - 1, i + reach); ++j) {
      if (j == i) continue;
      const double Q = entry(table, n_nodes, i, j);
      if (Q != 0) entries_.push_back({j, Q});
    }
    first_.push_back(static_cast<std::int64_t>(entries_.size()));
  }
}

}  // namespace diptych::closure
