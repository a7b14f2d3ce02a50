/// What a run is said to need before it is built, against what building it takes.

#include "benchmarks/run/memory_estimate.hpp"

#include "benchmarks/run/case_check.hpp"
#include "benchmarks/run/memory.hpp"
#include "common/base/error.hpp"
#include "common/cases/reader.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <gmock/gmock.h>
#include <ostream>
#include <sys/resource.h>

namespace diptych::harness {
namespace {

using testing::AllOf;
using testing::HasSubstr;

cases::Case cube(const std::string& element, int cells, const std::vector<std::string>& overrides) {
  const bool plane = element == "triangle" || element == "quadrilateral";
  const std::string n = std::to_string(cells);
  return cases::case_from_text(
      "[mesh]\nelement = '" + element + "'\ncells = [" + n + ", " + n + (plane ? "" : ", " + n) +
          "]\n[material]\nmodel = 'mooney-rivlin'\ndensity = 1100\nyoungs_modulus = 17e6\n"
          "poissons_ratio = 0.3\nzeta_ratio = 0.5\n[[material.branch]]\nbeta_C = 0.5\ntau_C = "
          "1e-2\n"
          "[time]\nend = 1\n",
      "cube.toml", overrides);
}

struct Scene {
  const char* name;
  const char* element;
  int cells;
  std::vector<std::string> overrides;
};

void PrintTo(const Scene& scene, std::ostream* out) {
  *out << scene.name;
}

class Estimates : public testing::TestWithParam<std::tuple<std::string, Scene>> {};

TEST_P(Estimates, AreWithinThirtyPercentOfWhatBuildingTakes) {
  const auto& [method, scene] = GetParam();
  const cases::Case setup = cube(scene.element, scene.cells, scene.overrides);
  const CaseCheck check = check_case(setup, method, 0, 0);
  const MemoryEstimate estimate = estimate_memory(setup, method, 0);
  ASSERT_GE(check.nodes, 12000);
  EXPECT_EQ(estimate.nodes, static_cast<double>(check.nodes));
  EXPECT_EQ(estimate.cells, static_cast<double>(check.cells));
  EXPECT_NEAR(estimate.pairs / static_cast<double>(check.pairs), 1, 0.15);
  EXPECT_NEAR(estimate.bytes / static_cast<double>(check.building_bytes), 1, 0.3);
  EXPECT_EQ(check.estimated_bytes, estimate.bytes);
  EXPECT_GT(check.seconds, 0);
}

const Scene scenes[] = {
    {"hexahedra", "hexahedron", 30, {}},
    {"tetrahedra", "tetrahedron", 22, {}},
    {"perturbed", "hexahedron", 25, {"mesh.perturbation=0.2", "mesh.seed=3"}},
    {"single", "hexahedron", 30, {"scheme.precision=single"}},
    {"wide", "hexahedron", 28, {"sph.kappa=1.5", "fvm.stencil=integral"}},
    {"touching", "hexahedron", 32, {"sph.kappa=1"}},
    {"quadrilaterals", "quadrilateral", 160, {}},
    {"lines", "hexahedron", 28, {"fvm.stencil=sbp", "sph.gradient=sbp"}},
};

INSTANTIATE_TEST_SUITE_P(Both,
                         Estimates,
                         testing::Combine(testing::Values("sph", "fvm"), testing::ValuesIn(scenes)),
                         [](const auto& all) {
                           return std::string(std::get<0>(all.param)) + "_" +
                                  std::get<1>(all.param).name;
                         });

template <class Error>
std::string refusal(const cases::Case& setup, int level) {
  try {
    require_memory(setup, {"sph", "fvm"}, {0, level});
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(RequireMemory, RefusesWithNumbersBeforeAnythingIsBuilt) {
  const cases::Case setup = cube("hexahedron", 4, {});
  EXPECT_EQ(refusal<base::EnvironmentError>(setup, 1), "accepted");
  // 1024 cells along a side: 1e9 nodes, terabytes
  EXPECT_THAT(
      refusal<base::EnvironmentError>(setup, 8),
      AllOf(HasSubstr("cube with sph at level 8 asks for about"), HasSubstr(" TB of memory"),
            HasSubstr("1.08e+09 nodes"), HasSubstr("are available"), HasSubstr("--level")));
  EXPECT_THAT(refusal<base::InputError>(setup, 9), HasSubstr("counted in 32 bits"));
  EXPECT_THAT(refusal<base::InputError>(setup, 63), HasSubstr("--level 63"));
  EXPECT_THAT(refusal<base::InputError>(setup, -1), HasSubstr("--level -1"));
}

TEST(AvailableMemory, CountsTheLimitOfTheAddressSpace) {
  const AvailableMemory before = available_memory();
  EXPECT_GT(before.bytes, 0);
  rlimit limit{};
  ASSERT_EQ(getrlimit(RLIMIT_AS, &limit), 0);
  const rlimit saved = limit;
  std::ifstream file("/proc/self/statm");
  std::int64_t pages = 0;
  ASSERT_TRUE(file >> pages);
  limit.rlim_cur = static_cast<rlim_t>(pages * 4096 + 50'000'000);
  ASSERT_EQ(setrlimit(RLIMIT_AS, &limit), 0);
  const AvailableMemory limited = available_memory();
  setrlimit(RLIMIT_AS, &saved);
  EXPECT_LE(limited.bytes, 50'000'000);
  EXPECT_THAT(limited.limit, HasSubstr("ulimit -v"));
}

}  // namespace
}  // namespace diptych::harness
