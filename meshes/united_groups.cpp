#include "meshes/united_groups.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <utility>

namespace diptych::meshes {

std::string united_name(const std::vector<std::string>& names) {
  return fmt::format("{}", fmt::join(names, " + "));
}

void unite_overlapping(const std::vector<std::string>& names, Mesh& mesh) {
  BoundaryGroup all{united_name(names), {}};
  for (const BoundaryGroup& group : mesh.boundary_groups) {
    if (group.name == all.name) return;
    if (std::find(names.begin(), names.end(), group.name) != names.end())
      all.faces.insert(all.faces.end(), group.faces.begin(), group.faces.end());
  }
  std::sort(all.faces.begin(), all.faces.end());
  const auto end = std::unique(all.faces.begin(), all.faces.end());
  if (end == all.faces.end()) return;
  all.faces.erase(end, all.faces.end());
  mesh.boundary_groups.push_back(std::move(all));
}

}  // namespace diptych::meshes
