/// Frames: the layout of VTKHDF 1.0 as written in VTK's file format document, read back through
/// HDF5; times in the index; failures that leave no half of a file.

#include "common/io/field_writer.hpp"

#include "common/base/error.hpp"
#include "common/io/hdf5_file.hpp"
#include "common/io/run_record.hpp"
#include "tests/common/io/scratch.hpp"

#include <gtest/gtest.h>
#include <hdf5.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <sys/resource.h>
#include <thread>

namespace diptych::io {
namespace {

namespace fs = std::filesystem;
using test::message_of;
using test::Scratch;
using testing::ElementsAre;
using testing::HasSubstr;

/// Two tetrahedra that share a face.
VisualMesh two_tets() {
  VisualMesh mesh;
  mesh.points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 0.1};
  mesh.connectivity = {0, 1, 2, 3, 1, 4, 2, 3};
  mesh.offsets = {0, 4, 8};
  mesh.types = {10, 10};
  return mesh;
}

std::vector<NodeField> fields(double scale = 1) {
  NodeField velocity{"velocity [m/s]", 3, {}};
  NodeField stress{"stress [Pa]", 9, {}};
  for (int i = 0; i < 15; ++i)
    velocity.values.push_back(scale * (0.1 + i));
  for (int i = 0; i < 45; ++i)
    stress.values.push_back(scale * (1e6 - i));
  return {velocity, stress, {"jacobian [-]", 1, {1, 0.9, 0.8, 0.7, 0.6}}};
}

/// Of meshes of fewer nodes than are asked for at once.
FieldsOfNodes whole(std::vector<NodeField> all) {
  return [all = std::move(all)](std::int64_t, std::int64_t) { return all; };
}

TEST(FieldWriter, AsksForManyNodesPartByPart) {
  const Scratch folder;
  const std::int64_t n = (1 << 16) + 1000;
  VisualMesh mesh = two_tets();
  mesh.points.resize(3 * static_cast<size_t>(n));
  FieldWriter writer(folder.path(), mesh);
  std::vector<std::int64_t> asked;
  writer.write(0, [&](std::int64_t begin, std::int64_t end) {
    asked.push_back(begin);
    NodeField number{"number [-]", 1, {}}, place{"place [m]", 3, {}};
    for (std::int64_t a = begin; a < end; ++a) {
      number.values.push_back(static_cast<double>(a));
      place.values.insert(place.values.end(), {0.5 * static_cast<double>(a), 1, 2});
    }
    return std::vector<NodeField>{number, place};
  });
  EXPECT_THAT(asked, ElementsAre(0, 1 << 16));
  const NodeField number = read_field(folder / "frame_0000.hdf", "number [-]");
  const NodeField place = read_field(folder / "frame_0000.hdf", "place [m]");
  ASSERT_EQ(std::ssize(number.values), n);
  ASSERT_EQ(std::ssize(place.values), 3 * n);
  size_t n_wrong = 0;
  for (size_t a = 0; a < number.values.size(); ++a)
    n_wrong += number.values[a] != static_cast<double>(a) ||
               place.values[3 * a] != 0.5 * static_cast<double>(a) || place.values[3 * a + 2] != 2;
  EXPECT_EQ(n_wrong, 0u);
}

TEST(FieldWriter, GivesBackWhatItWroteInSinglePrecision) {
  const Scratch folder;
  FieldWriter writer(folder / "out", two_tets());
  writer.write(0.5, whole(fields()));
  const NodeField velocity = read_field(folder / "out/frame_0000.hdf", "velocity [m/s]");
  EXPECT_EQ(velocity.n_components, 3);
  ASSERT_EQ(velocity.values.size(), 15u);
  EXPECT_EQ(velocity.values[14], static_cast<double>(14.1f));
  EXPECT_EQ(read_field(folder / "out/frame_0000.hdf", "velocity [m s-1]").values, velocity.values);
  EXPECT_EQ(read_field(folder / "out/frame_0000.hdf", "stress [Pa]").n_components, 9);
  EXPECT_EQ(read_field(folder / "out/frame_0000.hdf", "jacobian [-]").n_components, 1);
}

/// HDF5 would put the second in which it makes a table beside it.
TEST(FieldWriter, GivesTheSameBytesWheneverItWrites) {
  const Scratch folder;
  FieldWriter(folder / "one", two_tets()).write(0.5, whole(fields()));
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  FieldWriter(folder / "other", two_tets()).write(0.5, whole(fields()));
  for (const char* file : {"/mesh.hdf", "/frame_0000.hdf"})
    EXPECT_TRUE(read_file(folder / "one" + file) == read_file(folder / "other" + file)) << file;
}

TEST(FieldWriter, HasTheLayoutOfVtkhdfOne) {
  const Scratch folder;
  FieldWriter writer(folder.path(), two_tets());
  writer.write(0.25, whole(fields()));
  const Hdf5File frame = Hdf5File::open_for_reading(folder / "frame_0000.hdf");
  EXPECT_THAT(frame.read_integers("/VTKHDF/NumberOfPoints"), ElementsAre(5));
  EXPECT_THAT(frame.read_integers("/VTKHDF/NumberOfCells"), ElementsAre(2));
  EXPECT_THAT(frame.read_integers("/VTKHDF/NumberOfConnectivityIds"), ElementsAre(8));
  EXPECT_THAT(frame.shape("/VTKHDF/Points"), ElementsAre(5, 3));
  EXPECT_EQ(frame.read_doubles("/VTKHDF/Points"), two_tets().points);
  EXPECT_EQ(frame.read_integers("/VTKHDF/Connectivity"), two_tets().connectivity);
  EXPECT_EQ(frame.read_integers("/VTKHDF/Offsets"), two_tets().offsets);
  EXPECT_THAT(frame.read_integers("/VTKHDF/Types"), ElementsAre(10, 10));
  EXPECT_THAT(frame.names("/VTKHDF/PointData"),
              ElementsAre("jacobian [-]", "stress [Pa]", "velocity [m s-1]"));
  EXPECT_THAT(frame.shape("/VTKHDF/PointData/velocity [m s-1]"), ElementsAre(5, 3));
  EXPECT_THAT(frame.shape("/VTKHDF/PointData/jacobian [-]"), ElementsAre(5));
  EXPECT_THAT(frame.read_doubles("/VTKHDF/FieldData/time"), ElementsAre(0.25));
}

/// Straight through HDF5: what Hdf5File does not say.
TEST(FieldWriter, LinksTheMeshAndMarksTheFile) {
  const Scratch folder;
  FieldWriter writer(folder.path(), two_tets());
  writer.write(0, whole(fields()));
  const hid_t file = H5Fopen((folder / "frame_0000.hdf").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  ASSERT_GE(file, 0);
  for (const char* name : {"Points", "Connectivity", "Offsets", "Types"}) {
    H5L_info_t link{};
    H5Lget_info(file, (std::string("/VTKHDF/") + name).c_str(), &link, H5P_DEFAULT);
    EXPECT_EQ(link.type, H5L_TYPE_EXTERNAL) << name;
  }
  int version[2] = {-1, -1};
  const hid_t version_id = H5Aopen_by_name(file, "/VTKHDF", "Version", H5P_DEFAULT, H5P_DEFAULT);
  H5Aread(version_id, H5T_NATIVE_INT, version);
  EXPECT_THAT(version, ElementsAre(1, 0));
  const hid_t type_id = H5Aopen_by_name(file, "/VTKHDF", "Type", H5P_DEFAULT, H5P_DEFAULT);
  const hid_t type = H5Aget_type(type_id);
  char text[17] = {};
  ASSERT_EQ(H5Tget_size(type), 16u);  // fixed length: VTK 9.1 reads no other
  H5Aread(type_id, type, text);
  EXPECT_STREQ(text, "UnstructuredGrid");
  const hid_t set = H5Dopen2(file, "/VTKHDF/PointData/stress [Pa]", H5P_DEFAULT);
  const hid_t stored = H5Dget_type(set);
  EXPECT_GT(H5Tequal(stored, H5T_IEEE_F32LE), 0);
  H5Tclose(stored), H5Dclose(set), H5Tclose(type), H5Aclose(type_id), H5Aclose(version_id);
  EXPECT_EQ(H5Fget_obj_count(file, H5F_OBJ_ALL), 1) << "only the file itself is open";
  H5Fclose(file);
}

TEST(FieldWriter, IndexListsFramesAndTimes) {
  const Scratch folder;
  FieldWriter writer(folder.path(), two_tets());
  for (const double time : {0.0, 0.1, 0.30000000000000004})
    writer.write(time, whole(fields()));
  const auto series = nlohmann::json::parse(read_file(folder / "run.hdf.series"));
  EXPECT_EQ(series["file-series-version"], "1.0");
  EXPECT_EQ(series["files"][1]["name"], "frame_0001.hdf");
  const std::vector<FrameEntry> frames = read_series(folder / "run.hdf.series");
  ASSERT_EQ(frames.size(), 3u);
  EXPECT_EQ(frames[2].time, 0.30000000000000004);
  EXPECT_EQ(read_field(frames[2].path, "velocity [m/s]").values.size(), 15u);
  EXPECT_THROW(writer.write(0.1, whole(fields())), std::logic_error) << "time must advance";
}

TEST(FieldWriter, RemovesFramesOfAnEarlierRunAndNothingElse) {
  const Scratch folder;
  {
    FieldWriter writer(folder.path(), two_tets());
    writer.write(0, whole(fields()));
    writer.write(1, whole(fields()));
  }
  write_file_atomically(folder / "frame_notes.hdf", "mine");
  FieldWriter again(folder.path(), two_tets());
  EXPECT_FALSE(fs::exists(folder / "run.hdf.series"));
  EXPECT_FALSE(fs::exists(folder / "frame_0001.hdf"));
  EXPECT_TRUE(fs::exists(folder / "frame_notes.hdf"));
}

TEST(FieldWriter, StoresUnitsWithoutSlashes) {
  EXPECT_EQ(stored_name("velocity [m/s]"), "velocity [m s-1]");
  EXPECT_EQ(stored_name("density [kg/m^3]"), "density [kg m-3]");
  EXPECT_EQ(stored_name("rate [1/s]"), "rate [s-1]");
  EXPECT_EQ(stored_name("power [J/m/s]"), "power [J m-1 s-1]");
  EXPECT_EQ(stored_name("displacement [m]"), "displacement [m]");
  EXPECT_THROW(stored_name("a / b"), std::logic_error);
  EXPECT_THROW(stored_name("../mesh"), std::logic_error);
}

TEST(FieldWriter, RefusesWhatIsNoNumberOrDoesNotFit) {
  const Scratch folder;
  FieldWriter writer(folder.path(), two_tets());
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), 1e39}) {
    auto broken = fields();
    broken[0].values[7] = bad;
    EXPECT_THAT(message_of<base::BreakdownError>([&] { writer.write(0, whole(broken)); }),
                HasSubstr("'velocity [m/s]' is " + std::string(bad > 0 ? "1e+39" : "nan") +
                          " at node 2, component 1"));
  }
  EXPECT_FALSE(fs::exists(folder / "frame_0000.hdf"));
  EXPECT_FALSE(fs::exists(folder / "frame_0000.hdf.tmp"));
  auto short_field = fields();
  short_field[1].values.pop_back();
  EXPECT_THROW(writer.write(0, whole(short_field)), std::logic_error);
}

