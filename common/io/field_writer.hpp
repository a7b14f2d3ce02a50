#pragma once
/// Fields for ParaView and for reading back: VTKHDF 1.0, one .hdf per frame, topology stored once
/// in mesh.hdf and linked externally, index run.hdf.series. Each file is written under a temporary
/// name, closed, and renamed.

#include <algorithm>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace diptych::io {

/// Topology in VTK's terms (types: 5 triangle, 9 quad, 10 tet, 12 hexahedron, 13 wedge).
struct VisualMesh {
  std::vector<double> points;                       ///< [n][3] m, reference positions
  std::vector<std::int64_t> connectivity, offsets;  ///< offsets [n_cells + 1], the first is 0
  std::vector<std::uint8_t> types;                  ///< [n_cells]
};

/// A nodal field: name with unit as users read it ("velocity [m/s]"), values [n][n_components].
struct NodeField {
  std::string name;
  int n_components = 1;
  std::vector<double> values;
};
/// The fields of the nodes [begin, end) of the mesh: the same ones whatever the nodes.
using FieldsOfNodes = std::function<std::vector<NodeField>(std::int64_t begin, std::int64_t end)>;

/// A number of a frame, such as a probe: name with unit, value.
struct NamedValue {
  std::string name;
  double value = 0;
};

class FieldWriter {
 public:
  /// Writes DIR/mesh.hdf. Frames that stand in the folder are removed but for the first ones, as
  /// many as there are times: those that the run has written before a checkpoint.
  /// @param times  s, of these frames
  /// @throws base::InputError where one of them is not there; base::EnvironmentError
  FieldWriter(std::string directory, const VisualMesh& mesh, std::vector<double> times = {});
  /// Writes DIR/frame_NNNN.hdf (fields as float32; field data "time" and the values) and refreshes
  /// run.hdf.series. @return path of the frame
  /// @param fields  asked for some nodes after the other, so that none is whole in memory but in
  /// the
  ///                file
  std::string write(double time,
                    const FieldsOfNodes& fields,
                    std::span<const NamedValue> values = {});
  /// So many of n: not more than eight parts, since each may cost a sweep over the body.
  static std::int64_t nodes_at_once(std::int64_t n) {
    return std::max<std::int64_t>(1 << 16, (n + 7) / 8);
  }

 private:
  std::string directory_;
  std::int64_t n_points_, n_cells_, n_connectivity_;
  std::vector<double> times_;
};

/// A field read back from a frame, widened to double, with its number of components.
/// @throws base::InputError naming the fields the frame has
NodeField read_field(const std::string& frame_path, const std::string& name);

/// The name of a field inside the file. HDF5 names cannot hold "/", so units are stored in the
/// notation of CF and UDUNITS: "velocity [m/s]" as "velocity [m s-1]", "[kg/m^3]" as "[kg m-3]".
/// read_field takes either.
std::string stored_name(const std::string& name);

/// @throws base::InputError where one of the first frames, as many as there are times, is not there
void require_frames(const std::string& directory, const std::vector<double>& times);

/// Removes the frames of the folder but for the first ones, as many as there are times, and makes
/// the index anew. @throws base::EnvironmentError  and as require_frames does
void keep_frames(const std::string& directory, const std::vector<double>& times);

struct FrameEntry {
  std::string path;
  double time = 0;  ///< s
};

/// The frames named by DIR/run.hdf.series, in order, with paths that start like series_path.
std::vector<FrameEntry> read_series(const std::string& series_path);

}  // namespace diptych::io
