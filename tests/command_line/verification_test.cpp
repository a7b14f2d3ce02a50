/// Verification tables through the program: their files, their verdicts, their exit codes.

#include "tests/command_line/program.hpp"
#include "tests/folders.hpp"

#include <gtest/gtest.h>

#include <gmock/gmock.h>

namespace diptych {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;
using tests::diptych;
using tests::Folder;
using tests::text_of;

/// A table of one small case; least_order and greatest error as given.
std::string table(const std::string& bounds) {
  return "title = \"Small\"\ntext = \"What it shows.\"\ncase = \"shear-wave-elastic\"\n"
         "levels = [0, 1]\nset = [\"output.frames=1\"]\n\n"
         "[[measure]]\nname = \"volume\"\nreduce = \"integral\"\nvalue = \"1\"\n\n"
         "[[run]]\nname = \"as shipped\"\n\n[[run]]\nname = \"less dissipation\"\n"
         "methods = [\"fvm\"]\n[run.vary]\n\"scheme.dissipation\" = [0.5, 0.25]\n\n"
         "[[column]]\ntitle = \"v\"\nvalue = \"error_velocity\"\norder = true\n\n"
         "[[column]]\ntitle = \"A\"\nvalue = \"error_viscous_C\"\noptional = true\n\n"
         "[[column]]\ntitle = \"volume\"\nvalue = \"volume\"\n\n"
         "[[column]]\ntitle = \"v, of shipped\"\nvalue = \"error_velocity\"\n"
         "ratio_to = \"as shipped\"\n\n" +
         bounds;
}

const std::string fair = "[[bound]]\ncolumns = [\"v\", \"A\"]\nleast = 1e-6\n";
const std::string unfair =
    "[[bound]]\ncolumns = [\"v\"]\nruns = [\"as shipped\"]\nleast_order = 9\n";

TEST(Verify, ShowsValuesOrdersAndVerdicts) {
  const Folder folder;
  const std::string file = folder.write("small.toml", table(fair + unfair));
  const auto outcome = diptych(folder, "verify small.toml --quiet --threads 1 --out out");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
  EXPECT_THAT(outcome.text, AllOf(HasSubstr("Small: bounds met: 3 of 5"),
                                  ContainsRegex("NOT met: v, as shipped \\(sph\\): [0-9.]+, asked "
                                                "order >= 9")));
  const std::string page = text_of(folder.path() / "out" / "VERIFICATION.md");
  EXPECT_THAT(page, HasSubstr("**NOT met**"));
  EXPECT_THAT(page, ContainsRegex("Finite volume \\| scheme.dissipation = 0.25 \\| +1 \\| +0.125"));
  EXPECT_THAT(page, ContainsRegex("\\| less dissipation \\| v +\\| >= 1e-06")) << page;
}

TEST(Verify, EndsWithFiveWhereABoundIsNotMetAndThatIsAsked) {
  const Folder folder;
  folder.write("small.toml", table(fair + unfair));
  folder.write("met.toml", table(fair));
  const auto unmet = diptych(folder, "verify small.toml --check --quiet --threads 1 --out out");
  EXPECT_EQ(unmet.exit_code, 5) << unmet.text;
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "out" / "VERIFICATION.md"));
  EXPECT_EQ(diptych(folder, "verify met.toml --check --quiet --threads 1 --out out").exit_code, 0);
}

TEST(Verify, GoesOnWhereItStopped) {
  const Folder folder;
  folder.write("small.toml", table(fair));
  const std::string command = "verify small.toml --threads 1 --out out";
  EXPECT_THAT(diptych(folder, command).text, Not(HasSubstr("taken over")));
  const auto again = diptych(folder, command);
  size_t n = 0;
  for (size_t at = 0; (at = again.text.find("taken over", at)) != std::string::npos; ++at)
    ++n;
  EXPECT_EQ(n, 6u) << again.text;
  const auto quick = diptych(folder, command + " --quick");
  EXPECT_THAT(quick.text, Not(HasSubstr("level 1"))) << quick.text;
}

TEST(Verify, ShowsABreakdownAsARowAndAnUnmetBound) {
  const Folder folder;
  const std::string bound = "[[bound]]\ncolumns = [\"v\"]\nmost = 10\n";
  std::string text = table(bound);
  const std::string set = "\"output.frames=1\"";
  text.replace(text.find(set), set.size(), set + ", \"time.cfl=9\"");
  folder.write("small.toml", text);
  const auto outcome = diptych(folder, "verify small.toml --check --quiet --threads 1 --out out");
  EXPECT_EQ(outcome.exit_code, 5) << outcome.text;
  EXPECT_THAT(outcome.text, HasSubstr("none, asked <= 10"));
  EXPECT_THAT(text_of(folder.path() / "out" / "VERIFICATION.md"), HasSubstr("failed"));
}

