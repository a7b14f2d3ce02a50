/// Checksums tell which files are not as they were, and refuse a list that is none.

#include "common/io/checksums.hpp"

#include "common/base/error.hpp"
#include "tests/common/io/scratch.hpp"

#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>

namespace diptych::io {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

void write(const std::string& path, const std::string& text) {
  std::ofstream(path) << text;
}

TEST(Checksums, TellWhichFilesHaveChanged) {
  const test::Scratch folder;
  const std::string path = folder / "";
  for (const char* name : {"a", "b", "c"})
    write(folder / name, name);
  write_checksums(path, {"a", "b", "c", "not there"});
  EXPECT_THAT(changed_files(path), IsEmpty());
  write(folder / "b", "B");
  std::filesystem::remove(folder / "c");
  EXPECT_THAT(changed_files(path),
              ElementsAre(AllOf(HasSubstr("b: is not as the run left it"), HasSubstr("differs")),
                          HasSubstr("c: is missing")));
}

TEST(Checksums, OfTheFormatOfXxh128sum) {
  const test::Scratch folder;
  write(folder / "a", "");
  write_checksums(folder / "", {"a"});
  std::ifstream file(folder / checksums_file);
  std::string line;
  std::getline(file, line);
  EXPECT_EQ(line, "99aa06d3014798d86001c324468d497f  a") << "XXH3 of nothing, 128 bits";
}

TEST(Checksums, ThatAreDamagedAreRefused) {
  const test::Scratch folder;
  for (const char* text : {"", "99aa06d3014798d86001c324468d497f a\n", "zz\n",
                           "99aa06d3014798d86001c324468d497f  ../a\n"}) {
    write(folder / checksums_file, text);
    EXPECT_THROW(changed_files(folder / ""), base::InputError) << text;
  }
}

}  // namespace
}  // namespace diptych::io
