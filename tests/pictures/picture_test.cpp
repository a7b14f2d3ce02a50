/// VTK reads our frames and draws them: through the program diptych-picture, on an X server that is
/// started for it (xvfb-run). Built where VTK was found.

#include "common/io/field_writer.hpp"
#include "common/io/run_record.hpp"
#include "tests/common/io/scratch.hpp"
#include "tests/folders.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <gmock/gmock.h>
namespace diptych::pictures {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// Two hexahedra, one on the other; the second frame is sheared.
void write_run(const std::string& directory) {
  io::VisualMesh mesh;
  for (int k = 0; k < 3; ++k) {
    mesh.points.insert(mesh.points.end(),
                       {0, 0, 1.0 * k, 1, 0, 1.0 * k, 1, 1, 1.0 * k, 0, 1, 1.0 * k});
  }
  mesh.connectivity = {0, 1, 2, 3, 4, 5, 6, 7, 4, 5, 6, 7, 8, 9, 10, 11};
  mesh.offsets = {0, 8, 16};
  mesh.types = {12, 12};
  io::FieldWriter writer(directory, mesh);
  for (const double time : {0.0, 0.5}) {
    io::NodeField displacement{"displacement [m]", 3, {}}, velocity{"velocity [m/s]", 3, {}};
    for (size_t a = 0; a < 12; ++a) {
      const double height = mesh.points[3 * a + 2];
      displacement.values.insert(displacement.values.end(), {time * height, 0, 0});
      velocity.values.insert(velocity.values.end(), {height, 0, 0});
    }
    writer.write(time, [&](std::int64_t, std::int64_t) {
      return std::vector<io::NodeField>{displacement, velocity};
    });
  }
}

class Picture : public testing::Test {
 protected:
  void SetUp() override {
    program_ = tests::build_folder() + "/diptych-picture";
    write_run(folder_ / "sph");
  }

  /// Exit code of the program; what it said is in log(). The code goes through a file, since
  /// xvfb-run at times has an exit code of its own: it cannot clean up behind a quick program.
  int run(const std::string& before, const std::string& arguments) {
    const std::string code = folder_ / "code", command = folder_ / "command";
    fs::remove(code);
    io::write_file_atomically(command, "'" + program_ + "' " + arguments + " > '" +
                                           (folder_ / "log") + "' 2>&1; echo $? > '" + code +
                                           "'\n");
    const std::string line = before + " sh '" + command + "' < /dev/null > /dev/null 2>&1";
    if (std::system(line.c_str()) < 0) ADD_FAILURE() << "cannot start a shell";
    return fs::exists(code) ? std::stoi(io::read_file(code)) : -1;
  }
  std::string log() const { return io::read_file(folder_ / "log"); }

  test::Scratch folder_;
  std::string program_;
};

TEST_F(Picture, SaysWhatToDoWithoutADisplay) {
  EXPECT_EQ(run("env -u DISPLAY", (folder_ / "sph") + " -o " + (folder_ / "a.png")), 4) << log();
  EXPECT_THAT(log(), HasSubstr("xvfb-run -a diptych-picture"));
  EXPECT_EQ(run("env DISPLAY=:987", (folder_ / "sph") + " -o " + (folder_ / "a.png")), 4) << log();
}

TEST_F(Picture, IsDrawnForOneRunAndForTwo) {
  if (std::system("command -v xvfb-run > /dev/null") != 0) {
    GTEST_SKIP() << "no X server to start: apt-get install xvfb xauth libgl1-mesa-dri";
  }
  const std::string series = (folder_ / "sph") + "/run.hdf.series";
  ASSERT_EQ(run("xvfb-run -a", series + " -o " + (folder_ / "one.png")), 0) << log();
  ASSERT_EQ(
      run("xvfb-run -a", (folder_ / "sph ") + series + " --frame 0 -o " + (folder_ / "two.png")), 0)
      << log();
  const std::string png = io::read_file(folder_ / "one.png");
  EXPECT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1a\n");
  EXPECT_GT(png.size(), 5000u) << "an empty picture of this size packs to less";
  EXPECT_NE(png, io::read_file(folder_ / "two.png"));
}

TEST_F(Picture, RefusesWhatIsNotThereBeforeItAsksForADisplay) {
  const std::string out = " -o " + (folder_ / "a.png");
  EXPECT_EQ(run("env -u DISPLAY", (folder_ / "sph") + out + " --field 'velocty [m/s]'"), 2);
  EXPECT_THAT(log(), HasSubstr("velocity [m s-1]"));
  EXPECT_EQ(run("env -u DISPLAY", (folder_ / "sph") + out + " --frame 2"), 2) << log();
  EXPECT_EQ(run("env -u DISPLAY", (folder_ / "fvm") + out), 4) << log();
  fs::remove(fs::path(folder_ / "sph") / "mesh.hdf");
  EXPECT_EQ(run("env -u DISPLAY", (folder_ / "sph") + out), 2);
  EXPECT_THAT(log(), HasSubstr("is mesh.hdf beside the frame?"));
}

}  // namespace
}  // namespace diptych::pictures
