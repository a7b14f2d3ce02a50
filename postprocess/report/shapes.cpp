#include "postprocess/report/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

namespace diptych::report {
namespace {

using Point = std::array<double, 3>;
using Cube = std::array<std::int64_t, 3>;
using Face = std::array<std::int32_t, 4>;
using Json = nlohmann::ordered_json;

Cube cube_of(const Point& x, double size) {
  return {std::llround(std::floor(x[0] / size)), std::llround(std::floor(x[1] / size)),
          std::llround(std::floor(x[2] / size))};
}

double squared_distance(const Point& a, const Point& b) {
  return std::pow(a[0] - b[0], 2) + std::pow(a[1] - b[1], 2) + std::pow(a[2] - b[2], 2);
}

/// [n_points] the point that stands for each: of those in one cube the farthest from the middle of
/// the body, so that its edges and corners stay.
std::vector<std::int32_t> representatives(std::span<const Point> X,
                                          const Point& middle,
                                          double size) {
  std::map<Cube, std::int32_t> chosen;
  for (size_t a = 0; a < X.size(); ++a) {
    const auto number = static_cast<std::int32_t>(a);
    const auto [at, is_first] = chosen.emplace(cube_of(X[a], size), number);
    if (!is_first && squared_distance(X[a], middle) > squared_distance(X[at->second], middle))
      at->second = number;
  }
  std::vector<std::int32_t> result(X.size());
  for (size_t a = 0; a < X.size(); ++a)
    result[a] = chosen.at(cube_of(X[a], size));
  return result;
}

/// Side of the cubes, about the smallest with at most `limit` of them taken: doubled from where
/// more than `limit` lie along the longest side, then halved in ratio to within 5 %.
double fitting_size(std::span<const Point> X, double longest, size_t limit) {
  const auto fits = [&](double size) {
    std::set<Cube> cubes;
    for (const Point& x : X)
      cubes.insert(cube_of(x, size));
    return cubes.size() <= limit;
  };
  double fine = longest / static_cast<double>(limit), coarse = 2 * fine;
  for (; !fits(coarse); coarse *= 2)
    fine = coarse;
  while (coarse > 1.05 * fine) {
    const double middle = std::sqrt(fine * coarse);
    (fits(middle) ? coarse : fine) = middle;
  }
  return coarse;
}

/// The face on other points, without those that fall together; false where less than a triangle
/// is left.
bool collapsed(Face& face, const std::vector<std::int32_t>& standing) {
  std::vector<std::int32_t> corners;
  for (const std::int32_t point : face) {
    const std::int32_t p = standing[point];
    if (std::find(corners.begin(), corners.end(), p) == corners.end()) corners.push_back(p);
  }
  if (corners.size() < 3) return false;
  corners.resize(4, corners.back());
  std::copy(corners.begin(), corners.end(), face.begin());
  return true;
}

/// Smallest and largest of values; equal ones are set apart, so that a scale has a length.
struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  void widen(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  void close() {
    if (low > high) low = high = 0;
    if (low == high) high = low + (low == 0 ? 1 : std::abs(low));
  }
};

/// Values of all frames, one after the other; what is not finite becomes `otherwise`.
template <class OfFrame>
std::vector<double> joined(const ShapeRecord& record,
                           size_t n_frames,
                           double otherwise,
                           OfFrame values) {
  std::vector<double> all;
  for (size_t k = 0; k < n_frames; ++k) {
    for (const double value : values(record.frames[k]))
      all.push_back(std::isfinite(value) ? value : otherwise);
  }
  return all;
}

/// Distance of the two methods' nodes, all frames.
std::vector<double> distances(const ShapeRecord& a, const ShapeRecord& b, size_t n_frames) {
  const auto dimension = static_cast<size_t>(a.surface.dimension);
  std::vector<double> result;
  for (size_t k = 0; k < n_frames; ++k) {
    const std::vector<double>&x = a.frames[k].x, &y = b.frames[k].x;
    for (size_t p = 0; p + dimension <= x.size(); p += dimension) {
      double sum = 0;
      for (size_t i = 0; i < dimension; ++i)
        sum += std::pow(x[p + i] - y[p + i], 2);
      result.push_back(std::sqrt(sum));
    }
  }
  return result;
}

Json field_json(const std::string& name, const std::string& unit, const Range& range) {
  return {{"name", name}, {"unit", unit}, {"low", range.low}, {"high", range.high}};
}

/// What the 16 bits of positions and of each field span, for all methods and times.
struct Scales {
  Range box;  ///< one for all axes: keeps the proportions
  std::vector<Range> fields;
};

Scales scales_of(const std::map<std::string, ShapeRecord>& shapes, size_t n_frames) {
  Scales scales;
  scales.fields.resize(shapes.begin()->second.fields.size());
  for (const auto& [method, record] : shapes) {
    for (size_t k = 0; k < n_frames; ++k) {
      for (const double x : record.frames[k].x)
        scales.box.widen(x);
      for (size_t f = 0; f < scales.fields.size(); ++f) {
        for (const double value : record.frames[k].values[f])
          scales.fields[f].widen(value);
      }
    }
  }
  scales.box.close();
  for (Range& range : scales.fields)
    range.close();
  return scales;
}

Json method_json(const std::string& method,
                 const ShapeRecord& record,
                 size_t n_frames,
                 const Scales& scales) {
  Json entry = {{"name", method}};
  const auto x = joined(
      record, n_frames, scales.box.low,
      [](const ShapeFrame& frame) -> const auto& { return frame.x; });
  entry["positions"] = quantised(x, scales.box.low, scales.box.high);
  for (size_t f = 0; f < scales.fields.size(); ++f) {
    const Range& range = scales.fields[f];
    const auto values = joined(
        record, n_frames,
        range.low, [f](const ShapeFrame& frame) -> const auto& { return frame.values[f]; });
    entry["values"].push_back(quantised(values, range.low, range.high));
  }
  return entry;
}

Json difference_json(const ShapeRecord& a, const ShapeRecord& b, size_t n_frames) {
  const std::vector<double> apart = distances(a, b, n_frames);
  Range range;
  range.widen(0);
  for (const double value : apart)
    range.widen(value);
  range.close();
  Json field = field_json("distance of the nodes", "m", range);
  field["values"] = quantised(apart, range.low, range.high);
  return field;
}

std::string faces_text(const std::vector<Face>& faces) {
  std::vector<std::uint8_t> bytes;
  for (const Face& face : faces) {
    for (const std::int32_t point : face) {
      bytes.push_back(static_cast<std::uint8_t>(point & 0xff));
      bytes.push_back(static_cast<std::uint8_t>(point >> 8));
    }
  }
  return base64(bytes);
}

}  // namespace

Surface thinned(const Surface& surface, std::span<const Point> X, size_t limit) {
  if (surface.nodes.size() <= limit) return surface;
  Range sides[3];
  for (const Point& x : X) {
    for (int i = 0; i < 3; ++i)
      sides[i].widen(x[i]);
  }
  double longest = 0;
  Point middle{};
  for (size_t i = 0; i < 3; ++i) {
    longest = std::max(longest, sides[i].high - sides[i].low);
    middle[i] = 0.5 * (sides[i].low + sides[i].high);
  }
  std::vector<std::int32_t> standing = representatives(X, middle, fitting_size(X, longest, limit));
  const std::set<std::int32_t> kept(standing.begin(), standing.end());
  Surface result{surface.dimension, {}, {}, surface.n_points_of_mesh};
  std::vector<std::int32_t> new_number(X.size(), -1);
  for (const std::int32_t point : kept) {
    new_number[point] = static_cast<std::int32_t>(result.nodes.size());
    result.nodes.push_back(surface.nodes[point]);
  }
  for (std::int32_t& point : standing)
    point = new_number[point];
  std::set<Face> seen;
  for (Face face : surface.faces) {
    if (!collapsed(face, standing)) continue;
    Face corners = face;
    std::sort(corners.begin(), corners.end());
    if (seen.insert(corners).second) result.faces.push_back(face);
  }
  return result;
}

size_t frame_stride(size_t n_outputs, size_t n_points) {
  const size_t allowed =
      std::clamp(most_point_frames / std::max<size_t>(n_points, 1), size_t{2}, most_frames);
  if (n_outputs <= allowed) return 1;
  return (n_outputs - 1 + allowed - 2) / (allowed - 1);
}

std::string quantised(std::span<const double> values, double low, double high) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(2 * values.size());
  for (const double value : values) {
    const auto bits = static_cast<std::uint16_t>(std::lround((value - low) / (high - low) * 65535));
    bytes.push_back(static_cast<std::uint8_t>(bits & 0xff));
    bytes.push_back(static_cast<std::uint8_t>(bits >> 8));
  }
  return base64(bytes);
}

