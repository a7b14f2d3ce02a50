/// `diptych check FOLDER` says of what runs have left that it is whole, and names what is not.

#include "tests/command_line/small_case.hpp"

#include <gmock/gmock.h>

namespace diptych::tests {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class RecordCheck : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("case.toml", small_case("bar"));
    const auto run = diptych(folder_,
                             "run case.toml --method fvm --out out --quiet --threads 1 --set "
                             "time.checkpoint_every=20");
    ASSERT_EQ(run.exit_code, 0) << run.text;
  }
  fs::path file(const std::string& name) const { return folder_.path() / "out/fvm" / name; }
  Outcome check() const { return diptych(folder_, "check out"); }

  Folder folder_;
};

TEST_F(RecordCheck, FindsAWholeRunWhole) {
  const auto whole = check();
  EXPECT_EQ(whole.exit_code, 0) << whole.text;
  EXPECT_THAT(whole.text, HasSubstr("done"));
  EXPECT_THAT(whole.text, HasSubstr(" 3 frames"));
  EXPECT_THAT(whole.text, HasSubstr(": whole"));
}

TEST_F(RecordCheck, NamesAFileWithAnotherByte) {
  std::vector<std::string> names{"history.csv", "summary.json", "mesh.hdf"};
  for (const auto& entry : fs::directory_iterator(file(""))) {
    const std::string name = entry.path().filename().string();
    if (name.ends_with(".hdf") && name != "mesh.hdf") names.push_back(name);
  }
  ASSERT_GT(names.size(), 6U) << "frames and a checkpoint";
  for (const std::string& name : names) {
    const auto middle = static_cast<std::streamoff>(fs::file_size(file(name)) / 2);
    std::fstream stream(file(name), std::ios::in | std::ios::out | std::ios::binary);
    const auto flip = [&] {
      stream.seekg(middle);
      const int byte = stream.get();
      stream.seekp(middle);
      stream.put(static_cast<char>(byte ^ 1));
      stream.flush();
    };
    flip();
    const auto damaged = check();
    EXPECT_EQ(damaged.exit_code, 2) << name << ": " << damaged.text;
    EXPECT_THAT(damaged.text, HasSubstr(name));
    flip();
  }
  EXPECT_EQ(check().exit_code, 0);
}

TEST_F(RecordCheck, NamesAFileThatIsMissing) {
  fs::remove(file("history.csv"));
  const auto damaged = check();
  EXPECT_EQ(damaged.exit_code, 2) << damaged.text;
  EXPECT_THAT(damaged.text, HasSubstr("history.csv"));
}

}  // namespace
}  // namespace diptych::tests
