#include "postprocess/report/atlas_page.hpp"

#include <gmock/gmock.h>

namespace diptych::report {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// One row; two values of nu, each at two loads.
AtlasPicture picture() {
  return {"sph",
          "nodes",
          "nu, load",
          {{"moved <30 %>"}},
          {{"0.3", "p"}, {"0.3", "a load with a long name"}, {"0.49", "p"}, {"0.49", "q"}},
          {{{"stable", "", ""},
            {"stopped", "2 cells", "wrong"},
            {"wrong", "residual 1 > 0.01", ""},
            {}}}};
}

size_t count(const std::string& text, const std::string& part) {
  size_t n = 0;
  for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++n;
  return n;
}

TEST(AtlasPage, HasACellForEachPointThatIsKnown) {
  const std::string page = atlas_page("Map", "lead", "Of 3 points ...", {picture()}, "counts");
  EXPECT_EQ(count(page, "<rect class="), 3U);
  EXPECT_EQ(count(page, "class=\"wrong before\""), 1U) << "what it was, as a corner";
  EXPECT_THAT(page,
              AllOf(HasSubstr("moved &lt;30 %&gt;, 0.49, p: wrong: residual 1 &gt; 0.01"),
                    HasSubstr(">S</text>"), HasSubstr(">W</text>"), Not(HasSubstr("moved <30"))));
}

TEST(AtlasPage, NamesWhatColumnsShareOnce) {
  const std::string page = atlas_page("Map", "", "", {picture()}, "");
  EXPECT_EQ(count(page, "<title>0.3</title>"), 1U);
  EXPECT_EQ(count(page, "<title>0.49</title>"), 1U);
  EXPECT_THAT(page, AllOf(HasSubstr("…<title>a load with a long name</title>"),
                          HasSubstr("<th scope=\"col\">0.3, a load with a long name</th>")));
}

}  // namespace
}  // namespace diptych::report