std::string base64(std::span<const std::uint8_t> bytes) {
  static const char* const letters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (size_t i = 0; i < bytes.size(); i += 3) {
    const size_t n = std::min<size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (size_t k = 0; k < 3; ++k)
      group = (group << 8) | (k < n ? bytes[i + k] : 0u);
    for (size_t k = 0; k < 4; ++k)
      text += k <= n ? letters[(group >> (18 - 6 * k)) & 63] : '=';
  }
  return text;
}

size_t n_common_frames(const std::map<std::string, ShapeRecord>& shapes) {
  if (shapes.empty() || shapes.begin()->second.surface.faces.empty()) return 0;
  size_t n_frames = shapes.begin()->second.frames.size();
  for (const auto& [method, record] : shapes)
    n_frames = std::min(n_frames, record.frames.size());
  return n_frames;
}

nlohmann::ordered_json shapes_json(const std::map<std::string, ShapeRecord>& shapes) {
  const size_t n_frames = n_common_frames(shapes);
  if (n_frames == 0) return nullptr;
  const ShapeRecord& first = shapes.begin()->second;
  for (const auto& [method, record] : shapes) {
    if (record.surface.nodes != first.surface.nodes)
      throw std::logic_error("shapes of different surfaces in one report");
  }
  const Scales scales = scales_of(shapes, n_frames);
  const Range& box = scales.box;
  Json result = {{"dimension", first.surface.dimension},
                 {"points", first.surface.nodes.size()},
                 {"low", box.low},
                 {"high", box.high},
                 {"faces", faces_text(first.surface.faces)}};
  for (size_t k = 0; k < n_frames; ++k)
    result["times"].push_back(first.frames[k].time);
  for (size_t f = 0; f < first.fields.size(); ++f)
    result["fields"].push_back(
        field_json(first.fields[f].name, first.fields[f].unit, scales.fields[f]));
  for (const auto& [method, record] : shapes)
    result["methods"].push_back(method_json(method, record, n_frames, scales));
  if (shapes.size() == 2) {
    result["difference"] = difference_json(first, std::next(shapes.begin())->second, n_frames);
  }
  return result;
}

}  // namespace diptych::report
