/// The fields of a frame: names, units, components, numbering of the user's mesh, values by hand;
/// and what a run of each dimension writes.

#include "common/run/observers/fields.hpp"

#include "benchmarks/run/case_list.hpp"
#include "benchmarks/run/run_case.hpp"
#include "common/cases/reader.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <gmock/gmock.h>

namespace diptych::run {
namespace {

using testing::ElementsAre;

/// Two nodes: one at rest, one stretched to twice its length, 12 Pa on its undeformed area.
Snapshot two_nodes() {
  Snapshot s;
  s.u = {{0, 0, 0}, {1, 2, 3}};
  s.v = {{0, 0, 0}, {4, 5, 6}};
  s.F = {Mat3::Identity(), Eigen::Vector3d(2, 0.5, 0.5).asDiagonal()};
  s.P = {Mat3::Zero(), Mat3::Zero()};
  s.P[1](0, 0) = 12;
  s.P[1](0, 1) = 8;
  s.H = {Mat3::Identity(), Eigen::Vector3d(0.25, 1, 1).asDiagonal()};
  s.J = {1, 0.5};
  return s;
}

const io::NodeField& field(const std::vector<io::NodeField>& fields, const std::string& name) {
  for (const io::NodeField& one : fields) {
    if (one.name == name) return one;
  }
  throw std::out_of_range(name);
}

TEST(FrameFields, HaveNamesWithUnitsInOrder) {
  std::vector<std::string> names;
  for (const io::NodeField& one : frame_fields(two_nodes()))
    names.push_back(one.name);
  EXPECT_THAT(names, ElementsAre("displacement [m]", "velocity [m/s]", "deformation_gradient [-]",
                                 "first_piola_stress [Pa]", "cauchy_stress [Pa]",
                                 "von_mises_stress [Pa]", "jacobian [-]", "pressure [Pa]"));
}

// sigma = P F^T / J: 12 * 2 / 0.5 and 8 * 0.5 / 0.5, in the row of the first that is asked
TEST(FrameFields, AreThoseOfTheNodesThatAreAsked) {
  const std::vector<std::int32_t> nodes{1, 0};
  const auto fields = frame_fields(two_nodes().of(nodes));
  EXPECT_THAT(field(fields, "displacement [m]").values, ElementsAre(1, 2, 3, 0, 0, 0));
  EXPECT_THAT(field(fields, "velocity [m/s]").values, ElementsAre(4, 5, 6, 0, 0, 0));
  EXPECT_THAT(field(fields, "cauchy_stress [Pa]").values,
              ElementsAre(48, 8, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0));
  EXPECT_THAT(field(fields, "jacobian [-]").values, ElementsAre(0.5, 1));
  EXPECT_THAT(field(fields, "pressure [Pa]").values, ElementsAre(-16, 0));
  // sqrt(3/2 (32^2 + 16^2 + 16^2 + 8^2))
  EXPECT_DOUBLE_EQ(field(fields, "von_mises_stress [Pa]").values[0], std::sqrt(1.5 * 1600));
  EXPECT_EQ(field(fields, "von_mises_stress [Pa]").values[1], 0);
}

/// The von Mises stress of a frame is that of its Cauchy stress, and the pressure too.
/// @param renumbers  the solver numbers its nodes otherwise than the mesh
void expect_consistent_frame(const std::string& case_name, const char* end, bool renumbers) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("diptych-frame-" + case_name);
  std::filesystem::remove_all(folder);
  const cases::Case setup =
      cases::read_case(harness::find_case(case_name),
                       {"output.fields=true", "output.frames=1", std::string("time.end=") + end});
  harness::RunOptions options;
  options.directory = folder.string();
  options.quiet = true;
  const harness::RunResult run = harness::run_case(setup, options);
  const std::string frame = (folder / "frame_0001.hdf").string();
  const io::NodeField sigma = io::read_field(frame, "cauchy_stress [Pa]");
  const io::NodeField mises = io::read_field(frame, "von_mises_stress [Pa]");
  const io::NodeField p = io::read_field(frame, "pressure [Pa]");
  const io::NodeField u = io::read_field(frame, "displacement [m]");
  std::filesystem::remove_all(folder);
  ASSERT_EQ(sigma.n_components, 9);
  ASSERT_EQ(mises.values.size(), static_cast<size_t>(run.summary.nodes));
  double largest = 0;
  for (size_t a = 0; a < mises.values.size(); ++a) {
    const double* s = &sigma.values[9 * a];
    const double x = s[0] - s[4], y = s[4] - s[8], z = s[8] - s[0];
    const double shear = s[1] * s[1] + s[2] * s[2] + s[5] * s[5];
    const double by_hand = std::sqrt((x * x + y * y + z * z) / 2 + 3 * shear);
    // frames are float32: differences of stresses keep seven digits of the largest component
    const double rounding = 1e-6 * (std::abs(s[0]) + std::abs(s[4]) + std::abs(s[8]) + by_hand);
    ASSERT_NEAR(mises.values[a], by_hand, rounding) << a;
    ASSERT_NEAR(p.values[a], -(s[0] + s[4] + s[8]) / 3, rounding) << a;
    largest = std::max(largest, mises.values[a]);
  }
  EXPECT_GT(largest, 1e3) << "a body under load";
  EXPECT_EQ(std::is_sorted(run.order.begin(), run.order.end()), !renumbers);
  for (size_t a = 0; a < run.order.size(); ++a) {
    for (int i = 0; i < 3; ++i) {
      ASSERT_EQ(u.values[3 * static_cast<size_t>(run.order[a]) + static_cast<size_t>(i)],
                static_cast<float>(run.final_state.u[a][i]))
          << "node " << run.order[a] << " of the user's mesh";
    }
  }
}

TEST(FrameFields, OfARunInThreeDimensions) {
  expect_consistent_frame("bending-column", "0.05", false);
}
TEST(FrameFields, OfARunInPlaneStrain) {
  expect_consistent_frame("cooks-membrane", "0.02", true);
}

}  // namespace
}  // namespace diptych::run