TEST(FieldWriter, RefusesAMeshWhoseArraysDisagree) {
  const Scratch folder;
  const auto refuses = [&](auto change) {
    VisualMesh mesh = two_tets();
    change(mesh);
    EXPECT_THROW(FieldWriter(folder.path(), mesh), std::logic_error);
  };
  refuses([](VisualMesh& m) { m.connectivity[3] = 5; });
  refuses([](VisualMesh& m) { m.connectivity[3] = -1; });
  refuses([](VisualMesh& m) { m.offsets = {4, 8}; });
  refuses([](VisualMesh& m) { m.offsets = {0, 9, 8}; });
  refuses([](VisualMesh& m) { m.points.pop_back(); });
  refuses([](VisualMesh& m) { m = {}; });
}

TEST(ReadField, SaysWhatIsThere) {
  const Scratch folder;
  FieldWriter writer(folder.path(), two_tets());
  writer.write(0, whole(fields()));
  const std::string frame = folder / "frame_0000.hdf";
  EXPECT_THAT(message_of<base::InputError>([&] { read_field(frame, "veloctiy [m/s]"); }),
              HasSubstr("the frame has: jacobian [-], stress [Pa], velocity [m s-1]"));
  EXPECT_THAT(message_of<base::InputError>([&] { read_field(frame, "../x"); }),
              HasSubstr("no field"));
  EXPECT_THAT(message_of<base::InputError>([&] { read_field(folder / "mesh.hdf", "stress [Pa]"); }),
              HasSubstr("it is not a frame of a run"));
  EXPECT_THAT(message_of<base::EnvironmentError>([&] { read_field(folder / "none.hdf", "x"); }),
              testing::AllOf(HasSubstr("none.hdf"), HasSubstr("No such file or directory")));
  fs::resize_file(frame, fs::file_size(frame) / 2);
  EXPECT_THROW(read_field(frame, "stress [Pa]"), base::EnvironmentError);
}

