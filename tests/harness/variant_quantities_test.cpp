/// Quantities of a study of two variants, both methods and two levels, by hand.

#include "benchmarks/study/variant_quantities.hpp"

#include "benchmarks/run/case_list.hpp"
#include "benchmarks/run/judgement.hpp"
#include "common/base/error.hpp"
#include "common/cases/reader.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <sstream>

namespace diptych::harness {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// A run whose tip goes to De + level (SPH) or De + level + 0.5 (FVM).
WorkPoint point(double De, const std::string& method, int level) {
  WorkPoint p;
  p.run.method = method;
  p.run.level = level;
  p.run.spacing = std::exp2(-level);
  p.run.nodes = 100;
  p.run.steps = 7;
  p.run.min_jacobian = 0.9;
  p.run.energy.kinetic = 12;
  const double tip = De + level + (method == "fvm" ? 0.5 : 0);
  io::QuantitySummary probe;
  probe.name = "tip";
  probe.unit = "m";
  probe.final_value = tip;
  probe.least = -tip;
  probe.greatest = 2 * tip;
  p.run.quantities.push_back(probe);
  p.least = 3;
  return p;
}

VariantStudy study() {
  VariantStudy s;
  s.variants = variants_of({"parameters.De=1,100"});
  for (const Variant& variant : s.variants) {
    for (const std::string method : {"sph", "fvm"}) {
      const double De = variant.label == "De=1" ? 1 : 100;
      s.curves.push_back({variant.label, method, {point(De, method, 0), point(De, method, 1)}});
    }
  }
  s.quantities = {"tip, final", "seconds"};
  return s;
}

TEST(VariantQuantities, OfARunAreItsProbesEnergiesAndCost) {
  std::vector<std::string> names;
  for (const RunQuantity& q : quantities_of_run(point(1, "sph", 0)))
    names.push_back(q.name + " [" + q.unit + "]");
  EXPECT_THAT(
      names, ElementsAre("tip, final [m]", "tip, least [m]", "tip, greatest [m]", "tip, period [s]",
                         "tip, amplitude [m]", "kinetic energy [J]", "strain energy [J]",
                         "external work [J]", "viscous dissipation [J]",
                         "numerical dissipation [J]", "projection work [J]", "energy residual [-]",
                         "least J [-]", "seconds [s]", "steps [-]", "nodes [-]"));
}

TEST(VariantQuantities, TableHasARowForEachVariant) {
  EXPECT_EQ(quantities_table(study()),
            "\n"
            "tip, final [m]\n"
            "                    SPH 0        SPH 1        FVM 0        FVM 1\n"
            "De=1                    1            2          1.5          2.5\n"
            "De=100                100          101        100.5        101.5\n"
            "\n"
            "seconds [s]\n"
            "                    SPH 0        SPH 1        FVM 0        FVM 1\n"
            "De=1                    3            3            3            3\n"
            "De=100                  3            3            3            3\n");
}

TEST(VariantQuantities, TableIsNoWiderThanAHundredColumnsAndShowsWhatIsMissing) {
  VariantStudy s = study();
  for (WorkCurve& curve : s.curves) {
    for (int level = 2; level < 9; ++level)
      curve.points.push_back(point(1, curve.method, level));
  }
  s.curves.back().points.resize(1);  // FVM with De=100 broke down on level 1
  const std::string table = quantities_table(s);
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);)
    EXPECT_LE(line.size(), 100u) << line;
  EXPECT_THAT(table, HasSubstr("FVM 8"));
  EXPECT_THAT(table, HasSubstr("            -            -"));
}

TEST(VariantQuantities, CsvHasTheKeysThatVaryAndEveryQuantity) {
  const std::string csv = quantities_csv(study());
  EXPECT_THAT(csv, testing::StartsWith("variant,parameters.De,method,level,spacing [m],"
                                       "\"tip, final [m]\",\"tip, least [m]\","));
  EXPECT_THAT(csv, HasSubstr("\n\"De=100\",\"100\",fvm,1,0.5,101.5,-101.5,203,,,12,"));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 8);
}

// parameters from 1 to 100 on a logarithmic axis, a curve for each method and level
TEST(VariantQuantities, PageDrawsThemAgainstTheParameter) {
  const std::string page = quantities_html("title", study());
  EXPECT_THAT(page, HasSubstr(R"({"x":"parameters.De","y":"tip, final [m]","logarithmic":true,)"
                              R"("curves":[{"name":"SPH 0","points":[{"x":1.0,"y":1.0},)"
                              R"({"x":100.0,"y":100.0}]})"));
  EXPECT_THAT(page, HasSubstr("id=\"panel-1\""));
  EXPECT_THAT(page, HasSubstr("</html>"));
}

