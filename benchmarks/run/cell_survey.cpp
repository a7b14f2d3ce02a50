#include "benchmarks/run/cell_survey.hpp"

#include "common/parallel/sharing.hpp"
#include "common/scheme/body/node_chunks.hpp"
#include "meshes/cell_checks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace diptych::harness {

namespace {

using meshes::Mesh;

/// Cells that are shared at a time, so that no other rank has all of them.
constexpr std::int64_t together = 1 << 16;

/// Cells whose first node is of this part, with the numbers of nodes of the whole body.
void share_topology(const Mesh* whole, const parallel::Part& part, OwnCells& own) {
  parallel::Communicator& ranks = part.ranks();
  std::int64_t n = whole == nullptr ? 0 : whole->n_cells();
  parallel::share(ranks, n);
  std::vector<meshes::CellType> types;
  std::vector<std::int32_t> nodes;
  own.mesh.cell_offsets = {0};
  for (std::int64_t first = 0; first < n; first += together) {
    const std::int64_t end = std::min(n, first + together);
    if (whole != nullptr) {
      types.assign(whole->cell_types.begin() + first, whole->cell_types.begin() + end);
      nodes.assign(whole->cell_nodes.begin() + whole->cell_offsets[static_cast<size_t>(first)],
                   whole->cell_nodes.begin() + whole->cell_offsets[static_cast<size_t>(end)]);
    }
    parallel::share(ranks, types);
    parallel::share(ranks, nodes);
    auto at = nodes.begin();
    for (std::int64_t c = first; c < end; ++c) {
      const meshes::CellType type = types[static_cast<size_t>(c - first)];
      const auto next = at + meshes::n_nodes_of(type);
      if (part.owns(scheme::chunk_of_node(*at))) {
        own.cells.push_back(c);
        own.mesh.cell_types.push_back(type);
        own.mesh.cell_nodes.insert(own.mesh.cell_nodes.end(), at, next);
        own.mesh.cell_offsets.push_back(std::ssize(own.mesh.cell_nodes));
      }
      at = next;
    }
  }
}

/// Numbers the nodes of the cells anew, and brings their places.
void share_nodes(const Mesh* whole, parallel::Communicator& ranks, OwnCells& own) {
  own.nodes = own.mesh.cell_nodes;
  std::sort(own.nodes.begin(), own.nodes.end());
  own.nodes.erase(std::unique(own.nodes.begin(), own.nodes.end()), own.nodes.end());
  own.nodes.shrink_to_fit();
  for (std::int32_t& node : own.mesh.cell_nodes) {
    node = static_cast<std::int32_t>(std::lower_bound(own.nodes.begin(), own.nodes.end(), node) -
                                     own.nodes.begin());
  }
  own.mesh.nodes.reserve(own.nodes.size());
  auto next = own.nodes.begin();
  parallel::share_pieces(ranks, whole == nullptr ? nullptr : &whole->nodes,
                         [&](std::int64_t first, const std::vector<meshes::Vec3>& X) {
                           for (; next != own.nodes.end() && *next < first + std::ssize(X); ++next)
                             own.mesh.nodes.push_back(X[static_cast<size_t>(*next - first)]);
                         });
}

/// The order of an answer.
enum Place {
  J,
  n_inverted,
  cell,
  node,
  x,
  y,
  z,
  steps_left,
  n_folded,
  folded,
  folded_x,
  folded_y,
  folded_z,
  n_places
};

}  // namespace

OwnCells share_cells(const Mesh* whole, const parallel::Part& part) {
  OwnCells own;
  own.mesh.dimension = whole == nullptr ? 0 : whole->dimension;
  parallel::share(part.ranks(), own.mesh.dimension);
  share_topology(whole, part, own);
  share_nodes(whole, part.ranks(), own);
  return own;
}

CellSurvey::CellSurvey(const Mesh& mesh, const run::Solver& solver)
    : mesh_(mesh), reads_(solver.reads({})), deformed_(mesh) {}

CellSurvey::CellSurvey(OwnCells own, const run::Solver& solver)
    : own_(std::move(own)),
      mesh_(own_.mesh),
      reads_(solver.reads(std::move(own_.nodes))),
      deformed_(mesh_) {}

std::vector<double> CellSurvey::answer(const run::Solver& solver,
                                       std::span<const double> question) {
  const run::Motion motion = solver.motion(reads_);
  if (mesh_.n_cells() == 0) return {};
  const auto outlook = deformed_.outlook(motion.u, motion.v, question[0]);
  const bool is_whole = own_.cells.empty();
  const auto in_body = [&](std::int64_t c) {
    return static_cast<double>(is_whole ? c : own_.cells[static_cast<size_t>(c)]);
  };
  const auto c = outlook.now.cell;
  const std::int32_t first = mesh_.cell(c)[0];
  const meshes::Vec3 centre = meshes::centre_of(mesh_, c);
  std::vector<double> answer(n_places);
  answer[J] = outlook.now.J;
  answer[n_inverted] = static_cast<double>(outlook.now.n_inverted);
  answer[cell] = in_body(c);
  answer[node] = is_whole ? first : reads_.nodes[static_cast<size_t>(first)];
  for (int i = 0; i < 3; ++i)
    answer[x + i] = centre[i];
  answer[steps_left] = outlook.steps_left;
  if (outlook.now.n_folded == 0) return answer;
  answer[n_folded] = static_cast<double>(outlook.now.n_folded);
  answer[folded] = in_body(outlook.now.folded);
  const meshes::Vec3 fold = meshes::centre_of(mesh_, outlook.now.folded);
  for (int i = 0; i < 3; ++i)
    answer[folded_x + i] = fold[i];
  return answer;
}

run::CellOutlook outlook_of(const run::Answers& answers, std::int64_t n_cells) {
  run::CellOutlook all{{}, std::numeric_limits<double>::infinity()};
  const std::vector<double>*least = nullptr, *fold = nullptr;
  // what is not finite is the worst of all
  const auto is_worse = [](const std::vector<double>& one, const std::vector<double>& other) {
    const bool nan = std::isnan(one[J]), other_nan = std::isnan(other[J]);
    if (nan != other_nan) return nan;
    if (!nan && one[J] != other[J]) return one[J] < other[J];
    return one[cell] < other[cell];
  };
  for (const std::vector<double>& answer : answers) {
    if (answer.empty()) continue;
    all.now.n_inverted += static_cast<std::int64_t>(answer[n_inverted]);
    all.steps_left = std::min(all.steps_left, answer[steps_left]);
    if (least == nullptr || is_worse(answer, *least)) least = &answer;
    all.now.n_folded += static_cast<std::int64_t>(answer[n_folded]);
    if (answer[n_folded] > 0 && (fold == nullptr || answer[folded] < (*fold)[folded]))
      fold = &answer;
  }
  all.now.n_cells = n_cells;
  if (fold != nullptr) all.now.folded = {(*fold)[folded_x], (*fold)[folded_y], (*fold)[folded_z]};
  if (least == nullptr) return all;
  all.now.J = (*least)[J];
  all.now.centre = {(*least)[x], (*least)[y], (*least)[z]};
  all.now.node = static_cast<std::int32_t>((*least)[node]);
  return all;
}

}  // namespace diptych::harness
