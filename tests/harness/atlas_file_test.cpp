#include "benchmarks/study/atlas.hpp"
#include "common/base/error.hpp"
#include "common/io/run_record.hpp"
#include "tests/folders.hpp"

#include <filesystem>
#include <gmock/gmock.h>

namespace diptych::harness {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::string head = "title = 'A'\ncase = 'bending-column'\n";
const std::string nu = "[[axis]]\nname = 'nu'\nkey = 'parameters.nu'\nvalues = [0.3, 0.4, 0.45]\n";
const std::string graph =
    "[[axis]]\nname = 'graph'\n"
    "[[axis.choice]]\nname = 'wide'\nmethods = ['sph']\nset = ['sph.kappa=1.2']\n"
    "[[axis.choice]]\nname = 'near'\nmethods = ['sph']\nset = ['sph.kappa=0.75']\n"
    "[[axis.choice]]\nname = 'tets'\nmethods = ['fvm']\ncoarse = true\n"
    "set = ['mesh.element=tetrahedron']\ncase = 'impact'\n";

Atlas atlas_of(const std::string& text) {
  // tests run side by side
  const auto folder = std::filesystem::path(testing::TempDir()) / std::to_string(getpid());
  std::filesystem::create_directories(folder);
  const std::string path = (folder / "map.toml").string();
  io::write_file_atomically(path, text);
  return read_atlas(path);
}

std::string refusal_of(const std::string& text) {
  try {
    atlas_of(text);
  } catch (const base::InputError& error) {
    return error.what();
  }
  return "";
}

std::vector<std::string> names_of(const Atlas& atlas, const std::string& method, bool coarse) {
  std::vector<std::string> names;
  for (const AtlasPoint& point : points_of(atlas, method, coarse)) {
    std::string name;
    for (const std::string& setting : settings_of(atlas, point))
      name += setting + " ";
    names.push_back(name);
  }
  return names;
}

TEST(AtlasFile, GivesEachMethodTheProductOfItsChoices) {
  const Atlas atlas = atlas_of(head + nu + graph);
  EXPECT_EQ(atlas.name, "map");
  EXPECT_EQ(atlas.axes[0].choices[1].set, std::vector<std::string>{"parameters.nu=0.4"});
  EXPECT_THAT(names_of(atlas, "sph", false), ElementsAre("0.3 wide ", "0.3 near ", "0.4 wide ",
                                                         "0.4 near ", "0.45 wide ", "0.45 near "));
  EXPECT_THAT(names_of(atlas, "fvm", false), ElementsAre("0.3 tets ", "0.4 tets ", "0.45 tets "));
  EXPECT_THAT(atlas.axes[1].choices[2].case_file, HasSubstr("impact/case.toml"));
}

TEST(AtlasFile, IsCoarseAtTheEndsOfAnAxisOrWhereItSaysSo) {
  EXPECT_THAT(names_of(atlas_of(head + nu), "fvm", true), ElementsAre("0.3 ", "0.45 "));
  EXPECT_THAT(names_of(atlas_of(head + nu + "coarse = [0.4]\n"), "fvm", true), ElementsAre("0.4 "));
  EXPECT_THAT(names_of(atlas_of(head + graph), "fvm", true), ElementsAre("tets "));
  EXPECT_THAT(names_of(atlas_of(head + graph), "sph", true), ElementsAre("wide ", "near "));
}

TEST(AtlasFile, RefusesWithThePlaceAndTheNearestName) {
  EXPECT_THAT(refusal_of(head + "[[axs]]\n"), HasSubstr("did you mean 'axis'?"));
  EXPECT_THAT(refusal_of(head), HasSubstr("needs an [[axis]]"));
  EXPECT_THAT(refusal_of("title = 'A'\ncase = 'bending-colum'\n" + nu), HasSubstr("map.toml:2:"));
  EXPECT_THAT(refusal_of(head + nu + "coarse = [0.5]\n"), HasSubstr("none of the values"));
  EXPECT_THAT(refusal_of(head + nu + nu), HasSubstr("two axes are called 'nu'"));
  EXPECT_THAT(refusal_of(head + "columns = ['mu']\n" + nu), HasSubstr("did you mean 'nu'?"));
  EXPECT_THAT(refusal_of(head + "holds = ['least J']\n" + nu), HasSubstr("is no bound"));
  EXPECT_THAT(refusal_of(head + "[[axis]]\nname = 'a'\n"), HasSubstr("[[axis.choice]]"));
  EXPECT_THAT(refusal_of(head + "methods = ['sphh']\n" + nu), HasSubstr("unknown method"));
}

TEST(AtlasFile, OfEveryShippedAtlasCanBeRead) {
  int n = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(tests::source_folder() + "/benchmarks/atlas")) {
    if (entry.path().extension() != ".toml") continue;
    const Atlas atlas = read_atlas(find_atlas(entry.path().stem().string()));
    for (const std::string& method : atlas.methods) {
      EXPECT_FALSE(points_of(atlas, method, true).empty()) << entry.path();
      EXPECT_GT(points_of(atlas, method, false).size(), points_of(atlas, method, true).size());
    }
    ++n;
  }
  EXPECT_GE(n, 3);
}

}  // namespace
}  // namespace diptych::harness
