/// The table of `diptych cost`: that every option of every column can be made and costs something.

#include "benchmarks/cost/option_costs.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace diptych::harness {
namespace {

TEST(OptionCosts, HasEachOptionForBothMethodsInBothDimensions) {
  const CostTable table = measure_option_costs(6, 1, true);
  ASSERT_EQ(table.columns.size(), 4u);
  ASSERT_GT(table.rows.size(), 20u);
  for (const CostRow& row : table.rows) {
    ASSERT_EQ(row.ns.size(), 4u) << row.option;
    const auto is_meant = [&](const CostRow& other) { return other.option == row.against; };
    EXPECT_EQ(std::count_if(table.rows.begin(), table.rows.end(), is_meant),
              row.against.empty() ? 0 : 1)
        << row.option << " is held against " << row.against;
    for (const double ns : row.ns) {
      EXPECT_GT(ns, 1) << row.option;
      EXPECT_LT(ns, 1e6) << row.option;
    }
  }
}

}  // namespace
}  // namespace diptych::harness
