/// The copy of the case among the results runs to the same state, wherever it lies.

#include "tests/command_line/small_case.hpp"

#include <gtest/gtest.h>

namespace diptych {
namespace {

namespace fs = std::filesystem;
using tests::cube;
using tests::Folder;
using tests::probes;
using tests::summary_in;

TEST(CopyOfTheCase, RunsToTheSameState) {
  const Folder folder;
  fs::create_directories(folder.path() / "mine" / "data");
  folder.write("mine/data/tip.csv", "time [s],u [m]\n0,0\n1e-3,1e-3\n");
  folder.write("mine/data/pair.msh",
               "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n5\n1 0 0 0\n2 1 0 0\n3 0 1 0\n"
               "4 0 0 1\n5 1 1 1\n$EndNodes\n$Elements\n2\n1 4 2 1 1 1 2 3 4\n"
               "2 4 2 1 1 2 3 4 5\n$EndElements\n");
  std::string text = cube + "[time]\nend = 1e-3\n" + probes +
                     "[[reference]]\nprobe = \"at a corner\"\nsource = \"me\"\nfile = "
                     "\"data/tip.csv\"\n";
  const std::string box = "lower = [0, 0, 0]\nupper = [1, 1, 1]\ncells = [4, 4, 4]";
  text.replace(text.find(box), box.size(), "file = \"data/pair.msh\"");
  text.replace(text.find("hexahedron"), 10, "tetrahedron");
  folder.write("mine/case.toml", text);
  const auto first = tests::diptych(folder,
                                    "run mine/case.toml --method fvm --threads 1 --quiet "
                                    "--set time.end=5e-4 --set title='a \"pair\"' --out out");
  ASSERT_EQ(first.exit_code, 0) << first.text;
  for (const char* copy : {"out/case.toml", "out/fvm/case.toml"}) {
    const auto second =
        tests::diptych(folder, std::string("run ") + copy +
                                   " --method fvm --threads 1 --quiet --force --out again");
    ASSERT_EQ(second.exit_code, 0) << second.text;
    const auto a = summary_in(folder.path() / "out" / "fvm"),
               b = summary_in(folder.path() / "again" / "fvm");
    EXPECT_EQ(b.state_hash, a.state_hash);
    EXPECT_EQ(b.provenance.input_hash, a.provenance.input_hash);
    EXPECT_EQ(b.case_name, "mine");
    EXPECT_EQ(b.title, "a \"pair\"");
    EXPECT_EQ(b.end_time, 5e-4);
  }
}

}  // namespace
}  // namespace diptych
