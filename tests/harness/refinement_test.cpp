/// Levels of a study that have the same nodes are refused.

#include "benchmarks/study/refinement.hpp"

#include "common/base/error.hpp"

#include <gmock/gmock.h>

namespace diptych::harness {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(Refinement, AsksForMoreNodesOnEachLevel) {
  cases::Case setup;
  setup.file = "case.toml";
  setup.mesh.file = "body.geo";
  setup.mesh.size = 0.3;
  io::RunSummary coarse, fine;
  coarse.nodes = fine.nodes = 143;
  EXPECT_NO_THROW(require_refined(setup, coarse, fine)) << "the same level";
  fine.level = 1;
  try {
    require_refined(setup, coarse, fine);
    FAIL() << "not refused";
  } catch (const base::InputError& error) {
    EXPECT_THAT(error.what(),
                AllOf(HasSubstr("case.toml: level 1 has as many nodes as level 0, 143"),
                      HasSubstr("'body.geo'"), HasSubstr("DefineConstant[h = 0.3]")));
  }
  fine.nodes = 900;
  EXPECT_NO_THROW(require_refined(setup, coarse, fine));
}

}  // namespace
}  // namespace diptych::harness
