/// A body under a uniform stress moves as a whole: an affine motion of the exact body force and
/// tractions has no error in space, at edges and corners neither, whatever carries the pressure.

#include "benchmarks/run/case_list.hpp"
#include "benchmarks/run/menus.hpp"
#include "benchmarks/run/run_case.hpp"

#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

namespace diptych::harness {
namespace {

struct Operators {
  const char* name;
  const char* method;
  std::vector<std::string> set;
};

void PrintTo(const Operators& o, std::ostream* out) {
  *out << o.name;
}

class UniformStress
    : public testing::TestWithParam<std::tuple<Operators, std::string, std::string>> {};

TEST_P(UniformStress, IsInBalanceAtEveryNode) {
  const auto& [operators, nodes, nu] = GetParam();
  std::vector<std::string> set{std::string("parameters.nu=") + nu, "output.frames=2", nodes};
  set.insert(set.end(), operators.set.begin(), operators.set.end());
  RunOptions options;
  options.method = operators.method;
  options.level = 1;
  options.threads = 1;
  options.quiet = true;
  const RunResult run = run_case(read_case(find_case("affine-motion-traction"), set), options);
  ASSERT_EQ(run.summary.status, "done");
  // what is left is the error of the time integration: up to 1.6e-4 and 2.1e-4 at the default step
  EXPECT_LE(run.summary.errors.at("deformation_gradient").linf, 3e-4);
  EXPECT_LE(run.summary.errors.at("stress").linf, 4e-4);
}

INSTANTIATE_TEST_SUITE_P(
    All,
    UniformStress,
    testing::Combine(
        testing::Values(Operators{"sph", "sph", {}},
                        Operators{"sph corrected", "sph", {"sph.gradient=corrected"}},
                        Operators{"sph sbp", "sph", {"sph.gradient=sbp"}},
                        Operators{"fvm", "fvm", {}},
                        Operators{"fvm sbp", "fvm", {"fvm.stencil=sbp"}}),
        testing::Values("mesh.perturbation=0", "mesh.perturbation=0.2", "mesh.element=tetrahedron"),
        testing::Values("0.3", "0.45")));

}  // namespace
}  // namespace diptych::harness
