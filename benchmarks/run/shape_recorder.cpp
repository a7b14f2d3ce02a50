#include "benchmarks/run/shape_recorder.hpp"

#include "common/cases/stress_measures.hpp"

#include <algorithm>

namespace diptych::harness {

namespace {

/// A face of the mesh's nodes; a triangle repeats its last one.
std::array<std::int32_t, 4> face_of(std::span<const std::int32_t> nodes) {
  std::array<std::int32_t, 4> face{};
  for (size_t k = 0; k < 4; ++k)
    face[k] = nodes[std::min(k, nodes.size() - 1)];
  return face;
}

}  // namespace

report::Surface surface_of(const meshes::Mesh& mesh) {
  report::Surface surface;
  surface.dimension = mesh.dimension;
  if (mesh.dimension == 3) {
    for (const meshes::BoundaryFace& face : mesh.boundary_faces)
      surface.faces.push_back(face_of({face.nodes.data(), static_cast<size_t>(face.n_nodes)}));
  } else {
    for (std::int64_t c = 0; c < mesh.n_cells(); ++c)
      surface.faces.push_back(face_of(mesh.cell(c)));
  }
  std::vector<std::int32_t> point(mesh.nodes.size(), -1);
  for (const auto& face : surface.faces) {
    for (const std::int32_t node : face)
      point[node] = 0;
  }
  for (size_t a = 0; a < point.size(); ++a) {
    if (point[a] < 0) continue;
    point[a] = static_cast<std::int32_t>(surface.nodes.size());
    surface.nodes.push_back(static_cast<std::int32_t>(a));
  }
  for (auto& face : surface.faces) {
    for (std::int32_t& node : face)
      node = point[node];
  }
  surface.n_points_of_mesh = surface.nodes.size();
  return surface;
}

ShapeRecorder::ShapeRecorder(const meshes::Mesh& mesh, size_t n_outputs) : n_outputs_(n_outputs) {
  const report::Surface surface = surface_of(mesh);
  std::vector<std::array<double, 3>> X;
  for (const std::int32_t node : surface.nodes)
    X.push_back({mesh.nodes[node][0], mesh.nodes[node][1], mesh.nodes[node][2]});
  record_.surface = report::thinned(surface, X);
  record_.fields = {{"speed", "m/s"}, {"von Mises stress", "Pa"}, {"pressure", "Pa"}, {"J", "-"}};
  record_.n_outputs = n_outputs;
  stride_ = report::frame_stride(n_outputs, record_.surface.nodes.size());
  for (const std::int32_t node : record_.surface.nodes)
    X_.push_back(mesh.nodes[node]);
}

void ShapeRecorder::at_output(const run::Output& output) {
  const auto number = static_cast<size_t>(output.number);
  if (number % stride_ != 0 && number + 1 != n_outputs_) return;
  const run::Snapshot& state = output.state.fields();
  report::ShapeFrame frame;
  frame.time = state.time;
  frame.values.resize(record_.fields.size());
  for (size_t p = 0; p < X_.size(); ++p) {
    const std::int32_t a = record_.surface.nodes[p];
    const algebra::Vec3 x = X_[p] + state.u[a];
    for (int i = 0; i < record_.surface.dimension; ++i)
      frame.x.push_back(x[i]);
    frame.values[0].push_back(state.v[a].norm());
    const run::Mat3 sigma = cases::cauchy_stress(state.P[a], state.F[a], state.J[a]);
    frame.values[1].push_back(cases::von_mises(sigma));
    frame.values[2].push_back(cases::pressure(sigma));
    frame.values[3].push_back(state.J[a]);
  }
  record_.frames.push_back(std::move(frame));
}

}  // namespace diptych::harness
