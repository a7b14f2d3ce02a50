/// What is shown and kept of an atlas, of a map that is made up.

#include "benchmarks/study/atlas.hpp"

#include "common/base/error.hpp"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace diptych::harness {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// Two values of nu across, two loads down: stable, stopped; wrong, and one that is not run yet.
class Map : public testing::Test {
 protected:
  Map() {
    map.atlas.title = "Moulds";
    map.atlas.name = "moulds";
    map.atlas.columns = {"nu"};
    const std::vector<std::string> sph{"sph"};
    map.atlas.axes = {{"load", {{"p 3", {}, sph, "", true}, {"p 10", {}, sph, "", true}}},
                      {"nu", {{"0.3", {}, sph, "", true}, {"0.49", {}, sph, "", true}}}};
    map.n_planned = 4;
    add({0, 0}, {Outcome::stable, ""});
    add({0, 1}, {Outcome::stopped, "28 of 216 cells are inside out, step 1005, time 1.5e-02 s"});
    add({1, 0}, {Outcome::wrong, "energy residual 0.036, asked <= 0.01"});
  }
  void add(const std::vector<size_t>& choices, const Judgement& judgement) {
    AtlasPoint point;
    point.method = "sph";
    point.choices = choices;
    point.judgement = judgement;
    point.kinetic_growth = std::nan("");
    map.points.push_back(point);
  }
  AtlasMap map;
};

TEST_F(Map, IsShownByLettersWithItsCausesCounted) {
  EXPECT_THAT(atlas_text(map),
              AllOf(HasSubstr("load   0.3 0.49  nu\np 3      .    S\np 10     W"),
                    HasSubstr("Of 3 points 1 are stable, 1 were stopped with their cause, 1 came"),
                    HasSubstr("1 are still to be run"),
                    HasSubstr("1 stopped: N of N cells are inside out, step N, time N s"),
                    HasSubstr("1 wrong: energy residual N, asked <= N"), Not(HasSubstr("before"))));
}

TEST_F(Map, IsAPageWithTheReasonInEachCell) {
  EXPECT_THAT(atlas_html(map),
              AllOf(HasSubstr("<svg class=\"atlas\""),
                    HasSubstr("p 10, 0.3: wrong: energy residual 0.036, asked &lt;= 0.01</title>"),
                    HasSubstr("<td class=\"stopped\">stopped: 28 of 216 cells are inside out"),
                    HasSubstr("</html>"), Not(HasSubstr("<script"))));
}

TEST_F(Map, IsKeptAsATableAndAsJson) {
  EXPECT_THAT(atlas_csv(map), AllOf(HasSubstr("method,\"load\",\"nu\",outcome,"),
                                    HasSubstr("sph,\"p 10\",\"0.3\",wrong,,\"energy residual")));
  const auto json = nlohmann::json::parse(atlas_json(map));
  EXPECT_EQ(json["planned"], 4);
  ASSERT_EQ(json["points"].size(), 3U);
  EXPECT_EQ(json["points"][1]["settings"]["nu"], "0.49");
  EXPECT_EQ(json["points"][1]["outcome"], "stopped");
  EXPECT_TRUE(json["points"][1]["kinetic_growth"].is_null());
}

TEST_F(Map, IsComparedWithAnEarlierOnePointByPoint) {
  const std::string earlier = atlas_json(map);
  map.points[0].judgement = {Outcome::wrong, "least J 0.1, asked >= 0.5"};
  map.points[1].judgement = {Outcome::stable, ""};
  add({1, 1}, {Outcome::stable, ""});  // was not known
  set_before(map, earlier, "before.json");
  EXPECT_EQ(map.points[1].before, Outcome::stopped);
  EXPECT_FALSE(map.points[3].before);
  EXPECT_THAT(
      atlas_text(map),
      AllOf(HasSubstr("Of 2 that were not stable before, 1 are now; 1 that were"),
            HasSubstr("no longer stable: sph p 3, 0.3: wrong: least J"), HasSubstr(".>W"),
            HasSubstr("S>."),
            HasSubstr("stopped                 1        0        0        0          0\n")));
  EXPECT_THAT(atlas_csv(map), HasSubstr("stable,stopped,"));
  EXPECT_THAT(atlas_html(map), HasSubstr("(before: stopped)"));
}

TEST_F(Map, IsNotComparedWithWhatIsNone) {
  EXPECT_THROW(set_before(map, "{", "a.json"), base::InputError);
  EXPECT_EQ(set_before(map, R"({"points": []})", "a.json"), 0U);
  std::string other = atlas_json(map);
  other.replace(other.find("\"stable\""), 8, "\"fine\"");
  EXPECT_THROW(set_before(map, other, "a.json"), base::InputError);
}

}  // namespace
}  // namespace diptych::harness
