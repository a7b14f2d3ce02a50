/// A sealed file gives back its content or says what is wrong with it: no flipped bit, no missing
/// or added byte goes unseen.

#include "common/io/sealed_file.hpp"

#include "common/base/error.hpp"
#include "common/io/run_record.hpp"
#include "tests/common/io/scratch.hpp"

#include <fstream>
#include <gmock/gmock.h>
#include <random>

namespace diptych::io {
namespace {

using test::message_of;
using test::Scratch;
using testing::AllOf;
using testing::HasSubstr;

/// Bytes of every value, of which none is like its neighbours.
std::string content_of(size_t size) {
  std::mt19937 random(7);
  std::string content(size, '\0');
  for (char& c : content)
    c = static_cast<char>(random() & 0xff);
  return content;
}

void write(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

TEST(SealedFile, GivesBackItsContentAfterTheSealOfIt) {
  const Scratch folder;
  for (const size_t size : {size_t{0}, size_t{1}, sealed_piece - 1, sealed_piece, sealed_piece + 1,
                            5 * sealed_piece / 2}) {
    const std::string content = content_of(size);
    write_sealed_file(folder / "file", content);
    EXPECT_EQ(read_sealed_file(folder / "file"), content) << size;
    EXPECT_EQ(read_file(folder / "file").substr(0, size), content) << "it begins with the content";
  }
}

TEST(SealedFile, RefusesEveryFlippedBit) {
  const Scratch folder;
  write_sealed_file(folder / "file", content_of(300));
  const std::string whole = read_file(folder / "file");
  for (size_t i = 0; i < whole.size(); ++i) {
    for (int bit = 0; bit < 8; ++bit) {
      std::string damaged = whole;
      damaged[i] = static_cast<char>(damaged[i] ^ (1 << bit));
      write(folder / "damaged", damaged);
      EXPECT_THROW(read_sealed_file(folder / "damaged"), base::InputError) << i << ", bit " << bit;
    }
  }
}

TEST(SealedFile, RefusesWhateverIsMissingOrTooMuch) {
  const Scratch folder;
  write_sealed_file(folder / "file", content_of(300));
  const std::string whole = read_file(folder / "file");
  for (size_t size = 0; size < whole.size(); ++size) {
    write(folder / "damaged", whole.substr(0, size));
    EXPECT_THROW(read_sealed_file(folder / "damaged"), base::InputError) << size << " bytes";
  }
  for (const std::string& more : {whole + "x", "x" + whole, whole + whole, whole.substr(1)}) {
    write(folder / "damaged", more);
    EXPECT_THROW(read_sealed_file(folder / "damaged"), base::InputError) << more.size();
  }
}

TEST(SealedFile, SaysWhereTheDamageIs) {
  const Scratch folder;
  write_sealed_file(folder / "file", content_of(3 * sealed_piece));
  std::string damaged = read_file(folder / "file");
  damaged[sealed_piece + 5] ^= 1;
  write(folder / "damaged", damaged);
  EXPECT_THAT(
      message_of<base::InputError>([&] { (void)read_sealed_file(folder / "damaged"); }),
      AllOf(HasSubstr(folder / "damaged"), HasSubstr("between byte 65536 and byte 131071")));
  write(folder / "damaged", read_file(folder / "file").substr(0, sealed_piece));
  EXPECT_THAT(message_of<base::InputError>([&] { (void)read_sealed_file(folder / "damaged"); }),
              HasSubstr("cut off"));
  EXPECT_THAT(message_of<base::EnvironmentError>([&] { (void)read_sealed_file(folder / "none"); }),
              AllOf(HasSubstr(folder / "none"), HasSubstr("No such file")));
}

}  // namespace
}  // namespace diptych::io
