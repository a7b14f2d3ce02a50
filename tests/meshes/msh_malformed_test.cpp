/// Bad files: each is a good one with one passage replaced, and must end in an InputError that says
/// what is wrong and where.

#include "meshes/gmsh.hpp"
#include "meshes/msh/contents.hpp"
#include "tests/meshes/mesh_measures.hpp"
#include "tests/trials.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <gmock/gmock.h>

namespace diptych::meshes {
namespace {

std::string error_of(const std::string& bytes) {
  return input_error_of([&] { msh::read_msh_bytes(bytes, "bad.msh"); });
}

struct BadText {
  const char* name;
  const char* from;  ///< passage of the good file
  const char* to;
  const char* message;  ///< part of the error
};

/// Two triangles on the unit square, the lower side in a group.
const char* const good_2 =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n1 4 \"low\"\n$EndPhysicalNames\n"
    "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n"
    "$Elements\n3\n1 1 2 4 1 1 2\n2 2 2 1 1 1 2 3\n3 2 2 1 1 1 3 4\n$EndElements\n";

const char* const good_4 =
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n1 4 \"low\"\n$EndPhysicalNames\n"
    "$Entities\n0 1 1 0\n1 0 0 0 1 0 0 1 4 0\n1 0 0 0 1 1 0 0 1 1\n$EndEntities\n"
    "$Nodes\n1 4 1 4\n2 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n$EndNodes\n"
    "$Elements\n2 3 1 3\n1 1 1 1\n1 1 2\n2 1 2 2\n2 1 2 3\n3 1 3 4\n$EndElements\n";

const BadText bad_2[] = {
    {"Empty", good_2, "", "bad.msh:1: the file is empty"},
    {"NotGmsh", "$MeshFormat", "solid", "begins with $MeshFormat, not with 'solid'"},
    {"ByteOrderMarkOfUtf8", "$MeshFormat", "\xef\xbb\xbf$MeshFormat", "begins with $MeshFormat"},
    {"OldVersion", "2.2 0 8", "1 0 8", "bad.msh:2: $MeshFormat: version 1"},
    {"FileType", "2.2 0 8", "2.2 2 8", "neither 0 (ASCII) nor 1 (binary)"},
    {"DataSize", "2.2 0 8", "2.2 0 4", "data size 4"},
    {"BinaryFlagLies", "2.2 0 8", "2.2 1 8", "byte order mark"},
    {"TagWithTwoNames", "1\n1 4 \"low\"", "2\n1 4 \"low\"\n1 4 \"side\"",
     "physical tag 4 has two names"},
    {"NameWithoutQuotes", "\"low\"", "low", "bad.msh:6: $PhysicalNames"},
    {"NameEmpty", "\"low\"", "\"\"", "name is empty"},
    {"NameTwice", "1\n1 4 \"low\"", "2\n1 4 \"low\"\n1 5 \"low\"", "'low' is given twice"},
    {"NameOfUnmeshedGroup", "1 4 \"low\"", "1 5 \"low\"", "'low' has no faces in the file"},
    {"NameOfUnmeshedVolume", "1 4 \"low\"", "3 4 \"low\"", "volume 'low' has no cells"},
    {"NoNodes", "$Nodes", "$Nudes", "$EndNudes follows"},
    {"NodesTwice", "$Elements", "$Nodes", "section stands twice"},
    {"NodeCountTooLow", "$Nodes\n4", "$Nodes\n3", "bad.msh:13: $Nodes: $EndNodes is needed"},
    {"NodeCountTooHigh", "$Nodes\n4", "$Nodes\n5", "bad.msh:14: $Nodes: a node number"},
    {"NodeCountHuge", "$Nodes\n4", "$Nodes\n1000000000000000000", "can hold"},
    {"NodeCountBeyond64Bits", "$Nodes\n4", "$Nodes\n9223372036854775808", "64-bit"},
    {"NodeCountNegative", "$Nodes\n4", "$Nodes\n-4", "must not be negative"},
    {"NodeCountNoNumber", "$Nodes\n4", "$Nodes\n4.5", "a whole number is needed, not '4.5'"},
    {"NodeNumberNegative", "2 1 0 0", "-2 1 0 0", "bad.msh:11: $Nodes: node number -2"},
    {"NodeNumberBeyond32Bits", "2 1 0 0", "4294967298 1 0 0", "32-bit"},
    {"NodeTwice", "2 1 0 0", "1 1 0 0", "node 1 stands twice"},
    {"CoordinateNan", "2 1 0 0", "2 nan 0 0", "bad.msh:11: $Nodes: coordinate x = nan"},
    {"CoordinateInfinite", "2 1 0 0", "2 1 -inf 0", "coordinate y"},
    {"CoordinateBeyondDouble", "2 1 0 0", "2 1e400 0 0", "beyond double precision"},
    {"CoordinateWithComma", "2 1 0 0", "2 1,0 0 0", "a number is needed, not '1,0'"},
    {"CoordinateHuge", "2 1 0 0", "2 1e200 0 0", "far too large"},
    {"SurfaceInSpace", "3 1 1 0", "3 1 1 0.5", "z runs from 0 to 0.5"},
    {"NoElements", "$Elements\n3", "$Elements\n0", "$EndElements is needed"},
    {"ElementCountHuge", "$Elements\n3", "$Elements\n99999999999", "can hold"},
    {"TagCountHuge", "2 2 2 1 1 1 2 3", "2 2 2000000000 1 1 1 2 3", "can hold"},
    {"TagCountNegative", "2 2 2 1 1 1 2 3", "2 2 -2 1 1 1 2 3", "must not be negative"},
    {"ElementTwice", "3 2 2 1 1", "2 2 2 1 1", "bad.msh:19: element 2 stands twice"},
    {"ElementNumberZero", "3 2 2 1 1", "0 2 2 1 1", "element number 0 must be positive"},
    {"NodeOfCellMissing", "1 3 4\n", "1 3 5\n", "bad.msh:19: element 3 refers to node 5"},
    {"NodeOfGroupMissing", "1 1 2 4 1 1 2", "1 1 2 4 1 1 9", "'low' refers to node 9"},
    {"RepeatedNode", "1 3 4\n", "1 3 3\n", "same node twice"},
    {"MixedOrientation", "1 3 4\n", "1 4 3\n", "element 3 (triangle) at (0.333333, 0.666667, 0)"},
    {"DegenerateCell", "4 0 1 0", "4 0.5 0.5 0", "element 3 (triangle)"},
    {"OverlappingCells", "1 1 1 3 4\n", "1 2 1 2 3\n", "same side"},
    {"FaceInsideTheMesh", "4 1 1 2\n", "4 1 1 3\n", "physical curve 'low' lies inside the mesh"},
    {"FaceOfNoCell", "4 1 1 2\n", "4 1 2 4\n", "is not a face of any cell"},
    {"FaceTwice", "$Elements\n3\n", "$Elements\n4\n9 1 2 4 1 2 1\n", "stands twice"},
    {"SecondOrder", "3 2 2 1 1 1 3 4", "3 9 2 1 1 1 3 4 5 6 7", "higher-order triangle"},
    {"Pyramid", "3 2 2 1 1 1 3 4", "3 7 2 1 1 1 3 4 1 2", "element 3 is a pyramid (type 7)"},
    {"UnknownType", "3 2 2 1 1 1 3 4", "3 77 2 1 1 1 3 4", "element 3 has type 77"},
    {"OnlyLines", "2 2 2 1 1 1 2 3\n3 2 2 1 1 1 3 4", "2 1 2 1 1 1 2\n3 1 2 1 1 1 3",
     "has no triangles"},
    {"RubbishAtTheEnd", "$EndElements\n", "$EndElements\nrubbish\n", "not 'rubbish'"},
};

const BadText bad_4[] = {
    {"Version40", "4.1 0 8", "4 0 8", "version 4 of the format"},
    {"EntityCountHuge", "0 1 1 0\n1 0", "0 1 999999999999 0\n1 0", "can hold"},
    {"EntityTwice", "0 1 1 0\n", "0 1 2 0\n1 0 0 0 1 1 0 0 0\n", "entity 1 of dimension 2"},
    {"PhysicalTagZero", "0 0 1 4 0\n", "0 0 1 0 0\n", "physical tag 0"},
    {"PhysicalTagCountHuge", "1 0 0 1 4 0", "1 0 0 123456789012 4 0", "can hold"},
    {"BlocksOfNodesTooFew", "$Nodes\n1 4", "$Nodes\n1 5", "5 nodes are announced"},
    {"BlockOfNodesHuge", "2 1 0 4", "2 1 0 4444444444444444444", "can hold"},
    {"ParametricMark", "2 1 0 4", "2 1 2 4", "parametric mark 2"},
    {"DimensionOfBlock", "2 1 0 4", "4 1 0 4", "dimension 4 of an entity"},
    {"NodeTagZero", "\n1\n2\n3\n4\n", "\n0\n2\n3\n4\n", "node tag 0"},
    {"NodeTagBeyond64Bits", "\n1\n2\n3\n4\n", "\n1\n2\n3\n18446744073709551615\n", "64-bit"},
    {"EntityMissing", "2 1 2 2\n", "2 7 2 2\n", "entity 7 of dimension 2, which $Entities lacks"},
    {"TypeInWrongDimension", "1 1 1 1\n", "1 1 2 1\n", "in an entity of dimension 1"},
    {"ElementsAnnounced", "$Elements\n2 3", "$Elements\n2 4", "4 elements are announced"},
    {"ElementTagNegative", "3 1 3 4\n", "-3 1 3 4\n", "must not be negative"},
    {"SecondOrderBlock", "2 1 2 2\n", "3 1 11 2\n", "second-order tetrahedron (type 11)"},
    {"PyramidBlock", "2 1 2 2\n", "3 1 7 2\n", "pyramid"},
    {"Partitioned", "$EndEntities\n", "$EndEntities\n$PartitionedEntities\n", "partitioned"},
};

/// The good file with the first passage `from` replaced.
std::string changed(const std::string& good, const BadText& bad) {
  std::string text = good;
  const size_t at = text.find(bad.from);
  EXPECT_NE(at, std::string::npos) << bad.name;
  return text.replace(at, std::strlen(bad.from), bad.to);
}

TEST(MshMalformed, GoodTextsAreGood) {
  EXPECT_EQ(error_of(good_2), "");
  EXPECT_EQ(error_of(good_4), "");
}

TEST(MshMalformed, EachFaultOfVersion2IsNamed) {
  tests::Trials trials("hostile inputs");
  for (const auto& bad : bad_2) {
    const std::string error = error_of(changed(good_2, bad));
    EXPECT_THAT(error, testing::HasSubstr(bad.message)) << bad.name;
    trials.add(error.find(bad.message) != std::string::npos);
  }
}

TEST(MshMalformed, EachFaultOfVersion4IsNamed) {
  tests::Trials trials("hostile inputs");
  for (const auto& bad : bad_4) {
    const std::string error = error_of(changed(good_4, bad));
    EXPECT_THAT(error, testing::HasSubstr(bad.message)) << bad.name;
    trials.add(error.find(bad.message) != std::string::npos);
  }
}

TEST(MshMalformed, NulByteAndEndlessWordAreShownShort) {
  std::string text = good_2;
  text[text.find("1 0 0 0")] = '\0';
  EXPECT_THAT(error_of(text), testing::HasSubstr("bad.msh:10: $Nodes"));
  const std::string error = error_of("$MeshFormat\n" + std::string(10'000'000, 'x'));
  EXPECT_THAT(error, testing::HasSubstr("bad.msh:2:"));
  EXPECT_LT(error.size(), 200u);
}

TEST(MshMalformed, BinaryFaultsAreNamedWithTheirByte) {
  const std::string good = bytes_of_file(block_path("block_41_binary.msh"));
  ASSERT_EQ(error_of(good), "");
  const size_t mark = good.find("4.1 1 8\n") + 8;
  std::string swapped = good;
  std::reverse(swapped.begin() + mark, swapped.begin() + mark + 4);
  EXPECT_THAT(error_of(swapped), testing::HasSubstr("other byte order"));

  const size_t nodes = good.find("$Nodes\n") + 7;  // number of blocks, number of nodes
  std::string huge = good;
  huge.replace(nodes + 8, 8, std::string(7, '\xff') + '\x7f');
  EXPECT_THAT(error_of(huge), testing::HasSubstr("bad.msh: byte " + std::to_string(nodes + 8)));
  EXPECT_THAT(error_of(huge), testing::HasSubstr("can hold"));
  huge.replace(nodes + 8, 8, std::string(8, '\xff'));
  EXPECT_THAT(error_of(huge), testing::HasSubstr("64-bit"));

  // First node: behind four sizes of the section, three integers and a size of the block, its tag.
  std::string nan = good;
  const size_t x = nodes + 4 * 8 + 3 * 4 + 8 + 8;
  nan.replace(x, 8, std::string(6, '\0') + "\xf8\x7f");
  EXPECT_THAT(error_of(nan), testing::HasSubstr("byte " + std::to_string(x) + ": $Nodes: coord"));
  std::string ascii = good;
  ascii[mark - 4] = '0';
  EXPECT_THAT(error_of(ascii), testing::HasSubstr("$EndMeshFormat is needed"));
}

TEST(MshTruncated, EveryPrefixOfEveryFormatIsRefused) {
  for (const char* file : block_files) {
    const std::string good = bytes_of_file(block_path(file));
    ASSERT_EQ(error_of(good), "") << file;
    // Without its last line end a file is still whole.
    const size_t whole = good.find_last_not_of('\n') + 1;
    EXPECT_EQ(error_of(good.substr(0, whole)), "") << file;
    for (size_t n = 0; n < whole; ++n) {
      EXPECT_THAT(error_of(good.substr(0, n)), testing::StartsWith("bad.msh")) << file << " " << n;
    }
  }
}

}  // namespace
}  // namespace diptych::meshes
