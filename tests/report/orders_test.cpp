/// Orders of convergence and the order of runs and fields.

#include "postprocess/report/orders.hpp"

#include "tests/report/sample_study.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <gmock/gmock.h>
#include <limits>

namespace diptych::report {
namespace {

using testing::ElementsAre;

TEST(ObservedOrder, IsTheSlopeInLogarithms) {
  EXPECT_DOUBLE_EQ(observed_order(8, 1, 2, 1), 3);
  EXPECT_NEAR(observed_order(std::pow(0.3, 1.7), std::pow(0.1, 1.7), 0.3, 0.1), 1.7, 1e-14);
  EXPECT_DOUBLE_EQ(observed_order(1, 2, 2, 1), -1) << "errors that grow have a negative order";
}

TEST(ObservedOrder, IsNoNumberWhereNoOrderIs) {
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(std::isnan(observed_order(1, 0, 2, 1)));
  EXPECT_TRUE(std::isnan(observed_order(inf, 1, 2, 1)));
  EXPECT_TRUE(std::isnan(observed_order(2, 1, 1, 1)));
  EXPECT_TRUE(std::isnan(observed_order(2, 1, -2, 1)));
  EXPECT_TRUE(std::isnan(observed_order(std::nan(""), 1, 2, 1)));
}

TEST(StudyOrder, PutsSphFirstLevelsCoarseToFineAndFieldsAsTheEquations) {
  StudyReport study = test::sample_study();
  study.runs[0].errors["pressure"] = {};
  EXPECT_THAT(methods_of(study.runs), ElementsAre("sph", "fvm"));
  const std::vector<io::RunSummary> fvm = runs_of(study.runs, "fvm");
  ASSERT_EQ(fvm.size(), 3u);
  EXPECT_EQ(fvm[0].level, 0);
  EXPECT_EQ(fvm[2].level, 2);
  EXPECT_THAT(fields_of(study.runs), ElementsAre("velocity", "displacement", "deformation_gradient",
                                                 "stress", "pressure"));
}

}  // namespace
}  // namespace diptych::report