/// Three levels of a case with a probe, with a group, an estimate and a figure of the literature.
const std::string bar_in_flight = R"toml(title = "Bar"
text = "Flies."
case = "bar-rebound"
levels = [0, 1, 2]
set = ["time.end=1e-5", "output.frames=2"]

[[run]]
name = "in flight"

[[column]]
title = "ns each"
value = "1e9*seconds/pair_updates"

[[column]]
title = "speed"
group = "Motion"
value = "mean_velocity"
estimate = true
literature = "-100 (by hand)"

[[column]]
title = "cells"
group = "Motion"
value = "least_cell_J"
)toml";

TEST(Verify, ExtrapolatesProbesBesideTheLiterature) {
  const Folder folder;
  folder.write("bar.toml", bar_in_flight);
  const auto outcome =
      diptych(folder, "verify bar.toml --literature --quiet --threads 1 --out out");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
  const std::string page = text_of(folder.path() / "out" / "LITERATURE.md");
  EXPECT_THAT(page, AllOf(HasSubstr("# Cases of the literature"), HasSubstr("`bar.toml`"),
                          HasSubstr("both methods, 1 thread."), HasSubstr("\nMotion:\n"),
                          HasSubstr("Extrapolated from the three finest levels")));
  EXPECT_THAT(page, ContainsRegex("\\| method +\\| level \\| +h \\[m\\] .* ns each \\|"));
  // a body in flight keeps its velocity and its cells, on all levels and with both methods
  EXPECT_THAT(page, ContainsRegex("\\| speed +\\| -100 \\(by hand\\) \\| SPH +\\| +-100 \\|"));
  EXPECT_THAT(page, ContainsRegex("Finite volume \\| +-100 \\|.* yes"));
  EXPECT_THAT(page, ContainsRegex("SPH +\\| +2 \\| +-100 \\| +1 \\|"));
}

TEST(Verify, RefusesBadTablesWithOneMessageBeforeItRuns) {
  const std::vector<std::array<std::string, 3>> faults{
      {"order = true", "ordr = true", "unknown key 'ordr' of [[column]]; did you mean 'order'?"},
      {"value = \"error_velocity\"\norder", "value = 3\norder",
       "'value' of [[column]] must be a text"},
      {"title = \"Small\"", "", "lacks 'title'"},
      {"optional = true", "literature = \"1\"", "add estimate = true"},
      {"least = 1e-6", "least = 1e-6\nmost = 2", "needs one of least_order"},
      {"columns = [\"v\", \"A\"]", "columns = [\"V\"]", "'V' is none of the columns"},
      {"[0.5, 0.25]", "[0.5]", "1 values for 2 levels"},
      {"reduce = \"integral\"", "reduce = \"sum\"", "unknown reduction 'sum'"},
      {"value = \"1\"", "value = \"w1\"", "unknown name 'w1'"},
      {"shear-wave-elastic", "shear-wave-elastc", "did you mean 'shear-wave-elastic'?"},
      {"ratio_to = \"as shipped\"", "ratio_to = \"shipped\"", "no run 'shipped'"}};
  for (const auto& [from, to, message] : faults) {
    const Folder folder;
    std::string text = table(fair);
    ASSERT_NE(text.find(from), std::string::npos) << from;
    text.replace(text.find(from), from.size(), to);
    folder.write("small.toml", text);
    const auto outcome = diptych(folder, "verify small.toml --quiet --out out");
    EXPECT_EQ(outcome.exit_code, 2) << outcome.text;
    EXPECT_THAT(outcome.text, HasSubstr(message));
    EXPECT_THAT(outcome.text, HasSubstr("small.toml:"));
    EXPECT_EQ(std::count(outcome.text.begin(), outcome.text.end(), '\n'), 1) << outcome.text;
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "out"));
  }
  const Folder folder;
  const auto outcome = diptych(folder, "verify shear-wav --out out");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.text, HasSubstr("did you mean 'shear-wave'?"));
}

TEST(Verify, EveryShippedTableIsReadAndStandsOnThePage) {
  const Folder folder;
  const std::string top = tests::source_folder() + "/benchmarks/";
  int n_tables = 0;
  for (const auto& [page_name, tables] :
       {std::pair{"VERIFICATION.md", "verification"}, std::pair{"LITERATURE.md", "literature"}}) {
    const std::string page = text_of(top + page_name);
    for (const auto& entry : std::filesystem::directory_iterator(top + tables)) {
      // the misspelt table comes second: the first is read before
      const std::string name = entry.path().stem().string();
      EXPECT_THAT(page, HasSubstr("`" + name + ".toml`")) << "refresh it: benchmarks/verify";
      const auto outcome = diptych(folder, "verify " + name + " no-such-table --out out");
      EXPECT_THAT(outcome.text, HasSubstr("no verification table 'no-such-table'"));
      ++n_tables;
    }
  }
  EXPECT_GE(n_tables, 13);
}

}  // namespace
}  // namespace diptych
