#include "meshes/united_groups.hpp"

#include "common/base/error.hpp"
#include "common/base/text.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <utility>

namespace diptych::meshes {

std::string united_name(const std::vector<std::string>& names) {
  return fmt::format("{}", fmt::join(names, " + "));
}

void unite_overlapping(const std::vector<std::string>& names, Mesh& mesh) {
  if (names.size() < 2) return;
  BoundaryGroup all{united_name(names), {}};
  const BoundaryGroup* namesake = nullptr;
  for (const BoundaryGroup& group : mesh.boundary_groups) {
    if (group.name == all.name) namesake = &group;
    if (std::find(names.begin(), names.end(), group.name) != names.end())
      all.faces.insert(all.faces.end(), group.faces.begin(), group.faces.end());
  }
  std::sort(all.faces.begin(), all.faces.end());
  const auto end = std::unique(all.faces.begin(), all.faces.end());
  const bool overlap = end != all.faces.end();
  all.faces.erase(end, all.faces.end());
  if (namesake == nullptr) {
    if (overlap) mesh.boundary_groups.push_back(std::move(all));
    return;
  }
  std::vector<std::int32_t> faces = namesake->faces;
  std::sort(faces.begin(), faces.end());
  if (faces == all.faces) return;  // as it was added before
  throw base::InputError(fmt::format(
      "the mesh has a boundary group '{}', which is what the union of {} is called where they are "
      "given together: rename it",
      all.name, base::joined(names)));
}

}  // namespace diptych::meshes
