/// Values of probes from elsewhere: what is read, and what is refused with place and remedy.

#include "common/base/error.hpp"
#include "common/cases/reader.hpp"
#include "tests/common/io/scratch.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <gmock/gmock.h>

namespace diptych::cases {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const char* const body =
    "[parameters]\nT = 2\n[mesh]\ncells = [1, 1, 1]\n[material]\nmodel = 'neo-hookean'\n"
    "density = 1\nshear_modulus = 1\nlame = 1\n[time]\nend = 1\n"
    "[[probe]]\nname = 'tip'\nunit = 'm'\nat = [0, 0, 0]\nquantity = 'ux'\n";

/// A case in a folder of its own, with a file of values beside it.
class CaseReferences : public testing::Test {
 protected:
  Case read(const std::string& reference, const std::string& csv = "t,u\n") {
    std::ofstream(folder_ / "values.csv") << csv;
    return case_from_text(body + ("[[reference]]\n" + reference), folder_ / "case.toml");
  }
  std::string refusal(const std::string& reference, const std::string& csv = "t,u\n") {
    try {
      read(reference, csv);
    } catch (const base::InputError& error) {
      return error.what();
    }
    return "accepted";
  }
  test::Scratch folder_;
};

using Point = std::array<double, 2>;

TEST_F(CaseReferences, AreOneValueOrAFileInTheOrderOfTime) {
  const Case one = read("probe = 'tip'\nvalue = 0.5\ntime = 'T/4'\nsource = 'Doe 1999'\n");
  ASSERT_EQ(one.references.size(), 1u);
  EXPECT_EQ(one.references[0].source, "Doe 1999");
  EXPECT_THAT(one.references[0].points, ElementsAre(Point{0.5, 0.5}));
  const Case file = read("probe = 'tip'\nfile = 'values.csv'\nsource = 's'\n",
                         "time [s],tip [m]\r\n0.25 ,2\r\n\r\n0.5, -1e-3\r\n");
  EXPECT_THAT(file.references[0].points, ElementsAre(Point{0.25, 2}, Point{0.5, -1e-3}));
}

TEST_F(CaseReferences, AreAColumnOfAFileByItsName) {
  const std::string csv = "t,x0 [m],x1 [m]\n0,1,2\n1,3,-4\n";
  const Case read_case =
      read("probe = 'tip'\nfile = 'values.csv'\ncolumn = 'x1 [m]'\nsource = 's'\n", csv);
  EXPECT_THAT(read_case.references[0].points, ElementsAre(Point{0, 2}, Point{1, -4}));
  const std::string quoted = "t,\"x, mid [m]\",\"a \"\"b\"\"\"\n0,1,2\n1,3,-4\n";
  const std::string file = "probe = 'tip'\nfile = 'values.csv'\nsource = 's'\n";
  EXPECT_THAT(read(file + "column = 'x, mid [m]'\n", quoted).references[0].points,
              ElementsAre(Point{0, 1}, Point{1, 3}));
  EXPECT_THAT(read(file + "column = 'a \"b\"'\n", quoted).references[0].points,
              ElementsAre(Point{0, 2}, Point{1, -4}));
  EXPECT_THAT(refusal(file + "column = 'x2 [m]'\n", csv), HasSubstr("is no column of the file"));
  EXPECT_THAT(refusal(file + "column = 't'\n", csv), HasSubstr("is no column of the file"));
  EXPECT_THAT(refusal(file + "column = 'x1 [m]'\n", "t,x0 [m],x1 [m]\n0,1\n"),
              HasSubstr("values.csv:2: '0,1' is not a line of 3 cells"));
  EXPECT_THAT(refusal("probe = 'tip'\nvalue = 1\ntime = 1\nsource = 's'\ncolumn = 'u'\n"),
              HasSubstr("has no effect without reference.file"));
}

TEST_F(CaseReferences, StateTheirUncertaintyInTheirUnitOrAsAShare) {
  const std::string value = "probe = 'tip'\nvalue = -2\ntime = 1\nsource = 's'\n";
  EXPECT_FALSE(read(value).references[0].uncertainty);
  EXPECT_EQ(read(value + "uncertainty = 0.1\n").references[0].uncertainty, 0.1);
  EXPECT_EQ(read(value + "relative_uncertainty = 0.1\n").references[0].uncertainty, 0.2);
  EXPECT_THAT(refusal(value + "uncertainty = 0\n"), HasSubstr("reference.0.uncertainty"));
  EXPECT_THAT(refusal(value + "uncertainty = 1\nrelative_uncertainty = 1\n"),
              HasSubstr("remove one of the two"));
  EXPECT_THAT(refusal("probe = 'tip'\nvalue = 0\ntime = 1\nsource = 's'\n"
                      "relative_uncertainty = 0.1\n"),
              HasSubstr("all 0"));
}

TEST_F(CaseReferences, AreRefusedWhereTheyMeanNothing) {
  const std::string value = "value = 1\ntime = 1\nsource = 's'\n";
  EXPECT_THAT(refusal("probe = 'tpi'\n" + value), HasSubstr("did you mean 'tip'?"));
  EXPECT_THAT(refusal("probe = 'tip'\nvalue = 1\nsource = 's'\n"), HasSubstr("reference.0.time"));
  EXPECT_THAT(refusal("probe = 'tip'\nvalue = 1\ntime = 1\n"), HasSubstr("reference.0.source"));
  EXPECT_THAT(refusal("probe = 'tip'\nfile = 'values.csv'\n" + value),
              HasSubstr("has no effect with reference.file"));
  const std::string file = "probe = 'tip'\nfile = 'values.csv'\nsource = 's'\n";
  EXPECT_THAT(refusal(file), HasSubstr("has no values below its first line"));
  EXPECT_THAT(refusal(file, "t,u\n0,0\n1;2\n"), HasSubstr("values.csv:3: '1;2' is not a time"));
  EXPECT_THAT(refusal(file, "t,u\n0,nan\n"), HasSubstr("values.csv:2"));
  EXPECT_THAT(refusal(file, "t,u\n0,1,2\n"), HasSubstr("values.csv:2"));
  EXPECT_THAT(refusal(file, "0,1\n1,2\n"),
              HasSubstr("values.csv:1: '0,1' is a line of numbers; write a line of names above it, "
                        "as in \"time [s],value [m]\""));
  EXPECT_THAT(refusal(file, "time [ms],u\n0,1\n"),
              HasSubstr("values.csv:1: 'time [ms]' is in ms, asked is s"));
  EXPECT_THAT(refusal(file, "time (ms),u\n0,1\n"), HasSubstr("is in ms"));
  EXPECT_THAT(refusal(file, "time [s],u [mm]\n0,1\n"),
              HasSubstr("values.csv:1: 'u [mm]' is in mm, asked is m"));
  EXPECT_THAT(
      refusal(file, "t,u\n0,1\n2,1\n1,1\n"),
      HasSubstr("values.csv:4: the time 1 s is not after that of the value before it, 2 s"));
  EXPECT_THAT(refusal(file, "t,u\n0,1\n0,2\n"), HasSubstr("values.csv:3"));
  EXPECT_EQ(refusal(file, "time,u (of the tip)\n0,1\n2,1\n"), "accepted");
  EXPECT_THAT(refusal("probe = 'tip'\nfile = 'none.csv'\nsource = 's'\n"),
              HasSubstr("cannot be read"));
}

}  // namespace
}  // namespace diptych::cases
