/// Links between the pages of the project lead somewhere, and the check catches what it should.

#include "tests/style/page_links.hpp"

#include "tests/folders.hpp"

#include <gtest/gtest.h>

#include <gmock/gmock.h>

namespace diptych::tests {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(PageLinks, LeadToFilesAndSectionsThatAreThere) {
  const auto pages = pages_of_project(source_folder());
  EXPECT_GT(pages.size(), 20u);
  for (const auto& page : pages)
    EXPECT_THAT(dead_links(page), IsEmpty());
}

TEST(PageLinks, CheckCatchesWhatIsNotThere) {
  const std::filesystem::path folder = testing::TempDir() + "diptych_page_links";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "other.md") << "# 1.2 Steps, and σ\n";
  std::ofstream(folder / "page.md")
      << "# Here\n[a](other.md) [b](other.md#12-steps-and-σ) [c](#here) [d](https://x.org/none)\n"
         "[e](none.md) [f](other.md#here) [g](#there)\n";
  EXPECT_THAT(
      dead_links(folder / "page.md"),
      ElementsAre("page.md: ](none.md)", "page.md: ](other.md#here)", "page.md: ](#there)"));
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace diptych::tests
