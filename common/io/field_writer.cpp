/// VTKHDF 1.0 as VTK 9.1 and ParaView 5.11 read it: group /VTKHDF with the attributes Version and
/// Type, the three counts, Points, Connectivity, Offsets, Types, PointData and FieldData. mesh.hdf
/// is such a file of its own; a frame links the four mesh arrays to it. The index run.hdf.series is
/// ParaView's JSON list of files and times. (VTKHDF 2.0 keeps all times in one file, but these
/// versions cannot read it.) Test: tests/common/io/field_writer_test.cpp

#include "common/io/field_writer.hpp"

#include "common/base/error.hpp"
#include "common/base/text.hpp"
#include "common/io/atomic_file.hpp"
#include "common/io/hdf5_file.hpp"
#include "common/io/run_record.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>

namespace diptych::io {
namespace {

namespace fs = std::filesystem;

constexpr const char* root = "/VTKHDF";
constexpr const char* mesh_file = "mesh.hdf";
constexpr const char* series_file = "run.hdf.series";

std::string in_root(const std::string& name) {
  return fmt::format("{}/{}", root, name);
}

bool is_letter(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}
bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

void check_mesh(const VisualMesh& mesh) {
  const auto wrong = [](const std::string& what) {
    throw std::logic_error("visual mesh: " + what);
  };
  if (mesh.points.empty() || mesh.points.size() % 3 != 0) wrong("points must be [n][3], n > 0");
  if (mesh.types.empty()) wrong("it has no cells");
  if (mesh.offsets.size() != mesh.types.size() + 1) wrong("offsets must be [n_cells + 1]");
  if (mesh.offsets.front() != 0 ||
      mesh.offsets.back() != static_cast<std::int64_t>(mesh.connectivity.size())) {
    wrong("offsets must run from 0 to the length of the connectivity");
  }
  for (size_t i = 1; i < mesh.offsets.size(); ++i) {
    if (mesh.offsets[i] < mesh.offsets[i - 1]) wrong("offsets must not decrease");
  }
  const auto n_points = static_cast<std::int64_t>(mesh.points.size() / 3);
  for (const std::int64_t node : mesh.connectivity) {
    if (node < 0 || node >= n_points) wrong(fmt::format("a cell names node {}", node));
  }
}

void write_counts(Hdf5File& file, std::int64_t n_points, std::int64_t n_cells, std::int64_t n_ids) {
  constexpr int version[] = {1, 0};
  file.create_group(root);
  file.write_attribute(root, "Version", version);
  file.write_attribute(root, "Type", std::string("UnstructuredGrid"));
  file.write(in_root("NumberOfPoints"), std::span(&n_points, 1));
  file.write(in_root("NumberOfCells"), std::span(&n_cells, 1));
  file.write(in_root("NumberOfConnectivityIds"), std::span(&n_ids, 1));
}

/// Values as float32. What does not fit, or is no number, is a breakdown of the run and not a
/// colour in a picture.
/// @param first  number of the first node
std::vector<float> narrowed(const NodeField& field, std::int64_t first) {
  std::vector<float> values(field.values.size());
  for (size_t i = 0; i < values.size(); ++i) {
    values[i] = static_cast<float>(field.values[i]);
    if (!std::isfinite(values[i])) {
      throw base::BreakdownError(fmt::format(
          "field '{}' is {} at node {}, component {}; no frame was written", field.name,
          field.values[i], static_cast<size_t>(first) + i / static_cast<size_t>(field.n_components),
          i % static_cast<size_t>(field.n_components)));
    }
  }
  return values;
}

bool is_frame_name(const std::string& name) {
  const std::string digits = name.substr(0, name.size() < 4 ? 0 : name.size() - 4);
  return name.ends_with(".hdf") && digits.starts_with("frame_") && digits.size() >= 10 &&
         digits.find_first_not_of("0123456789", 6) == std::string::npos;
}

/// Frames of an earlier run here would point into the new mesh: they go, the index first.
void remove_frames(const std::string& directory, const std::set<std::string>& kept) {
  std::error_code failure;
  fs::remove(fs::path(directory) / series_file, failure);
  std::vector<fs::path> frames;
  if (!failure) {
    for (const auto& entry : fs::directory_iterator(directory, failure)) {
      const std::string name = entry.path().filename().string();
      if (is_frame_name(name) && kept.count(name) == 0) frames.push_back(entry.path());
    }
  }
  for (size_t i = 0; i < frames.size() && !failure; ++i)
    fs::remove(frames[i], failure);
  if (failure) {
    throw base::EnvironmentError(fmt::format(
        "cannot remove the frames of an earlier run in '{}': {}", directory, failure.message()));
  }
}

std::string frame_name(size_t index) {
  return fmt::format("frame_{:04}.hdf", index);
}

std::string series_json(const std::vector<double>& times) {
  nlohmann::ordered_json files = nlohmann::ordered_json::array();
  for (size_t i = 0; i < times.size(); ++i) {
    files.push_back({{"name", frame_name(i)}, {"time", times[i]}});
  }
  const nlohmann::ordered_json series = {{"file-series-version", "1.0"}, {"files", files}};
  return series.dump(2) + "\n";
}

/// "[m/s]" as "[m s-1]", "[1/s]" as "[s-1]"; nothing where "/" does not stand between units.
std::optional<std::string> name_with_powers(const std::string& name) {
  std::string result;
  for (size_t i = 0; i < name.size();) {
    if (name[i] != '/') {
      result += name[i++];
      continue;
    }
    const size_t unit = i + 1;
    size_t end = unit;
    while (end < name.size() && is_letter(name[end]))
      ++end;
    if (end == unit || result.empty() || !(is_letter(result.back()) || is_digit(result.back()))) {
      return std::nullopt;
    }
    size_t power = end < name.size() && name[end] == '^' ? end + 1 : end;
    size_t rest = power;
    while (rest < name.size() && is_digit(name[rest]))
      ++rest;
    if (result.ends_with("[1")) {
      result.pop_back();
    } else {
      result += ' ';
    }
    result += name.substr(unit, end - unit) + "-" +
              (rest > power ? name.substr(power, rest - power) : "1");
    i = rest;
  }
  return result;
}

}  // namespace

std::string stored_name(const std::string& name) {
  const std::optional<std::string> stored = name_with_powers(name);
  if (!stored)
    throw std::logic_error(fmt::format("field '{}': '/' must stand between units", name));
  return *stored;
}

void require_frames(const std::string& directory, const std::vector<double>& times) {
  for (size_t k = 0; k < times.size(); ++k) {
    const fs::path frame = fs::path(directory) / frame_name(k);
    std::error_code failure;
    if (!fs::is_regular_file(frame, failure)) {
      throw base::InputError(fmt::format(
          "{}: is missing; a run goes on where all of its frames until then are", frame.string()));
    }
  }
}

void keep_frames(const std::string& directory, const std::vector<double>& times) {
  require_frames(directory, times);
  std::set<std::string> kept;
  for (size_t k = 0; k < times.size(); ++k)
    kept.insert(frame_name(k));
  remove_frames(directory, kept);
  if (!times.empty())
    write_file_atomically((fs::path(directory) / series_file).string(), series_json(times));
}

FieldWriter::FieldWriter(std::string directory, const VisualMesh& mesh, std::vector<double> times)
    : directory_(std::move(directory)),
      n_points_(static_cast<std::int64_t>(mesh.points.size() / 3)),
      n_cells_(static_cast<std::int64_t>(mesh.types.size())),
      n_connectivity_(static_cast<std::int64_t>(mesh.connectivity.size())),
      times_(std::move(times)) {
  check_mesh(mesh);
  make_directory(directory_);
  keep_frames(directory_, times_);
  Hdf5File file = Hdf5File::create((fs::path(directory_) / mesh_file).string());
  write_counts(file, n_points_, n_cells_, n_connectivity_);
  file.write(in_root("Points"), std::span(mesh.points), 3);
  file.write(in_root("Connectivity"), std::span(mesh.connectivity), true);
  file.write(in_root("Offsets"), std::span(mesh.offsets), true);
  file.write(in_root("Types"), std::span(mesh.types), true);
  file.publish();
}

std::string FieldWriter::write(double time,
                               const FieldsOfNodes& fields,
                               std::span<const NamedValue> values) {
  if (!std::isfinite(time) || (!times_.empty() && time <= times_.back())) {
    throw std::logic_error(fmt::format("frames must follow in time: {} after {}", time,
                                       times_.empty() ? 0.0 : times_.back()));
  }
  const fs::path folder(directory_);
  const std::string path = (folder / frame_name(times_.size())).string();
  Hdf5File file = Hdf5File::create(path);
  write_counts(file, n_points_, n_cells_, n_connectivity_);
  for (const char* shared : {"Points", "Connectivity", "Offsets", "Types"}) {
    file.link(in_root(shared), mesh_file, in_root(shared));
  }
  file.create_group(in_root("PointData"));
  const std::int64_t at_once = nodes_at_once(n_points_);
  for (std::int64_t begin = 0; begin < n_points_; begin += at_once) {
    const std::int64_t end = std::min(n_points_, begin + at_once);
    for (const NodeField& field : fields(begin, end)) {
      const int n = field.n_components;
      if (n < 1 || static_cast<std::int64_t>(field.values.size()) != (end - begin) * n) {
        throw std::logic_error(fmt::format("field '{}' has {} values for {} nodes x {} components",
                                           field.name, field.values.size(), end - begin, n));
      }
      file.write_rows<float>(in_root("PointData/" + stored_name(field.name)),
                             narrowed(field, begin), n, begin, n_points_);
    }
  }
  file.create_group(in_root("FieldData"));
  file.write(in_root("FieldData/time"), std::span<const double>(&time, 1));
  for (const NamedValue& value : values) {
    file.write(in_root("FieldData/" + stored_name(value.name)),
               std::span<const double>(&value.value, 1));
  }
  file.publish();
  times_.push_back(time);
  write_file_atomically((folder / series_file).string(), series_json(times_));
  return path;
}

NodeField read_field(const std::string& frame_path, const std::string& name) {
  const Hdf5File file = Hdf5File::open_for_reading(frame_path);
  const std::string group = in_root("PointData");
  if (!file.contains(group)) {
    throw base::InputError(
        fmt::format("{}: no group {}; it is not a frame of a run", frame_path, group));
  }
  const std::string stored = name_with_powers(name).value_or(name);
  const std::vector<std::string> known = file.names(group);
  if (std::find(known.begin(), known.end(), stored) == known.end()) {
    throw base::InputError(
        fmt::format("{}: no field '{}'; the frame has: {}", frame_path, name, base::joined(known)));
  }
  const std::string path = group + "/" + stored;
  const std::vector<std::int64_t> shape = file.shape(path);
  if (shape.empty() || shape.size() > 2) {
    throw base::InputError(fmt::format("{}: field '{}' must have one or two dimensions, it has {}",
                                       frame_path, name, shape.size()));
  }
  return {name, shape.size() == 2 ? static_cast<int>(shape[1]) : 1, file.read_doubles(path)};
}

std::vector<FrameEntry> read_series(const std::string& series_path) {
  const std::string text = read_file(series_path);
  const fs::path folder = fs::path(series_path).parent_path();
  std::vector<FrameEntry> frames;
  try {
    const nlohmann::json series = nlohmann::json::parse(text);
    for (const nlohmann::json& file : series.at("files")) {
      frames.push_back(
          {(folder / file.at("name").get<std::string>()).string(), file.at("time").get<double>()});
    }
  } catch (const nlohmann::json::exception& error) {
    throw base::InputError(
        fmt::format("{}: not an index of frames: {}", series_path, error.what()));
  }
  if (frames.empty()) throw base::InputError(series_path + ": the index names no frame");
  return frames;
}

}  // namespace diptych::io
