#include "benchmarks/probes/machine_probes.hpp"

#include <gmock/gmock.h>

namespace diptych::probes {
namespace {

using testing::HasSubstr;
using testing::Not;

// No speed is asserted, only that every figure was measured and that the arrays do leave the cache
// or stay within a quarter of the memory.
TEST(MachineProbes, MeasureEverythingBeyondTheCache) {
  const MachineProbes probes = measure_machine(1);
  EXPECT_EQ(probes.threads, 1);
  for (const Peak& peak :
       {probes.double_one, probes.double_all, probes.float_one, probes.float_all}) {
    EXPECT_GT(peak.bandwidth, 0);
    EXPECT_GT(peak.flops, 0);
  }
  EXPECT_GT(probes.array_bytes, 0);
  if (probes.array_bytes > probes.cache_bytes) {
    EXPECT_THAT(probes_text(probes), Not(HasSubstr("TOO SMALL")));
  }
}

TEST(MachineProbes, SayWhenTheArraysFitIntoTheCache) {
  MachineProbes probes;
  probes.cache_bytes = 64 << 20;
  probes.array_bytes = 32 << 20;
  EXPECT_THAT(probes_text(probes), HasSubstr("TOO SMALL"));
}

}  // namespace
}  // namespace diptych::probes
