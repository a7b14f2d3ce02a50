/// A list of known misses may only shrink: a miss that it lacks is told, and one that it has and
/// that is met now.

#include "benchmarks/verifier/known_misses.hpp"

#include "common/base/error.hpp"
#include "tests/common/io/scratch.hpp"

#include <fstream>
#include <gmock/gmock.h>

namespace diptych::harness {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<VerificationResult> results() {
  VerificationResult result;
  result.table.name = "swirl";
  result.verdicts = {{"default", "v", "order >= 1.8", "sph", "1.65", false},
                     {"default", "v", "order >= 1.8", "fvm", "2.05", true}};
  return {result};
}

const std::string miss = "swirl | default | v | order >= 1.8 | sph";

TEST(KnownMisses, MayOnlyShrink) {
  EXPECT_THAT(misses_of(results()), ElementsAre(miss));
  EXPECT_THAT(differences_from_known(results(), {miss}), IsEmpty());
  EXPECT_THAT(differences_from_known(results(), {miss, "other | a | b | c | sph"}), IsEmpty())
      << "a table that was not made";
  EXPECT_THAT(differences_from_known(results(), {}),
              ElementsAre("not met, and not known: " + miss));
  EXPECT_THAT(differences_from_known(results(), {miss, "swirl | default | v | order >= 1.8 | fvm"}),
              ElementsAre(HasSubstr("met now, take it from the list: swirl | default")));
}

TEST(KnownMisses, AreReadWithTheirPlace) {
  const test::Scratch folder;
  const auto read = [&](const std::string& text) {
    std::ofstream(folder / "list") << text;
    return read_known_misses(folder / "list");
  };
  EXPECT_THAT(read("# why\n\n  " + miss + "  # its cause\n"), ElementsAre(miss));
  EXPECT_THAT(test::message_of<base::InputError>([&] { read("a | b\n"); }),
              HasSubstr("list:1: write TABLE | RUN | COLUMN | ASKED | METHOD"));
  EXPECT_THAT(test::message_of<base::InputError>([&] { read(miss + "\n" + miss); }),
              HasSubstr("list:2: stands twice"));
}

}  // namespace
}  // namespace diptych::harness
