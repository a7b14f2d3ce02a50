/// What is put into a checkpoint comes back to the last bit; what does not fit, or is left over, is
/// an error with its name.

#include "common/io/checkpoint_file.hpp"

#include "common/base/error.hpp"
#include "common/io/sealed_file.hpp"
#include "tests/common/io/scratch.hpp"

#include <bit>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <limits>

namespace diptych::io {
namespace {

using algebra::Archive;
using algebra::Vec3;
using test::message_of;
using test::Scratch;
using testing::AllOf;
using testing::HasSubstr;

/// One of each kind.
struct Things {
  double real = 0;
  int number = 0;
  bool flag = false;
  Vec3 vector = Vec3::Zero();
  std::vector<Vec3> vectors;
  std::vector<double> table;  ///< [n][4]
  std::vector<std::int64_t> integers;
  std::string text;
  std::vector<std::string> texts;

  void archive(Archive& archive) {
    archive.real("a/real", "m/s", real);
    archive.integer("a/number", number);
    archive.integer("flag", flag);
    archive.vector("a/b/vector", "m", vector);
    archive.vectors("a/b/vectors", "m", vectors);
    archive.reals("table of values", "Pa", table, 4);
    archive.integers("a/integers", integers);
    archive.text("text", text);
    archive.texts("texts", texts);
  }
};

Things things() {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return {-0.0,
          -7,
          true,
          {1, 1.0 / 3, 5e-324},
          {{1, 2, 3}, {4, 5, std::nextafter(6.0, 7.0)}},
          {infinity, -infinity, 1e308, std::numeric_limits<double>::quiet_NaN(), 0, 1, 2, 3},
          {std::numeric_limits<std::int64_t>::min(), 0, std::numeric_limits<std::int64_t>::max()},
          std::string("line\nnext \0 \xff", 13),
          {"", "one", "two words"}};
}

void write(const std::string& path, Things of) {
  CheckpointWriter writer(path);
  of.archive(writer);
  writer.publish();
}

TEST(CheckpointFile, GivesBackEveryBit) {
  const Scratch folder;
  write(folder / "file", things());
  CheckpointReader reader(folder / "file");
  Things found;
  found.archive(reader);
  reader.finish();
  const Things wanted = things();
  EXPECT_TRUE(std::signbit(found.real));
  EXPECT_EQ(found.number, wanted.number);
  EXPECT_EQ(found.flag, wanted.flag);
  EXPECT_EQ(found.vector, wanted.vector);
  EXPECT_EQ(found.vectors, wanted.vectors);
  ASSERT_EQ(found.table.size(), wanted.table.size());
  for (size_t k = 0; k < wanted.table.size(); ++k)
    EXPECT_EQ(std::bit_cast<std::uint64_t>(found.table[k]),
              std::bit_cast<std::uint64_t>(wanted.table[k]));
  EXPECT_EQ(found.integers, wanted.integers);
  EXPECT_EQ(found.text, wanted.text);
  EXPECT_EQ(found.texts, wanted.texts);
}

TEST(CheckpointFile, GivesBackEmptyTables) {
  const Scratch folder;
  write(folder / "file", Things());
  CheckpointReader reader(folder / "file");
  Things found = things();
  found.archive(reader);
  EXPECT_TRUE(found.vectors.empty() && found.table.empty() && found.integers.empty());
  EXPECT_TRUE(found.text.empty() && found.texts.empty());
}

TEST(CheckpointFile, RefusesAnotherShapeByName) {
  const Scratch folder;
  write(folder / "file", things());
  CheckpointReader reader(folder / "file");
  std::vector<double> values;
  std::vector<std::int64_t> integers;
  EXPECT_THAT(
      message_of<base::InputError>([&] { reader.reals("table of values", "Pa", values, 2, -1); }),
      AllOf(HasSubstr(folder / "file"), HasSubstr("'table of values' as 2 x 4")));
  EXPECT_THAT(message_of<base::InputError>([&] { reader.reals("a/b/vectors", "m", values, 3, 5); }),
              HasSubstr("needs 5 rows of 3"));
  EXPECT_THAT(message_of<base::InputError>([&] { reader.integers("a/integers", integers, 2); }),
              HasSubstr("'a/integers' as 3"));
}

TEST(CheckpointFile, RefusesWhatIsMissingAndWhatIsLeftOver) {
  const Scratch folder;
  write(folder / "file", things());
  CheckpointReader reader(folder / "file");
  double value = 0;
  EXPECT_THAT(message_of<base::InputError>([&] { reader.real("a/other", "m", value); }),
              HasSubstr("has no 'a/other'"));
  reader.real("a/real", "m/s", value);
  EXPECT_THAT(message_of<base::InputError>([&] { reader.real("a/real", "m/s", value); }),
              HasSubstr("has no 'a/real'"))
      << "each once";
  EXPECT_THAT(message_of<base::InputError>([&] { reader.finish(); }),
              HasSubstr("holds 'a/b/vector', which this run does not have"));
}

TEST(CheckpointFile, RefusesFilesThatAreNone) {
  const Scratch folder;
  write_sealed_file(folder / "text", "sealed, but no HDF5 file");
  EXPECT_THROW(CheckpointReader(folder / "text"), base::Error);
  Hdf5File other = Hdf5File::create(folder / "other");
  const std::vector<double> values{1, 2};
  other.write("values", std::span<const double>(values));
  write_sealed_file(folder / "other", other.take_image());
  EXPECT_THAT(message_of<base::InputError>([&] { CheckpointReader{folder / "other"}; }),
              HasSubstr("is no checkpoint"));
  Hdf5File later = Hdf5File::create(folder / "later");
  const std::vector<std::int64_t> format{checkpoint_format + 1};
  later.write("format", std::span<const std::int64_t>(format));
  later.write("index", std::span<const std::int64_t>(format));
  write_sealed_file(folder / "later", later.take_image());
  EXPECT_THAT(message_of<base::InputError>([&] { CheckpointReader{folder / "later"}; }),
              AllOf(HasSubstr(fmt::format("has the format {}", checkpoint_format + 1)),
                    HasSubstr(fmt::format("this program reads {}", checkpoint_format))));
}

TEST(CheckpointFile, IsNotThereBeforeItIsWhole) {
  const Scratch folder;
  Things some = things();
  CheckpointWriter writer(folder / "file");
  some.archive(writer);
  EXPECT_FALSE(std::filesystem::exists(folder / "file"));
  writer.publish();
  EXPECT_TRUE(std::filesystem::exists(folder / "file"));
}

}  // namespace
}  // namespace diptych::io
