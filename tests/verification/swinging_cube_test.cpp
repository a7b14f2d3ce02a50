/// Observed orders and error caps of the swinging cube (benchmarks A4), both methods. Caps are the
/// errors measured when the case was made plus a tenth: they hold the accuracy that was reached.

#include "benchmarks/run/case_list.hpp"
#include "benchmarks/study/study.hpp"
#include "common/cases/reader.hpp"

#include <gtest/gtest.h>

namespace diptych {
namespace {

struct Expectation {
  const char* name;
  const char* method;
  double least_order_v, least_order_P;  ///< between levels 1 and 2
  double most_v, most_P;                ///< relative L2 errors at level 2
};

void PrintTo(const Expectation& e, std::ostream* out) {
  *out << e.name << " " << e.method;
}

class SwingingCube : public testing::TestWithParam<Expectation> {};

TEST_P(SwingingCube, ConvergesAtSecondOrder) {
  const auto setup = cases::read_case(harness::find_case(GetParam().name));
  harness::StudyOptions options;
  options.methods = {GetParam().method};
  options.levels = {1, 2};
  options.threads = 1;
  options.quiet = true;
  const auto runs = harness::run_study(setup, options).runs;
  const auto order = [&](const char* field) {
    return std::log2(runs[0].errors.at(field).l2 / runs[1].errors.at(field).l2);
  };
  EXPECT_GE(order("velocity"), GetParam().least_order_v);
  EXPECT_GE(order("stress"), GetParam().least_order_P);
  EXPECT_LE(runs[1].errors.at("velocity").l2, GetParam().most_v);
  EXPECT_LE(runs[1].errors.at("stress").l2, GetParam().most_P);
  // numerical dissipation is of higher order than the error
  EXPECT_GE(std::log2(runs[0].energy.numerical_dissipation / runs[1].energy.numerical_dissipation),
            2.0);
}

INSTANTIATE_TEST_SUITE_P(
    Cases,
    SwingingCube,
    testing::Values(Expectation{"swinging-cube-elastic-hex", "sph", 1.9, 1.8, 5.5e-3, 3.3e-3},
                    Expectation{"swinging-cube-elastic-hex", "fvm", 1.8, 1.8, 2.2e-3, 1.6e-3},
                    Expectation{"swinging-cube-ve2-hex", "sph", 1.9, 1.8, 2.3e-3, 1.7e-3},
                    Expectation{"swinging-cube-ve2-hex", "fvm", 1.9, 1.8, 7.6e-4, 8.3e-4},
                    Expectation{"swinging-cube-elastic-tet", "sph", 1.8, 1.5, 5.4e-3, 7.9e-3},
                    Expectation{"swinging-cube-elastic-tet", "fvm", 1.8, 1.5, 4.5e-3, 8.4e-3},
                    Expectation{"swinging-cube-ve2-tet", "sph", 1.8, 1.5, 2.9e-3, 4.7e-3},
                    Expectation{"swinging-cube-ve2-tet", "fvm", 1.8, 1.5, 2.4e-3, 4.9e-3}));

TEST(SwingingCube, FaceCorrectionDividesStressErrorByFive) {
  const auto errors = [](const char* method, const char* kappa_f) {
    const auto setup =
        cases::read_case(harness::find_case("swinging-cube-elastic-hex"),
                         {std::string("scheme.face_correction=") + kappa_f,
                          "sph.gradient=corrected", "sph.kappa=1", "fvm.stencil=edge"});
    harness::StudyOptions options;
    options.methods = {method};
    options.levels = {2};
    options.threads = 1;
    options.quiet = true;
    return harness::run_study(setup, options).runs[0].errors;
  };
  for (const char* method : {"sph", "fvm"}) {
    const auto plain = errors(method, "0"), corrected = errors(method, "\"1/6\"");
    EXPECT_LE(corrected.at("stress").l2, 0.2 * plain.at("stress").l2) << method;
    EXPECT_LE(corrected.at("displacement").l2, 0.2 * plain.at("displacement").l2) << method;
  }
}

TEST(SwingingCubeVE2, ViscousDissipationOfTheMethodsAgreesWithinOnePercent) {
  const auto setup = cases::read_case(harness::find_case("swinging-cube-ve2-hex"));
  harness::StudyOptions options;
  options.levels = {2};
  options.threads = 1;
  options.quiet = true;
  const auto runs = harness::run_study(setup, options).runs;
  const double sph = runs[0].energy.viscous_dissipation, fvm = runs[1].energy.viscous_dissipation;
  EXPECT_GT(fvm, 0);
  EXPECT_NEAR(sph / fvm, 1, 0.01);
}

}  // namespace
}  // namespace diptych
