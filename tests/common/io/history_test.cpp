/// history.csv: the same doubles come back; damage is refused with line and column.

#include "common/base/error.hpp"
#include "common/io/run_record.hpp"
#include "tests/common/io/scratch.hpp"

#include <gtest/gtest.h>

#include <clocale>
#include <cmath>
#include <gmock/gmock.h>
#include <limits>
#include <locale>

namespace diptych::io {
namespace {

using base::InputError;
using test::message_of;
using testing::HasSubstr;
using testing::StartsWith;

const std::vector<std::string> names{"tip z [m]", "v at (0, 0, \"top\") [m/s]"};

std::vector<HistoryRow> rows() {
  HistoryRow first;
  first.time = 0.1, first.step = 3, first.dt = 1.0 / 3;
  first.energy = {1e-300, -2.5, std::nextafter(1.0, 2.0), 4, 5, -7, 6e-17};
  first.linear_momentum[2] = -0.0, first.angular_momentum[0] = 1e22;
  first.min_jacobian = 0.7, first.involution_H = 1e-16, first.involution_J = 5e-324;
  first.least_cell_J = -0.3;
  first.probes = {1.25, -3};
  HistoryRow second = first;
  second.time = 0.2, second.step = 9'000'000'000;
  return {first, second};
}

TEST(History, IsReadBackBitForBit) {
  const std::string text = history_csv(rows(), names);
  const std::vector<HistoryRow> read = history_from_csv(text, "history.csv");
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(history_csv(read, names), text);
  EXPECT_EQ(read[0].dt, 1.0 / 3);
  EXPECT_EQ(read[0].energy.viscous_dissipation, std::nextafter(1.0, 2.0));
  EXPECT_EQ(read[0].energy.projection_work, -7);
  EXPECT_EQ(read[0].involution_J, 5e-324);
  EXPECT_EQ(read[0].least_cell_J, -0.3);
  EXPECT_TRUE(std::signbit(read[0].linear_momentum[2]));
  EXPECT_EQ(read[1].step, 9'000'000'000);
  EXPECT_EQ(read[1].probes, (std::vector<double>{1.25, -3}));
  EXPECT_EQ(probe_names_from_csv(text, "history.csv"), names);
}

TEST(History, IsReadAsColumnsOfAnyName) {
  const auto columns = history_columns_from_csv(history_csv(rows(), names), "history.csv");
  ASSERT_EQ(columns.size(), 22u);
  EXPECT_EQ(columns[0].name, "time");
  EXPECT_EQ(columns[0].unit, "s");
  EXPECT_EQ(columns[1].unit, "-") << "the number of the step";
  EXPECT_EQ(columns[21].name, "v at (0, 0, \"top\")");
  EXPECT_EQ(columns[21].unit, "m/s");
  EXPECT_EQ(columns[20].values, (std::vector<double>{1.25, 1.25}));
}

TEST(History, HeaderNamesUnits) {
  EXPECT_THAT(history_csv({}, {}), StartsWith("time [s],step,dt [s],kinetic energy [J],"));
  EXPECT_TRUE(history_from_csv(history_csv({}, {}), "history.csv").empty());
}

/// Decimal commas and grouped digits, as streams write them in much of the world.
struct CommaNumbers : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

TEST(History, DoesNotDependOnTheLocale) {
  const std::string before = history_csv(rows(), names);
  const std::locale plain = std::locale::global(std::locale(std::locale(), new CommaNumbers));
  std::setlocale(LC_ALL, "de_DE.UTF-8");  // where it is installed
  const std::string german = history_csv(rows(), names);
  const double dt = history_from_csv(german, "history.csv")[0].dt;
  std::locale::global(plain);
  std::setlocale(LC_ALL, "C");
  EXPECT_EQ(german, before);
  EXPECT_EQ(dt, 1.0 / 3);
}

TEST(History, RefusesDamageWithItsPlace) {
  const std::string text = history_csv(rows(), names);
  const auto refusal = [](const std::string& damaged) {
    return message_of<InputError>([&] { history_from_csv(damaged, "h.csv"); });
  };
  const auto with = [&text](const std::string& from, const std::string& to) {
    std::string changed = text;
    return changed.replace(changed.find(from), from.size(), to);
  };
  EXPECT_THAT(refusal(""), HasSubstr("h.csv:1: the file is empty"));
  EXPECT_THAT(refusal(with("dt [s]", "dt [ms]")),
              HasSubstr("column 3 is 'dt [ms]', expected 'dt [s]'"));
  EXPECT_THAT(refusal(with("\n0.10000000000000001", "\nnan")),
              HasSubstr("h.csv:2: column 'time [s]' holds 'nan'"));
  EXPECT_THAT(refusal(with("\n0.10000000000000001", "\n1e400")), HasSubstr("expected a number"));
  EXPECT_THAT(refusal(with(",3,", ",3.5,")), HasSubstr("column 'step' holds '3.5'"));
  EXPECT_THAT(refusal(with(",3,", ",-3,")), HasSubstr("expected a whole number >= 0"));
  EXPECT_THAT(refusal(with(",3,", ",3,,")), HasSubstr("23 values under 22 columns"));
  EXPECT_THAT(refusal(text.substr(0, text.size() - 4)), HasSubstr("cut off"));
  EXPECT_THAT(refusal("time [s],step\n"), HasSubstr("column 'dt [s]' is missing"));
}

TEST(ExactCsv, GivesBackItsColumns) {
  const std::vector<HistoryColumn> columns{{"time", "s", {0, 0.1}}, {"a, b", "-", {1e-300, -2}}};
  const std::string text = columns_csv(columns);
  EXPECT_EQ(text.substr(0, text.find('\n')), "time [s],\"a, b [-]\"");
  const auto read = columns_from_csv(text, "exact.csv");
  ASSERT_EQ(read.size(), 2u);
  for (size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(read[k].name, columns[k].name);
    EXPECT_EQ(read[k].unit, columns[k].unit);
    EXPECT_EQ(read[k].values, columns[k].values);
  }
  EXPECT_THROW(columns_from_csv(text.substr(0, text.size() - 1), "exact.csv"), base::InputError);
  EXPECT_THROW(columns_from_csv("", "exact.csv"), base::InputError);
}

}  // namespace
}  // namespace diptych::io
