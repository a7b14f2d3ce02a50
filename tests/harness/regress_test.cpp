/// The regression fires: its comparer on broken records, its checks on seeded mistakes.

#include "benchmarks/regression/regress.hpp"

#include "benchmarks/regression/report.hpp"
#include "benchmarks/run/case_list.hpp"
#include "benchmarks/run/menus.hpp"
#include "common/base/error.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <gmock/gmock.h>
#include <limits>
#include <set>

namespace diptych::harness {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Names of the checks that failed.
std::set<std::string> fired(const std::vector<RegressCheck>& checks) {
  std::set<std::string> names;
  for (const RegressCheck& check : checks) {
    if (check.verdict == Verdict::failed) names.insert(check.name);
  }
  return names;
}

RegressBaseline small_baseline() {
  RegressBaseline b;
  b.case_name = "small";
  b.reason = "why \"not\"";
  b.commit = "abc+";
  b.date = "2026-01-01T00:00:00Z";
  b.platform = {"x86-64-v3", "GCC 12", "-O2"};
  b.set = {"time.end=0.1"};
  b.levels = 2;
  b.disagreement = {{"kinetic energy", 4.0 / 3}};
  MethodFigures figures;
  figures.state = "00ff";
  figures.canary = {{"velocity norm", {0.1, 1}}};
  figures.errors = {{"velocity L2", {1.0 / 3, 1.0 / 3}}};
  figures.quantities = {{"strain energy", {-1e-300, 2e17}}};
  b.methods = {{"sph", figures}, {"fvm", figures}};
  return b;
}

TEST(RegressComparer, IsMetByEqualFiguresOnly) {
  const RegressFigures one{{"a", {2, 4}}};
  EXPECT_THAT(fired(compare_figures("x", one, one, 0)), IsEmpty());
  EXPECT_THAT(fired(compare_figures("x", one, {{"a", {2.4, 4}}}, 0.1 + 1e-12)), IsEmpty());
  EXPECT_THAT(fired(compare_figures("x", one, {{"a", {2.4, 4}}}, 0.09)), Contains("x"));
}

TEST(RegressComparer, FailsOnAScaleThatTheRunDoesNotGive) {
  const RegressFigures now{{"a", {2, 4}}};
  EXPECT_THAT(fired(compare_figures("x", {{"a", {2, 1e30}}}, now, 1)), Contains("x"));
  EXPECT_THAT(compare_figures("x", {{"a", {1, 1e30}}}, now, 1).at(0).note,
              HasSubstr("recorded with the scale 1e+30"));
  EXPECT_THAT(fired(compare_figures("x", {{"a", {2, 4.0001}}}, now, 0)), IsEmpty());
  EXPECT_THAT(fired(compare_figures("x", {{"a", {2, 2}}}, now, 0)), IsEmpty()) << "it is narrower";
}

TEST(RegressComparer, FailsOnNaN) {
  const RegressFigures good{{"a", {2, 2}}}, bad{{"a", {nan, 2}}}, bad_scale{{"a", {1, nan}}};
  EXPECT_THAT(fired(compare_figures("x", good, bad, 1e9)), Contains("x"));
  EXPECT_THAT(fired(compare_figures("x", bad, good, 1e9)), Contains("x"));
  EXPECT_THAT(fired(compare_figures("x", bad, bad, 1e9)), Contains("x"));
  EXPECT_THAT(fired(compare_figures("x", bad_scale, good, 1e9)), Contains("x"));
  EXPECT_EQ(checked("x", "f", 0, nan).verdict, Verdict::failed);
  EXPECT_EQ(checked("x", "f", nan, 1).verdict, Verdict::failed);
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(checked("x", "f", inf, inf).verdict, Verdict::failed);
}

TEST(RegressComparer, FailsOnAFigureThatOneSideLacks) {
  const RegressFigures one{{"a", {2, 2}}}, two{{"a", {2, 2}}, {"b", {1, 1}}};
  EXPECT_THAT(fired(compare_figures("x", two, one, 1e9)), Contains("x"));
  EXPECT_THAT(fired(compare_figures("x", one, two, 1e9)), Contains("x"));
}

TEST(RegressComparer, FailsOnAnEmptyRecordAndOnABreakdown) {
  MethodMeasurement now;
  now.figures = small_baseline().methods.at("sph");
  EXPECT_THAT(fired(checks_of(now.figures, now, true)), IsEmpty());
  EXPECT_THAT(fired(checks_of({}, now, true)), Contains("canary"));
  EXPECT_THAT(fired(checks_of({}, {}, true)), Contains("canary"));
  now.failure = "J <= 0";
  EXPECT_THAT(fired(checks_of(now.figures, now, true)), Contains("run"));
}

TEST(RegressAgreement, IsBoundedByTheErrorBarsAndKnownOnesMayNotGrow) {
  RegressMeasurement now;
  RegressBaseline recorded;
  now.agreement["E"] = {1.0, 1.3, 0.2};
  EXPECT_THAT(fired(agreement_checks(recorded, now)), Contains("agreement"));
  recorded.disagreement["E"] = 1.5;
  EXPECT_EQ(agreement_checks(recorded, now).at(0).verdict, Verdict::known);
  EXPECT_THAT(regress_table({{"c", "both", agreement_checks(recorded, now)}}),
              HasSubstr("add [[apart]]"));
  now.explanations["E"] = "SPH swings late";
  EXPECT_EQ(agreement_checks(recorded, now).at(0).verdict, Verdict::known);
  EXPECT_THAT(regress_table({{"c", "both", agreement_checks(recorded, now)}}),
              HasSubstr("apart: E 1.5 of 1 (sph 1, fvm 1.3; SPH swings late)"));
  recorded.disagreement["E"] = 1.49;
  EXPECT_THAT(fired(agreement_checks(recorded, now)), Contains("agreement"));
  now.agreement["E"] = {1.0, 1.1, 0.2};
  EXPECT_EQ(agreement_checks(recorded, now).at(0).verdict, Verdict::met);
  now.agreement["E"] = {1.0, nan, 0.2};
  EXPECT_THAT(fired(agreement_checks(recorded, now)), Contains("agreement"));
  now.agreement.clear();
  EXPECT_THAT(fired(agreement_checks(recorded, now)), Contains("agreement"));
}

TEST(RegressDissipation, IsBoundedByEveryShippedCase) {
  for (const ListedCase& entry : listed_cases("")) {
    const cases::Case setup = harness::read_case(entry.file);
    const bool by_holds = std::any_of(
        setup.expect.holds.begin(), setup.expect.holds.end(),
        [](const auto& bound) { return bound.figure.starts_with("numerical ") && bound.at_most; });
    const bool is_to_be_stopped = !setup.expect.stops.empty();
    EXPECT_TRUE(setup.bounds.numerical_dissipation || by_holds || is_to_be_stopped)
        << entry.name << ": add [bounds] numerical_dissipation";
  }
}

/// A method whose run is off a reference by so many times its uncertainty.
MethodMeasurement off_by(double times) {
  MethodMeasurement now;
  now.figures = small_baseline().methods.at("sph");
  now.asked = {checked(reference_check, "tip, reference", 0.5 * times, 0.5, "Doe 1999")};
  return now;
}

TEST(RegressReference, ThatWasMetMustStayMetAndWhatWasNotMayNotGrow) {
  const MethodFigures met = small_baseline().methods.at("sph");
  MethodFigures unmet = met;
  unmet.unmet["tip, reference"] = 2;
  EXPECT_THAT(fired(checks_of(met, off_by(0.9), true)), IsEmpty());
  EXPECT_THAT(fired(checks_of(met, off_by(1.1), true)), Contains("reference"));
  EXPECT_THAT(fired(checks_of(met, off_by(nan), true)), Contains("reference"));
  EXPECT_THAT(fired(checks_of(unmet, off_by(nan), true)), Contains("reference"));
  EXPECT_THAT(fired(checks_of(unmet, off_by(2.1), true)), Contains("reference"));
  const auto known = checks_of(unmet, off_by(2), true);
  EXPECT_THAT(fired(known), IsEmpty());
  EXPECT_THAT(regress_table({{"c", "sph", known}}),
              HasSubstr("not met: tip, reference 1 of 0.5 (Doe 1999)"));
  EXPECT_THAT(fired(checks_of(unmet, off_by(0.9), true)), IsEmpty()) << "met by now";
  MethodMeasurement gone = off_by(2);
  gone.asked.clear();
  EXPECT_THAT(fired(checks_of(unmet, gone, true)), Contains("reference")) << "not measured";
}

TEST(RegressBaselineFile, KeepsWhatIsNotMet) {
  RegressBaseline b = small_baseline();
  b.methods["sph"].unmet["numerical share"] = 5.0 / 3;
  const RegressBaseline c = baseline_from_json(to_json(b), "small.json");
  EXPECT_EQ(c.methods.at("sph").unmet, b.methods["sph"].unmet);
  EXPECT_TRUE(c.methods.at("fvm").unmet.empty());
}

TEST(RegressBaselineFile, KeepsEveryBit) {
  const RegressBaseline b = small_baseline();
  const RegressBaseline c = baseline_from_json(to_json(b), "small.json");
  EXPECT_EQ(to_json(b), to_json(c));
  EXPECT_TRUE(b.platform == c.platform);
  EXPECT_EQ(c.methods.at("fvm").errors.at("velocity L2").value, 1.0 / 3);
  EXPECT_EQ(c.methods.at("fvm").quantities.at("strain energy").value, -1e-300);
}

/// The message of a text that is no baseline.
std::string complaint(const std::string& text) {
  try {
    baseline_from_json(text, "x.json");
  } catch (const base::InputError& error) {
    return error.what();
  }
  return "accepted";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(RegressBaselineFile, RefusesWhatIsNoRecord) {
  const std::string good = to_json(small_baseline());
  EXPECT_EQ(complaint(""), "x.json: the file is empty");
  EXPECT_THAT(complaint(good.substr(0, good.size() / 2)), HasSubstr("no JSON"));
  EXPECT_THAT(complaint("[]"), HasSubstr("must be an object"));
  EXPECT_THAT(complaint(replaced(good, "\"value\": 0.1,", "\"value\": 1e999,")),
              testing::StartsWith("x.json: no JSON: "));
  EXPECT_THAT(complaint(replaced(good, "\"fvm\"", "\"fvn\"")),
              HasSubstr("x.json: methods: 'fvn' is no method; known: sph, fvm"));
  EXPECT_THAT(complaint(replaced(good, "why \\\"not\\\"", " ")),
              HasSubstr("x.json: 'reason' must be the reason why it was recorded"));
  EXPECT_THAT(complaint(replaced(replaced(good, "\"levels\": 2", "\"levels\": 1"),
                                 "\"one_level_because\": \"\"", "\"one_level_because\": \"b\"")),
              HasSubstr("x.json: 'disagreement' must be empty"));
  EXPECT_THAT(complaint(replaced(good, "\"errors\"", "\"error\"")),
              HasSubstr("unknown key 'error'"));
  EXPECT_THAT(complaint(replaced(good, "\"value\": 0.1,", "")), HasSubstr("'value' is missing"));
  EXPECT_THAT(complaint(replaced(good, "\"value\": 0.1", "\"value\": null")),
              HasSubstr("velocity norm: 'value' must be a finite number"));
  EXPECT_THAT(complaint(replaced(good, "\"value\": 0.1", "\"value\": [0.1]")),
              HasSubstr("must be a finite number"));
  EXPECT_THAT(complaint(replaced(good, "\"value\": 0.1", "\"value\": NaN")), HasSubstr("no JSON"));
  EXPECT_THAT(complaint(replaced(good, "\"levels\": 2", "\"levels\": 1")),
              HasSubstr("one_level_because"));
}

TEST(RegressBaselineFile, TakesNoNaN) {
  RegressBaseline b = small_baseline();
  b.methods["sph"].errors["velocity L2"].value = nan;
  EXPECT_THROW(to_json(b), base::InputError);
}

TEST(RegressTable, ShowsWhatFailedAndByHowMuch) {
  const std::vector<RegressCheck> checks{checked("errors", "v L2", 3e-8, 1e-8, "2, was 1"),
                                         checked("errors", "u L2", 0, 1e-8)};
  const std::string text = regress_table({{"some-case", "sph", checks}});
  EXPECT_THAT(text,
              AllOf(HasSubstr("1 FAILED, 1 met"), HasSubstr("FAILED errors: v L2 3e-08 of 1e-08"),
                    HasSubstr("(2, was 1)")));
  EXPECT_TRUE(has_failed({{"some-case", "sph", checks}}));
  EXPECT_FALSE(has_failed({{"some-case", "sph", {checks[1]}}}));
}

// ---- seeded mistakes: a viscoelastic wave with an exact solution, level 0, 30 steps or so

class Mutation : public testing::Test {
 protected:
  static RegressMeasurement measured(const std::vector<std::string>& overrides) {
    RegressBaseline size;
    size.set = {"time.end=0.015", "output.frames=3", "time.integrator=ssp-rk3"};
    size.one_level_because = "of the test";
    return measure_regress(find_case("shear-wave-ve2"), size, overrides, 1);
  }
  static const RegressMeasurement& sound() {
    static const RegressMeasurement measurement = measured({});
    return measurement;
  }
  /// Checks that fire on a platform other than the one of the record: the weaker bounds.
  static std::set<std::string> fired_by(const std::vector<std::string>& overrides,
                                        const std::string& method) {
    const RegressMeasurement mutant = measured(overrides);
    const auto checks =
        checks_of(sound().methods.at(method).figures, mutant.methods.at(method), false);
    const auto names = fired(checks);
    std::string list;
    for (const std::string& name : names)
      list += " " + name;
    std::printf("%s, %s: caught by%s\n", overrides.empty() ? "nothing" : overrides[0].c_str(),
                method.c_str(), names.empty() ? " nothing" : list.c_str());
    return names;
  }
};

TEST_F(Mutation, NoneFiresNothing) {
  for (const std::string method : {"sph", "fvm"})
    EXPECT_THAT(fired_by({}, method), IsEmpty());
}

TEST_F(Mutation, OnePercentOfTheModulusIsCaught) {
  for (const std::string method : {"sph", "fvm"})
    EXPECT_THAT(fired_by({"material.youngs_modulus=17.17e6"}, method),
                AllOf(Contains("canary"), Contains("errors"), Contains("quantities")));
}

TEST_F(Mutation, DroppedDissipationIsCaught) {
  for (const std::string method : {"sph", "fvm"})
    EXPECT_THAT(fired_by({"scheme.dissipation=0"}, method),
                AllOf(Contains("errors"), Contains("quantities")));
}

TEST_F(Mutation, AWrongBranchTimeIsCaught) {
  for (const std::string method : {"sph", "fvm"})
    EXPECT_THAT(fired_by({"material.branch.0.tau_C=2.02e-3"}, method),
                AllOf(Contains("canary"), Contains("errors"), Contains("quantities")));
}

TEST_F(Mutation, AnIntegratorOfLowerOrderIsCaught) {
  for (const std::string method : {"sph", "fvm"})
    EXPECT_THAT(fired_by({"time.integrator=ssp-rk2"}, method),
                AllOf(Contains("canary"), Contains("errors")));
}

TEST_F(Mutation, AnotherTimeStepIsCaught) {
  for (const std::string method : {"sph", "fvm"})
    EXPECT_THAT(fired_by({"time.cfl=0.29"}, method),
                AllOf(Contains("canary"), Contains("quantities")));
}

TEST_F(Mutation, AnotherKappaIsCaughtInSphOnly) {
  EXPECT_THAT(fired_by({"sph.kappa=1.3"}, "sph"), Contains("canary"));
  EXPECT_THAT(fired_by({"sph.kappa=1.3"}, "fvm"), IsEmpty());
}

}  // namespace
}  // namespace diptych::harness
