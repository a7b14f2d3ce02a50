/// What is embedded of the deformed bodies: bounded, true to 16 bits, on one scale.

#include "postprocess/report/shapes.hpp"

#include "tests/report/decoded.hpp"
#include "tests/report/sample_study.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>
#include <stdexcept>

namespace diptych::report {
namespace {

using test::words;

std::string base64_of(const std::string& text) {
  return base64({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

/// n x n squares of side 1/n, and where their corners are.
std::pair<Surface, std::vector<std::array<double, 3>>> sheet(int n) {
  Surface surface;
  std::vector<std::array<double, 3>> X;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      surface.nodes.push_back(static_cast<std::int32_t>(X.size()));
      X.push_back({i / double(n), j / double(n), 0});
      const std::int32_t a = j * (n + 1) + i;
      if (i < n && j < n) surface.faces.push_back({a, a + 1, a + n + 2, a + n + 1});
    }
  }
  surface.n_points_of_mesh = X.size();
  return {surface, X};
}

/// Area in the plane z = 0 by the shoelace rule.
double area(const Surface& surface, const std::vector<std::array<double, 3>>& X) {
  double sum = 0;
  for (const auto& face : surface.faces) {
    for (size_t k = 0; k < 4; ++k) {
      const auto &a = X[surface.nodes[face[k]]], &b = X[surface.nodes[face[(k + 1) % 4]]];
      sum += 0.5 * (a[0] * b[1] - a[1] * b[0]);
    }
  }
  return sum;
}

TEST(Base64, IsThatOfTheStandard) {  // RFC 4648, section 10
  EXPECT_EQ(base64_of(""), "");
  EXPECT_EQ(base64_of("f"), "Zg==");
  EXPECT_EQ(base64_of("fo"), "Zm8=");
  EXPECT_EQ(base64_of("foobar"), "Zm9vYmFy");
}

TEST(Quantised, ComesBackWithinHalfAStep) {
  std::vector<double> values;
  for (int i = 0; i <= 1000; ++i)
    values.push_back(-2 + 5 * std::pow(i / 1000.0, 3));
  const std::vector<int> back = words(quantised(values, -2, 3));
  ASSERT_EQ(back.size(), values.size());
  for (size_t i = 0; i < values.size(); ++i)
    EXPECT_NEAR(-2 + 5 * back[i] / 65535.0, values[i], 0.5001 * 5 / 65535) << i;
  EXPECT_EQ(back.front(), 0);
  EXPECT_EQ(back.back(), 65535);
}

TEST(Thinned, KeepsFewPointsAndTheShape) {
  const auto [fine, X] = sheet(120);
  const Surface coarse = thinned(fine, X, 500);
  EXPECT_LE(coarse.nodes.size(), 500u);
  EXPECT_GE(coarse.nodes.size(), 300u) << "coarser than it need be";
  EXPECT_EQ(coarse.n_points_of_mesh, 121u * 121u);
  EXPECT_NEAR(area(coarse, X), 1, 1e-12) << "the outermost points keep the edges";
  EXPECT_EQ(std::set(coarse.faces.begin(), coarse.faces.end()).size(), coarse.faces.size());
  for (const auto& face : coarse.faces) {
    for (const std::int32_t point : face)
      EXPECT_LT(static_cast<size_t>(point), coarse.nodes.size());
  }
  EXPECT_EQ(thinned(fine, X, 121 * 121).faces.size(), fine.faces.size());
}

TEST(FrameStride, KeepsPointsTimesInstantsInBounds) {
  for (const size_t n_points : {1u, 400u, 1000u, 3999u, 4000u}) {
    for (const size_t n_outputs : {2u, 11u, 151u, 1001u, 100001u}) {
      const size_t stride = frame_stride(n_outputs, n_points);
      const size_t kept = (n_outputs - 1 + stride - 1) / stride + 1;  // the last one always
      EXPECT_LE(kept * n_points, most_point_frames) << n_points << " " << n_outputs;
      EXPECT_LE(kept, most_frames);
      EXPECT_GE(kept, 2u);
    }
  }
}

TEST(ShapesJson, CarriesPositionsFieldsAndDistancesOnOneScale) {
  const auto shapes = test::sample_shapes(3, 4);
  const auto json = shapes_json(shapes);
  const ShapeRecord& fvm = shapes.at("fvm");
  ASSERT_EQ(json["methods"][0]["name"], "fvm");
  const double low = json["low"].get<double>(), high = json["high"].get<double>();
  const double step = (high - low) / 65535;
  const std::vector<int> x = words(json["methods"][0]["positions"].get<std::string>());
  const size_t n = fvm.frames[0].x.size();
  ASSERT_EQ(x.size(), 4 * n);
  for (size_t k = 0; k < 4; ++k) {
    for (size_t i = 0; i < n; ++i)
      EXPECT_NEAR(low + step * x[k * n + i], fvm.frames[k].x[i], 0.5001 * step);
  }
  // the sample's methods part along z by 0.01 m for each frame
  const std::vector<int> apart = words(json["difference"]["values"].get<std::string>());
  EXPECT_EQ(json["difference"]["low"], 0);
  EXPECT_NEAR(json["difference"]["high"].get<double>(), 0.03, 1e-12);
  EXPECT_EQ(apart.front(), 0);
  EXPECT_EQ(apart.back(), 65535);
  EXPECT_EQ(json["fields"][0]["unit"], "m/s");
  EXPECT_EQ(json["times"].size(), 4u);
}

TEST(ShapesJson, IsNothingWithoutShapesAndRefusesTwoSurfaces) {
  EXPECT_TRUE(shapes_json({}).is_null());
  std::map<std::string, ShapeRecord> blank;
  blank["sph"].n_outputs = 3;
  EXPECT_TRUE(shapes_json(blank).is_null());
  auto shapes = test::sample_shapes(3, 2);
  shapes["sph"].surface.nodes.pop_back();
  EXPECT_THROW(shapes_json(shapes), std::logic_error);
}

}  // namespace
}  // namespace diptych::report
