/// The fields at a node under the names that expressions of probes use.

#include "common/cases/probe_fields.hpp"

#include "common/base/error.hpp"
#include "common/cases/stress_measures.hpp"
#include "tests/common/io/scratch.hpp"

#include <gmock/gmock.h>
#include <map>

namespace diptych::cases {
namespace {

using testing::HasSubstr;

TEST(ProbeFields, GiveEachNameItsComponent) {
  NodeValues node;
  node.u = {1, 2, 3};
  node.v = {4, 5, 6};
  node.F << 1.1, 0.2, 0.3, 0.4, 1.5, 0.6, 0.7, 0.8, 1.9;
  node.P << 10, 11, 12, 13, 14, 15, 16, 17, 18;
  node.J = node.F.determinant();
  ProbeFields fields;
  fields.set(node);
  const auto names = fields.names();
  const auto values = fields.values(0);
  ASSERT_EQ(names.size(), values.size());
  std::map<std::string, double> of;
  for (size_t k = 0; k < names.size(); ++k)
    of[names[k]] = values[k];
  EXPECT_EQ(of.size(), names.size()) << "a name stands twice";
  const Mat3 sigma = node.P * node.F.transpose() / node.J;
  for (int i = 0; i < 3; ++i) {
    const char x = "xyz"[i];
    EXPECT_EQ(of[std::string("u") + x], node.u[i]);
    EXPECT_EQ(of[std::string("v") + x], node.v[i]);
    for (int j = 0; j < 3; ++j) {
      const std::string ij = {x, "xyz"[j]};
      EXPECT_EQ(of["F" + ij], node.F(i, j));
      EXPECT_EQ(of["P" + ij], node.P(i, j));
      const bool is_given = i <= j;
      EXPECT_EQ(of.count("s" + ij), is_given ? 1U : 0U);
      // the symmetric part; P F^T of these is not symmetric
      if (i == j) {
        EXPECT_NEAR(of["s" + ij], sigma(i, i), 1e-12 * sigma.norm());
      }
    }
  }
  EXPECT_EQ(of["J"], node.J);
  EXPECT_NEAR(of["p"], -sigma.trace() / 3, 1e-12 * sigma.norm());
  EXPECT_EQ(of["mises"], von_mises(cauchy_stress(node.P, node.F, node.J)));
}

TEST(ProbeFields, RefuseParametersOfTheirNames) {
  const ProbeFields fields;
  functions::Vocabulary vocabulary;
  vocabulary.parameters["E"] = 1;
  const functions::SourcePlace where{"case.toml", 7, 1};
  EXPECT_NO_THROW(fields.check_names(vocabulary, where));
  vocabulary.parameters["mises"] = 1;
  EXPECT_THAT(test::message_of<base::InputError>([&] { fields.check_names(vocabulary, where); }),
              HasSubstr("'mises' is a field in the quantities of probes; rename the parameter"));
}

}  // namespace
}  // namespace diptych::cases