TEST(VariantQuantities, PageDrawsThemAgainstTheSpacingWhereNoNumberVaries) {
  VariantStudy s = study();
  s.variants = variants_of({"time.integrator=leapfrog,ssp-rk3"});
  for (size_t i = 0; i < s.curves.size(); ++i)
    s.curves[i].variant = s.variants[i / 2].label;
  EXPECT_THAT(quantities_html("title", s),
              HasSubstr(R"("x":"spacing [m]","y":"tip, final [m]","logarithmic":false,"curves":)"
                        R"([{"name":"SPH integrator=leapfrog","points":[{"x":0.5,)"));
}

TEST(VariantQuantities, VerdictSaysHowFarTheMethodsAreApart) {
  VariantStudy s = study();
  EXPECT_THAT(quantities_verdict(s), HasSubstr("On level 1 SPH and finite volume are within 5 % of "
                                               "the largest value in 1 of 1 quantities"));
  EXPECT_THAT(quantities_verdict(s), HasSubstr("furthest apart in tip, final (De=100): by 0.493"));
  s.curves[3].points[1].run.quantities[0].final_value = 1;  // of FVM with De = 100 on level 1
  EXPECT_THAT(quantities_verdict(s), HasSubstr("Too coarse to say of tip, final (De=100)"));
  EXPECT_THAT(quantities_verdict(s), HasSubstr("in 0 of 1 quantities"));
  s.curves = {s.curves[0]};
  EXPECT_THAT(quantities_verdict(s), HasSubstr("One method only"));
}

TEST(VariantQuantities, AreChosenByNameOrProbe) {
  const cases::Case setup = cases::read_case(find_case("bending-column-ve"), {});
  const std::string probe = setup.probes.front().name;
  EXPECT_NO_THROW(check_quantities(setup, {"all", probe, probe + ", least", "least J"}));
  try {
    check_quantities(setup, {"kinetic enrgy"});
    FAIL();
  } catch (const base::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("kinetic energy"));
  }
  EXPECT_THAT(chosen_quantities(setup, {probe}, {}), testing::Contains(probe + ", greatest"));
  EXPECT_THAT(chosen_quantities(setup, {"least J"}, {}), ElementsAre("least J"));
}

/// What history.csv, bounds and tables have of every run.
std::vector<std::string> names_of_every_run() {
  std::vector<std::string> names{"all"};
  for (const auto& column : io::history_columns_from_csv(io::history_csv({}, {}), "history.csv"))
    names.push_back(column.name);
  for (const auto& [name, value] : run_figures({}, {io::HistoryRow{}}))
    names.push_back(name);
  for (const RunQuantity& quantity : quantities_of_run({}))
    names.push_back(quantity.name);
  return names;
}

TEST(VariantQuantities, HaveNamesThatNoProbeMayTake) {
  const auto names = names_of_every_run();
  EXPECT_GT(names.size(), 40U);
  for (const std::string& name : names) {
    try {
      cases::case_from_text(
          "[mesh]\ncells = [2, 2, 2]\n[material]\nmodel = 'neo-hookean'\ndensity = 1\n"
          "shear_modulus = 1\nlame = 1\n[time]\nend = 1\n[[probe]]\nname = \"" +
              name + "\"\nunit = \"m\"\nkind = \"mean\"\nquantity = \"ux\"\n",
          "case.toml");
      ADD_FAILURE() << name << " is accepted";
    } catch (const base::InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("case.toml:11:8: probe.0.name = '" + name + "' is what"));
    }
  }
}

// energies that are zero in every run say nothing; a residual of zero does
TEST(VariantQuantities, LeaveOutByDefaultWhatSaysNothing) {
  const cases::Case setup = cases::read_case(find_case("bending-column-ve"), {});
  StudyRuns runs;
  runs.curves = study().curves;
  const auto chosen = chosen_quantities(setup, {}, runs);
  EXPECT_THAT(chosen,
              testing::IsSupersetOf({"kinetic energy", "energy residual", "least J", "seconds"}));
  EXPECT_THAT(chosen, Not(testing::Contains("external work")));
  EXPECT_THAT(chosen, Not(testing::Contains("steps")));
}

}  // namespace
}  // namespace diptych::harness
