/// Edit distance and "did you mean" of messages.

#include "common/base/text.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace {

using diptych::base::edit_distance;
using diptych::base::folded;
using diptych::base::joined;
using diptych::base::nearest_name;
using diptych::base::suggestion;

TEST(EditDistance, CountsInsertionsDeletionsAndSubstitutions) {
  EXPECT_EQ(edit_distance("", ""), 0);
  EXPECT_EQ(edit_distance("", "abc"), 3);
  EXPECT_EQ(edit_distance("abc", ""), 3);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
  EXPECT_EQ(edit_distance("material", "materal"), 1);
}

TEST(EditDistance, CountsASwapOfNeighboursAsOne) {
  EXPECT_EQ(edit_distance("lenght", "length"), 1);
  EXPECT_EQ(edit_distance("ab", "ba"), 1);
  // optimal string alignment: a swapped pair is not edited again, so "ca" -> "abc" takes 3, not 2
  EXPECT_EQ(edit_distance("ca", "abc"), 3);
}

TEST(EditDistance, IgnoresCaseAndIsSymmetric) {
  EXPECT_EQ(edit_distance("MooneyRivlin", "mooneyrivlin"), 0);
  const std::vector<std::string> words = {"density", "Destiny", "nu", "poisson", "posiosn", ""};
  for (const auto& a : words) {
    for (const auto& b : words)
      EXPECT_EQ(edit_distance(a, b), edit_distance(b, a)) << a << " " << b;
  }
}

TEST(NearestName, IsTheOneOfLeastDistance) {
  const std::vector<std::string> names = {"density", "youngs_modulus", "poissons_ratio"};
  EXPECT_EQ(nearest_name("densty", names), "density");
  EXPECT_EQ(nearest_name("young_modulus", names), "youngs_modulus");
  EXPECT_EQ(nearest_name("PoissonRatio", names), "poissons_ratio");
}

TEST(NearestName, IsEmptyWhereMoreThanHalfOfTheLettersDiffer) {
  EXPECT_EQ(nearest_name("abcd", {"abxy"}), "abxy");  // two of four
  EXPECT_EQ(nearest_name("abcd", {"axyz"}), "");      // three of four
  EXPECT_EQ(nearest_name("viscosity", {"gravity_x"}), "");
  EXPECT_EQ(nearest_name("abcd", {}), "");
  EXPECT_EQ(nearest_name("", {"a"}), "");
}

TEST(Suggestion, NamesTheNearestOrElseListsAll) {
  const std::vector<std::string> names = {"cubic", "quintic", "wendland"};
  EXPECT_EQ(suggestion("quintc", names), "; did you mean 'quintic'?");
  EXPECT_EQ(suggestion("xyzzy", names), "; known: cubic, quintic, wendland");
}

TEST(Joined, PutsTheSeparatorBetween) {
  EXPECT_EQ(joined({}), "");
  EXPECT_EQ(joined({"a"}), "a");
  EXPECT_EQ(joined({"a", "b", "c"}, " | "), "a | b | c");
}

TEST(FoldedText, FitsEveryLineAndKeepsTheOthers) {
  EXPECT_EQ(folded("short\n\n  kept as it is\n", 2, 20), "short\n\n  kept as it is\n");
  EXPECT_EQ(folded("one two three four\nfive", 4, 10), "one two\n    three\n    four\nfive");
  EXPECT_EQ(folded("a twenty-letter-word-here b", 2, 8), "a twenty-letter-word-here\n  b");
  EXPECT_EQ(folded("", 2, 8), "");
}

}  // namespace
