/// A case that says two things of its initial state is refused; one whose F is that of its
/// displacement is not, wherever that has kinks or no value.

#include "common/parallel/for_chunks.hpp"
#include "tests/common/scheme/scenes.hpp"

#include <gmock/gmock.h>

namespace diptych::run {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const char* const strip = R"([mesh]
element = "quadrilateral"
upper = [1, 0.5]
cells = [8, 4]
[material]
model = "neo-hookean"
density = 1100
youngs_modulus = 17e6
poissons_ratio = 0.3
[time]
end = 1e-3
)";

class InitialDeformation : public testing::Test {
 protected:
  void SetUp() override { parallel::set_threads(1); }  // 45 nodes
  void TearDown() override { parallel::set_threads(0); }
};

/// What is said of a start; empty where it is taken.
std::string refusal(const std::string& u_x, const std::string& F_xx, const std::string& F_xy) {
  const std::string text = std::string(strip) + "[initial]\ndisplacement = [\"" + u_x +
                           "\", 0]\ndeformation_gradient = [[\"" + F_xx + "\", \"" + F_xy +
                           "\"], [0, 1]]\n";
  const std::string by_sph = tests::refusal_of("sph", text),
                    by_fvm = tests::refusal_of("fvm", text);
  EXPECT_EQ(by_sph.empty(), by_fvm.empty()) << by_sph << by_fvm;
  return by_fvm;
}

TEST_F(InitialDeformation, MustBeThatOfTheDisplacement) {
  EXPECT_THAT(refusal("0.5*x", "1", "0"),
              AllOf(HasSubstr("scene: initial.deformation_gradient is not that of"),
                    HasSubstr("its column 1 is (1, 0)"), HasSubstr("derivative (1.5, 0) along x")));
  EXPECT_THAT(refusal("0.5*y", "1", "0"), HasSubstr("derivative (0.5, 1) along y"));
  EXPECT_THAT(refusal("0", "1.5", "0"), HasSubstr("initial.displacement, which is 0: at"));
  EXPECT_THAT(refusal("0.1*x^2", "1 + 0.1*x", "0"), HasSubstr("column 1"));
}

TEST_F(InitialDeformation, IsTakenWhereItIs) {
  EXPECT_EQ(refusal("0.5*x", "1.5", "0"), "");
  EXPECT_EQ(refusal("0.1*sin(3*x)*y", "1 + 0.3*cos(3*x)*y", "0.1*sin(3*x)"), "");
  EXPECT_EQ(refusal("0.1*abs(x - 0.5)", "x < 0.5 ? 0.9 : 1.1", "0"), "") << "a kink at nodes";
  EXPECT_EQ(refusal("0.1*abs(x - 0.5)", "x > 0.5 ? 1.1 : 0.9", "0"), "") << "its other side";
  EXPECT_EQ(refusal("0.1*(x - x^2)^1.5", "1 + 0.15*(1 - 2*x)*sqrt(x - x^2)", "0"), "")
      << "no value outside of the body";
  EXPECT_EQ(refusal("1e3 + 1e-6*x", "1 + 1e-6", "0"), "") << "a small strain far away";
}

}  // namespace
}  // namespace diptych::run
