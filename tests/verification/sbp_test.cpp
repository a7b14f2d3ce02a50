/// Operators that sum by parts, of both methods, on manufactured motions with a branch: orders
/// between two small levels and errors beside those of finite volumes with the edge stencil. The
/// orders that finer levels reach stand in the tables sbp and sbp-sph of benchmarks/verification.

#include "benchmarks/run/case_list.hpp"
#include "benchmarks/study/study.hpp"
#include "common/cases/reader.hpp"

#include <gtest/gtest.h>

namespace diptych {
namespace {

struct Expectation {
  const char* method;
  const char* stencil;  ///< what sums by parts
  const char* name;
  const char* boundary;  ///< velocity or traction
  const char* cells;
  double least_order_v, least_order_u, least_order_F, least_order_P;
  double most_of_edge;  ///< errors at the finer level over those of the edge stencil of fvm, every
                        ///< field
};

void PrintTo(const Expectation& e, std::ostream* out) {
  *out << e.method << " " << e.name << " " << e.boundary;
}

std::vector<io::RunSummary> runs_of(const Expectation& e,
                                    const std::string& method,
                                    const std::vector<int>& levels,
                                    const std::vector<std::string>& stencil) {
  std::vector<std::string> overrides{std::string("boundary.0.type=") + e.boundary,
                                     std::string("mesh.cells=") + e.cells, "output.frames=2"};
  overrides.insert(overrides.end(), stencil.begin(), stencil.end());
  harness::StudyOptions options;
  options.methods = {method};
  options.levels = levels;
  options.threads = 1;
  options.quiet = true;
  return harness::run_study(cases::read_case(harness::find_case(e.name), overrides), options).runs;
}

class SummingByParts : public testing::TestWithParam<Expectation> {};

TEST_P(SummingByParts, ConvergesFasterThanTheEdgeStencil) {
  const Expectation& e = GetParam();
  const auto sbp = runs_of(e, e.method, {0, 1}, {e.stencil, "sph.kappa=1.2"});
  const auto edge = runs_of(e, "fvm", {1}, {"fvm.stencil=edge"});
  const auto order = [&](const char* field) {
    return std::log2(sbp[0].errors.at(field).l2 / sbp[1].errors.at(field).l2);
  };
  EXPECT_GE(order("velocity"), e.least_order_v);
  EXPECT_GE(order("displacement"), e.least_order_u);
  EXPECT_GE(order("deformation_gradient"), e.least_order_F);
  EXPECT_GE(order("stress"), e.least_order_P);
  for (const char* field :
       {"velocity", "displacement", "deformation_gradient", "stress", "viscous_C"}) {
    EXPECT_LE(sbp[1].errors.at(field).l2, e.most_of_edge * edge[0].errors.at(field).l2) << field;
  }
}

constexpr const char* fvm_sbp = "fvm.stencil=sbp";
constexpr const char* sph_sbp = "sph.gradient=sbp";

INSTANTIATE_TEST_SUITE_P(
    Cases,
    SummingByParts,
    testing::Values(Expectation{"fvm", fvm_sbp, "manufactured-swirl-2d", "velocity", "[16, 16]",
                                2.7, 2.7, 2.4, 2.4, 0.2},
                    Expectation{"fvm", fvm_sbp, "manufactured-swirl-2d", "traction", "[16, 16]",
                                2.7, 2.7, 2.4, 2.4, 0.2},
                    Expectation{"fvm", fvm_sbp, "manufactured-wave-3d", "traction", "[8, 8, 8]",
                                2.7, 2.7, 2.4, 2.4, 0.2},
                    Expectation{"sph", sph_sbp, "manufactured-swirl-2d", "velocity", "[16, 16]",
                                2.7, 2.7, 2.4, 2.4, 0.2},
                    Expectation{"sph", sph_sbp, "manufactured-swirl-2d", "traction", "[16, 16]",
                                2.7, 2.7, 2.4, 2.4, 0.2},
                    Expectation{"sph", sph_sbp, "manufactured-wave-3d", "traction", "[8, 8, 8]",
                                2.7, 2.7, 2.1, 2.1, 0.334}));

}  // namespace
}  // namespace diptych
