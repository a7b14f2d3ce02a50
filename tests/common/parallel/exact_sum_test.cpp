#include "common/parallel/exact_sum.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace diptych::parallel {
namespace {

double sum_of(const std::vector<double>& numbers) {
  ExactSum sum;
  for (const double x : numbers)
    sum.add(x);
  return sum.value();
}

TEST(ExactSum, RoundsOnceAtItsEnd) {
  EXPECT_EQ(sum_of({}), 0);
  EXPECT_EQ(sum_of({1e16, 1, -1e16, 1}), 2);
  EXPECT_EQ(sum_of({1, 0x1p-53}), 1);  // to even
  EXPECT_EQ(sum_of({1, 0x1p-53, 0x1p-1074}), 1 + 0x1p-52);
  EXPECT_EQ(sum_of({-1, -0x1p-53, -0x1p-1074}), -1 - 0x1p-52);
  EXPECT_EQ(sum_of({0x1p-1074, 0x1p-1074}), 0x1p-1073);
  EXPECT_EQ(sum_of({0x1p1023, 0x1p1023, -0x1p1023}), 0x1p1023);
  EXPECT_EQ(sum_of({0x1p1023, 0x1p1023}), std::numeric_limits<double>::infinity());
  EXPECT_EQ(sum_of({1e300, 1e-300, -1e300}), 1e-300);
}

TEST(ExactSum, OfOneNumberIsTheNumber) {
  std::mt19937_64 random(3);
  for (int exponent = -1074; exponent < 1024; ++exponent) {
    const double x = std::ldexp(0.5 + 0.5 * std::generate_canonical<double, 53>(random), exponent);
    EXPECT_EQ(sum_of({x}), x) << exponent;
    EXPECT_EQ(sum_of({-x}), -x) << exponent;
  }
}

/// Sums of 1024 numbers of 31 bits and exponents from 0 to 20 that an integer holds, too.
TEST(ExactSum, IsThatOfIntegersInAnyOrder) {
  std::mt19937_64 random(7);
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<double> numbers;
    std::int64_t integer = 0;
    for (int i = 0; i < 1024; ++i) {
      const auto mantissa = static_cast<std::int64_t>(random() >> 33) - (std::int64_t{1} << 30);
      const int exponent = static_cast<int>(random() % 21);
      numbers.push_back(std::ldexp(static_cast<double>(mantissa), exponent));
      integer += mantissa * (std::int64_t{1} << exponent);
    }
    const double sum = sum_of(numbers);
    EXPECT_EQ(sum, static_cast<double>(integer));
    std::shuffle(numbers.begin(), numbers.end(), random);
    EXPECT_EQ(sum_of(numbers), sum);

    ExactSum parts[2];
    for (size_t i = 0; i < numbers.size(); ++i)
      parts[i % 3 == 0].add(numbers[i]);
    for (size_t w = 0; w < parts[0].words().size(); ++w)
      parts[0].words()[w] += parts[1].words()[w];
    EXPECT_EQ(parts[0].value(), sum);
  }
}

TEST(ExactSum, OfNoNumbersIsNone) {
  const double infinity = std::numeric_limits<double>::infinity(), nan = std::nan("");
  EXPECT_TRUE(std::isnan(sum_of({1, nan, 2})));
  EXPECT_TRUE(std::isnan(sum_of({infinity, -infinity})));
  EXPECT_EQ(sum_of({1, infinity}), infinity);
  EXPECT_EQ(sum_of({-infinity, 1e308}), -infinity);
}

}  // namespace
}  // namespace diptych::parallel
