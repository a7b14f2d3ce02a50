/// Ranks of other builds are refused; of other processors they are told.

#include "benchmarks/run/rank_programs.hpp"

#include "common/base/error.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <gmock/gmock.h>

namespace diptych::harness {
namespace {

using testing::HasSubstr;

TEST(RankPrograms, AreOneProgram) {
  std::vector<RankProgram> all(3);
  for (RankProgram& one : all)
    std::strcpy(one.hash, "0123abcd");
  EXPECT_NO_THROW(require_one_program(all));
  EXPECT_FALSE(notice_of_processors(all));
  std::strcpy(all[2].instruction_set, "baseline");
  EXPECT_THAT(notice_of_processors(all).value(),
              HasSubstr("rank 2 of 3 runs on a processor with baseline"));
  EXPECT_NO_THROW(require_one_program(all));
  std::strcpy(all[2].hash, "0123abce");
  try {
    require_one_program(all);
    ADD_FAILURE() << "another build is not refused";
  } catch (const base::EnvironmentError& error) {
    EXPECT_THAT(error.what(), HasSubstr("rank 2 of 3 is another program"));
  }
}

}  // namespace
}  // namespace diptych::harness
