/// The tables of sbp_operator.hpp, in exact fractions, and what the operators make of lines.

#include "common/closure/sbp_operator.hpp"

#include "common/base/error.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numeric>

namespace diptych::graphs {
namespace {

using closure::Rational;
using closure::SbpTable;

/// Numbers here stay below 1e20, products of numerators below 1e38.
__extension__ typedef __int128 Integer;

/// An exact fraction in lowest terms.
struct Fraction {
  Integer over = 0, under = 1;

  Fraction(Integer n) : over(n) {}
  Fraction(Integer n, Integer d) : over(n), under(d) { reduce(); }
  explicit Fraction(const Rational& r) : Fraction(r.numerator, r.denominator) {}

  friend Fraction operator+(const Fraction& a, const Fraction& b) {
    return {a.over * b.under + b.over * a.under, a.under * b.under};
  }
  friend Fraction operator*(const Fraction& a, const Fraction& b) {
    return {a.over * b.over, a.under * b.under};
  }
  Fraction operator-() const { return {-over, under}; }
  bool operator==(const Fraction& b) const { return over == b.over && under == b.under; }
  bool is_positive() const { return over > 0; }

 private:
  void reduce() {
    Integer a = over < 0 ? -over : over, b = under;
    while (b != 0) {
      const Integer rest = a % b;
      a = b;
      b = rest;
    }
    over /= a;
    under /= a;
  }
};

Fraction power(Integer x, int k) {
  Fraction result(1);
  for (int i = 0; i < k; ++i)
    result = result * Fraction(x);
  return result;
}

/// Q_ij of a half line whose block begins at node 0.
Fraction entry(const SbpTable& table, int i, int j) {
  if (i == j) return i == 0 ? Fraction(-1, 2) : Fraction(0);
  if (i > j) return -entry(table, j, i);
  const int n = table.block_size();
  if (j < n) return Fraction(table.block[static_cast<size_t>(i * (2 * n - i - 1) / 2 + j - i - 1)]);
  const auto width = static_cast<int>(table.interior.size());
  return j - i <= width ? Fraction(table.interior[static_cast<size_t>(j - i - 1)]) : Fraction(0);
}

constexpr int orders[] = {2, 4, 6};

// Q is skew but for its corner by construction; D x^k = k x^(k-1) about the node itself.
TEST(SbpTables, AreExactForPolynomialsOfHalfTheOrderInTheBlock) {
  for (const int order : orders) {
    const SbpTable& table = closure::sbp_table(order);
    const int n = table.block_size(), width = static_cast<int>(table.interior.size());
    for (int i = 0; i < n; ++i) {
      for (int k = 0; k <= order / 2; ++k) {
        Fraction sum(0);
        for (int j = 0; j < n + width; ++j)
          sum = sum + entry(table, i, j) * power(j - i, k);
        const Fraction H(table.H[static_cast<size_t>(i)]);
        EXPECT_TRUE(sum == (k == 1 ? H : Fraction(0))) << order << " row " << i << " x^" << k;
      }
    }
  }
}

TEST(SbpTables, AreExactForPolynomialsOfTheOrderInside) {
  for (const int order : orders) {
    const SbpTable& table = closure::sbp_table(order);
    for (int k = 1; k <= order; ++k) {
      Fraction sum(0);
      for (int r = 1; r <= static_cast<int>(table.interior.size()); ++r) {
        const Fraction Q(table.interior[static_cast<size_t>(r - 1)]);
        sum = sum + Q * power(r, k) + (-Q) * power(-r, k);
      }
      EXPECT_TRUE(sum == Fraction(k == 1 ? 1 : 0)) << order << " x^" << k;
    }
  }
}

/// H integrates polynomials of degree order - 1 over the half line, as sums by parts imply: from 0
/// to N with the weights of the block mirrored. Here N = 2 block - 1.
TEST(SbpTables, HaveWeightsThatIntegrate) {
  for (const int order : orders) {
    const SbpTable& table = closure::sbp_table(order);
    const int n = table.block_size(), N = 2 * n - 1;
    for (int k = 0; k < order; ++k) {
      Fraction sum(0);
      for (int i = 0; i <= N; ++i) {
        const Fraction H(table.H[static_cast<size_t>(std::min(i, N - i))]);
        EXPECT_TRUE(H.is_positive());
        sum = sum + H * power(i, k);
      }
      EXPECT_TRUE(sum == power(N, k + 1) * Fraction(1, k + 1)) << order << " x^" << k;
    }
  }
}

TEST(SbpOperator, SumsByPartsOnEveryLine) {
  for (const int order : orders) {
    const SbpTable& table = closure::sbp_table(order);
    for (const int n : {table.least_nodes(), table.least_nodes() + 1, 30}) {
      const closure::SbpOperator D(table, n);
      std::map<std::pair<int, int>, double> Q;
      double length = 0;
      for (int i = 0; i < n; ++i) {
        length += D.H(i);
        EXPECT_EQ(D.H(i), D.H(n - 1 - i));
        for (const auto& entry : D.row(i))
          Q[{i, entry.node}] = entry.Q;
      }
      EXPECT_NEAR(length, n - 1, 1e-13 * n);
      for (const auto& [place, value] : Q) {
        const auto [i, j] = place;
        EXPECT_EQ((Q[{j, i}]), -value) << order << " " << n << " " << i << " " << j;
        EXPECT_EQ((Q[{n - 1 - i, n - 1 - j}]), -value) << order << " " << n << " " << i << " " << j;
      }
    }
  }
}

// The diagonal, which the rows leave out, is -1/2 and 1/2 at the ends.
TEST(SbpOperator, IsExactForPolynomialsOfHalfTheOrderOnShortLines) {
  for (const int order : orders) {
    const SbpTable& table = closure::sbp_table(order);
    const int n = table.least_nodes();
    const closure::SbpOperator D(table, n);
    for (int i = 0; i < n; ++i) {
      for (int k = 0; k <= order / 2; ++k) {
        double sum = k > 0 ? 0 : i == 0 ? -0.5 : i == n - 1 ? 0.5 : 0;
        for (const auto& entry : D.row(i))
          sum += entry.Q * std::pow(entry.node - i, k);
        EXPECT_NEAR(sum, k == 1 ? D.H(i) : 0, 1e-13) << order << " row " << i << " x^" << k;
      }
    }
  }
}

// Of lines that are too short for blocks: exact for polynomials of degree two, weights for cubics,
// and pairs of neighbours that all count the same.
TEST(SbpTables, OfShortLinesAreExactForQuadratics) {
  for (int n = 3; n <= 7; ++n) {
    const SbpTable& table = closure::sbp_line_table(n);
    ASSERT_EQ(table.block_size(), n);
    for (int i = 0; i < n; ++i) {
      for (int k = 0; k <= 2; ++k) {
        Fraction sum = i == n - 1 && k == 0 ? Fraction(1, 2) : Fraction(0);
        for (int j = 0; j < n; ++j)
          sum = sum + entry(table, i, j) * power(j - i, k);
        EXPECT_TRUE(sum == (k == 1 ? Fraction(table.H[static_cast<size_t>(i)]) : Fraction(0)))
            << n << " row " << i << " x^" << k;
      }
      if (i + 1 < n) {
        EXPECT_TRUE(entry(table, i, i + 1) == entry(table, 0, 1)) << n << " " << i;
      }
    }
    for (int k = 0; k <= 3; ++k) {
      Fraction sum(0);
      for (int i = 0; i < n; ++i)
        sum = sum + Fraction(table.H[static_cast<size_t>(i)]) * power(i, k);
      EXPECT_TRUE(sum == power(n - 1, k + 1) * Fraction(1, k + 1)) << n << " x^" << k;
    }
  }
}

TEST(SbpOperator, OfShortLinesSumsByParts) {
  for (int n = 3; n <= 7; ++n) {
    const closure::SbpOperator D(closure::widest_sbp_table(6, n), n);
    std::map<std::pair<int, int>, double> Q;
    for (int i = 0; i < n; ++i) {
      EXPECT_EQ(D.H(i), D.H(n - 1 - i));
      for (const auto& entry : D.row(i))
        Q[{i, entry.node}] = entry.Q;
    }
    for (const auto& [place, value] : Q) {
      const auto [i, j] = place;
      EXPECT_EQ((Q[{j, i}]), -value) << n << " " << i << " " << j;
      EXPECT_EQ((Q[{n - 1 - i, n - 1 - j}]), -value) << n << " " << i << " " << j;
    }
  }
}

/// With weights that are exact for quadratics alone, rows cannot be exact for them, whatever Q: the
/// sum of x^2 times the error of (x^2)' over the block is a quarter.
TEST(SbpTables, OfGregorysWeightsAreExactForLinearFunctionsAndNearlyForQuadratics) {
  const SbpTable& table = closure::gregory_table(20);
  const int n = table.block_size(), width = static_cast<int>(table.interior.size());
  EXPECT_EQ(closure::gregory_table(8).block_size(), n);
  EXPECT_TRUE(closure::gregory_table(7).is_line);
  Fraction missed(0);
  for (int i = 0; i < n; ++i) {
    const Fraction H(table.H[static_cast<size_t>(i)]);
    std::array<Fraction, 3> of_power{Fraction(0), Fraction(0), Fraction(0)};
    for (int k = 0; k <= 2; ++k) {
      for (int j = 0; j < n + width; ++j)
        of_power[k] = of_power[k] + entry(table, i, j) * power(j - i, k);
    }
    EXPECT_TRUE(of_power[0] == Fraction(0)) << i;
    EXPECT_TRUE(of_power[1] == H) << i;
    EXPECT_LT(std::abs(static_cast<double>(of_power[2].over)),
              0.08 * static_cast<double>(of_power[2].under))
        << i;
    missed = missed + of_power[2] * power(i, 2);
  }
  EXPECT_TRUE(missed == Fraction(1, 4));
}

/// On rings Q is skew, H one, and waves have the derivative of the interior weights.
TEST(SbpOperator, OfRingsIsTheInteriorEverywhere) {
  for (const auto& [order, n] : {std::pair{2, 3}, {4, 5}, {4, 24}, {6, 7}, {6, 24}}) {
    const closure::SbpOperator D = closure::SbpOperator::closed(order, n);
    EXPECT_EQ(closure::widest_closed_table(order, n).order, order);
    const double step = 2 * std::acos(-1.0) / n;
    double symbol = 0;
    for (size_t k = 0; k < closure::sbp_table(order).interior.size(); ++k)
      symbol += 2 * closure::sbp_table(order).interior[k].value() *
                std::sin(static_cast<double>(k + 1) * step);
    for (int i = 0; i < n; ++i) {
      EXPECT_EQ(D.H(i), 1);
      double sum = 0, derivative = 0;
      for (const auto& [j, Q] : D.row(i)) {
        sum += Q;
        derivative += Q * std::sin(j * step);
        for (const auto& back : D.row(j))
          EXPECT_TRUE(back.node != i || back.Q == -Q);
      }
      EXPECT_NEAR(sum, 0, 1e-15);
      EXPECT_NEAR(derivative, symbol * std::cos(i * step), 1e-15);
    }
  }
  EXPECT_EQ(closure::widest_closed_table(6, 6).order, 4);
  EXPECT_EQ(closure::widest_closed_table(6, 4).order, 2);
}

TEST(SbpTables, FallToTheWidestThatFits) {
  const auto order = [](int asked, int n) { return closure::widest_sbp_table(asked, n).order; };
  EXPECT_EQ(order(6, 12), 6);
  EXPECT_EQ(order(6, 11), 4);
  EXPECT_EQ(order(6, 8), 4);
  EXPECT_EQ(order(6, 7), 2);
  EXPECT_TRUE(closure::widest_sbp_table(6, 7).is_line);
  EXPECT_FALSE(closure::widest_sbp_table(2, 7).is_line);
  EXPECT_EQ(order(4, 100), 4);
  EXPECT_EQ(order(4, 2), 2);
  EXPECT_EQ(order(2, 100), 2);
  EXPECT_THROW(closure::sbp_table(3), base::InputError);
}

}  // namespace
}  // namespace diptych::graphs
