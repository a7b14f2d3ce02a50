/// How far a run is from values from elsewhere: at whose times, and when it is not asked.

#include "common/run/references.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace diptych::run {
namespace {

/// Probe 0 of the rows is 2 t, at the instants 0, 0.1, ..., 1.
struct Record {
  cases::Case setup;
  std::vector<io::HistoryRow> history;

  explicit Record(std::vector<std::array<double, 2>> points) {
    cases::ProbeCase probe;
    probe.name = "tip";
    setup.probes = {probe};
    setup.references = {{"tip", "Doe", std::move(points), 0.25}};
    for (int i = 0; i <= 10; ++i) {
      io::HistoryRow row;
      row.time = 0.1 * i;
      row.probes = {2 * row.time};
      history.push_back(row);
    }
  }
  std::vector<io::ReferenceSummary> found() const { return references_of(setup, history, {}); }
};

TEST(References, FewPointsAreComparedAtTheirTimes) {
  const Record record({{0.25, 0.6}, {0.5, 0.8}, {1, 2}, {3, 100}});
  const auto found = record.found();
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].name, "tip");
  EXPECT_EQ(found[0].n_times, 3) << "the run has no time 3 s";
  EXPECT_NEAR(found[0].greatest, 0.2, 1e-14);
  EXPECT_EQ(found[0].greatest_at, 0.5);
  EXPECT_NEAR(found[0].at_end, 0, 1e-14);
  EXPECT_EQ(found[0].until, 1);
  EXPECT_NEAR(found[0].rms, std::sqrt((0.01 + 0.04) / 3), 1e-14);
  EXPECT_TRUE(found[0].is_inside());
}

TEST(References, ADenserHistoryIsComparedAtTheInstantsOfTheRun) {
  std::vector<std::array<double, 2>> points;
  for (int i = 0; i <= 400; ++i)
    points.push_back({i / 200.0, 2 * i / 200.0 + 0.3});
  const auto found = Record(points).found();
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].n_times, 11);
  EXPECT_NEAR(found[0].greatest, 0.3, 1e-12);
  EXPECT_NEAR(found[0].at_end, -0.3, 1e-12);
  EXPECT_FALSE(found[0].is_inside());
}

TEST(References, ASecondOneOfAProbeHasANameOfItsOwn) {
  Record record({{0.5, 1}});
  record.setup.references.push_back({"tip", "Roe", {{1, 2}}, {}});
  const auto found = record.found();
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[1].name, "tip (2)");
  EXPECT_FALSE(found[1].is_inside()) << "it states no uncertainty";
}

TEST(References, NoNumberIsNeverInside) {
  Record record({{0.2, 0.4}, {0.5, 1}, {1, 2}});
  record.history[5].probes[0] = std::numeric_limits<double>::quiet_NaN();
  const auto found = record.found();
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(std::isnan(found[0].greatest));
  EXPECT_FALSE(found[0].is_inside());
}

TEST(References, AreNotOfAnotherSceneOrOfTimesThatTheRunDoesNotHave) {
  EXPECT_TRUE(Record({{2, 4}}).found().empty());
  Record record({{0.5, 1}});
  for (const char* same : {"time.end=0.1", "sph.kappa=0.75", "mesh.cells=[8, 8, 8]"}) {
    record.setup.overrides = {same};
    EXPECT_EQ(record.found().size(), 1u) << same;
  }
  for (const char* other : {"material.density=1", "parameters.V = 2", "initial.velocity=[0,0,0]"}) {
    record.setup.overrides = {"time.end=0.1", other};
    EXPECT_EQ(changed_scene(record.setup.overrides), other);
    EXPECT_TRUE(record.found().empty()) << other;
  }
}

}  // namespace
}  // namespace diptych::run
