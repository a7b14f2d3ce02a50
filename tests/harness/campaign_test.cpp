/// What a plan asks for twice is made once; a breakdown ends its own run only.

#include "benchmarks/campaign/campaign.hpp"

#include "benchmarks/run/case_list.hpp"
#include "common/cases/reader.hpp"

#include <gmock/gmock.h>

namespace diptych::harness {
namespace {

using testing::ElementsAre;

CampaignRun run_of(const cases::Case& setup, const std::string& method, int repetition) {
  RunOptions options;
  options.method = method;
  options.threads = 1;
  options.quiet = true;
  return {&setup, options, method, method, "", repetition};
}

class Campaign : public testing::Test {
 protected:
  void make(const std::vector<CampaignRun>& plan) {
    EXPECT_TRUE(make_runs(plan, TakeOver::nothing, [&](size_t, auto made, const Schedule&) {
      taken_over.push_back(made.taken_over);
      results.push_back(made.run.summary);
    }));
  }
  const cases::Case setup =
      cases::read_case(find_case("shear-wave-elastic"), {"time.max_steps=3", "output.frames=1"});
  std::vector<bool> taken_over;
  std::vector<io::RunSummary> results;
};

TEST_F(Campaign, MakesOnceWhatIsAskedForTwice) {
  const cases::Case same = setup;
  make({run_of(setup, "fvm", 0), run_of(setup, "sph", 0), run_of(same, "fvm", 0),
        run_of(setup, "fvm", 1)});
  EXPECT_THAT(taken_over, ElementsAre(false, false, true, false));
  EXPECT_EQ(results[2].state_hash, results[0].state_hash);
  EXPECT_EQ(results[2].wall_seconds, results[0].wall_seconds);
  EXPECT_NE(results[1].state_hash, results[0].state_hash);
}

TEST_F(Campaign, GoesOnAfterABreakdown) {
  const cases::Case wild = cases::read_case(
      find_case("shear-wave-elastic"), {"time.cfl=9", "time.max_retries=0", "output.frames=1"});
  make({run_of(wild, "fvm", 0), run_of(setup, "fvm", 0)});
  EXPECT_EQ(results[0].status, "breakdown");
  EXPECT_EQ(results[1].steps, 3);
}

}  // namespace
}  // namespace diptych::harness
