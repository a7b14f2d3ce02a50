/// summary.json: what is written is read back bit for bit; what is not whole is refused by name.

#include "common/io/run_record.hpp"

#include "common/base/error.hpp"
#include "tests/common/io/scratch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <gmock/gmock.h>
#include <limits>
#include <nlohmann/json.hpp>

namespace diptych::io {
namespace {

using base::InputError;
using nlohmann::json;
using test::message_of;
using testing::HasSubstr;

/// Every member differs from its default and from every other.
RunSummary full_summary() {
  RunSummary s;
  s.method = "fvm", s.case_name = "column", s.case_file = "/home/me/column/case.toml";
  s.title = "twisting \"column\" <1>";
  s.level = 2, s.dimension = 2, s.nodes = 4'000'000'017, s.pairs = 123456789,
  s.unknowns_per_node = 34;
  s.steps = 77, s.stages = 154, s.threads = 3, s.ranks = 5;
  s.imbalance = 1.25, s.exchanged_bytes = 4711, s.communication_seconds = 0.5;
  s.arrangement = "rows";
  s.precision = "single", s.integrator = "ssp-rk3", s.volumes = "cells", s.status = "interrupted";
  s.end_time = 0.1, s.setup_seconds = 1.0 / 3, s.wall_seconds = 12.5, s.loop_seconds = 11.7;
  s.nanoseconds_per_node_crossing = 777.1;
  s.nanoseconds_per_node_stage = 451.3, s.peak_rss_bytes = 1'234'567'890'123;
  s.solver_bytes = 234, s.running_rss_bytes = 345, s.building_rss_bytes = 456;
  s.dt_min = 1e-7, s.dt_max = 2e-5, s.spacing = 0.0625, s.mean_neighbours = 50.7;
  s.graph_closure = 1.1e-16, s.graph_linear_exactness = 2.3e-15;
  s.graph_operators = "sbp: order 4 on 17 nodes along (1, 0, 0)";
  s.notices = {"corrected gradient, since walls are thin", "a cavity"};
  s.errors["velocity"] = {1e-3, std::nextafter(2e-3, 1), 3e-3};
  s.errors["stress"] = {4e-3, 5e-3, 6e-3};
  s.measures["star stress"] = 7.25;
  s.energy = {1.5, 2.5, 3.5, 4.5, -5.5, 6.5e-5};
  s.linear_momentum_drift = 7e-16, s.angular_momentum_drift = 8e-9, s.min_jacobian = 0.93;
  s.quantities = {{"tip", "m", 1.25, -0.5, 2.5, 0, 0, 0, 0, std::nullopt},
                  {"swing", "mm", 1, -2, 3, 4, 0.65, 0.1, 2, 0.2}};
  s.involution_H = 9e-7, s.involution_J = 1e-6;
  s.least_cell_J = -0.25, s.most_inverted_cells = 12;
  s.rejected_steps = 3;
  s.restarts = 2;
  s.projections = 5, s.resynchronisations = 6, s.limited_pairs = 7;
  s.state_hash = "a1b2";
  s.provenance = {"0.1.0", "c0ffee",     "GCC 12.2", "-O3",  "some cpu",
                  "avx2",  "2026-01-02", "d00d",     "beef", "f00d"};
  return s;
}

json as_json(const RunSummary& summary) {
  return json::parse(to_json(summary));
}

TEST(RunRecord, IsReadBackBitForBit) {
  const RunSummary written = full_summary();
  const RunSummary read = summary_from_json(to_json(written), "summary.json");
  EXPECT_EQ(to_json(read), to_json(written));
  EXPECT_EQ(read.errors.at("velocity").l2, written.errors.at("velocity").l2);
  EXPECT_EQ(read.setup_seconds, written.setup_seconds);
  EXPECT_EQ(read.nodes, written.nodes);
  EXPECT_EQ(read.provenance.instruction_set, "avx2");
}

TEST(RunRecord, SaysSinceWhenCellsAreInvertedOnlyWhereTheyAre) {
  RunSummary summary = full_summary();
  EXPECT_FALSE(as_json(summary)["cells"].contains("inverted_from"));
  EXPECT_FALSE(summary_from_json(to_json(summary), "summary.json").inverted_from);
  summary.inverted_from = 0.045;
  EXPECT_EQ(summary_from_json(to_json(summary), "summary.json").inverted_from, 0.045);
}

TEST(RunRecord, SaysWhatItsCaseAsksAndDoesNotHoldOnlyWhereSomethingDoesNot) {
  RunSummary summary = full_summary();
  EXPECT_FALSE(as_json(summary).contains("unmet"));
  EXPECT_EQ(summary_from_json(to_json(summary), "summary.json").unmet, "");
  summary.unmet = "numerical share 0.02, asked <= 0.01";
  EXPECT_EQ(summary_from_json(to_json(summary), "summary.json").unmet, summary.unmet);
}

TEST(RunRecord, SaysWhyARunWasNotFinishedWhereItWasNot) {
  RunSummary summary = full_summary();
  EXPECT_FALSE(as_json(summary).contains("failure"));
  summary.status = "breakdown";
  summary.failure = RunFailure{"J <= 0 at node 7\n  F = ...", 0.125, 42, 7, {{1, -2, 0.5}}};
  const RunSummary read = summary_from_json(to_json(summary), "summary.json");
  ASSERT_TRUE(read.failure.has_value());
  EXPECT_EQ(read.failure->message, summary.failure->message);
  EXPECT_EQ(read.failure->time, 0.125);
  EXPECT_EQ(read.failure->step, 42);
  EXPECT_EQ(read.failure->node, 7);
  EXPECT_EQ(read.failure->place, summary.failure->place);
  summary.failure = RunFailure{"no space left", {}, {}, {}, {}};
  const auto plain = summary_from_json(to_json(summary), "summary.json").failure;
  ASSERT_TRUE(plain.has_value());
  EXPECT_FALSE(plain->time || plain->step || plain->node || plain->place);
  json broken = as_json(summary);
  for (const json& wrong : {json(3), json::array({1, 2}), json::array({1, 2, "x"})}) {
    broken["failure"]["place"] = wrong;
    EXPECT_THAT(message_of<InputError>([&] { summary_from_json(broken.dump(), "s.json"); }),
                HasSubstr("failure.place must be three numbers"));
  }
}

TEST(RunRecord, TellsItsOwnerEvenWhereItIsNotWhole) {
  const auto owner = summary_owner(to_json(full_summary()) + "   \n");
  ASSERT_TRUE(owner.has_value());
  EXPECT_EQ(owner->case_name, "column");
  EXPECT_EQ(owner->case_file, "/home/me/column/case.toml");
  const auto earlier = summary_owner(R"({"method": "sph", "case": "cube", "dt": null})");
  ASSERT_TRUE(earlier.has_value());
  EXPECT_EQ(earlier->case_file, "");
  for (const char* text : {"", "{", "[]", "{}", R"({"case": 3, "method": "sph"})"})
    EXPECT_FALSE(summary_owner(text).has_value()) << text;
}

TEST(RunRecord, HasTheKeysOfTheContract) {
  const json record = as_json(full_summary());
  for (const char* pointer : {"/method",
                              "/case",
                              "/level",
                              "/dimension",
                              "/nodes",
                              "/pairs",
                              "/unknowns_per_node",
                              "/steps",
                              "/stages",
                              "/threads",
                              "/ranks",
                              "/communication/imbalance",
                              "/communication/exchanged_bytes",
                              "/communication/seconds",
                              "/precision",
                              "/arrangement",
                              "/volumes",
                              "/status",
                              "/wall_seconds",
                              "/loop_seconds",
                              "/nanoseconds_per_node_stage",
                              "/nanoseconds_per_node_crossing",
                              "/peak_rss_bytes",
                              "/solver_bytes",
                              "/running_rss_bytes",
                              "/building_rss_bytes",
                              "/dt/min",
                              "/dt/max",
                              "/errors/velocity/l1",
                              "/errors/velocity/l2",
                              "/errors/velocity/linf",
                              "/quantities/swing/oscillation/period",
                              "/quantities/swing/oscillation/logarithmic_decrement",
                              "/energy/kinetic",
                              "/energy/strain",
                              "/energy/viscous_dissipation",
                              "/energy/numerical_dissipation",
                              "/energy/external_work",
                              "/energy/projection_work",
                              "/energy/relative_residual",
                              "/momentum/linear_drift",
                              "/momentum/angular_drift",
                              "/involution/H",
                              "/involution/J",
                              "/rejected_steps",
                              "/restarts",
                              "/interventions/projections",
                              "/interventions/resynchronisations",
                              "/interventions/limited_pairs",
                              "/min_jacobian",
                              "/cells/least_J",
                              "/cells/most_inverted",
                              "/state_hash",
                              "/provenance/version",
                              "/provenance/commit",
                              "/provenance/compiler",
                              "/provenance/flags",
                              "/provenance/cpu",
                              "/provenance/date",
                              "/provenance/case_hash",
                              "/provenance/program",
                              "/provenance/input_hash",
                              "/measures/star stress"}) {
    EXPECT_TRUE(record.contains(json::json_pointer(pointer))) << pointer;
  }
  EXPECT_EQ(record["energy"]["external_work"], -5.5);
  EXPECT_EQ(record["dt"]["max"], 2e-5);
}

TEST(RunRecord, RefusesEachMissingKeyByName) {
  RunSummary summary = full_summary();
  summary.quantities.pop_back();  // an oscillation is optional, and so is its decrement
  summary.notices.clear();        // and what there is to say
  const json whole = as_json(summary).flatten();
  for (const auto& item : whole.items()) {
    const json::json_pointer pointer(item.key());
    if (pointer.parent_pointer().to_string() == "/measures") continue;  // none has to be there
    json record = whole.unflatten();
    record[pointer.parent_pointer()].erase(pointer.back());
    const std::string message =
        message_of<InputError>([&] { summary_from_json(record.dump(), "out/summary.json"); });
    EXPECT_THAT(message, HasSubstr("out/summary.json: ")) << item.key();
    EXPECT_THAT(message, HasSubstr(pointer.back() + " is missing")) << item.key();
  }
}

TEST(RunRecord, WritesNanAsNullAndRefusesToCompareIt) {
  RunSummary broken = full_summary();
  broken.energy.kinetic = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(as_json(broken)["energy"]["kinetic"].is_null());
  EXPECT_THAT(message_of<InputError>([&] { summary_from_json(to_json(broken), "s.json"); }),
              HasSubstr("energy.kinetic is null"));
}

TEST(RunRecord, SaysLineAndColumnOfBrokenText) {
  EXPECT_THAT(message_of<InputError>([] { summary_from_json("{\n  \"method\": ?}", "s.json"); }),
              HasSubstr("s.json:2:13: not valid JSON"));
  EXPECT_THAT(message_of<InputError>([] { summary_from_json("", "s.json"); }),
              HasSubstr("s.json:1:1"));
  const std::string text = to_json(full_summary());
  for (size_t length = 0; length + 2 < text.size(); length += 37) {
    EXPECT_THROW(summary_from_json(text.substr(0, length), "s.json"), InputError) << length;
  }
}

TEST(RunRecord, RefusesWrongTypesRangesAndDoubleKeys) {
  const auto refusal = [](const char* key, const json& value) {
    json record = as_json(full_summary());
    record[key] = value;
    return message_of<InputError>([&] { summary_from_json(record.dump(), "s.json"); });
  };
  EXPECT_THAT(refusal("method", 3), HasSubstr("method must be a text"));
  EXPECT_THAT(refusal("steps", 1.5), HasSubstr("steps must be a whole number"));
  EXPECT_THAT(refusal("steps", -1), HasSubstr("steps must lie between 0 and"));
  EXPECT_THAT(refusal("nodes", std::numeric_limits<std::uint64_t>::max()),
              HasSubstr("nodes must lie"));
  EXPECT_THAT(refusal("level", 3'000'000'000),
              HasSubstr("level must lie between 0 and 2147483647"));
  EXPECT_THAT(refusal("wall_seconds", "1"), HasSubstr("wall_seconds must be a number"));
  EXPECT_THAT(refusal("errors", 1), HasSubstr("errors must be an object"));
  std::string text = to_json(full_summary());
  text.insert(1, "\"method\": \"sph\",");
  EXPECT_THAT(message_of<InputError>([&] { summary_from_json(text, "s.json"); }),
              HasSubstr("key 'method' stands twice"));
  EXPECT_THAT(message_of<InputError>([] { summary_from_json("{\"level\": 1e999}", "s.json"); }),
              HasSubstr("s.json"));
}

TEST(RunRecord, TakesKeysOfLaterVersions) {
  json record = as_json(full_summary());
  record["added_later"] = {1, 2, 3};
  EXPECT_EQ(summary_from_json(record.dump(), "s.json").method, "fvm");
}

}  // namespace
}  // namespace diptych::io