TEST(ReadSeries, RefusesWhatIsNoIndex) {
  const Scratch folder;
  for (const char* text :
       {"", "{}", "{\"files\": []}", "{\"files\": [{\"name\": 3, \"time\": 0}]}"}) {
    write_file_atomically(folder / "run.hdf.series", text);
    EXPECT_THROW(read_series(folder / "run.hdf.series"), base::InputError) << text;
  }
}

TEST(FieldWriterDeathTest, AFullDiskIsAnErrorAndLeavesNoHalfOfAFrame) {
  const Scratch folder;
  const auto write_too_much = [&folder] {
    FieldWriter writer(folder.path(), two_tets());
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{1024, 1024};
    setrlimit(RLIMIT_FSIZE, &limit);
    try {
      writer.write(0, whole(fields()));
    } catch (const base::EnvironmentError& error) {
      fputs(error.what(), stderr);
      std::exit(4);
    }
    std::exit(0);
  };
  EXPECT_EXIT(write_too_much(), testing::ExitedWithCode(4),
              "bytes to .*frame_0000.hdf.*File too large");
  EXPECT_FALSE(fs::exists(folder / "frame_0000.hdf"));
  EXPECT_FALSE(fs::exists(folder / "frame_0000.hdf.tmp"));
  EXPECT_FALSE(fs::exists(folder / "run.hdf.series"));
}

}  // namespace
}  // namespace diptych::io
