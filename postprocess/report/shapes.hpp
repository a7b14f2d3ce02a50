#pragma once
/// Deformed shapes over time as a report carries them: the surface that is drawn, thinned to a
/// bounded number of points and instants, with positions and fields in 16 bits as base64.
/// Test: tests/report/shapes_test.cpp

#include <array>
#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

namespace diptych::report {

/// What is drawn: the boundary faces of a body in 3-D, its cells in 2-D.
struct Surface {
  int dimension = 3;
  std::vector<std::int32_t> nodes;                 ///< [n_points] numbers of the mesh's nodes
  std::vector<std::array<std::int32_t, 4>> faces;  ///< of points; a triangle repeats its last one
  size_t n_points_of_mesh = 0;                     ///< before any thinning
};

struct ShapeField {
  std::string name, unit;
};

/// One instant of a surface.
struct ShapeFrame {
  double time = 0;                          ///< s
  std::vector<double> x;                    ///< [n_points][dimension] m, deformed positions
  std::vector<std::vector<double>> values;  ///< [field][n_points]
};

/// What a run leaves for the pictures.
struct ShapeRecord {
  Surface surface;
  std::vector<ShapeField> fields;
  std::vector<ShapeFrame> frames;
  size_t n_outputs = 0;  ///< output times of the run, of which the frames are some
};

/// Bounds of what is embedded: two methods, 3-D, four fields come to 40 bytes of text for a point
/// and an instant, 2.4 MB in all.
constexpr size_t most_points = 4000;
constexpr size_t most_point_frames = 60'000;
constexpr size_t most_frames = 121;

/// The surface on at most `limit` of its points: the outermost in each of equal cubes stands for
/// all in its cube; faces that collapse are left out.
/// @param X  [n_points] reference positions, m
Surface thinned(const Surface& surface,
                std::span<const std::array<double, 3>> X,
                size_t limit = most_points);

/// Every how many-th of n_outputs (the first included) is kept for n_points.
size_t frame_stride(size_t n_outputs, size_t n_points);

/// Values in [low, high] as 16-bit numbers, low byte first, in base64. @pre finite, in the range
std::string quantised(std::span<const double> values, double low, double high);

/// Bytes as base64 (RFC 4648).
std::string base64(std::span<const std::uint8_t> bytes);

/// Instants that all methods have; 0 where there is nothing to draw.
size_t n_common_frames(const std::map<std::string, ShapeRecord>& shapes);

/// Surface, instants and fields of all methods on one scale; where there are two, the distance
/// of their nodes besides. null where there is nothing to draw.
/// @throws std::logic_error on records of different surfaces
nlohmann::ordered_json shapes_json(const std::map<std::string, ShapeRecord>& shapes);

}  // namespace diptych::report
